// Pixar RenderMan: numbered lobes, object groups in the third place, `.` that takes lobes only.
#include <algorithm>
#include <array>
#include <cctype>

#include "lpe/dialects/spelling.h"
#include "lpe/dialects/tuple_reader.h"

namespace lightsieve::lpe::dialects {
namespace {

/// The label of lobes that let light straight through.
constexpr std::string_view kStraight = "passthru";

constexpr std::array kFacts{
    Fact{"`|` joins one item on each side", true, "|"},
    Fact{"what follows a leading parenthesis is read", false, "("},
    Fact{"`.` takes reflections and transmissions only", true, "."},
    Fact{"S is every specular lobe, rough or not", true, "S"},
    Fact{"a light or emission that the camera sees is O", true, "O",
         Fact::bit(CommonKind::Light) | Fact::bit(CommonKind::Object)},
    Fact{"which lobe has which number is set by the scene's options; these are the usual ones",
         false, "1"},
    Fact{"D3 is subsurface, S4 clear coat, S6 fuzz, S8 glass, as the usual options say", false,
         "D3"},
    Fact{"S4 is the clear coat, the label 'coat' elsewhere", false, "S4"},
    Fact{"S6 is fuzz, the label 'sheen' elsewhere", false, "S6"},
    Fact{"an event of no group passes a [^'group']", false, "[^'"},
    Fact{"passing through a cut-out is a specular transmission of the group 'passthru'", false, "",
         Fact::bit(CommonKind::Straight)},
    Fact{"no expression can name scattering in a volume", false, "",
         Fact::bit(CommonKind::Volume)},
    Fact{"the background is O where the camera sees it, else L", false, "",
         Fact::bit(CommonKind::Background)},
    Fact{"the third place of a light is its group", false, "<L"},
};

constexpr std::array kPrefixes{
    Prefix{"unoccluded", "unoccluded"},
    Prefix{"noclamp", "noclamp"},
    Prefix{"nothruput", "nothruput"},
    Prefix{"shadow", "shadows"},
    Prefix{"holdouts", "holdouts"},
    Prefix{"overwrite", "overwrite"},
    Prefix{"noinfinitecheck", "noinfinitecheck"},
};

/// Lobe labels and the numbers that the bridges' usual options give such lobes. A lobe without
/// one of these is number 1.
struct Slot {
    std::string_view lobe, label;
};
constexpr std::array kSlots{
    Slot{"D2", "diffuse"},     Slot{"D3", "subsurface"}, Slot{"D4", "diffuse4"},
    Slot{"S2", "specular"},    Slot{"S3", "rough"},      Slot{"S4", "coat"},
    Slot{"S5", "iridescence"}, Slot{"S6", "sheen"},      Slot{"S7", "single_scatter"},
    Slot{"S8", "glass"},
};
constexpr std::array<std::string_view, kSlots.size()> kSlotLabels{
    "diffuse", "subsurface",  "diffuse4", "specular",       "rough",
    "coat",    "iridescence", "sheen",    "single_scatter", "glass"};

std::string slot_of(char lobe, const std::string& label) {
    for (const Slot& slot : kSlots)
        if (slot.lobe[0] == lobe && slot.label == label) return std::string(slot.lobe);
    return std::string{lobe, '1'};
}

View hit(char event, std::string lobe, const std::string& group) {
    View out{View::Form::Hit, {event, std::move(lobe), {}}};
    if (!group.empty()) out.hit.labels.push_back(group);
    return out;
}

View view(const CommonEvent& event) {
    const char lobe = event.lobe == CommonLobe::Diffuse ? 'D' : 'S';
    switch (event.kind) {
        case CommonKind::Camera: return hit('C', "", "");
        case CommonKind::Reflection: return hit('R', slot_of(lobe, event.label), event.object);
        case CommonKind::Transmission: return hit('T', slot_of(lobe, event.label), event.object);
        case CommonKind::Straight: return hit('T', "S1", std::string(kStraight));
        case CommonKind::Light:
        case CommonKind::Background: return hit(event.seen ? 'O' : 'L', "", event.group);
        case CommonKind::Object: return hit('O', "", event.object);
        case CommonKind::Foreign:
            if (event.name[0] == 'U') return hit('U', event.name, "");
            break;
        case CommonKind::Volume:
        case CommonKind::Probe:
        case CommonKind::ForeignEnd: break;
    }
    return {View::Form::Absent, {}};
}

bool any_event(const Hit& hit) { return hit.event == 'R' || hit.event == 'T' || hit.event == 'U'; }
bool any_lobe(const Hit& hit) { return hit.event != 'U'; }
bool any(const Hit& hit) { return any_event(hit) && any_lobe(hit); }

std::string hint(char c) {
    switch (c) {
        case 'G': return "S is every specular lobe here, glossy or not";
        case 's': return "light that goes straight through is <TS'passthru'>";
        case 'V': return "its documents name no event for volumes";
        case 'B': return "the background is O where the camera sees it, else L";
        case 'A': return "albedo is a user lobe here: U2, with prefixes";
        case 'E': return "the camera is C";
        default: return "";
    }
}

constexpr TupleOptions kOptions{.renderer = "RenderMan",
                                .events = "CRTLO",
                                .lobes = "DSU",
                                .numbered = "DSU",
                                .max_number = 12,
                                .foreign = "U",
                                .label_places = 1,
                                .any_event = any_event,
                                .any_lobe = any_lobe,
                                .hint = hint};
constexpr TupleOptions kAsMeant{.renderer = "RenderMan",
                                .events = "CRTLO",
                                .lobes = "DSU",
                                .numbered = "DSU",
                                .max_number = 12,
                                .foreign = "U",
                                .tight = false,
                                .repeats = Repeats::All,
                                .label_places = 1,
                                .any_place = true,
                                .any_event = any_event,
                                .any_lobe = any_lobe,
                                .hint = hint};

/// `color lpe:` and prefixes.
Reading read_with(std::string_view text, SourceSpan base, Diagnostics& diagnostics,
                  const TupleOptions& options) {
    Reading before;
    const auto skip = [&](std::string_view word) {
        if (!text.starts_with(word)) return;
        if (base.known() && base.length == text.size())
            base = {base.source, base.offset + word.size(), base.length - word.size()};
        text.remove_prefix(word.size());
    };
    skip("color ");
    skip("lpe:");
    take_prefixes(text, base, kPrefixes, "RenderMan", false, before, diagnostics);
    const bool is_name = text.size() > 1 && std::ranges::all_of(text, [](unsigned char c) {
                             return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_';
                         });
    if (is_name) {
        diagnostics.error(Code::LpeEvent,
                          "\"" + std::string(text) +
                              "\" is the name of an expression in the renderer's configuration",
                          base, "give the expression itself; rendermn.ini has it");
        return before;
    }
    Reading reading = read_tuples(text, base, diagnostics, options);
    reading.prefixes = std::move(before.prefixes);
    return reading;
}

Reading read(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    return read_with(text, base, diagnostics, kOptions);
}
Reading read_as_meant(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics) {
    return read_with(text, base, diagnostics, kAsMeant);
}

/// The lobes that these labels have, and all others of the same letter.
void add_slots(std::vector<PlaceText>& lobes, const std::vector<std::string>& labels, char letter,
               std::size_t n) {
    std::vector<std::string> with, without;
    for (std::size_t i = 1; i <= n; ++i) {
        const std::string lobe = letter + std::to_string(i);
        const bool named = i > 1 && std::ranges::any_of(labels, [&](const std::string& label) {
                               return slot_of(letter, label) == lobe;
                           });
        (named ? with : without).push_back(lobe);
    }
    if (with.empty()) return;
    lobes.push_back(lobe_place(with));
    lobes.push_back(lobe_place(without));
}

std::vector<LetterText> letters(const LabelSets& sets) {
    std::vector<LetterText> out{
        {".", "..", any}, bare_event('C'), bare_event('L'), bare_event('O')};
    for (const char* lobe : {"D", "S"})
        out.push_back(bare_lobe(lobe, any));
    for (const char letter : {'R', 'T'})
        out.push_back(bare_event(letter));
    std::vector<PlaceText> lobes{lobe_place({"D"}), lobe_place({"S"})};
    for (const auto& [letter, n] : {std::pair{'D', std::size_t{4}}, {'S', std::size_t{8}}}) {
        for (std::size_t i = 1; i <= n; ++i)
            lobes.push_back(lobe_place({letter + std::to_string(i)}));
        for (const std::vector<std::string>& set : sets)
            add_slots(lobes, set, letter, n);
    }
    for (const PlaceText& lobe : lobes)
        out.push_back({lobe.text, "." + lobe.text,
                       [test = lobe.test](const Hit& hit) { return any(hit) && test(hit); }});
    for (LetterText& tuple : tuples_of({event_place("R"), event_place("T")}, lobes))
        out.push_back(std::move(tuple));
    for (std::size_t i = 1; i <= kOptions.max_number; ++i) {
        const std::string lobe = "U" + std::to_string(i);
        out.push_back({lobe, "", [lobe](const Hit& hit) { return hit.lobe == lobe; }});
    }
    return out;
}

std::vector<LabelText> labels(const LabelSets& sets) {
    LabelSets all = sets;
    all.push_back({std::string(kStraight)});
    return label_texts(all, {.n = 1});
}

}  // namespace

const Dialect& renderman_dialect() {
    static const Dialect dialect{.name = "renderman",
                                 .title = "Pixar RenderMan",
                                 .facts = kFacts,
                                 .prefixes = kPrefixes,
                                 .repeats = Repeats::StarAndPlus,
                                 .lobe_labels = kSlotLabels,
                                 .view = view,
                                 .read = read,
                                 .read_as_meant = read_as_meant,
                                 .letters = letters,
                                 .labels = labels};
    return dialect;
}

}  // namespace lightsieve::lpe::dialects
