// polymesh: polygons of any number of corners, made into triangles here.
//
// Files come from everywhere, so every count and index is checked before it is used. What makes the mesh meaningless
// is an error at the parameter; what can be left out is a warning. Subdivision is done here, evenly over the whole mesh;
// displacement, which needs shaders, is done by the renderer (render/compile_displacement.cpp).
#include <fmt/format.h>

#include <numeric>
#include <unordered_map>

#include "nodes/common/polygon.h"
#include "nodes/common/refined_mesh.h"
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class SubdivType : std::int32_t { None, Catclark, Linear };
enum class SubdivMetric : std::int32_t { Auto, EdgeLength, Flatness };
enum class SubdivSpace : std::int32_t { Raster, Object };

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

void describe_subdivision(Describe<Polymesh>& d) {
    d.param("subdiv_type", &Polymesh::subdiv_type,
            "Subdivision: catclark is smooth, linear only cuts finer.")
        .names({"none", "catclark", "linear"});
    d.param("subdiv_iterations", &Polymesh::subdiv_iterations,
            "Steps of subdivision, at most that many with subdiv_adaptive_error. Each makes four "
            "quads of one.");
    d.param("subdiv_adaptive_error", &Polymesh::subdiv_adaptive_error,
            "Error below which no more steps are made, the same number for the whole mesh; 0: all "
            "steps.");
    d.param("subdiv_adaptive_metric", &Polymesh::subdiv_adaptive_metric,
            "What that error is: the longest edge, or the distance to the smooth surface; auto: "
            "edges if the mesh is displaced.")
        .names({"auto", "edge_length", "flatness"});
    d.param("subdiv_adaptive_space", &Polymesh::subdiv_adaptive_space,
            "Whether that error is in pixels or in object space.")
        .names({"raster", "object"});
    d.param("subdiv_uv_smoothing", &Polymesh::subdiv_uv_smoothing,
            "How texture coordinates are subdivided: borders of islands keep their corners, keep "
            "their place, everything is linear, or everything is smooth.")
        .names({"pin_corners", "pin_borders", "linear", "smooth"});
    d.param("subdiv_smooth_derivs", &Polymesh::subdiv_smooth_derivs,
            "Tangents that turn smoothly; here they are those of the refined quads.")
        .pending();
    d.param("subdiv_frustum_ignore", &Polymesh::subdiv_frustum_ignore,
            "Subdivides unseen parts too; here they always are.")
        .ignored();
    d.param("subdiv_dicing_camera", &Polymesh::subdiv_dicing_camera,
            "Camera whose pixels subdiv_adaptive_error counts; none: the one of the frame.");
    d.param("crease_idxs", &Polymesh::crease_idxs,
            "Pairs of vertices: edges that stay sharp. The same vertex twice stays pointed.");
    d.param("crease_sharpness", &Polymesh::crease_sharpness,
            "For how many steps each crease stays sharp; 10 and more: for all.");
}

void describe_displacement(Describe<Polymesh>& d) {
    d.param("disp_map", &ShapeCommon::disp_map,
            "Shader that moves the vertices: a number (the mean of a colour) along the normal, a "
            "vector by itself, in object space. Several are chosen from by shidxs.");
    d.param("disp_height", &Polymesh::disp_height, "Factor on the displacement.");
    d.param("disp_padding", &Polymesh::disp_padding,
            "Largest displacement, which is not needed here: everything is moved before rays are "
            "traced.")
        .unit("scene units")
        .ignored();
    d.param("disp_zero_value", &Polymesh::disp_zero_value,
            "Value of disp_map that moves nothing.");
    d.param("disp_autobump", &Polymesh::disp_autobump,
            "What of the displacement is finer than the mesh shows as bumps.");
    d.param("autobump_visibility", &Polymesh::autobump_visibility,
            "Ray types (as for visibility) that see those bumps.");
    d.param("use_shadow_terminator_fix", &Polymesh::use_shadow_terminator_fix,
            "Arnold's cure for shadows of coarse meshes; subdivide instead.")
        .pending();
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
    describe_subdivision(d);
    describe_displacement(d);
    return d.done();
}

