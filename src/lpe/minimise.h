// The smallest automaton that does the same.
//
// Hopcroft's partition refinement: states start in blocks of equal output, and a block is split
// when some of its states lead into a block that others do not. n log n in the number of states
// for a fixed alphabet. Source: Hopcroft 1971, "An n log n algorithm for minimizing states in a
// finite automaton".
#pragma once

#include "lpe/determinise.h"

namespace lightsieve::lpe {

/// Merges states that no path tells apart. Outputs are kept; state 0 stays the dead state; the
/// others are numbered in breadth-first order from the start, so that equal automata come out
/// equal.
[[nodiscard]] Dfa minimise(const Dfa& dfa);

}  // namespace lightsieve::lpe
