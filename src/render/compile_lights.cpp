// Lights, and the choice among them. See compiler.h.
#include <algorithm>
#include <cmath>

#include "render/compiler.h"
#include "render/filtered_light.h"

namespace lightsieve {

void Compiler::make_lights() {
    std::set<std::string> groups;
    const NodeInstance* portal = nullptr;
    for (const auto& node : graph_.nodes()) {
        if (node->kind() != NodeKind::Light || node->type().make_light == nullptr) continue;
        CompileContext context(*this, node.get(), node->name());
        SceneLight light;
        light.light = node->type().make_light(node->block(), context);
        if (!light.light) continue;
        if (const bool* opening = node->find<bool>("portal"); opening != nullptr && *opening) {
            scene_->portals.push_back(std::move(light.light));
            portal = node.get();
            continue;
        }
        light.common = *node->type().light_common(node->block());
        add_filters(*node, light);
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
    if (portal != nullptr) set_portals(*portal);
    scene_->summary.light_groups.assign(groups.begin(), groups.end());
    std::vector<const Light*> lights;
    for (const SceneLight& light : scene_->lights)
        lights.push_back(light.light.get());
    scene_->light_samplers.push_back(std::make_unique<LightSampler>(lights));
    add_light_geometry();
}

/// Tells skies where the openings are. `last`: one of them.
void Compiler::set_portals(const NodeInstance& last) {
    std::vector<const Light*> portals;
    for (const auto& portal : scene_->portals)
        portals.push_back(portal.get());
    bool sky = false;
    for (SceneLight& light : scene_->lights) {
        light.light->set_portals(portals);
        sky |= light.is_skydome;
    }
    if (sky) return;
    diagnostics_.warning(Code::InvalidValue,
                         "no skydome shines through portal "
                         " + last.name().str() + "
                         "",
                         last.where("portal"),
                         "a portal is no light itself: add a skydome_light, or turn `portal` off");
}

/// Puts the light behind the filters that it names.
void Compiler::add_filters(const NodeInstance& node, SceneLight& light) {
    std::vector<std::unique_ptr<LightFilter>> filters;
    for (const NodeRef& ref : light.common.filters.first_key()) {
        if (!ref) continue;
        const NodeType& type = ref.node->type();
        if (type.make_light_filter == nullptr) {
            diagnostics_.warning(Code::LinkType,
                                 "\"" + ref.node->name().str() + "\" is a " + type.name.str() +
                                     ", not a light filter: it is left out",
                                 node.where("filters"));
            continue;
        }
        CompileContext context(*this, ref.node, ref.node->name());
        if (auto filter = type.make_light_filter(ref.node->block(), context, light_place(node)))
            filters.push_back(std::move(filter));
    }
    if (!filters.empty())
        light.light = std::make_unique<FilteredLight>(std::move(light.light), std::move(filters));
}

LightPlace Compiler::light_place(const NodeInstance& node) {
    const LightCommon& common = *node.type().light_common(node.block());
    LightPlace out;
    const auto first = [&](const char* param, Vec3f fallback) {
        const auto* values = node.find<Array<Vec3f>>(param);
        return values == nullptr || values->empty() ? fallback : (*values)[0];
    };
    out.world_from_light = Mat4f::look_at(first("position", {}), first("look_at", {0, 0, -1}),
                                          first("up", {0, 1, 0}));
    if (!common.matrix.empty()) out.world_from_light = out.world_from_light * common.matrix[0];
    out.light_from_world = out.world_from_light.inverse();
    constexpr float kWidest = 179;  // tangents are tame below it [deg]
    if (const auto* cone = node.find<float>("cone_angle"); cone != nullptr)
        out.cone_tangent = std::tan(deg_to_rad(std::clamp(*cone, 0.0F, kWidest) * 0.5F));
    return out;
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
