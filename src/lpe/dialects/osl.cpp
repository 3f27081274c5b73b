// Open Shading Language's own engine, as renderers embed it; and the same in a renderer that gives
// unlabelled events a placeholder label.
#include <array>

#include "lpe/dialects/osl_family.h"

namespace lightsieve::lpe::dialects {
namespace {

constexpr std::string_view kPlaceholder = "placeholder";

constexpr std::array kFamilyFacts{
    Fact{"`|` joins one item on each side, and what follows a leading parenthesis is ignored",
         true, "|"},
    Fact{"G is glossy, S is a perfect mirror only", true},
    Fact{"labels are tested in order", true, "'"},
    Fact{"passing through a cut-out is an event <Ts>", true, "s>",
         Fact::bit(CommonKind::Straight)},
    Fact{"the lobe's label comes before the object's, if a renderer gives both", false, "'"},
    Fact{"the label of a light is its group", false, "<L."},
    Fact{"a skydome that the camera sees is the background B; one that lights a surface is L",
         false, "", Fact::bit(CommonKind::Background)},
    Fact{"subsurface scattering is <TD>; the renderer decides", false, "TD"},
};

constexpr auto with(const Fact& own) {
    std::array<Fact, kFamilyFacts.size() + 1> all{own};
    for (std::size_t i = 0; i < kFamilyFacts.size(); ++i)
        all[i + 1] = kFamilyFacts[i];
    return all;
}
constexpr auto kFacts = with({"an event without labels does not pass a [^'x']", true, "[^'"});
constexpr auto kPlaceholderFacts =
    with({"the renderer gives every event without labels the label 'placeholder'", false, "'"});

View view(const CommonEvent& event) { return osl_view(event); }

View view_with_placeholder(const CommonEvent& event) {
    View out = osl_view(event);
    if (out.form == View::Form::Hit && out.hit.labels.empty())
        out.hit.labels.emplace_back(kPlaceholder);
    return out;
}

Reading read(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    return read_osl(text, base, diagnostics, {});
}
Reading read_with_placeholder(std::string_view text, const SourceSpan& base,
                              Diagnostics& diagnostics) {
    return read_osl(text, base, diagnostics,
                    {.renderer = "OSL with a placeholder", .every_event_is_labelled = true});
}
Reading read_as_meant(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    return read_osl_as_meant(text, base, diagnostics, "");
}

std::vector<LetterText> letters(const LabelSets&) { return osl_letters(); }
std::vector<LabelText> labels(const LabelSets& sets) {
    return label_texts(sets, {.n = 2, .negation_takes_none = false});
}

}  // namespace

const Dialect& osl_dialect() {
    static const Dialect dialect{.name = "osl",
                                 .title = "Open Shading Language",
                                 .facts = kFacts,
                                 .prefixes = {},
                                 .repeats = Repeats::Counts,
                                 .view = view,
                                 .read = read,
                                 .read_as_meant = read_as_meant,
                                 .variant = osl_placeholder_dialect,
                                 .letters = letters,
                                 .labels = labels};
    return dialect;
}

const Dialect& osl_placeholder_dialect() {
    static const Dialect dialect{
        .name = "osl-placeholder",
        .title = "Open Shading Language in a renderer that labels every event",
        .facts = kPlaceholderFacts,
        .prefixes = {},
        .repeats = Repeats::Counts,
        .view = view_with_placeholder,
        .read = read_with_placeholder,
        .read_as_meant = read_as_meant,
        .letters = letters,
        .labels = labels};
    return dialect;
}

}  // namespace lightsieve::lpe::dialects
