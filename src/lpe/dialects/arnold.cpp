// Arnold, and Lightsieve with its extensions: docs/lpe-language.md.
#include <array>

#include "lpe/ast.h"
#include "lpe/dialects/dialect.h"
#include "lpe/dialects/spelling.h"
#include "lpe/parse.h"
#include "lpe/predicate.h"

namespace lightsieve::lpe::dialects {
namespace {

/// The group of lights that have none.
constexpr std::string_view kNoGroup = "default";

constexpr std::array kFacts{
    Fact{"specular is one lobe here, rough or not", true},
    Fact{"passing through a cut-out leaves no event", true, "", Fact::bit(CommonKind::Straight)},
    Fact{"a skydome that lights a surface is L, and the background B where the camera sees it",
         false, "", Fact::bit(CommonKind::Background)},
    Fact{"a light that has no group is in the group 'default'", true, "'default'"},
};

View view(const CommonEvent& event) {
    Hit hit;
    for (const std::string& label : {event.label, event.object})
        if (!label.empty()) hit.labels.push_back(label);
    switch (event.kind) {
        case CommonKind::Camera: break;
        case CommonKind::Reflection: hit.event = 'R'; break;
        case CommonKind::Transmission: hit.event = 'T'; break;
        case CommonKind::Volume: hit.event = 'V'; break;
        case CommonKind::Object: hit.event = 'O'; break;
        case CommonKind::Probe: hit.event = 'A'; break;
        case CommonKind::Light:
            hit.event = 'L';
            hit.labels.assign(1, event.group.empty() ? std::string(kNoGroup) : event.group);
            break;
        case CommonKind::Background:
            hit.event = 'B';
            if (!event.group.empty()) hit.labels.assign(1, event.group);
            break;
        case CommonKind::Straight: return {View::Form::Invisible, {}};
        case CommonKind::Foreign:
        case CommonKind::ForeignEnd: return {View::Form::Absent, {}};
    }
    if (event.lobe != CommonLobe::None) hit.lobe = event.lobe == CommonLobe::Diffuse ? "D" : "S";
    return {View::Form::Hit, std::move(hit)};
}

EventKind kind_of(char letter) {
    switch (letter) {
        case 'R': return EventKind::Reflection;
        case 'T': return EventKind::Transmission;
        case 'V': return EventKind::Volume;
        case 'L': return EventKind::Light;
        case 'O': return EventKind::Object;
        case 'B': return EventKind::Background;
        case 'A': return EventKind::Albedo;
        default: return EventKind::Camera;
    }
}

Event to_event(const Hit& hit) {
    const EventLobe lobe = hit.lobe.empty()  ? EventLobe::None
                           : hit.lobe == "D" ? EventLobe::Diffuse
                                             : EventLobe::Specular;
    return {kind_of(hit.event), lobe, hit.labels};
}

/// The engine's tree as a pattern; what a single event's test takes is still its to say.
PatternPtr to_pattern(const Expr& expr) {
    if (!expr) return make_nothing();
    const Node& node = *expr;
    if (is_event_test(node))
        return make_event([expr](const Hit& hit) { return takes(*expr, to_event(hit)); });
    std::vector<PatternPtr> parts;
    for (const Expr& child : children(node))
        parts.push_back(to_pattern(child));
    if (const auto* repeat = std::get_if<Repeat>(&node.form))
        return make_repeat(std::move(parts[0]), repeat->min, repeat->max);
    if (std::holds_alternative<Alternation>(node.form)) return make_alternation(std::move(parts));
    if (std::holds_alternative<Intersection>(node.form))
        return make_boolean(Pattern::Form::Intersection, std::move(parts));
    if (std::holds_alternative<Difference>(node.form))
        return make_boolean(Pattern::Form::Difference, std::move(parts));
    if (std::holds_alternative<Complement>(node.form))
        return make_boolean(Pattern::Form::Complement, std::move(parts));
    return make_sequence(std::move(parts));
}

Reading read(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    Reading reading;
    const Expr expr = parse(text, base, diagnostics);
    if (!expr) return reading;
    reading.pattern = to_pattern(expr);
    for_each_node(*expr, [&](const Node& node) {
        if (const auto* label = std::get_if<Label>(&node.form))
            reading.labels.push_back(label->label);
        if (const auto* angle = std::get_if<Angle>(&node.form))
            for (const LabelTest& test : angle->labels) {
                reading.labels.insert(reading.labels.end(), test.labels.begin(),
                                      test.labels.end());
                reading.label_sets.push_back(test.labels);
            }
        if (const auto* brackets = std::get_if<Brackets>(&node.form)) {
            std::vector<std::string> labels;
            for (const Expr& item : brackets->items)
                if (const auto* label = std::get_if<Label>(&item->form))
                    labels.push_back(label->label);
            if (labels.size() > 1) reading.label_sets.push_back(std::move(labels));
        }
    });
    return reading;
}

bool is_ordinary(const Hit& hit) { return hit.event != 'C' && hit.event != 'A'; }

std::vector<LetterText> letters(const LabelSets&) {
    std::vector<LetterText> out{{".", "..", is_ordinary}, bare_event('C')};
    for (const char* lobe : {"D", "S"})
        out.push_back(bare_lobe(lobe, is_ordinary));
    for (const char letter : {'R', 'T', 'V', 'L', 'O', 'B', 'A'})
        out.push_back(bare_event(letter));
    for (LetterText& tuple :
         tuples_of({event_place("R"), event_place("T")}, {lobe_place({"D"}), lobe_place({"S"})}))
        out.push_back(std::move(tuple));
    return out;
}

std::vector<LabelText> labels(const LabelSets& sets) { return label_texts(sets, {.n = 0}); }

}  // namespace

const Dialect& arnold_dialect() {
    static const Dialect dialect{.name = "arnold",
                                 .title = "Arnold and Lightsieve",
                                 .facts = kFacts,
                                 .prefixes = {},
                                 .repeats = Repeats::All,
                                 .view = view,
                                 .read = read,
                                 .letters = letters,
                                 .labels = labels};
    return dialect;
}

}  // namespace lightsieve::lpe::dialects
