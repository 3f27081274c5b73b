// polymesh: polygons of any number of corners, made into triangles here.
//
// Files come from everywhere, so every count and index is checked before it is used. What makes the mesh meaningless
// is an error at the parameter; what can be left out is a warning. Subdivision and displacement are not done yet: the
// control mesh is shown, with a warning.
#include <fmt/format.h>

#include <numeric>
#include <unordered_map>

#include "nodes/common/polygon.h"
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class SubdivType : std::int32_t { None, Catclark, Linear };
enum class SubdivMetric : std::int32_t { Auto, EdgeLength, Flatness };
enum class SubdivSpace : std::int32_t { Raster, Object };
enum class UvSmoothing : std::int32_t { PinCorners, PinBorders, Linear, Smooth };

struct Polymesh : ShapeNode {
    Array<std::uint32_t> nsides, vidxs, nidxs, uvidxs, crease_idxs, polygon_holes;
    Array<Vec3f> vlist, nlist;
    Array<Vec2f> uvlist;
    Array<std::uint8_t> shidxs;
    Array<float> crease_sharpness;
    bool smoothing = false;
    SubdivType subdiv_type = SubdivType::None;
    std::uint8_t subdiv_iterations = 1;
    float subdiv_adaptive_error = 0;
    SubdivMetric subdiv_adaptive_metric = SubdivMetric::Auto;
    SubdivSpace subdiv_adaptive_space = SubdivSpace::Raster;
    UvSmoothing subdiv_uv_smoothing = UvSmoothing::PinCorners;
    bool subdiv_smooth_derivs = false, subdiv_frustum_ignore = false;
    NodeRef subdiv_dicing_camera;
    float disp_height = 1, disp_padding = 0, disp_zero_value = 0;
    bool disp_autobump = false;
    std::uint8_t autobump_visibility = 1;
    bool use_shadow_terminator_fix = false;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const;
};

void describe_later(Describe<Polymesh>& d) {
    d.param("subdiv_type", &Polymesh::subdiv_type,
            "Subdivision scheme; not supported yet: the control mesh is shown.")
        .names({"none", "catclark", "linear"});
    d.param("subdiv_iterations", &Polymesh::subdiv_iterations,
            "Steps of subdivision; acts with subdiv_type.")
        .ignored();
    d.param("subdiv_adaptive_error", &Polymesh::subdiv_adaptive_error,
            "Error at which subdivision stops, 0 for all steps; acts with subdiv_type.")
        .ignored();
    d.param("subdiv_adaptive_metric", &Polymesh::subdiv_adaptive_metric,
            "Measure of that error; acts with subdiv_type.")
        .names({"auto", "edge_length", "flatness"})
        .ignored();
    d.param("subdiv_adaptive_space", &Polymesh::subdiv_adaptive_space,
            "Space of that error; acts with subdiv_type.")
        .names({"raster", "object"})
        .ignored();
    d.param("subdiv_uv_smoothing", &Polymesh::subdiv_uv_smoothing,
            "Subdivision of uv; acts with subdiv_type.")
        .names({"pin_corners", "pin_borders", "linear", "smooth"})
        .ignored();
    d.param("subdiv_smooth_derivs", &Polymesh::subdiv_smooth_derivs,
            "Smooth tangents; acts with subdiv_type.")
        .ignored();
    d.param("subdiv_frustum_ignore", &Polymesh::subdiv_frustum_ignore,
            "Subdivides unseen parts too; acts with subdiv_type.")
        .ignored();
    d.param("subdiv_dicing_camera", &Polymesh::subdiv_dicing_camera,
            "Camera for adaptive subdivision; acts with subdiv_type.")
        .ignored();
    d.param("crease_idxs", &Polymesh::crease_idxs,
            "Pairs of vertices: creased edges; act with subdiv_type.")
        .ignored();
    d.param("crease_sharpness", &Polymesh::crease_sharpness,
            "Sharpness of each crease; acts with subdiv_type.")
        .ignored();
    d.param("disp_map", &ShapeCommon::disp_map,
            "Shader that moves the surface; not supported yet: the mesh is shown as it is.");
    d.param("disp_height", &Polymesh::disp_height,
            "Factor on the displacement; acts with disp_map.")
        .ignored();
    d.param("disp_padding", &Polymesh::disp_padding, "Largest displacement; acts with disp_map.")
        .ignored();
    d.param("disp_zero_value", &Polymesh::disp_zero_value,
            "Value of disp_map that moves nothing; acts with disp_map.")
        .ignored();
    d.param("disp_autobump", &Polymesh::disp_autobump,
            "Fine displacement as bump; acts with disp_map.")
        .ignored();
    d.param("autobump_visibility", &Polymesh::autobump_visibility,
            "Ray types that see that bump; acts with disp_map.")
        .ignored();
    d.param("use_shadow_terminator_fix", &Polymesh::use_shadow_terminator_fix,
            "Arnold's cure for shadows of coarse meshes.")
        .ignored();
}

