// Which events the scene can make, and the engine's numbers for them. See compiler.h.
#include "render/compiler.h"

#include <algorithm>

#include "render/faults.h"

namespace lightsieve {
namespace {

/// The event of a lobe: its label, or the one that the scene gives it, and the shape's.
Event event_of(const LobeInfo& lobe, const EventLabels& labels) {
    Event event{lobe.kind, lobe.lobe, {}};
    if (!labels.object.empty()) event.labels.push_back(labels.object);
    if (active_fault() == Fault::TransmissionAsDiffuse && lobe.kind == EventKind::Transmission)
        event.lobe = EventLobe::Diffuse;
    if (active_fault() == Fault::CoatAsSpecular && lobe.label == "coat") return event;
    const std::string& label = labels.closure.empty() ? lobe.label : labels.closure;
    if (!label.empty() && label != labels.object) event.labels.push_back(label);
    std::sort(event.labels.begin(), event.labels.end());
    return event;
}

/// A shader without closures shows its colour unlit: emission.
const LobeInfo kUnlit{0, EventKind::Object, EventLobe::None, {}, {}};

Event light_event(const SceneLight& light) {
    return {EventKind::Light, EventLobe::None, {light.group}};
}
Event background_event(const SceneLight& light) {
    return {EventKind::Background, EventLobe::None, {light.group}};
}

/// A switch of a shader; off if it has none of that name.
bool switch_of(const ShaderProgram& shader, const char* name) {
    const ParamInfo* info = shader.type().find(name);
    return info != nullptr && info->type == ParamType::Bool &&
           *reinterpret_cast<const bool*>(shader.block() + info->offset);
}

/// extra_depth of a shader that has it.
std::uint8_t extra_depth_of(const ShaderProgram& shader) {
    const ParamInfo* info = shader.type().find("extra_depth");
    if (info == nullptr || info->type != ParamType::Int) return 0;
    const auto depth = *reinterpret_cast<const std::int32_t*>(shader.block() + info->offset);
    return static_cast<std::uint8_t>(std::clamp(depth, 0, 100));
}

/// Whether a lobe can act at all: bodies that are clear inside scatter nothing there.
bool can_happen(const ShaderProgram& shader, const LobeInfo& lobe) {
    return lobe.kind != EventKind::Volume || shader.type().fills_volumes ||
           shader.may_scatter_inside;
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
            if (can_happen(*shader, lobe)) event_index(event_of(lobe, shader->labels));
        if (shader->type().eval_closure == nullptr) event_index(event_of(kUnlit, shader->labels));
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
        for (const LobeInfo& lobe : shader->type().lobes) {
            LobeRecord& record = shader->records.emplace_back();
            if (can_happen(*shader, lobe)) fill(record, event_of(lobe, shader->labels));
        }
        const bool exits = switch_of(*shader, "exit_to_background"),
                   thin = switch_of(*shader, "thin_walled") ||
                          switch_of(*shader, "geometry_thin_walled");
        const bool passes_aovs = switch_of(*shader, "transmit_aovs") ||
                                 switch_of(*shader, "transmission_transmit_aovs");
        for (std::size_t i = 0; i < shader->records.size(); ++i) {
            shader->records[i].exit_to_background = exits;
            shader->records[i].makes_no_event = passes_aovs &&
                                                shader->records[i].lobe == EventLobe::Specular &&
                                                shader->records[i].kind == EventKind::Transmission;
            if (shader->records[i].lobe == EventLobe::Specular)
                shader->records[i].extra_depth = extra_depth_of(*shader);
            // Through a fibre goes a specular ray: it is in no body, and its depth and what lights give it are those of
            // highlights (extra_depth is one number for all). The event stays a transmission.
            if (const LobeInfo& lobe = shader->type().lobes[i];
                lobe.label == "hair" && lobe.kind == EventKind::Transmission)
                shader->records[i].kind = EventKind::Reflection;
            shader->records[i].subsurface = shader->type().lobes[i].below_surface && !thin;
        }
        if (shader->type().eval_closure == nullptr)
            fill(shader->records.emplace_back(), event_of(kUnlit, shader->labels));
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
