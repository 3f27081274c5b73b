// Shapes to geometry with keys over the shutter. See compiler.h.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/compiler.h"
#include "render/shade_services.h"

namespace lightsieve {
namespace {

Vec3f blend_points(const Vec3f& a, const Vec3f& b, float t) { return a * (1 - t) + b * t; }

Shutter shutter_of(const RenderSettings& s) { return {s.shutter_start, s.shutter_end}; }

bool shows_nothing(const TriangleMesh& g) { return g.indices.empty() || g.positions.empty(); }
bool shows_nothing(const SphereList& g) { return g.radii.empty() || g.centers.empty(); }
bool shows_nothing(const CurveList& g) { return g.segments.empty(); }
bool shows_nothing(const PointList& g) { return g.index.empty(); }
bool shows_nothing(const SimpleShape& /*g*/) { return false; }

std::vector<float> blend_numbers(const std::vector<float>& a, const std::vector<float>& b,
                                 float t) {
    std::vector<float> out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        out[i] = std::lerp(a[i], b[i], t);
    return out;
}

/// What options say about subdivision.
struct FinenessLimits {
    bool none = false;  ///< ignore_subdivision
    std::int32_t most = 255;
    NodeRef dicing_camera;  ///< of meshes that name none
};

/// The parameters of a shape after what options say about subdivision: a copy if they differ from what is written.
class LimitedBlock {
  public:
    LimitedBlock(const NodeInstance& node, const FinenessLimits& limits) : block_(node.block()) {
        const ParamInfo* steps = node.type().find("subdiv_iterations");
        const ParamInfo* camera = node.type().find("subdiv_dicing_camera");
        if (steps == nullptr || camera == nullptr) return;
        copy_.resize(node.type().block_size / sizeof(Unit) + 1);
        std::memcpy(copy_.data(), block_, node.type().block_size);
        auto* bytes = reinterpret_cast<std::byte*>(copy_.data());
        auto* n = reinterpret_cast<std::uint8_t*>(bytes + steps->offset);
        *n = static_cast<std::uint8_t>(std::clamp(limits.none ? 0 : limits.most, 0, int{*n}));
        auto* ref = reinterpret_cast<NodeRef*>(bytes + camera->offset);
        if (!*ref) *ref = limits.dicing_camera;
        block_ = bytes;
    }
    [[nodiscard]] const void* get() const { return block_; }

  private:
    struct alignas(16) Unit {
        std::byte bytes[16];
    };
    const void* block_;
    std::vector<Unit> copy_;
};

}  // namespace

void Compiler::make_shapes() {
    for (const auto& node : graph_.nodes())
        if (node->kind() == NodeKind::Shape && node->type().shape_common != nullptr)
            place_all(*node);
}

std::unique_ptr<ShapeGeometry> Compiler::geometry_of(const NodeInstance& node) {
    if (node.type().make_geometry == nullptr) return nullptr;
    CompileContext context(*this, &node, node.name());
    const FinenessLimits limits{option("ignore_subdivision", false),
                                option<std::int32_t>("max_subdivisions", 255),
                                option<NodeRef>("subdiv_dicing_camera", {})};
    const LimitedBlock block(node, limits);
    std::unique_ptr<ShapeGeometry> geometry = node.type().make_geometry(block.get(), context);
    if (!geometry || geometry->instance_of || geometry->instances != nullptr) return geometry;
    if (std::visit([](const auto& g) { return shows_nothing(g); }, geometry->data)) return nullptr;
    displace(node, *geometry);
    return geometry;
}

void Compiler::resample_motion(ShapeGeometry& geometry, MotionRange range) const {
    const Shutter shutter = shutter_of(scene_->settings);
    const auto resample = [&](std::vector<std::vector<Vec3f>>& keys) {
        if (keys.size() < 2) return;
        keys = keys_over_shutter<std::vector<Vec3f>>(
            keys, range, shutter,
            [](const std::vector<Vec3f>& a, const std::vector<Vec3f>& b, float t) {
                std::vector<Vec3f> out(a.size());
                for (std::size_t i = 0; i < a.size(); ++i)
                    out[i] = blend_points(a[i], b[i], t);
                return out;
            });
    };
    const auto resample_numbers = [&](std::vector<std::vector<float>>& keys) {
        if (keys.size() > 1)
            keys = keys_over_shutter<std::vector<float>>(keys, range, shutter, blend_numbers);
    };
    if (auto* mesh = std::get_if<TriangleMesh>(&geometry.data)) {
        resample(mesh->positions);
        resample(mesh->normals);
    } else if (auto* spheres = std::get_if<SphereList>(&geometry.data)) {
        resample(spheres->centers);
    } else if (auto* curves = std::get_if<CurveList>(&geometry.data)) {
        resample(curves->points);
        resample_numbers(curves->radii);
        resample_numbers(curves->own_radii);
    } else if (auto* points = std::get_if<PointList>(&geometry.data)) {
        resample(points->centers);
        resample_numbers(points->radii);
        resample_numbers(points->own_radii);
    }
}

const ShapeGeometry* Compiler::shared_geometry(const NodeInstance& node) {
    if (const auto known = geometry_by_node_.find(&node); known != geometry_by_node_.end())
        return known->second;
    std::unique_ptr<ShapeGeometry> geometry = geometry_of(node);
    const ShapeCommon& common = *node.type().shape_common(node.block());
    if (geometry) resample_motion(*geometry, {common.motion_start, common.motion_end});
    const ShapeGeometry* out = geometry.get();
    scene_->services->prepare(node);
    if (geometry) scene_->geometries.push_back(std::move(geometry));
    return geometry_by_node_[&node] = out;
}

}  // namespace lightsieve