NodeType Polymesh::describe() {
    Describe<Polymesh> d("polymesh", NodeKind::Shape, "A mesh of polygons.");
    describe_shape_common(d);
    d.param("nsides", &Polymesh::nsides, "Corners of each polygon; left out, all are triangles.");
    d.param("vidxs", &Polymesh::vidxs, "Vertex of each polygon corner.");
    d.param("nidxs", &Polymesh::nidxs, "Normal of each polygon corner; left out, as vidxs.");
    d.param("uvidxs", &Polymesh::uvidxs,
            "Texture coordinate of each polygon corner; left out, as vidxs.");
    d.param("shidxs", &Polymesh::shidxs, "Shader of each polygon, a number into `shader`.");
    d.param("vlist", &Polymesh::vlist, "Vertices, object space; one list a motion key.")
        .unit("scene units");
    d.param("nlist", &Polymesh::nlist,
            "Normals, object space; one list a motion key. They act with `smoothing`.");
    d.param("uvlist", &Polymesh::uvlist, "Texture coordinates.");
    d.param("polygon_holes", &Polymesh::polygon_holes,
            "Pairs of polygons: a hole, and the polygon that it is cut from.");
    d.param("smoothing", &Polymesh::smoothing,
            "Shades with nlist, or with averaged normals where there is none; off: with the "
            "polygons' own.");
    describe_later(d);
    return d.done();
}

/// Builds the triangles of one polymesh; `ok` turns false with the first error.
class MeshBuilder {
  public:
    MeshBuilder(const Polymesh& mesh, NodeContext& context) : mesh_(mesh), context_(context) {}

    std::unique_ptr<ShapeGeometry> build() {
        warn_pending();
        find_faces();
        check_indices(mesh_.vidxs, "vidxs", mesh_.vlist.n, "vlist");
        check_finite(mesh_.vlist, "vlist");
        check_shaders();
        find_holes();
        if (!ok_) return nullptr;
        if (n_faces() == 0) warning("the mesh has no polygons", "vidxs", "");
        split_faces();
        add_normals();
        add_uvs();
        if (!ok_) return nullptr;
        for (std::uint32_t k = 0; k < mesh_.vlist.n_keys; ++k)
            out_.positions.emplace_back(mesh_.vlist.key(k).begin(), mesh_.vlist.key(k).end());
        auto geometry = std::make_unique<ShapeGeometry>();
        geometry->data = std::move(out_);
        return geometry;
    }

  private:
    [[nodiscard]] std::size_t n_faces() const { return first_corner_.size() - 1; }
    [[nodiscard]] std::size_t n_corners() const { return first_corner_.back(); }

    void error(std::string message, const char* param, std::string hint = {}) {
        ok_ = false;
        context_.diagnostics().error(Code::BadMesh, std::move(message), context_.where(param),
                                     std::move(hint));
    }
    void warning(std::string message, const char* param, std::string hint) {
        context_.diagnostics().warning(Code::BadMesh, std::move(message), context_.where(param),
                                       std::move(hint));
    }

    void warn_pending() {
        if (mesh_.subdiv_type != SubdivType::None && mesh_.subdiv_iterations > 0)
            context_.diagnostics().warning(
                Code::ParamPending, "subdivision is not supported yet: the control mesh is shown",
                context_.where("subdiv_type"), "subdivide in the program that wrote the scene");
        for (const NodeRef& map : mesh_.disp_map.first_key())
            if (map)
                context_.diagnostics().warning(
                    Code::ParamPending,
                    "displacement is not supported yet: the mesh is shown without it",
                    context_.where("disp_map"), "displace in the program that wrote the scene");
    }

