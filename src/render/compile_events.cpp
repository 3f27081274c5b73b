// Which events the scene can make, and the engine's numbers for them. See compiler.h.
#include <algorithm>

#include "render/compiler.h"
#include "render/faults.h"

namespace lightsieve {
namespace {

Event event_of(const LobeInfo& lobe, const std::string& object_label) {
    Event event{lobe.kind, lobe.lobe, {}};
    if (!object_label.empty()) event.labels.push_back(object_label);
    if (active_fault() == Fault::TransmissionAsDiffuse && lobe.kind == EventKind::Transmission)
        event.lobe = EventLobe::Diffuse;
    if (active_fault() == Fault::CoatAsSpecular && lobe.label == "coat") return event;
    if (!lobe.label.empty() && lobe.label != object_label) event.labels.push_back(lobe.label);
    std::sort(event.labels.begin(), event.labels.end());
    return event;
}

/// A shader without closures shows its colour unlit: emission.
const LobeInfo kUnlit{0, EventKind::Object, EventLobe::None, "", ""};

Event light_event(const SceneLight& light) {
    return {EventKind::Light, EventLobe::None, {light.group}};
}
Event background_event(const SceneLight& light) {
    return {EventKind::Background, EventLobe::None, {light.group}};
}

/// A switch of a shader, or `missing` if it has none of that name.
bool switch_of(const ShaderProgram& shader, const char* name, bool missing) {
    const ParamInfo* info = shader.type().find(name);
    if (info == nullptr || info->type != ParamType::Bool) return missing;
    return *reinterpret_cast<const bool*>(shader.block() + info->offset);
}

}  // namespace

std::uint32_t Compiler::event_index(const Event& event) {
    const auto [at, is_new] =
        event_index_.try_emplace(event, static_cast<std::uint32_t>(scene_->events.size()));
    if (is_new) scene_->events.push_back(event);
    return at->second;
}

void Compiler::gather_events() {
    for (const ShaderProgram* shader : surface_shaders_) {
        for (const LobeInfo& lobe : shader->type().lobes)
            event_index(event_of(lobe, shader->object_label));
        if (shader->type().eval_closure == nullptr)
            event_index(event_of(kUnlit, shader->object_label));
    }
    for (const SceneLight& light : scene_->lights) {
        event_index(light_event(light));
        if (light.is_skydome) event_index(background_event(light));
    }
    event_index({EventKind::Background, EventLobe::None, {}});
    event_index({EventKind::Albedo, EventLobe::None, {}});
}

void Compiler::fill_records() {
    const lpe::Program& program = *scene_->plan.program;
    const auto fill = [&](LobeRecord& record, const Event& event) {
        record.event = event_index(event);
        record.kind = event.kind;
        record.lobe = event.lobe;
        if (is_terminal(event.kind)) {
            record.terminal = program.terminal(event);
        } else {
            record.event_class = program.scatter_class(event);
        }
    };
    for (ShaderProgram* shader : surface_shaders_) {
        shader->records.clear();
        for (const LobeInfo& lobe : shader->type().lobes)
            fill(shader->records.emplace_back(), event_of(lobe, shader->object_label));
        const bool exits = switch_of(*shader, "exit_to_background", false),
                   thin = switch_of(*shader, "thin_walled", true);
        for (LobeRecord& record : shader->records) {
            record.exit_to_background = exits;
            // Where there is no other side to pass to, TD is light that scattered below the surface.
            record.subsurface = !thin && record.kind == EventKind::Transmission &&
                                record.lobe == EventLobe::Diffuse;
        }
        if (shader->type().eval_closure == nullptr)
            fill(shader->records.emplace_back(), event_of(kUnlit, shader->object_label));
    }
    for (SceneLight& light : scene_->lights) {
        light.as_light = program.terminal(light_event(light));
        light.light_event = event_index(light_event(light));
        if (!light.is_skydome) continue;
        light.as_background = program.terminal(background_event(light));
        light.background_event = event_index(background_event(light));
    }
    fill(scene_->background_record, {EventKind::Background, EventLobe::None, {}});
    LobeRecord probe;
    fill(probe, {EventKind::Albedo, EventLobe::None, {}});
    scene_->probe = probe.terminal;
    scene_->probe_event = probe.event;
}

}  // namespace lightsieve
