// Acceleration structures and the masks that rays need. See compiler.h.
#include <algorithm>

#include "render/compiler.h"

namespace lightsieve {
namespace {

/// Ray types that scatter: those whose masks shares of one ray can differ in.
constexpr std::uint8_t kScattered =
    static_cast<std::uint8_t>(~(ray_bit(RayType::Camera) | ray_bit(RayType::Shadow)));

std::uint32_t mask_of(const SceneObject& object) {
    const std::uint32_t seen = object.visibility & ~std::uint32_t{ray_bit(RayType::Shadow)};
    if ((object.visibility & ray_bit(RayType::Shadow)) == 0) return seen;
    // One-sided shadows, and those in some lights only, need a look at each hit, as transparent ones do.
    const bool look = object.may_be_transparent || object.may_tint_shadows ||
                      object.shadow_lights != nullptr ||
                      (object.sidedness & ray_bit(RayType::Shadow)) == 0;
    return seen | (look ? kMaskShadowTransparent : kMaskShadowOpaque);
}

}  // namespace

void Compiler::find_mask_types() {
    for (const auto& shader : scene_->shaders)
        if (shader->type().reads_ray_type) scene_->mask_types = kScattered;
    const auto look_at = [&](std::uint8_t mask) {
        const std::uint8_t scattered = mask & kScattered;
        if (scattered != 0 && scattered != kScattered) scene_->mask_types = kScattered;
        const bool in_shadow_rays = (mask & ray_bit(RayType::Shadow)) != 0;
        if (scattered != (in_shadow_rays ? kScattered : 0)) scene_->shadows_by_mask = true;
    };
    for (const SceneObject& object : scene_->objects) {
        look_at(object.visibility);
        look_at(object.sidedness);
    }
    for (const SceneVolume& volume : scene_->volumes)
        look_at(volume.object.visibility);
}

void Compiler::make_accels() {
    scene_->cutters.find(scene_->objects, options_.isa);
    std::vector<AccelObject> objects;
    for (const SceneObject& object : scene_->objects) {
        const std::uint32_t mask = mask_of(object);
        scene_->has_transparency |= (mask & kMaskShadowTransparent) != 0;
        scene_->rays_may_pass |= object.may_be_passed();
        objects.push_back({object.geometry, object.world_from_object, mask});
    }
    scene_->accel = std::make_unique<Accel>(objects, options_.isa);
    if (scene_->light_objects.empty()) return;
    std::vector<AccelObject> lights;
    for (const SceneObject& object : scene_->light_objects)
        lights.push_back({object.geometry, object.world_from_object, 0xffffffffU});
    scene_->light_accel = std::make_unique<Accel>(lights, options_.isa, true);
}

/// Boundaries and bounds of volumes, in which shaders are run: after everything that they need.
void Compiler::finish_volumes() {
    for (SceneVolume& volume : scene_->volumes) {
        const SceneObject& object = volume.object;
        const Box3f& box = object.geometry->volume_box;
        if (box.empty()) {
            const AccelObject boundary{object.geometry, object.world_from_object, 0xffffffffU};
            volume.boundary = std::make_unique<Accel>(std::span(&boundary, 1), options_.isa);
            volume.bounds = volume.boundary->bounds();
        } else {
            for (const Mat4f& place : object.world_from_object)
                for (unsigned i = 0; i < 8; ++i)
                    volume.bounds.grow(place.point({(i & 1U) != 0 ? box.upper.x : box.lower.x,
                                                    (i & 2U) != 0 ? box.upper.y : box.lower.y,
                                                    (i & 4U) != 0 ? box.upper.z : box.lower.z}));
        }
        make_majorants(volume);
    }
    if (scene_->volumes.empty() && scene_->atmosphere == nullptr) return;
    scene_->haze.bounds = scene_->accel->bounds();
    std::vector<float> power;
    for (const SceneLight& light : scene_->lights) {
        const LightBounds bounds = light.light->bounds();
        power.push_back(light.light->infinite() ? 0 : bounds.intensity);
        if (!light.light->infinite()) scene_->haze.bounds.grow(bounds.box);
    }
    if (std::any_of(power.begin(), power.end(), [](float p) { return p > 0; }))
        scene_->finite_lights = Distribution1D(power);
    // Lights whose shadows pass through volumes: rays that meet them by chance see other things in the way.
    for (SceneLight& light : scene_->lights)
        light.samples_only |= !light.common.cast_volumetric_shadows;
}

}  // namespace lightsieve
