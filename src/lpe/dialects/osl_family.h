// What OSL and the renderers that carry its parser have in common.
//
// Internal to the dialects of that family.
#pragma once

#include "lpe/dialects/osl_reader.h"
#include "lpe/dialects/spelling.h"

namespace lightsieve::lpe::dialects {

/// A common event with its labels in order, those that there are.
[[nodiscard]] View osl_view(const CommonEvent& event);
/// The letters to write with.
[[nodiscard]] std::vector<LetterText> osl_letters();
/// A text as the rules of regular expressions and the parts of an event's tuple suggest: `|` as
/// far as it can, everything up to the end, blanks free, `<D>`, `<L'key'>` and labels in any
/// order, [^'x'] also where there is no label.
[[nodiscard]] Reading read_osl_as_meant(std::string_view text, const SourceSpan& base,
                                        Diagnostics& diagnostics, std::string_view user_events);

}  // namespace lightsieve::lpe::dialects
