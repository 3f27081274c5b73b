#include "lpe/words.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include "lpe/cursor.h"
#include "lpe/predicate.h"

namespace lightsieve::lpe {
namespace {

using Texts = std::vector<std::string>;

constexpr std::string_view kDefaultGroup = "default";

enum Kind : std::size_t { kRD, kRS, kTD, kTS, kV, kL, kO, kB, kA };

constexpr std::uint32_t bits(std::initializer_list<Kind> kinds) {
    std::uint32_t out = 0;
    for (const Kind kind : kinds)
        out |= 1U << kind;
    return out;
}

constexpr std::uint32_t kSurface = bits({kRD, kRS, kTD, kTS});
constexpr std::uint32_t kScatter = kSurface | bits({kV});
constexpr std::uint32_t kLight = bits({kL, kO, kB});

/// The lobe's own name, for the labels that Arnold's shaders give.
std::string_view known_lobe(const std::string& label) {
    if (label == "coat") return "the coat";
    if (label == "sheen") return "the sheen";
    if (label == "hair") return "hair";
    return {};
}

/// "the coat or something labelled "hero"".
std::string labelled(const Texts& labels, std::string_view word) {
    Texts parts, others;
    for (const std::string& label : labels)
        if (const std::string_view lobe = known_lobe(label); !lobe.empty())
            parts.emplace_back(lobe);
        else
            others.push_back(in_quotes(label));
    if (!others.empty()) parts.push_back("something labelled " + join_words(others, word));
    return join_words(parts, word);
}

std::string group_name(const std::string& group) {
    return group == kDefaultGroup ? "no group" : "group " + group;
}

std::string quoted_labels(const Texts& labels) {
    std::string out;
    for (const std::string& label : labels)
        out += "'" + label + "'";
    return out;
}

/// What one scattering event does, after "is".
std::string scatter_words(const Event& event) {
    const bool specular_reflection =
        event.kind == EventKind::Reflection && event.lobe == EventLobe::Specular;
    std::string out = event.kind == EventKind::Volume ? "scattered in a volume" : "";
    if (event.kind == EventKind::Reflection)
        out = event.lobe == EventLobe::Diffuse ? "reflected diffusely" : "reflected specularly";
    if (event.kind == EventKind::Transmission)
        out = event.lobe == EventLobe::Diffuse ? "transmitted diffusely" : "refracted";
    if (event.labels.empty()) return out;
    const bool by_known = std::ranges::any_of(
        event.labels, [](const std::string& label) { return !known_lobe(label).empty(); });
    if (specular_reflection && by_known) out = "reflected";
    return out + " by " + labelled(event.labels, "and");
}

/// Where one terminal event is, after "ends".
std::string end_words(const Event& event, bool names_groups) {
    switch (event.kind) {
        case EventKind::Light: {
            const std::string& group = event.labels.front();
            if (group == kDefaultGroup && !names_groups) return "at a light";
            return "at a light of " + group_name(group);
        }
        case EventKind::Object:
            if (event.labels.empty()) return "at an emissive object";
            return "at an emission labelled " +
                   join_words(Texts{in_quotes(event.labels.front())}, "and");
        case EventKind::Background:
            if (event.labels.empty()) return "in the background";
            return "in the background, a skydome of " + group_name(event.labels.front());
        default: return "as a probe of the albedo";
    }
}

std::string times(std::size_t n) {
    constexpr std::array<std::string_view, 3> kFew{"", "", " twice"};
    return n < kFew.size() ? std::string(kFew[n]) : " " + std::to_string(n) + " times";
}

// ---- which labels a set means ----

using LabelSets = std::vector<const Texts*>;

bool has(const Texts& labels, const std::string& label) {
    return std::ranges::find(labels, label) != labels.end();
}
bool has_one_of(const Texts& labels, const Texts& of) {
    return std::ranges::any_of(of, [&](const std::string& label) { return has(labels, label); });
}

std::set<std::string> all_labels(const LabelSets& sets) {
    std::set<std::string> out;
    for (const Texts* labels : sets)
        out.insert(labels->begin(), labels->end());
    return out;
}

/// Labels whose every carrier in `sets` is among them and none in `others`.
Texts sufficient_labels(const LabelSets& sets, const LabelSets& others) {
    Texts out;
    for (const std::string& label : all_labels(sets))
        if (std::ranges::none_of(others, [&](const Texts* set) { return has(*set, label); }))
            out.push_back(label);
    return out;
}

bool all_carry_one(const LabelSets& sets, const Texts& of) {
    return !of.empty() &&
           std::ranges::all_of(sets, [&](const Texts* set) { return has_one_of(*set, of); });
}

/// Collects the labels of tests, apart for lobes and for lights.
struct NamedLabels {
    std::set<std::string> lobes, groups;

