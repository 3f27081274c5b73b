#include "lpe/dialects/common.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lightsieve::lpe::dialects {
namespace {

/// What no object label may be.
constexpr std::array<std::string_view, 4> kNeverObjectLabels{"coat", "sheen", "hair", "default"};
/// The group of lights that have none, where a dialect gives it a name.
constexpr std::string_view kNoGroup = "default";

struct WithoutRow {
    std::string_view name, meaning;
};
constexpr std::array<WithoutRow, kWithouts> kWithout{{
    {"straight", "nothing in the scene is cut out by opacity or presence"},
    {"volumes", "the scene has no volumes"},
    {"background", "nothing lies behind the scene but lights"},
    {"glossy", "every specular lobe is a perfect mirror or perfect glass"},
    {"mirrors", "no specular lobe is a perfect mirror or perfect glass"},
    {"object-labels", "no object is labelled"},
}};

bool leaves_out(Without without, const CommonEvent& event) {
    switch (without) {
        case Without::Straight: return event.kind == CommonKind::Straight;
        case Without::Volumes: return event.kind == CommonKind::Volume;
        case Without::Background: return event.kind == CommonKind::Background;
        case Without::Glossy: return event.lobe == CommonLobe::Glossy;
        case Without::Mirrors: return event.lobe == CommonLobe::Mirror;
        case Without::ObjectLabels: return !event.object.empty();
    }
    return false;
}

char kind_letter(CommonKind kind) {
    switch (kind) {
        case CommonKind::Camera: return 'C';
        case CommonKind::Reflection: return 'R';
        case CommonKind::Volume: return 'V';
        case CommonKind::Light: return 'L';
        case CommonKind::Object: return 'O';
        case CommonKind::Background: return 'B';
        case CommonKind::Probe: return 'A';
        default: return 'T';
    }
}

std::string quoted(std::string_view label) { return "'" + std::string(label) + "'"; }

/// How a lobe scatters.
std::string_view adverb(CommonLobe lobe) {
    switch (lobe) {
        case CommonLobe::Diffuse: return " diffusely";
        case CommonLobe::Glossy: return " glossily";
        case CommonLobe::Mirror: return " perfectly";
        case CommonLobe::None: break;
    }
    return "";
}

std::string describe_event(const CommonEvent& event) {
    const std::string label = event.label.empty() ? "" : " " + quoted(event.label);
    const std::string how =
        std::string(adverb(event.lobe)) + (label.empty() ? "" : " by a lobe" + label);
    const std::string of = event.object.empty() ? "" : " of an object " + quoted(event.object);
    const std::string group = event.group.empty() ? "" : " of group " + quoted(event.group);
    switch (event.kind) {
        case CommonKind::Camera: return "leaves the camera";
        case CommonKind::Reflection: return "is reflected" + how + of;
        case CommonKind::Transmission: return "is transmitted" + how + of;
        case CommonKind::Volume: return "is scattered in a volume" + label + of;
        case CommonKind::Straight: return "goes straight through a surface";
        case CommonKind::Foreign: return "meets the event " + event.name;
        case CommonKind::Light: return "ends at a light" + group;
        case CommonKind::Object: return "ends at an emission" + label + of;
        case CommonKind::Background: return "ends at the background" + group;
        case CommonKind::Probe: return "ends as an albedo probe";
        case CommonKind::ForeignEnd: return "ends with the event " + event.name;
    }
    return "";
}

/// The names, then one that stands for all others.
std::vector<std::string> with_other(std::vector<std::string> names) {
    std::string other = "other";
    while (std::ranges::find(names, other) != names.end())
        other += "_";
    names.push_back(std::move(other));
    return names;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

}  // namespace

std::string print_event(const CommonEvent& event) {
    if (!event.name.empty()) return event.name;
    if (event.kind == CommonKind::Straight) return "Ts";
    std::string out{kind_letter(event.kind)};
    if (event.lobe == CommonLobe::Diffuse) out += 'D';
    if (event.lobe == CommonLobe::Glossy) out += 'G';
    if (event.lobe == CommonLobe::Mirror) out += 'S';
    if (!event.label.empty()) out += quoted(event.label);
    if (!event.group.empty()) out += quoted(event.group);
    if (!event.object.empty()) out += "@" + quoted(event.object);
    return out;
}

std::string print_path(std::span<const CommonEvent> path) {
    std::string out;
    for (const CommonEvent& event : path)
        out += (out.empty() ? "" : " ") + print_event(event);
    return out;
}

std::string describe_path(std::span<const CommonEvent> path) {
    std::string out = "a path that ";
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (i > 0) out += i + 1 == path.size() ? (i == 1 ? " and " : ", and ") : ", ";
        out += describe_event(path[i]);
    }
    return out;
}