/// Builds the triangles of one polymesh; `ok` turns false with the first error.
class MeshBuilder {
  public:
    MeshBuilder(const Polymesh& mesh, NodeContext& context) : mesh_(mesh), context_(context) {}

    std::unique_ptr<ShapeGeometry> build() {
        find_faces();
        check_indices(mesh_.vidxs, "vidxs", mesh_.vlist.n, "vlist");
        check_finite(mesh_.vlist, "vlist");
        check_shaders();
        find_holes();
        if (!ok_) return nullptr;
        if (n_faces() == 0) warning("the mesh has no polygons", "vidxs", "");
        const int levels = subdivision_levels();
        if (!ok_) return nullptr;
        if (levels > 0)
            refine(levels);
        else
            make_triangles();
        if (!ok_) return nullptr;
        add_displacement();
        auto geometry = std::make_unique<ShapeGeometry>();
        geometry->data = std::move(out_);
        return geometry;
    }

  private:
    void make_triangles() {
        split_faces();
        report_skipped();
        add_normals();
        add_uvs();
        if (!ok_) return;
        for (std::uint32_t k = 0; k < mesh_.vlist.n_keys; ++k)
            out_.positions.emplace_back(mesh_.vlist.key(k).begin(), mesh_.vlist.key(k).end());
    }

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

    /// Tells the renderer how disp_map acts, if there is one.
    void add_displacement() {
        const auto maps = mesh_.disp_map.first_key();
        if (std::none_of(maps.begin(), maps.end(), [](const NodeRef& map) { return bool(map); }))
            return;
        for (const auto& [param, value] : {std::pair{"disp_height", mesh_.disp_height},
                                           std::pair{"disp_zero_value", mesh_.disp_zero_value}})
            if (!std::isfinite(value))
                return warning(std::string(param) + " is not finite", param,
                               "the mesh is not displaced");
        if (mesh_.disp_height == 0) return;
        out_.displacement = Displacement{mesh_.disp_height, mesh_.disp_zero_value,
                                         mesh_.disp_autobump, mesh_.autobump_visibility};
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
        n_skipped_ = 0;
        for (std::uint32_t face = 0; face < n_faces() && ok_; ++face) {
            if (is_hole_[face]) continue;
            if (ring(face).size() < 3)
                ++n_skipped_;
            else
                split_polygon(face);
        }
        const auto points = mesh_.vidxs.first_key();
        out_.indices.reserve(out_.corner.size());
        for (const std::uint32_t corner : out_.corner)
            out_.indices.push_back(points[corner]);
    }

    void report_skipped() {
        if (n_skipped_ > 0)
            warning(fmt::format("{} polygons with fewer than 3 corners were left out", n_skipped_),
                    "nsides", "");
    }

