// A pattern whose events are spelled, as text that every parser of the dialect's family reads
// alike: alternatives as ((..)|(..)), never a parenthesis that something follows at the start.
#pragma once

#include <string>

#include "lpe/dialects/dialect.h"
#include "lpe/dialects/pattern.h"

namespace lightsieve::lpe::dialects {

/// The text; "" for a pattern that takes nothing. Repeats that the dialect lacks are written out,
/// which may make it too long: throws OverBudget.
[[nodiscard]] std::string write(const Pattern& pattern, Repeats repeats);

}  // namespace lightsieve::lpe::dialects
