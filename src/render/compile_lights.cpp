// Lights, and the choice among them. See compiler.h.
#include <algorithm>

#include "render/compiler.h"

namespace lightsieve {

void Compiler::make_lights() {
    std::set<std::string> groups;
    for (const auto& node : graph_.nodes()) {
        if (node->kind() != NodeKind::Light || node->type().make_light == nullptr) continue;
        CompileContext context(*this, node.get(), node->name());
        SceneLight light;
        light.light = node->type().make_light(node->block(), context);
        if (!light.light) continue;
        light.common = *node->type().light_common(node->block());
        light.name = node->name();
        light.group = light.common.aov.empty() ? "default" : light.common.aov.str();
        light.is_skydome = light.light->is_skydome();
        light.samples_only = !light.common.cast_shadows || light.common.shadow_density != 1 ||
                             !is_black(light.common.shadow_color);
        const auto index = static_cast<std::uint32_t>(scene_->lights.size());
        light_index_[node.get()] = index;
        if (light.light->infinite()) scene_->infinite_lights.push_back(index);
        if (light.group != "default") groups.insert(light.group);
        scene_->lights.push_back(std::move(light));
    }
    scene_->summary.light_groups.assign(groups.begin(), groups.end());
    std::vector<const Light*> lights;
    for (const SceneLight& light : scene_->lights)
        lights.push_back(light.light.get());
    scene_->light_samplers.push_back(std::make_unique<LightSampler>(lights));
    add_light_geometry();
}

/// What rays can meet of the lights.
void Compiler::add_light_geometry() {
    for (std::uint32_t i = 0; i < scene_->lights.size(); ++i) {
        const ShapeGeometry* geometry = scene_->lights[i].light->geometry();
        if (geometry == nullptr) continue;
        SceneObject object;
        object.geometry = geometry;
        object.world_from_object = object.object_from_world = {Mat4f{}};
        object.name = scene_->lights[i].name;
        scene_->light_of_object.push_back(i);
        scene_->light_objects.push_back(std::move(object));
    }
}

}  // namespace lightsieve