    void split_polygon(std::uint32_t face) {
        rings_.assign(1, ring(face));
        if (const auto found = holes_.find(face); found != holes_.end())
            for (const std::uint32_t hole : found->second)
                rings_.push_back(ring(hole));
        switch (triangulator_.split(rings_, mesh_.vidxs.first_key(), mesh_.vlist.first_key(),
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

    /// `indices` of the polygons' corners, or vidxs where there are none; null, with a report, if they do not fit.
    const Array<std::uint32_t>* checked(const Array<std::uint32_t>& indices, const char* param,
                                        std::size_t n_values, const char* list) {
        const Array<std::uint32_t>& used = indices.empty() ? mesh_.vidxs : indices;
        if (used.n < n_corners()) {
            error(fmt::format("{} has {} entries for {} polygon corners", param, used.n,
                              n_corners()),
                  param);
            return nullptr;
        }
        check_indices(used, indices.empty() ? "vidxs" : param, n_values, list);
        return ok_ ? &used : nullptr;
    }

    /// The same for one triangle corner each.
    std::vector<std::uint32_t> corner_values(const Array<std::uint32_t>& indices,
                                             const char* param, std::size_t n_values,
                                             const char* list) {
        const Array<std::uint32_t>* used = checked(indices, param, n_values, list);
        std::vector<std::uint32_t> out;
        if (used == nullptr) return out;
        out.reserve(out_.corner.size());
        for (const std::uint32_t corner : out_.corner)
            out.push_back((*used)[corner]);
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
        copy_uvs();
    }

    void copy_uvs() {
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

    // Subdivision.

    /// How often to subdivide; 0: not at all.
    int subdivision_levels() {
        if (mesh_.subdiv_type == SubdivType::None || mesh_.subdiv_iterations == 0) return 0;
        make_cage();
        if (!ok_ || cage_.first_corner.size() < 2) return 0;
        FinenessRule rule;
        rule.error = std::isfinite(mesh_.subdiv_adaptive_error) ? mesh_.subdiv_adaptive_error : 0;
        const bool displaced = !mesh_.disp_map.empty() && mesh_.disp_map[0];
        rule.by_edges = mesh_.subdiv_adaptive_metric == SubdivMetric::EdgeLength ||
                        (mesh_.subdiv_adaptive_metric == SubdivMetric::Auto && displaced);
        std::optional<DicingView> view;
        if (rule.error > 0 && mesh_.subdiv_adaptive_space == SubdivSpace::Raster) {
            const NodeInstance* camera =
                mesh_.subdiv_dicing_camera ? mesh_.subdiv_dicing_camera.node : context_.camera();
            rule.view = &view.emplace(camera, context_.frame());
            if (!mesh_.matrix.empty()) rule.world_from_object = mesh_.matrix[0];
        }
        const int wanted =
            levels_needed(cage_, mesh_.vlist.first_key(), rule, mesh_.subdiv_iterations);
        int levels = wanted;
        while (levels > 0 && n_refined_quads(cage_.first_corner, levels) > kMaxRefinedQuads)
            --levels;
        if (levels < wanted)
            context_.diagnostics().warning(
                Code::LimitMemory,
                fmt::format("{} steps of subdivision would make {:.3g} quads; {} are made", wanted,
                            n_refined_quads(cage_.first_corner, wanted), levels),
                context_.where("subdiv_iterations"),
                fmt::format("the limit kMaxRefinedQuads is {:.3g} quads a mesh; fewer steps, or a "
                            "subdiv_adaptive_error, save memory",
                            kMaxRefinedQuads));
        return levels;
    }

    /// The polygons; those with holes as triangles, and corners that repeat their neighbour's vertex left out.
    void make_cage() {
        corners_.resize(n_corners());
        std::iota(corners_.begin(), corners_.end(), 0U);
        cage_.first_corner = {0};
        for (std::uint32_t face = 0; face < n_faces() && ok_; ++face) {
            if (is_hole_[face]) continue;
            if (holes_.contains(face)) {
                add_triangles_with_holes(face);
            } else if (!add_to_cage(face, ring(face))) {
                ++n_skipped_;
            }
        }
        cage_.n_vertices = mesh_.vlist.n;
        cage_.linear = mesh_.subdiv_type == SubdivType::Linear;
        cage_.uv_smoothing = mesh_.subdiv_uv_smoothing;
        if (ok_) add_creases();
    }

    bool add_to_cage(std::uint32_t polygon, std::span<const std::uint32_t> corners) {
        const std::size_t first = cage_.vertex.size();
        for (const std::uint32_t corner : corners) {
            const std::uint32_t vertex = mesh_.vidxs[corner];
            if (cage_.vertex.size() > first && cage_.vertex.back() == vertex) continue;
            cage_.corner.push_back(corner);
            cage_.vertex.push_back(vertex);
        }
        while (cage_.vertex.size() > first + 1 && cage_.vertex.back() == cage_.vertex[first]) {
            cage_.corner.pop_back();
            cage_.vertex.pop_back();
        }
        if (cage_.vertex.size() < first + 3) {
            cage_.corner.resize(first);
            cage_.vertex.resize(first);
            return false;
        }
        cage_.first_corner.push_back(static_cast<std::uint32_t>(cage_.vertex.size()));
        polygon_.push_back(polygon);
        return true;
    }

    void add_triangles_with_holes(std::uint32_t face) {
        split_polygon(face);
        for (std::size_t i = 0; i + 2 < out_.corner.size(); i += 3)
            add_to_cage(face, std::span(out_.corner).subspan(i, 3));
        out_.corner.clear();
        out_.face.clear();
        out_.shader_index.clear();
    }

    void add_creases() {
        const auto pairs = mesh_.crease_idxs.first_key();
        const auto sharpness = mesh_.crease_sharpness.first_key();
        std::size_t n_wrong = pairs.size() % 2;
        for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
            const std::size_t which = sharpness.size() == 1 ? 0 : i / 2;
            const float s = which < sharpness.size() ? sharpness[which] : kInfinity;
            if (pairs[i] >= mesh_.vlist.n || pairs[i + 1] >= mesh_.vlist.n || std::isnan(s)) {
                ++n_wrong;
                continue;
            }
            cage_.creases.push_back({pairs[i], pairs[i + 1], std::clamp(s, 0.0F, kSharpest)});
        }
        if (n_wrong > 0)
            warning(
                fmt::format("{} of {} entries of crease_idxs name no vertex or have no "
                            "sharpness",
                            n_wrong, pairs.size()),
                "crease_idxs",
                fmt::format("indices run from 0 to {}; such creases are left out", mesh_.vlist.n));
        if (sharpness.size() > 1 && sharpness.size() != pairs.size() / 2)
            warning(fmt::format("crease_sharpness has {} entries for {} creases", sharpness.size(),
                                pairs.size() / 2),
                    "crease_sharpness", "creases without one stay sharp for all steps");
    }

    void refine(int levels) {
        report_skipped();
        cage_.levels = levels;
        RefinedMeshInput input;
        if (!mesh_.uvlist.empty()) {
            const Array<std::uint32_t>* uv =
                checked(mesh_.uvidxs, "uvidxs", mesh_.uvlist.n, "uvlist");
            if (uv == nullptr) return;
            for (const std::uint32_t corner : cage_.corner)
                cage_.uv.push_back((*uv)[corner]);
            cage_.n_uvs = mesh_.uvlist.n;
            copy_uvs();
        }
        input.smooth = mesh_.smoothing;
        // Smooth surfaces have normals of their own. Flat ones keep what they had.
        TriangleMesh flat;
        if (mesh_.smoothing && cage_.linear) {
            split_faces();
            add_normals();
            if (!ok_) return;
            flat = std::move(out_);
            out_ = {};
            out_.uvs = std::move(flat.uvs);
            for (const auto& key : flat.normals)
                input.normals.emplace_back(key);
            const bool own = !mesh_.nlist.empty() && !mesh_.nidxs.empty();
            input.normal_of_corner = (own ? mesh_.nidxs : mesh_.vidxs).first_key();
        }
        for (std::uint32_t k = 0; k < mesh_.vlist.n_keys; ++k)
            input.positions.push_back(mesh_.vlist.key(k));
        input.shader_of_polygon = mesh_.shidxs.first_key();
        const std::vector<Vec2f> uvs = std::move(out_.uvs);
        input.uvs = uvs;
        input.cage = std::move(cage_);
        input.polygon = std::move(polygon_);
        std::optional<TriangleMesh> refined = refined_mesh(input);
        if (!refined)
            return error("the mesh cannot be subdivided", "subdiv_type",
                         "no vertex or polygon may have more than 65535 edges");
        out_ = std::move(*refined);
    }

    static constexpr float kSharpest = 10;  ///< OpenSubdiv's: sharp for ever

    const Polymesh& mesh_;
    NodeContext& context_;
    bool ok_ = true;
    TriangleMesh out_;
    Triangulator triangulator_;
    std::vector<std::uint32_t> first_corner_;  ///< of each polygon in vidxs, and the end
    std::vector<std::uint32_t> corners_;       ///< 0, 1, 2, ...: rings are parts of it
    std::vector<bool> is_hole_;
    std::vector<std::span<const std::uint32_t>> rings_;  ///< of the polygon that is being split
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> holes_;  ///< by outer polygon
    std::size_t n_skipped_ = 0;  ///< polygons with fewer than 3 corners
    SubdivisionCage cage_;
    std::vector<std::uint32_t> polygon_;  ///< of each face of the cage
};

std::unique_ptr<ShapeGeometry> Polymesh::make_geometry(NodeContext& context) const {
    return MeshBuilder(*this, context).build();
}

}  // namespace

NodeType node_polymesh() { return Polymesh::describe(); }

}  // namespace lightsieve
