// Houdini's Karma: glossy is every specular lobe; an object tag, then a lobe label.
#include <array>

#include "lpe/dialects/spelling.h"
#include "lpe/dialects/tuple_reader.h"

namespace lightsieve::lpe::dialects {
namespace {

constexpr std::array kFacts{
    Fact{"G is every specular lobe, mirrors included", true, "G"},
    Fact{"in <..> the third place is the object's tag, the fourth the lobe's label", true, "'"},
    Fact{"a `.` in the place of a tag also takes what has none", true, "."},
    Fact{"an event without the tag or label passes a [^'x']", false, "[^'"},
    Fact{"`|` and parentheses are in none of its documents", false, "("},
    Fact{"passing through a cut-out leaves no event", false, "", Fact::bit(CommonKind::Straight)},
    Fact{"`.` does not take the albedo terminal A", false, "."},
    Fact{"a light's tag is its group", false, "<L"},
    Fact{"the background may carry a tag", false, "<B"},
    Fact{"the prefix \"shadow\" is known from users only", false, "shadow;"},
    Fact{"a skydome that the camera sees is the background B; one that lights a surface is L",
         false, "", Fact::bit(CommonKind::Background)},
};
constexpr std::array kPrefixes{Prefix{"unoccluded", "unoccluded"}, Prefix{"shadow", "shadow"}};

View view(const CommonEvent& event) {
    Hit hit;
    switch (event.kind) {
        case CommonKind::Camera: return {View::Form::Hit, hit};
        case CommonKind::Reflection: hit.event = 'R'; break;
        case CommonKind::Transmission: hit.event = 'T'; break;
        case CommonKind::Volume: hit.event = 'V'; break;
        case CommonKind::Object: hit.event = 'O'; break;
        case CommonKind::Light: hit.event = 'L'; break;
        case CommonKind::Background: hit.event = 'B'; break;
        case CommonKind::Probe: hit.event = 'A'; break;
        case CommonKind::Straight: return {View::Form::Invisible, {}};
        case CommonKind::Foreign:
        case CommonKind::ForeignEnd: return {View::Form::Absent, {}};
    }
    if (event.lobe != CommonLobe::None) hit.lobe = event.lobe == CommonLobe::Diffuse ? "D" : "G";
    if (!event.group.empty())
        hit.labels = {event.group};
    else if (!event.label.empty() || !event.object.empty())
        hit.labels = {event.object, event.label};
    return {View::Form::Hit, std::move(hit)};
}

bool any_event(const Hit& hit) { return hit.event != 'C' && hit.event != 'A'; }
bool any_lobe(const Hit&) { return true; }

std::string hint(char c) {
    switch (c) {
        case 'S': return "every specular lobe is G here";
        case 's': return "light that goes straight through leaves no event here";
        case 'E': return "the camera is C";
        default: return "";
    }
}

constexpr TupleOptions kOptions{.renderer = "Karma",
                                .events = "CRTVLOBA",
                                .lobes = "DG",
                                .label_places = 2,
                                .any_event = any_event,
                                .any_lobe = any_lobe,
                                .hint = hint};

Reading read(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    Reading before;
    SourceSpan place = base;
    take_prefixes(text, place, kPrefixes, "Karma", false, before, diagnostics);
    Reading reading = read_tuples(text, place, diagnostics, kOptions);
    reading.prefixes = std::move(before.prefixes);
    return reading;
}

std::vector<LetterText> letters(const LabelSets&) {
    std::vector<LetterText> out{{".", "..", any_event}, bare_event('C')};
    for (const char* lobe : {"D", "G"})
        out.push_back(bare_lobe(lobe, any_event));
    for (const char letter : {'R', 'T', 'V', 'L', 'O', 'B', 'A'})
        out.push_back(bare_event(letter));
    for (LetterText& tuple :
         tuples_of({event_place("R"), event_place("T")}, {lobe_place({"D"}), lobe_place({"G"})}))
        out.push_back(std::move(tuple));
    return out;
}

std::vector<LabelText> labels(const LabelSets& sets) { return label_texts(sets, {.n = 2}); }

}  // namespace

const Dialect& karma_dialect() {
    static const Dialect dialect{.name = "karma",
                                 .title = "Houdini Karma",
                                 .facts = kFacts,
                                 .prefixes = kPrefixes,
                                 .repeats = Repeats::StarAndPlus,
                                 .view = view,
                                 .read = read,
                                 .letters = letters,
                                 .labels = labels};
    return dialect;
}

}  // namespace lightsieve::lpe::dialects
