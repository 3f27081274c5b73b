// flakes: normals of small flat flakes under a surface, for metallic paint. Arnold's own pattern is private: other flakes.
//
// With `depth` a ray goes on below the surface, refracted, through layers `step` apart; the first flake that it meets counts.
#include "core/sampling.h"
#include "nodes/bump/bump_common.h"
#include "nodes/texture/cells.h"
#include "nodes/texture/coord_space.h"

namespace lightsieve {
namespace {

enum class OutputSpace : std::int32_t { World, Tangent };

struct Flakes : SolidPlace {
    float scale = 0.1F, density = 0.5F, step = 0, depth = 0, IOR = 1.52F, normal_randomize = 0.5F;
    OutputSpace output_space = OutputSpace::World;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;
};

NodeType Flakes::describe() {
    Describe<Flakes> d("flakes", NodeKind::Shader,
                       "Normals of flakes under a surface; alpha says where there are any.");
    d.param("scale", &Flakes::scale, "Size of a flake.").unit("scene units");
    d.param("density", &Flakes::density, "Part of the surface that flakes cover.").range(0, 1);
    d.param("step", &Flakes::step, "Distance between layers; acts with depth.")
        .unit("scene units");
    d.param("depth", &Flakes::depth, "How deep flakes lie; 0: on the surface.")
        .unit("scene units");
    d.param("IOR", &Flakes::IOR, "Index of refraction of what they lie in.");
    d.param("normal_randomize", &Flakes::normal_randomize,
            "How far flakes lean: 0: they lie flat.")
        .range(0, 1);
    describe_solid_place(d);
    d.param("output_space", &Flakes::output_space, "Space of the normal.")
        .names({"world", "tangent"});
    return d.done();
}

Rgba Flakes::eval(const ShadePoint& at) const {
    const Vec3f n = outward_normal(at, {});
    const Frame frame = tangent_frame(at, n, {});
    const auto shown = [&](Vec3f world, float alpha) {
        const Vec3f v = output_space == OutputSpace::World ? world : frame.local_from_world(world);
        return Rgba{{v.x, v.y, v.z}, alpha};
    };
    constexpr int kMostLayers = 64;
    const int layers =
        depth > 0 && step > 0
            ? static_cast<int>(std::clamp(depth / step, 1.0F, static_cast<float>(kMostLayers)))
            : 1;
    // Refracted, a ray goes more steeply down.
    const float cosine = std::abs(dot(n, at.wo)), bent = IOR > 0 ? IOR : 1;
    const float below = safe_sqrt(1 - (1 - cosine * cosine) / (bent * bent));
    const Vec3f side = normalize(n * dot(n, at.wo) - at.wo, {});
    const Vec3f way = side * (safe_sqrt(1 - below * below)) - n * below;
    ShadePoint point = at;
    for (int layer = 0; layer < layers; ++layer) {
        point.position = at.position + way * (step * static_cast<float>(layer));
        const CellPoint cell = cell_at(place(point) * (1 / std::fmax(scale, 1e-6F)), 1);
        const auto random = [&](std::uint32_t i) {
            return unit_from_bits(mixed_bits(cell.id, i));
        };
        if (random(20) >= unit(density)) continue;
        const Vec3f lean =
            frame.world_from_local(sample_cosine_hemisphere({random(21), random(22)}));
        return shown(normalize(n + (lean - n) * unit(normal_randomize), n), 1);
    }
    return shown(n, 0);
}

}  // namespace

NodeType node_flakes() { return Flakes::describe(); }

}  // namespace lightsieve