    void collect(const Node& node) {
        if (const auto* label = std::get_if<Label>(&node.form)) {
            lobes.insert(label->label);
            groups.insert(label->label);
        }
        const auto* angle = std::get_if<Angle>(&node.form);
        if (angle == nullptr) return;
        const auto may_be = [&](std::initializer_list<EventKind> kinds) {
            return std::ranges::any_of(
                kinds, [&](EventKind kind) { return may_be_kind(angle->kind, kind); });
        };
        const bool lobe = may_be({EventKind::Reflection, EventKind::Transmission,
                                  EventKind::Volume, EventKind::Object});
        const bool light = may_be({EventKind::Light, EventKind::Background});
        for (const LabelTest& test : angle->labels)
            for (const std::string& label : test.labels) {
                if (lobe && lobes.size() < kMaxWordLabels) lobes.insert(label);
                if (light && groups.size() < kMaxWordLabels) groups.insert(label);
            }
    }
};

}  // namespace

std::string join_words(std::span<const std::string> texts, std::string_view word) {
    std::string out;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const bool last = i + 1 == texts.size();
        if (i > 0) out += texts.size() > 2 ? ", " : " ";
        if (i > 0 && last) out += std::string(word) + " ";
        out += texts[i];
    }
    return out;
}

std::string path_in_words(std::span<const Event> path, bool names_groups) {
    Texts clauses{"leaves the camera"};
    for (std::size_t i = 1; i + 1 < path.size();) {
        std::size_t n = 1;
        while (i + n + 1 < path.size() && path[i + n] == path[i])
            ++n;
        clauses.push_back("is " + scatter_words(path[i]) + times(n));
        i += n;
    }
    if (path.size() > 1) clauses.push_back("ends " + end_words(path.back(), names_groups));
    return "a path that " + join_words(clauses, "and");
}

EventNames::EventNames(std::span<const Event> events) : events_(events.begin(), events.end()) {
    index();
}

EventNames::EventNames(std::span<const Expr> exprs) {
    NamedLabels named;
    for (const Expr& expr : exprs)
        if (expr) for_each_node(*expr, [&](const Node& node) { named.collect(node); });
    std::vector<Texts> lobes{{}};
    for (const std::string& label : named.lobes)
        lobes.push_back({label});
    for (auto a = named.lobes.begin(); a != named.lobes.end(); ++a)
        for (auto b = std::next(a); b != named.lobes.end(); ++b)
            if (known_lobe(*a).empty() || known_lobe(*b).empty()) lobes.push_back({*a, *b});

    std::vector<Texts> lights{{std::string(kDefaultGroup)}}, backgrounds{{}};
    if (!named.groups.empty()) {
        for (int i = 1; other_group_.empty() || named.groups.contains(other_group_); ++i)
            other_group_ = "group" + std::to_string(i);
        backgrounds.push_back({other_group_});
        lights.push_back({other_group_});
    }
    for (const std::string& group : named.groups) {
        if (group != kDefaultGroup) lights.push_back({group});
        backgrounds.push_back({group});
    }
    const auto add = [&](EventKind kind, EventLobe lobe, const std::vector<Texts>& sets) {
        for (const Texts& labels : sets)
            events_.push_back({kind, lobe, labels});
    };
    add(EventKind::Reflection, EventLobe::Diffuse, lobes);
    add(EventKind::Reflection, EventLobe::Specular, lobes);
    add(EventKind::Transmission, EventLobe::Diffuse, lobes);
    add(EventKind::Transmission, EventLobe::Specular, lobes);
    add(EventKind::Volume, EventLobe::None, lobes);
    add(EventKind::Light, EventLobe::None, lights);
    add(EventKind::Object, EventLobe::None, lobes);
    add(EventKind::Background, EventLobe::None, backgrounds);
    add(EventKind::Albedo, EventLobe::None, {{}});
    index();
}