    /// Where each polygon's corners start in vidxs.
    void find_faces() {
        first_corner_ = {0};
        const std::size_t n = mesh_.vidxs.n;
        if (mesh_.nsides.empty()) {
            if (n % 3 != 0)
                return error(
                    fmt::format("vidxs has {} entries, which is no number of triangles", n),
                    "vidxs", "without nsides every polygon is a triangle");
            for (std::size_t i = 3; i <= n; i += 3)
                first_corner_.push_back(static_cast<std::uint32_t>(i));
            return;
        }
        std::size_t total = 0;
        first_corner_.reserve(mesh_.nsides.n + 1);
        for (const std::uint32_t sides : mesh_.nsides.first_key()) {
            total += sides;
            if (total > n) break;
            first_corner_.push_back(static_cast<std::uint32_t>(total));
        }
        if (total > n)
            return error(fmt::format("nsides asks for more corners than the {} of vidxs", n),
                         "nsides", "the sum of nsides must be the length of vidxs");
        if (total < n)
            warning(fmt::format("vidxs has {} entries but nsides uses only {}", n, total), "vidxs",
                    "the sum of nsides must be the length of vidxs; the rest is left out");
    }

    void check_indices(const Array<std::uint32_t>& indices, const char* param,
                       std::size_t n_values, const char* list) {
        const auto all = indices.first_key();
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i] >= n_values)
                return error(fmt::format("entry {} of {} is {}, but {} has {} entries", i, param,
                                         all[i], list, n_values),
                             param,
                             fmt::format("indices run from 0 to the length of {} less one", list));
    }

    void check_finite(const Array<Vec3f>& values, const char* param) {
        for (std::size_t i = 0; i < std::size_t{values.n} * values.n_keys; ++i)
            if (!is_finite(values[i]))
                return error(fmt::format("entry {} of {} is not finite", i, param), param,
                             "replace nan and inf in the scene");
    }

    void check_shaders() {
        if (mesh_.shidxs.empty()) return;
        const auto all = mesh_.shidxs.first_key();
        if (ok_ && all.size() != n_faces())
            return error(
                fmt::format("shidxs has {} entries for {} polygons", all.size(), n_faces()),
                "shidxs");
        const std::size_t n = std::max<std::size_t>(1, mesh_.shader.n);
        for (const std::uint8_t index : all)
            if (index >= n)
                return warning(
                    fmt::format("shidxs asks for shader {}, but there are {}", index, n), "shidxs",
                    "such polygons get the first shader");
    }

    /// Which polygons are holes, and of which.
    void find_holes() {
        const auto pairs = mesh_.polygon_holes.first_key();
        if (pairs.size() % 2 != 0)
            return error("polygon_holes has an odd number of entries", "polygon_holes",
                         "it lists pairs: hole, outer polygon");
        is_hole_.assign(n_faces(), false);
        for (std::size_t i = 0; i < pairs.size(); i += 2) {
            const std::uint32_t hole = pairs[i], outer = pairs[i + 1];
            if (hole >= n_faces() || outer >= n_faces() || hole == outer)
                return error(fmt::format("polygon_holes pairs {} with {}, of {} polygons", hole,
                                         outer, n_faces()),
                             "polygon_holes", "each pair names two different polygons");
            holes_[outer].push_back(hole);
            is_hole_[hole] = true;
        }
    }

    [[nodiscard]] std::span<const std::uint32_t> ring(std::uint32_t face) const {
        return std::span(corners_).subspan(first_corner_[face],
                                           first_corner_[face + 1] - first_corner_[face]);
    }

    void split_faces() {
        corners_.resize(n_corners());
        std::iota(corners_.begin(), corners_.end(), 0U);
        std::size_t n_skipped = 0;
        std::vector<std::span<const std::uint32_t>> rings;
        for (std::uint32_t face = 0; face < n_faces() && ok_; ++face) {
            if (is_hole_[face]) continue;
            if (ring(face).size() < 3) {
                ++n_skipped;
                continue;
            }
            rings.assign(1, ring(face));
            if (const auto found = holes_.find(face); found != holes_.end())
                for (const std::uint32_t hole : found->second)
                    rings.push_back(ring(hole));
            split(face, rings);
        }
        if (n_skipped > 0)
            warning(fmt::format("{} polygons with fewer than 3 corners were left out", n_skipped),
                    "nsides", "");
        const auto points = mesh_.vidxs.first_key();
        out_.indices.reserve(out_.corner.size());
        for (const std::uint32_t corner : out_.corner)
            out_.indices.push_back(points[corner]);
    }

    void split(std::uint32_t face, std::span<const std::span<const std::uint32_t>> rings) {
        switch (triangulator_.split(rings, mesh_.vidxs.first_key(), mesh_.vlist.first_key(),
                                    out_.corner)) {
            case PolygonResult::Done: break;
            case PolygonResult::HoleOutside:
                warning(fmt::format("polygon {} has a hole that does not lie in it", face),
                        "polygon_holes", "the hole is left out");
                break;
            case PolygonResult::TooLarge:
                ok_ = false;
                context_.diagnostics().error(
                    Code::LimitPolygon,
                    fmt::format("polygon {} is concave and has {} corners", face,
                                ring(face).size()),
                    context_.where("nsides"),
                    fmt::format("the limit kMaxConcaveCorners is {}; triangulate such polygons "
                                "before export",
                                kMaxConcaveCorners));
                break;
        }
        out_.face.resize(out_.corner.size() / 3, face);
        if (!mesh_.shidxs.empty()) out_.shader_index.resize(out_.face.size(), mesh_.shidxs[face]);
    }

    /// Index list of one triangle corner each: `indices` of the corners, or vidxs where there are none.
    std::vector<std::uint32_t> corner_values(const Array<std::uint32_t>& indices,
                                             const char* param, std::size_t n_values,
                                             const char* list) {
        const Array<std::uint32_t>& used = indices.empty() ? mesh_.vidxs : indices;
        if (used.n < n_corners()) {
            error(fmt::format("{} has {} entries for {} polygon corners", param, used.n,
                              n_corners()),
                  param);
            return {};
        }
        check_indices(used, indices.empty() ? "vidxs" : param, n_values, list);
        if (!ok_) return {};
        std::vector<std::uint32_t> out;
        out.reserve(out_.corner.size());
        for (const std::uint32_t corner : out_.corner)
            out.push_back(used[corner]);
        return out;
    }

    void add_normals() {
        if (!mesh_.smoothing || !ok_) return;
        if (mesh_.nlist.empty()) return average_normals();
        check_finite(mesh_.nlist, "nlist");
        out_.normal_indices = corner_values(mesh_.nidxs, "nidxs", mesh_.nlist.n, "nlist");
        for (std::uint32_t k = 0; k < mesh_.nlist.n_keys; ++k)
            out_.normals.emplace_back(mesh_.nlist.key(k).begin(), mesh_.nlist.key(k).end());
    }

    /// Normals at the vertices: the sum of the triangles' normals, by area.
    void average_normals() {
        for (std::uint32_t k = 0; k < mesh_.vlist.n_keys; ++k) {
            const auto p = mesh_.vlist.key(k);
            std::vector<Vec3f> sums(p.size());
            for (std::size_t t = 0; t < out_.indices.size(); t += 3) {
                const std::uint32_t a = out_.indices[t], b = out_.indices[t + 1],
                                    c = out_.indices[t + 2];
                const Vec3f n = cross(p[b] - p[a], p[c] - p[a]);
                sums[a] += n;
                sums[b] += n;
                sums[c] += n;
            }
            for (Vec3f& n : sums)
                n = normalize(n);
            out_.normals.push_back(std::move(sums));
        }
        out_.normal_indices = out_.indices;
    }

    void add_uvs() {
        if (mesh_.uvlist.empty() || !ok_) return;
        out_.uv_indices = corner_values(mesh_.uvidxs, "uvidxs", mesh_.uvlist.n, "uvlist");
        const auto all = mesh_.uvlist.first_key();
        out_.uvs.assign(all.begin(), all.end());
        bool finite = true;
        for (Vec2f& uv : out_.uvs) {
            if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
            finite = false;
            uv = {};
        }
        if (!finite)
            warning("uvlist holds values that are not finite", "uvlist", "they are taken as 0 0");
    }

    const Polymesh& mesh_;
    NodeContext& context_;
    bool ok_ = true;
    TriangleMesh out_;
    Triangulator triangulator_;
    std::vector<std::uint32_t> first_corner_;  ///< of each polygon in vidxs, and the end
    std::vector<std::uint32_t> corners_;       ///< 0, 1, 2, ...: rings are parts of it
    std::vector<bool> is_hole_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> holes_;  ///< by outer polygon
};

std::unique_ptr<ShapeGeometry> Polymesh::make_geometry(NodeContext& context) const {
    return MeshBuilder(*this, context).build();
}

}  // namespace

NodeType node_polymesh() { return Polymesh::describe(); }

}  // namespace lightsieve