std::string_view without_name(Without without) {
    return kWithout[static_cast<std::size_t>(without)].name;
}
std::string_view without_meaning(Without without) {
    return kWithout[static_cast<std::size_t>(without)].meaning;
}

CommonAlphabet::CommonAlphabet(const CommonNames& names, std::span<const Without> without)
    : without_(without.begin(), without.end()) {
    const std::vector<std::string> labels = sorted(names.labels);
    std::vector<std::string> lobes = labels;
    lobes.insert(lobes.end(), names.lobes.begin(), names.lobes.end());
    lobes = with_other(sorted(std::move(lobes)));
    std::vector<std::string> objects = labels, groups = labels;
    std::erase_if(objects, [](const std::string& label) {
        return std::ranges::find(kNeverObjectLabels, label) != kNeverObjectLabels.end();
    });
    objects = with_other(std::move(objects));
    std::erase(groups, kNoGroup);
    groups = with_other(std::move(groups));

    // Plain events first: witnesses use the first event that will do.
    add({});
    for (const CommonKind kind : {CommonKind::Reflection, CommonKind::Transmission})
        for (const CommonLobe lobe : {CommonLobe::Diffuse, CommonLobe::Glossy, CommonLobe::Mirror})
            add_labelled({.kind = kind, .lobe = lobe}, lobes, objects);
    add_labelled({.kind = CommonKind::Volume}, lobes, objects);
    add({.kind = CommonKind::Straight});
    for (const std::string& name : sorted(names.foreign))
        add({.kind = CommonKind::Foreign, .name = name});
    for (const CommonKind kind : {CommonKind::Light, CommonKind::Background})
        for (const bool seen : {false, true}) {
            add({.kind = kind, .seen = seen});
            for (const std::string& group : groups)
                add({.kind = kind, .group = group, .seen = seen});
        }
    add_labelled({.kind = CommonKind::Object}, lobes, objects);
    add({.kind = CommonKind::Probe});
    for (const std::string& name : sorted(names.foreign_ends))
        add({.kind = CommonKind::ForeignEnd, .name = name});
    std::ranges::stable_sort(events_, {}, [](const CommonEvent& event) {
        return (event.label.empty() ? 0 : 1) + (event.object.empty() ? 0 : 1) +
               (event.group.empty() ? 0 : 1);
    });
    for (const CommonEvent& event : events_) {
        CommonEvent twin = event;
        twin.seen = !event.seen;
        const auto found = std::ranges::find(events_, twin);
        const auto self = &event - events_.data();
        twins_.push_back(
            static_cast<Symbol>(found == events_.end() ? self : found - events_.begin()));
    }
}

void CommonAlphabet::add(CommonEvent event) {
    const auto left_out = [&](Without without) { return leaves_out(without, event); };
    if (std::ranges::none_of(without_, left_out)) events_.push_back(std::move(event));
}

void CommonAlphabet::add_labelled(const CommonEvent& event, std::span<const std::string> labels,
                                  std::span<const std::string> objects) {
    const auto add_with = [&](const std::string& label, const std::string& object) {
        CommonEvent labelled = event;
        labelled.label = label;
        labelled.object = object;
        add(std::move(labelled));
    };
    add_with("", "");
    for (const std::string& label : labels)
        add_with(label, "");
    for (const std::string& object : objects) {
        add_with("", object);
        for (const std::string& label : labels)
            add_with(label, object);
    }
}

SymbolSet CommonAlphabet::all() const {
    SymbolSet set = none();
    for (Symbol s = 0; s < size(); ++s)
        set.add(s);
    return set;
}

SymbolSet CommonAlphabet::all_without(Without without) const {
    SymbolSet set = none();
    for (Symbol s = 0; s < size(); ++s)
        if (!leaves_out(without, events_[s])) set.add(s);
    return set;
}

CommonAlphabet::PathState CommonAlphabet::step(PathState state, Symbol s) const {
    const CommonEvent& event = events_[s];
    if (state == kStart) return event.kind == CommonKind::Camera ? kAtCamera : kNoPath;
    if (state != kAtCamera && state != kAfterVertex) return kNoPath;
    const bool at_camera = state == kAtCamera;
    switch (event.kind) {
        case CommonKind::Camera: return kNoPath;
        case CommonKind::Reflection:
        case CommonKind::Transmission:
        case CommonKind::Volume:
        case CommonKind::Foreign: return kAfterVertex;
        case CommonKind::Straight: return state;
        case CommonKind::Light:
        case CommonKind::Background: return event.seen == at_camera ? kEnd : kNoPath;
        case CommonKind::Probe: return at_camera ? kNoPath : kEnd;
        case CommonKind::Object:
        case CommonKind::ForeignEnd: return kEnd;
    }
    return kNoPath;
}

}  // namespace lightsieve::lpe::dialects