void EventNames::index() {
    static_assert(kLightKind == kL);
    for (std::size_t i = 0; i < events_.size(); ++i) {
        const std::size_t kind = kind_of(events_[i]);
        if (kind == kKinds) continue;
        of_kind_[kind].push_back(i);
        present_ |= 1U << kind;
    }
}

std::size_t EventNames::kind_of(const Event& event) {
    const bool diffuse = event.lobe == EventLobe::Diffuse;
    switch (event.kind) {
        case EventKind::Reflection: return diffuse ? kRD : kRS;
        case EventKind::Transmission: return diffuse ? kTD : kTS;
        case EventKind::Volume: return kV;
        case EventKind::Light: return kL;
        case EventKind::Object: return kO;
        case EventKind::Background: return kB;
        case EventKind::Albedo: return kA;
        case EventKind::Camera: break;
    }
    return kKinds;
}

EventNames::Labels EventNames::labels_of(std::size_t kind, const EventSet& set) const {
    LabelSets in, out;
    for (const std::size_t i : of_kind_[kind])
        (set[i] ? in : out).push_back(&events_[i].labels);
    if (out.empty()) return {};
    const Texts only_in = sufficient_labels(in, out), only_out = sufficient_labels(out, in);
    const bool is_except = all_carry_one(out, only_out);
    const bool is_open = !other_group_.empty() && has(only_in, other_group_);
    if (all_carry_one(in, only_in) && !(is_open && is_except))
        return {Labels::Form::One, only_in, {}, {}};
    if (is_except) return {Labels::Form::Except, {}, only_out, {}};
    if (in.size() == 1 && in.front()->empty()) return {Labels::Form::None, {}, {}, {}};
    // Every label of the set at once.
    Texts common;
    for (const std::string& label : all_labels(in))
        if (std::ranges::all_of(in, [&](const Texts* labels) { return has(*labels, label); }))
            common.push_back(label);
    const auto has_all = [&](const Texts* labels) {
        return std::ranges::all_of(common,
                                   [&](const std::string& label) { return has(*labels, label); });
    };
    if (!common.empty() && std::ranges::none_of(out, has_all))
        return {Labels::Form::All, common, {}, {}};
    // One of some, and none of those that nothing in the set carries.
    LabelSets others;
    for (const Texts* labels : out)
        if (!has_one_of(*labels, only_out)) others.push_back(labels);
    const Texts with = sufficient_labels(in, others);
    if (all_carry_one(in, with)) return {Labels::Form::OneExcept, with, only_out, {}};
    Labels listed{Labels::Form::Listed, {}, {}, {}};
    for (const Texts* labels : in)
        listed.listed.push_back(*labels);
    return listed;
}

std::vector<EventNames::Group> EventNames::groups(const EventSet& set) const {
    std::vector<Group> out;
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        if (std::ranges::none_of(of_kind_[kind], [&](std::size_t i) { return bool{set[i]}; }))
            continue;
        Labels labels = labels_of(kind, set);
        const Kinds bit = 1U << kind;
        const auto same = std::ranges::find_if(out, [&](const Group& group) {
            const bool both_scatter = ((group.kinds | bit) & ~kScatter) == 0;
            const bool both_light = ((group.kinds | bit) & ~kLight) == 0;
            return group.labels == labels && (both_scatter || both_light);
        });
        if (same == out.end())
            out.push_back({bit, std::move(labels)});
        else
            same->kinds |= bit;
    }
    return out;
}

std::vector<std::string_view> EventNames::cover(Kinds kinds,
                                                std::span<const Phrase> phrases) const {
    std::vector<std::string_view> out;
    Kinds left = kinds;
    // The phrase that says most; kinds that the list does not have are free to be said.
    while (left != 0) {
        const Phrase* best = nullptr;
        const auto gain = [&](const Phrase& phrase) {
            return 16 * std::popcount(phrase.kinds & left) - std::popcount(phrase.kinds);
        };
        for (const Phrase& phrase : phrases) {
            if ((phrase.kinds & present_ & ~kinds) != 0 || (phrase.kinds & left) == 0) continue;
            if (best == nullptr || gain(phrase) > gain(*best)) best = &phrase;
        }
        if (best == nullptr) return out;
        out.push_back(best->text);
        left &= ~best->kinds;
    }
    return out;
}

