// Lights, and the choice among them. See compiler.h.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "render/compiler.h"
#include "render/filtered_light.h"
#include "render/motion.h"

namespace lightsieve {

namespace {

/// How many still lights stand for one that moves. Each takes its time from the shutter's, and their shadows blend.
constexpr std::size_t kStops = 16;
/// Nested procedurals make more out of a short file than any machine holds.
constexpr std::uint64_t kMaxLights = std::uint64_t{1} << 20U;

/// Makes a node's light as if its matrix were `place` and it were `share` times as bright.
std::unique_ptr<Light> light_at(const NodeInstance& node, const Mat4f& place, float share,
                                NodeContext& context) {
    const NodeType& type = node.type();
    const std::align_val_t align{type.block_align};
    const auto free_block = [align](std::byte* p) { ::operator delete[](p, align); };
    const std::unique_ptr<std::byte[], decltype(free_block)> block(
        static_cast<std::byte*>(::operator new[](type.block_size, align)), free_block);
    // Parameter blocks are copied byte by byte (scene/describe.h).
    std::memcpy(block.get(), node.block(), type.block_size);
    auto& common = const_cast<LightCommon&>(*type.light_common(block.get()));
    common.matrix = {&place, 1, 1};
    common.intensity *= share;
    return type.make_light(block.get(), context);
}

/// options.light_samples: so many samples for all lights together, at least one each.
void share_samples(std::vector<SceneLight>& lights, int n) {
    for (SceneLight& light : lights)
        light.n_samples = std::max(1, n / static_cast<int>(lights.size()));
}

}  // namespace

/// The shutter belongs to the camera that the frame is about.
void Compiler::read_shutter() {
    const NodeInstance* camera = default_camera();
    if (camera == nullptr) return;
    const auto* start = camera->find<float>("shutter_start");
    const auto* end = camera->find<float>("shutter_end");
    if (start == nullptr || end == nullptr) return;
    RenderSettings& s = scene_->settings;
    s.shutter_start = *start;
    s.shutter_end = *end;
    if (!option("ignore_motion_blur", false)) return;
    const float length = *end - *start;
    const float time = length > 0 ? (option("reference_time", 0.0F) - *start) / length : 0;
    s.instant = std::fmin(std::fmax(time, 0.0F), kOneMinusEpsilon);  // what is no number is 0
}

std::vector<std::uint32_t> Compiler::indices_of_light(NodeRef light) const {
    const auto found = lights_of_node_.find(light.node);
    return found == lights_of_node_.end() ? std::vector<std::uint32_t>{} : found->second;
}

/// Where a light stands while the shutter is open: once if it does not move, else in even steps.
std::vector<Mat4f> Compiler::light_stops(const NodeInstance& node) {
    const LightCommon& common = *node.type().light_common(node.block());
    const std::span<const Mat4f> written(common.matrix.data,
                                         std::size_t{common.matrix.n} * common.matrix.n_keys);
    if (written.empty()) return {Mat4f{}};
    // Impossible matrices are reported where the light is made.
    const bool finite =
        std::all_of(written.begin(), written.end(), [](const Mat4f& m) { return m.finite(); });
    if (written.size() < 2 || !finite) return {written[0]};
    const auto blend = [](const Mat4f& a, const Mat4f& b, float t) { return lerp(a, b, t); };
    const std::vector<Mat4f> keys = keys_over_shutter<Mat4f>(
        written, {common.motion_start, common.motion_end},
        Shutter{scene_->settings.shutter_start, scene_->settings.shutter_end}, blend);
    if (std::all_of(keys.begin(), keys.end(), [&](const Mat4f& m) { return m == keys[0]; }))
        return {keys[0]};
    const auto at = [&](float time) {
        const float k = time * static_cast<float>(keys.size() - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(k), keys.size() - 2);
        return blend(keys[i], keys[i + 1], k - static_cast<float>(i));
    };
    if (scene_->settings.instant) return {at(*scene_->settings.instant)};
    if (common.camera > 0 || common.transmission > 0) {
        diagnostics_.warning(Code::ParamPending,
                             "light \"" + node.name().str() +
                                 "\" moves and is seen: it stands still in the middle of its way",
                             node.where("matrix"),
                             "with `camera 0` and `transmission 0` its light is blurred");
        return {at(0.5F)};
    }
    std::vector<Mat4f> stops;
    for (std::size_t i = 0; i < kStops; ++i)
        stops.push_back(at((static_cast<float>(i) + 0.5F) / kStops));
    return stops;
}

/// Lights in a scope and in the procedurals of it, saturating at the limit.
std::uint64_t Compiler::count_lights(const NodeScope& scope) {
    const auto [known, added] = light_counts_.try_emplace(&scope, 0);
    if (!added) return known->second;
    std::uint64_t count = 0;
    for (const auto& node : scope.nodes) {
        if (node->kind() == NodeKind::Light) ++count;
        if (const NodeScope* inside = graph_.contents(*node); inside != nullptr)
            count = std::min(count + count_lights(*inside), kMaxLights + 1);
    }
    return light_counts_[&scope] = count;
}

void Compiler::make_lights() {
    const NodeInstance* portal = nullptr;
    if (count_lights(*graph_.scopes().front()) > kMaxLights)
        diagnostics_.error(Code::LimitInstances,
                           "procedurals hold more than " + std::to_string(kMaxLights) + " lights",
                           {}, "nest procedurals with lights less deep");
    else
        make_lights_of(*graph_.scopes().front(), Mat4f{}, portal);
    std::set<std::string> groups;
    for (const SceneLight& light : scene_->lights)
        if (light.group != "default") groups.insert(light.group);
    if (portal != nullptr) set_portals(*portal);
    scene_->summary.light_groups.assign(groups.begin(), groups.end());
    if (const auto samples = option<std::int32_t>("light_samples", 0); samples > 0)
        share_samples(scene_->lights, squared_samples(samples));
    std::vector<const Light*> lights;
    for (const SceneLight& light : scene_->lights)
        lights.push_back(light.light.get());
    scene_->light_samplers.push_back(std::make_unique<LightSampler>(lights));
    add_light_geometry();
}

/// Lights of a scope and of the procedurals in it.
///
/// outer   matrix of the procedurals around, at their first key
/// portal  becomes the last light that is a portal
void Compiler::make_lights_of(const NodeScope& scope, const Mat4f& outer,
                              const NodeInstance*& portal) {
    for (const auto& node : scope.nodes) {
        if (const NodeScope* inside = graph_.contents(*node);
            inside != nullptr && count_lights(*inside) > 0) {
            const Array<Mat4f>& own = node->type().shape_common(node->block())->matrix;
            make_lights_of(*inside, own.empty() ? outer : own[0] * outer, portal);
        }
        if (node->kind() != NodeKind::Light || node->type().make_light == nullptr) continue;
        CompileContext context(*this, node.get(), node->name());
        context.set_outer(outer);
        const std::vector<Mat4f> stops = light_stops(*node);
        if (const bool* opening = node->find<bool>("portal"); opening != nullptr && *opening) {
            if (auto light = light_at(*node, stops[stops.size() / 2] * outer, 1, context))
                scene_->portals.push_back(std::move(light));
            portal = node.get();
            continue;
        }
        const float share = 1 / static_cast<float>(stops.size());
        for (const Mat4f& stop : stops) {
            const Mat4f place = stop * outer;
            add_light(*node, light_at(*node, place, share, context), place);
        }
    }
}

/// Takes a node's light into the scene; null: it has none.
void Compiler::add_light(const NodeInstance& node, std::unique_ptr<Light> made,
                         const Mat4f& place) {
    if (!made) return;
    SceneLight light;
    light.light = std::move(made);
    light.common = *node.type().light_common(node.block());
    add_filters(node, place, light);
    light.name = node.name();
    light.group = light.common.aov.empty() ? "default" : light.common.aov.str();
    light.is_skydome = light.light->is_skydome();
    light.samples_only = !light.common.cast_shadows || light.common.shadow_density != 1 ||
                         !is_black(light.common.shadow_color);
    light.n_samples = std::max(1, squared_samples(light.common.samples));
    light.n_volume_samples = std::max(1, squared_samples(light.common.volume_samples));
    // Rays meet what has an extent.
    const bool infinite = light.light->infinite();
    const bool can_be_met = infinite ? !light.light->sample({}, {0.5F, 0.5F}).delta
                                     : light.light->geometry() != nullptr;
    scene_->lights_can_be_met |= can_be_met;
    const auto index = static_cast<std::uint32_t>(scene_->lights.size());
    lights_of_node_[&node].push_back(index);
    if (infinite && can_be_met) scene_->infinite_lights.push_back(index);
    scene_->lights.push_back(std::move(light));
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
                         "no skydome shines through portal \"" + last.name().str() + '"',
                         last.where("portal"),
                         "a portal is no light itself: add a skydome_light, or turn `portal` off");
}

/// Puts the light behind the filters that it names.
void Compiler::add_filters(const NodeInstance& node, const Mat4f& place, SceneLight& light) {
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
        if (auto filter =
                type.make_light_filter(ref.node->block(), context, light_place(node, place)))
            filters.push_back(std::move(filter));
    }
    if (!filters.empty())
        light.light = std::make_unique<FilteredLight>(std::move(light.light), std::move(filters));
}

LightPlace Compiler::light_place(const NodeInstance& node, const Mat4f& place) {
    LightPlace out;
    const auto first = [&](const char* param, Vec3f fallback) {
        const auto* values = node.find<Array<Vec3f>>(param);
        return values == nullptr || values->empty() ? fallback : (*values)[0];
    };
    out.world_from_light = Mat4f::look_at(first("position", {}), first("look_at", {0, 0, -1}),
                                          first("up", {0, 1, 0}));
    out.world_from_light = out.world_from_light * place;
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
        static constexpr Mat4f kInPlace{};
        object.world_from_object = object.object_from_world = {&kInPlace, 1};
        object.in_place = true;
        object.name = scene_->lights[i].name;
        scene_->light_of_object.push_back(i);
        scene_->light_objects.push_back(std::move(object));
    }
}

}  // namespace lightsieve
