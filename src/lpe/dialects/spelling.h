// Builds the tests that a dialect can be written with, from its letters and from label sets.
//
// A dialect's file says which letters there are and what they take; the combinations are the same
// for most of them.
#pragma once

#include <string>
#include <vector>

#include "lpe/dialects/dialect.h"

namespace lightsieve::lpe::dialects {

using LabelSets = std::vector<std::vector<std::string>>;

/// One choice for a place inside <..>: its text and what it takes.
struct PlaceText {
    std::string text;
    HitTest test;
};

/// `R`, `[RT]`, ...: hits whose event is one of the letters.
[[nodiscard]] PlaceText event_place(const std::string& letters);
/// `D`, `[DG]`, `[S1S2]`: hits whose lobe is one of the lobes; a lobe of one letter takes its
/// numbered ones too.
[[nodiscard]] PlaceText lobe_place(const std::vector<std::string>& lobes);

/// Every event place with every lobe place, as <..> without labels and as the inside for labels.
[[nodiscard]] std::vector<LetterText> tuples_of(const std::vector<PlaceText>& events,
                                                const std::vector<PlaceText>& lobes);
/// The same letters as bare events: `L`, inside `L.`.
[[nodiscard]] LetterText bare_event(char letter);
/// `D`, inside `.D`; `events` are the letters that `.` takes there.
[[nodiscard]] LetterText bare_lobe(const std::string& lobe, HitTest any_event);

/// How the labels of a hit are tested.
struct LabelPlaces {
    std::size_t n = 1;  ///< places that can be tested one by one; 0: labels are a set
    /// Does "none of these" pass where there is no label?
    bool negation_takes_none = true;
    bool (*is)(const std::string& carried, const std::string& wanted) = nullptr;
};
/// Every test of labels: each place any, one of a set, or none of a set.
[[nodiscard]] std::vector<LabelText> label_texts(const LabelSets& sets, const LabelPlaces& places);

}  // namespace lightsieve::lpe::dialects
