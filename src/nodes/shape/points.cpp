// points: particles as disks, spheres or quads.
//
// Disks and quads turn to whatever looks at them. Points that cannot be drawn (no radius, numbers that are not finite)
// are left out and counted; the others keep their numbers, by which user data are found.
#include <fmt/format.h>

#include <cmath>

#include "nodes/common/pixel_width.h"
#include "nodes/shape/shape_checks.h"
#include "nodes/shape/shape_common.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

enum class Mode : std::int32_t { Disk, Sphere, Quad };

struct Points : ShapeNode {
    Array<Vec3f> points;
    Array<float> radius, aspect, rotation;
    Mode mode = Mode::Disk;
    float min_pixel_width = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const;
};

NodeType Points::describe() {
    Describe<Points> d("points", NodeKind::Shape, "Particles: disks, spheres or quads.");
    describe_shape_common(d);
    d.param("points", &Points::points, "Where they are, object space; one list a motion key.")
        .unit("scene units");
    d.param("radius", &Points::radius,
            "Radius, half the width of quads: one for all or one a point; may have motion keys.")
        .unit("scene units");
    d.param(
         "mode", &Points::mode,
         "disk: flat and round, turned to the viewer; sphere; quad: flat, turned to the viewer.")
        .names({"disk", "sphere", "quad"});
    d.param("aspect", &Points::aspect,
            "Width of quads by their height: one for all or one a point; 1.");
    d.param("rotation", &Points::rotation,
            "Turn of quads, counter-clockwise as seen: one for all or one a point; 0.")
        .unit("degrees");
    d.param("min_pixel_width", &Points::min_pixel_width,
            "Points smaller than that on the picture are widened to it and as much more "
            "transparent; 0: none.")
        .unit("pixels")
        .range(0, 1);
    return d.done();
}

/// Where the camera's upward direction points, world space.
Vec3f camera_up(NodeContext& context) {
    const NodeInstance* camera = context.camera();
    if (camera == nullptr) return {0, 1, 0};
    const auto* matrix = camera->find<Array<Mat4f>>("matrix");
    if (matrix != nullptr && !matrix->empty()) return (*matrix)[0].vector({0, 1, 0});
    const auto* up = camera->find<Array<Vec3f>>("up");
    return up != nullptr && !up->empty() ? (*up)[0] : Vec3f{0, 1, 0};
}

/// Builds the particles of one node.
class PointBuilder {
  public:
    PointBuilder(const Points& node, NodeContext& context)
        : node_(node),
          context_(context),
          pixel_width_(node.min_pixel_width, node.matrix, context) {}

    std::unique_ptr<ShapeGeometry> build() {
        out_.mode = static_cast<PointList::Mode>(node_.mode);
        check_counts();
        for (std::uint32_t k = 0; k < n_keys(); ++k) {
            out_.centers.emplace_back();
            out_.radii.emplace_back();
            if (pixel_width_.acts()) out_.own_radii.emplace_back();
        }
        for (std::uint32_t i = 0; i < node_.points.n; ++i)
            add(i);
        if (out_.own_radii == out_.radii) out_.own_radii.clear();
        if (out_.mode == PointList::Mode::Quad) find_up();
        report_left_out();
        auto geometry = std::make_unique<ShapeGeometry>();
        geometry->data = std::move(out_);
        return geometry;
    }

  private:
    [[nodiscard]] std::uint32_t n_keys() const {
        return std::max({1U, node_.points.n_keys, n_radii() > 0 ? node_.radius.n_keys : 0U});
    }
    [[nodiscard]] std::uint32_t n_radii() const { return node_.radius.n; }

    void warning(std::string message, const char* param, std::string hint) {
        context_.diagnostics().warning(Code::BadMesh, std::move(message), context_.where(param),
                                       std::move(hint));
    }

