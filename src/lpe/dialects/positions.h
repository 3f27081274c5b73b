// The automaton of a pattern's positions: one state for every place where an event stands
// (Glushkov 1961). Repeats with counts are written out.
//
// Internal to language.cpp and event_uses.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "lpe/dialects/pattern.h"
#include "lpe/limits.h"

namespace lightsieve::lpe::dialects {

struct Positions {
    std::vector<const Pattern*> node;                ///< per position: its Event node
    std::vector<std::vector<std::uint32_t>> follow;  ///< per position: what may stand after it
    std::vector<std::uint32_t> first;
    std::vector<bool> is_last;  ///< per position: may the pattern end with it?
    bool nullable = false;
};

/// The pattern must have no booleans. Throws OverBudget.
[[nodiscard]] Positions positions_of(const Pattern& pattern, const Limits& limits);

}  // namespace lightsieve::lpe::dialects