std::string EventNames::label_text(const Group& group) const {
    static constexpr std::array kLetters{
        Phrase{kScatter, "any scattering"},
        Phrase{kLight, "any light"},
        Phrase{kSurface, "D S"},
        Phrase{bits({kRD, kTD}), "D"},
        Phrase{bits({kRS, kTS}), "S"},
        Phrase{bits({kRD, kRS}), "R"},
        Phrase{bits({kTD, kTS}), "T"},
        Phrase{bits({kRD}), "RD"},
        Phrase{bits({kRS}), "RS"},
        Phrase{bits({kTD}), "TD"},
        Phrase{bits({kTS}), "TS"},
        Phrase{bits({kV}), "V"},
        Phrase{bits({kL}), "L"},
        Phrase{bits({kO}), "O"},
        Phrase{bits({kB}), "B"},
        Phrase{bits({kA}), "A"},
    };
    const std::vector<std::string_view> letters = cover(group.kinds, kLetters);
    Texts names(letters.begin(), letters.end());
    std::string out;
    for (const std::string& name : names)
        out += (out.empty() ? "" : " ") + name;
    const Labels& labels = group.labels;
    switch (labels.form) {
        case Labels::Form::Any: return out;
        case Labels::Form::One: {
            Texts quoted;
            for (const std::string& label : labels.with)
                quoted.push_back("'" + label + "'");
            return out + (names.size() > 1 ? " " : "") + join_words(quoted, "or");
        }
        case Labels::Form::All:
            return out + (names.size() > 1 ? " " : "") + quoted_labels(labels.with);
        case Labels::Form::None: return out + " unlabelled";
        case Labels::Form::Except: return out + " except " + join_words(labels.without, "and");
        case Labels::Form::OneExcept:
            return out + " with " + join_words(labels.with, "or") + " except " +
                   join_words(labels.without, "and");
        case Labels::Form::Listed: break;
    }
    Texts sets;
    for (const Texts& set : labels.listed)
        sets.push_back(out + quoted_labels(set));
    return join_words(sets, "or");
}

std::string EventNames::scatter_text(const Group& group) const {
    static constexpr std::array kVerbs{
        Phrase{kScatter, "scattered"},
        Phrase{kSurface, "scattered by a surface"},
        Phrase{bits({kRD, kTD}), "scattered diffusely"},
        Phrase{bits({kRS, kTS}), "scattered specularly"},
        Phrase{bits({kRD, kRS}), "reflected"},
        Phrase{bits({kTD, kTS}), "transmitted"},
        Phrase{bits({kRD}), "reflected diffusely"},
        Phrase{bits({kRS}), "reflected specularly"},
        Phrase{bits({kTD}), "transmitted diffusely"},
        Phrase{bits({kTS}), "refracted"},
        Phrase{bits({kV}), "scattered in a volume"},
    };
    const std::vector<std::string_view> verbs = cover(group.kinds & kScatter, kVerbs);
    const std::string by = by_text(group.labels);
    const bool known_lobe_only = group.labels.form == Labels::Form::One &&
                                 std::ranges::all_of(group.labels.with, [](const auto& label) {
                                     return !known_lobe(label).empty();
                                 });
    Texts out;
    for (const std::string_view verb : verbs) {
        const bool is_plain = group.kinds == bits({kRS}) && known_lobe_only;
        out.push_back((is_plain ? "reflected" : std::string(verb)) + by);
    }
    return join_words(out, "or");
}

/// " by the coat", " but not by hair": what of a kind is meant; empty for all of it.
std::string EventNames::by_text(const Labels& labels) {
    switch (labels.form) {
        case Labels::Form::Any: return "";
        case Labels::Form::One: return " by " + labelled(labels.with, "or");
        case Labels::Form::All: return " by " + labelled(labels.with, "and");
        case Labels::Form::None: return " by something without a label";
        case Labels::Form::Except: return " but not by " + labelled(labels.without, "or");
        case Labels::Form::OneExcept:
            return " by " + labelled(labels.with, "or") + " but not by " +
                   labelled(labels.without, "or");
        case Labels::Form::Listed: break;
    }
    Texts sets;
    for (const Texts& set : labels.listed)
        sets.push_back(set.empty() ? "something without a label"
                                   : labelled(set, "and") + " alone");
    return " by " + join_words(sets, "or");
}

