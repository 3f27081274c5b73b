// DreamWorks MoonRay: an early copy of OSL's parser; every event has exactly one label,
// `material.lobe`, or a placeholder.
#include <algorithm>
#include <array>

#include "lpe/dialects/osl_family.h"
#include "lpe/dialects/tuple_reader.h"

namespace lightsieve::lpe::dialects {
namespace {

constexpr std::string_view kPlaceholder = "placeholder";
constexpr std::string_view kUserEvents = "UM";
constexpr OslOptions kOptions{.renderer = "MoonRay",
                              .user_events = kUserEvents,
                              .dotted_labels = true,
                              .trims_labels = true,
                              .every_event_is_labelled = true};

constexpr std::array kFacts{
    Fact{"`|` joins one item on each side, and what follows a leading parenthesis is ignored",
         true, "|"},
    Fact{"G is glossy, S is a perfect mirror only", true},
    Fact{"an event's label is 'material.lobe'; a label without a dot stands for all that have it",
         true, "'"},
    Fact{"every event without a label gets a placeholder, so [^'x'] takes it", true, "[^'"},
    Fact{"passing through a cut-out is an event <Ts>", true, "s>",
         Fact::bit(CommonKind::Straight)},
    Fact{"subsurface scattering is <TD>", true, "TD"},
    Fact{"a label without a dot may also stand inside [^..]", false, "[^'"},
    Fact{"an object's label is the label of its material", false, "'"},
    Fact{"a lobe of a labelled material that has no label of its own carries the material's",
         false, "'"},
    Fact{"a skydome that the camera sees is the background B; one that lights a surface is L",
         false, "", Fact::bit(CommonKind::Background)},
};
constexpr std::array kPrefixes{Prefix{"unoccluded", "unoccluded"}};

struct Alias {
    std::string_view name, text;
};
constexpr std::array kAliases{
    Alias{"caustic", "CD[S]+[<L.>O]"},
    Alias{"diffuse", "CD[<L.>O]"},
    Alias{"emission", "CO"},
    Alias{"glossy", "CG[<L.>O]"},
    Alias{"mirror", "CS[<L.>O]"},
    Alias{"reflection", "C<RS>[DSG]+[<L.>O]"},
    Alias{"translucent", "C<TD>[DSG]+[<L.>O]"},
    Alias{"transmission", "C<TS>[DSG]+[<L.>O]"},
};

View view(const CommonEvent& event) {
    if (event.kind == CommonKind::ForeignEnd) {
        if (kUserEvents.find(event.name[0]) == std::string_view::npos || event.name.size() != 1)
            return {View::Form::Absent, {}};
        return {View::Form::Hit, {event.name[0], "", {std::string(kPlaceholder)}}};
    }
    View out = osl_view(event);
    if (out.form != View::Form::Hit) return out;
    std::vector<std::string>& labels = out.hit.labels;
    if (!event.label.empty() && !event.object.empty())
        labels.assign(1, event.object + "." + event.label);
    if (labels.empty()) labels.emplace_back(kPlaceholder);
    return out;
}

/// Prefix and alias; what is left is an expression.
std::string_view unwrap(std::string_view text, SourceSpan& base, Reading& reading,
                        Diagnostics& diagnostics) {
    take_prefixes(text, base, kPrefixes, "MoonRay", true, reading, diagnostics);
    const auto alias = std::ranges::find(kAliases, text, &Alias::name);
    if (alias == kAliases.end()) return text;
    reading.notes.push_back("\"" + std::string(text) + "\" is MoonRay's name for " +
                            std::string(alias->text));
    base = {};
    return alias->text;
}

Reading with_prefixes(Reading reading, Reading before) {
    reading.prefixes = std::move(before.prefixes);
    reading.notes.insert(reading.notes.end(), before.notes.begin(), before.notes.end());
    return reading;
}

Reading read(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    Reading before;
    SourceSpan place = base;
    const std::string_view rest = unwrap(text, place, before, diagnostics);
    return with_prefixes(read_osl(rest, place, diagnostics, kOptions), std::move(before));
}

Reading read_as_meant(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    Reading before;
    SourceSpan place = base;
    const std::string_view rest = unwrap(text, place, before, diagnostics);
    return with_prefixes(read_osl_as_meant(rest, place, diagnostics, kUserEvents),
                         std::move(before));
}

std::vector<LetterText> letters(const LabelSets&) {
    std::vector<LetterText> out = osl_letters();
    for (const char letter : kUserEvents)
        out.push_back(bare_event(letter));
    return out;
}

bool is_label(const std::string& carried, const std::string& wanted) {
    return is_dotted_label(carried, wanted);
}

std::vector<LabelText> labels(const LabelSets& sets) {
    // Both parts at once: 'hero.coat'.
    LabelSets all = sets;
    for (const std::vector<std::string>& object : sets)
        for (const std::vector<std::string>& lobe : sets)
            if (object.size() == 1 && lobe.size() == 1 && object != lobe)
                all.push_back({object[0] + "." + lobe[0]});
    return label_texts(all, {.n = 1, .negation_takes_none = false, .is = is_label});
}

}  // namespace

const Dialect& moonray_dialect() {
    static const Dialect dialect{.name = "moonray",
                                 .title = "DreamWorks MoonRay",
                                 .facts = kFacts,
                                 .prefixes = kPrefixes,
                                 .repeats = Repeats::Counts,
                                 .view = view,
                                 .read = read,
                                 .read_as_meant = read_as_meant,
                                 .letters = letters,
                                 .labels = labels};
    return dialect;
}

}  // namespace lightsieve::lpe::dialects
