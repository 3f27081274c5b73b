#include "lpe/dialects/osl_family.h"

#include "lpe/dialects/tuple_reader.h"

namespace lightsieve::lpe::dialects {
namespace {

bool any_event(const Hit&) { return true; }

std::string hint(char c) {
    if (c == 'A') return "albedo is a user event here; ask the renderer for its letter";
    return "";
}

constexpr TupleOptions kAsMeant{.renderer = "OSL",
                                .events = "CLBVTRO",
                                .lobes = "DGSs",
                                .tight = false,
                                .repeats = Repeats::All,
                                .any_place = true,
                                .any_event = any_event,
                                .any_lobe = any_event,
                                .hint = hint};
constexpr TupleOptions kMoonrayAsMeant{.renderer = "MoonRay",
                                       .events = "CLBVTROUM",
                                       .lobes = "DGSs",
                                       .tight = false,
                                       .repeats = Repeats::All,
                                       .any_place = true,
                                       .any_event = any_event,
                                       .any_lobe = any_event,
                                       .hint = hint};

}  // namespace

View osl_view(const CommonEvent& event) {
    Hit hit;
    const auto add_label = [&](const std::string& label) {
        if (!label.empty()) hit.labels.push_back(label);
    };
    add_label(event.label);
    add_label(event.object);
    add_label(event.group);
    switch (event.kind) {
        case CommonKind::Camera: break;
        case CommonKind::Reflection: hit.event = 'R'; break;
        case CommonKind::Transmission: hit.event = 'T'; break;
        case CommonKind::Volume: hit.event = 'V'; break;
        case CommonKind::Straight:
            hit.event = 'T';
            hit.lobe = "s";
            break;
        case CommonKind::Light: hit.event = 'L'; break;
        case CommonKind::Object: hit.event = 'O'; break;
        case CommonKind::Background: hit.event = 'B'; break;
        case CommonKind::Probe:
        case CommonKind::Foreign:
        case CommonKind::ForeignEnd: return {View::Form::Absent, {}};
    }
    if (event.lobe == CommonLobe::Diffuse) hit.lobe = "D";
    if (event.lobe == CommonLobe::Glossy) hit.lobe = "G";
    if (event.lobe == CommonLobe::Mirror) hit.lobe = "S";
    return {View::Form::Hit, std::move(hit)};
}

std::vector<LetterText> osl_letters() {
    std::vector<LetterText> out{{".", "..", any_event}, bare_event('C')};
    for (const char* lobe : {"D", "G", "S", "s"})
        out.push_back(bare_lobe(lobe, any_event));
    for (const char letter : {'R', 'T', 'V', 'L', 'O', 'B'})
        out.push_back(bare_event(letter));
    const std::vector<PlaceText> lobes{lobe_place({"D"}),      lobe_place({"G"}),
                                       lobe_place({"S"}),      lobe_place({"s"}),
                                       lobe_place({"G", "S"}), lobe_place({"D", "G"}),
                                       lobe_place({"D", "S"}), lobe_place({"D", "G", "S"})};
    for (LetterText& tuple : tuples_of({event_place("R"), event_place("T")}, lobes))
        out.push_back(std::move(tuple));
    // A choice of lobes of any event: bare letters do without labels, <..> with them.
    for (const PlaceText& lobe : lobes)
        if (lobe.text.size() > 1) out.push_back({lobe.text, "." + lobe.text, lobe.test});
    return out;
}

Reading read_osl_as_meant(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
                          std::string_view user_events) {
    return read_tuples(text, base, diagnostics, user_events.empty() ? kAsMeant : kMoonrayAsMeant);
}

}  // namespace lightsieve::lpe::dialects