std::string EventNames::end_text(const Group& group) const {
    static constexpr std::array kPlaces{
        Phrase{kLight, "at any source of light"},       Phrase{bits({kL}), "at a light"},
        Phrase{bits({kO}), "at an emissive object"},    Phrase{bits({kB}), "in the background"},
        Phrase{bits({kA}), "as a probe of the albedo"},
    };
    const Labels& labels = group.labels;
    if (labels.form == Labels::Form::Any) {
        const std::vector<std::string_view> places = cover(group.kinds, kPlaces);
        return join_words(Texts(places.begin(), places.end()), "or");
    }
    Texts places;
    if ((group.kinds & bits({kL})) != 0) places.push_back("at a light" + of_group_text(labels));
    if ((group.kinds & bits({kO})) != 0)
        places.push_back("at an emission" + emission_text(labels));
    if ((group.kinds & bits({kB})) != 0)
        places.push_back(labels.form == Labels::Form::None
                             ? "in the background without a skydome"
                             : "in the background, a skydome" + of_group_text(labels));
    if ((group.kinds & bits({kA})) != 0) places.emplace_back("as a probe of the albedo");
    return join_words(places, "or");
}

/// " labelled "fire"", " not labelled "fire"".
std::string EventNames::emission_text(const Labels& labels) {
    const auto quoted = [](const Texts& of, std::string_view word) {
        Texts out;
        for (const std::string& label : of)
            out.push_back(in_quotes(label));
        return join_words(out, word);
    };
    switch (labels.form) {
        case Labels::Form::Any: return "";
        case Labels::Form::One: return " labelled " + quoted(labels.with, "or");
        case Labels::Form::All: return " labelled " + quoted(labels.with, "and");
        case Labels::Form::None: return " without a label";
        case Labels::Form::Except: return " not labelled " + quoted(labels.without, "or");
        case Labels::Form::OneExcept:
            return " labelled " + quoted(labels.with, "or") + " but not " +
                   quoted(labels.without, "or");
        case Labels::Form::Listed: break;
    }
    Texts sets;
    for (const Texts& set : labels.listed)
        sets.push_back(set.empty() ? "without a label"
                                   : "labelled " + quoted(set, "and") + " alone");
    return " " + join_words(sets, "or");
}

/// " of group key", " of any group but key": of lights, each of which is in one group.
std::string EventNames::of_group_text(const Labels& labels) const {
    const auto names = [&](const Texts& of) {
        Texts out;
        for (const std::string& group : of)
            out.push_back(group == other_group_ ? "another group" : group_name(group));
        return out;
    };
    if (labels.form == Labels::Form::Except && labels.without == Texts{std::string(kDefaultGroup)})
        return " of some group";
    if (labels.form == Labels::Form::Except)
        return " but not of " + join_words(names(labels.without), "or");
    Texts groups = names(labels.with);
    for (const Texts& set : labels.listed)
        for (const std::string& name : set.empty() ? Texts{"no skydome at all"} : names(set))
            groups.push_back(name);
    std::string out = " of " + join_words(groups, "or");
    if (!labels.without.empty()) out += " but not of " + join_words(names(labels.without), "or");
    return out;
}

std::string EventNames::label(const EventSet& set) const {
    std::string out;
    for (const Group& group : groups(set))
        out += (out.empty() ? "" : ", ") + label_text(group);
    return out;
}

std::string EventNames::scatters(const EventSet& set) const {
    Texts out;
    for (const Group& group : groups(set))
        if ((group.kinds & kScatter) != 0) out.push_back(scatter_text(group));
    return join_words(out, "or");
}

std::string EventNames::ends(const EventSet& set) const {
    Texts out;
    for (const Group& group : groups(set))
        if ((group.kinds & kScatter) == 0) out.push_back(end_text(group));
    return join_words(out, "or");
}

std::string EventNames::doings(const EventSet& set) const {
    const std::string scattered = scatters(set), ended = ends(set);
    if (scattered.empty()) return "end " + ended;
    if (ended.empty()) return "be " + scattered;
    return "be " + scattered + ", or end " + ended;
}

}  // namespace lightsieve::lpe