    void check_counts() {
        const auto check = [&](const Array<float>& values, const char* param) {
            if (values.n <= 1 || values.n == node_.points.n) return;
            warning(
                fmt::format("{} has {} entries for {} points", param, values.n, node_.points.n),
                param, "one for all or one a point; the first is taken for those without");
        };
        check(node_.radius, "radius");
        if (node_.mode == Mode::Quad) {
            check(node_.aspect, "aspect");
            check(node_.rotation, "rotation");
        }
        if (node_.radius.empty() && node_.points.n > 0)
            warning("the points have no radius: they show nothing", "radius", "write a radius");
        if (node_.points.n_keys > 1 && node_.radius.n_keys > 1 &&
            node_.points.n_keys != node_.radius.n_keys)
            warning(fmt::format("radius has {} motion keys, points has {}", node_.radius.n_keys,
                                node_.points.n_keys),
                    "radius", "the first key is taken for all");
    }

    /// One value of a point, of one for all, or `fallback`.
    static float value(const Array<float>& values, std::uint32_t key, std::uint32_t i,
                       float fallback) {
        const auto all = values.key(std::min(key, std::max(values.n_keys, 1U) - 1));
        if (all.empty()) return fallback;
        return all[i < all.size() ? i : 0];
    }

    [[nodiscard]] float radius(std::uint32_t key, std::uint32_t i) const {
        return value(node_.radius, node_.radius.n_keys == n_keys() ? key : 0, i, 0);
    }
    [[nodiscard]] Vec3f center(std::uint32_t key, std::uint32_t i) const {
        return node_.points.key(node_.points.n_keys == n_keys() ? key : 0)[i];
    }

    /// Whether a point can be drawn; if not, counts why.
    [[nodiscard]] bool usable(std::uint32_t i) {
        float widest = 0;
        for (std::uint32_t k = 0; k < n_keys(); ++k) {
            const Vec3f c = center(k, i);
            const float r = radius(k, i);
            const float most = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z), r});
            if (!is_finite(c) || !std::isfinite(r) || most > kLargestCoordinate) {
                ++n_not_finite_;
                return false;
            }
            widest = std::max(widest, r);
        }
        if (widest > 0) return true;
        ++n_small_;
        return false;
    }

    void add(std::uint32_t i) {
        if (!usable(i)) return;
        out_.index.push_back(i);
        for (std::uint32_t k = 0; k < n_keys(); ++k) {
            const Vec3f c = center(k, i);
            const float r = std::max(radius(k, i), 0.0F);
            out_.centers[k].push_back(c);
            out_.radii[k].push_back(pixel_width_.acts() ? pixel_width_.widened(c, r) : r);
            if (pixel_width_.acts()) out_.own_radii[k].push_back(r);
        }
        if (out_.mode != PointList::Mode::Quad) return;
        const float aspect = value(node_.aspect, 0, i, 1),
                    rotation = value(node_.rotation, 0, i, 0);
        constexpr float kMostAspect = 1e4F;
        const bool odd =
            !(aspect >= 1 / kMostAspect && aspect <= kMostAspect) || !std::isfinite(rotation);
        if (odd) ++n_odd_;
        out_.aspect.push_back(odd ? 1 : aspect);
        out_.rotation_rad.push_back(odd ? 0 : deg_to_rad(rotation));
    }

    /// Quads stand upright for the camera.
    void find_up() {
        const Mat4f world_from_object = node_.matrix.empty() ? Mat4f{} : node_.matrix[0];
        out_.up = normalize(world_from_object.inverse().vector(camera_up(context_)), {0, 1, 0});
    }

    void report_left_out() {
        if (n_not_finite_ > 0)
            warning(fmt::format("{} points have a place or radius that is not finite, or too "
                                "large, and were left out",
                                n_not_finite_),
                    "points", "replace nan and inf in the scene");
        if (n_small_ > 0 && !node_.radius.empty())
            warning(fmt::format("{} points have no radius above 0 and were left out", n_small_),
                    "radius", "negative radii count as 0");
        if (n_odd_ > 0)
            warning(fmt::format("{} points have an impossible aspect or rotation", n_odd_),
                    "aspect", "they are shown as upright squares");
    }

    const Points& node_;
    NodeContext& context_;
    PixelWidth pixel_width_;
    PointList out_;
    std::size_t n_not_finite_ = 0, n_small_ = 0, n_odd_ = 0;
};

std::unique_ptr<ShapeGeometry> Points::make_geometry(NodeContext& context) const {
    return PointBuilder(*this, context).build();
}

}  // namespace

NodeType node_points() { return Points::describe(); }

}  // namespace lightsieve
