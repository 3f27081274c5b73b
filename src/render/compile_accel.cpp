// Acceleration structures and the masks that rays need. See compiler.h.
#include "render/compiler.h"

namespace lightsieve {
namespace {

/// Ray types that scatter: those whose masks shares of one ray can differ in.
constexpr std::uint8_t kScattered =
    static_cast<std::uint8_t>(~(ray_bit(RayType::Camera) | ray_bit(RayType::Shadow)));

std::uint32_t mask_of(const SceneObject& object) {
    const std::uint32_t seen = object.visibility & ~std::uint32_t{ray_bit(RayType::Shadow)};
    if ((object.visibility & ray_bit(RayType::Shadow)) == 0) return seen;
    // One-sided shadows need a look at each hit, as transparent ones do.
    const bool look = object.may_be_transparent || object.may_tint_shadows ||
                      (object.sidedness & ray_bit(RayType::Shadow)) == 0;
    return seen | (look ? kMaskShadowTransparent : kMaskShadowOpaque);
}

}  // namespace

void Compiler::find_mask_types() {
    for (const auto& shader : scene_->shaders)
        if (shader->type().reads_ray_type) scene_->mask_types = kScattered;
    for (const SceneObject& object : scene_->objects)
        for (const std::uint8_t mask : {object.visibility, object.sidedness}) {
            const std::uint8_t scattered = mask & kScattered;
            if (scattered != 0 && scattered != kScattered) scene_->mask_types = kScattered;
            const bool in_shadow_rays = (mask & ray_bit(RayType::Shadow)) != 0;
            if (scattered != (in_shadow_rays ? kScattered : 0)) scene_->shadows_by_mask = true;
        }
}

void Compiler::make_accels() {
    std::vector<AccelObject> objects;
    for (const SceneObject& object : scene_->objects) {
        const std::uint32_t mask = mask_of(object);
        scene_->has_transparency |= (mask & kMaskShadowTransparent) != 0;
        objects.push_back({object.geometry, object.world_from_object, mask});
    }
    scene_->accel = std::make_unique<Accel>(objects, options_.isa);
    if (scene_->light_objects.empty()) return;
    std::vector<AccelObject> lights;
    for (const SceneObject& object : scene_->light_objects)
        lights.push_back({object.geometry, object.world_from_object, 0xffffffffU});
    scene_->light_accel = std::make_unique<Accel>(lights, options_.isa, true);
}

}  // namespace lightsieve
