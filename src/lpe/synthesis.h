// A set of paths back to a short expression.
//
// From the minimal automaton: what may follow a state is written as a choice of events, those with
// the same continuation together, each followed by what may follow it. A loop is a star. Only
// states that lead to one another in a circle are eliminated one by one, as textbooks do. Two
// things make the result short: an event may be taken too often if its own continuation allows at
// least as much, and what comes after the end of a path does not matter.
//
// Internal to rest.h, which proves that the result is right.
#pragma once

#include <cstddef>
#include <span>

#include "core/event.h"
#include "lpe/algebra.h"
#include "lpe/ast.h"
#include "lpe/limits.h"

namespace lightsieve::lpe {

/// An expression that takes the same paths made of these events as `set` does.
///
/// labels      those that the result may name
/// max_length  of its text [bytes]
/// returns     null if there is no path, or if it would be longer or needs more than a fixed amount
///             of work
/// throws      OverBudget
[[nodiscard]] Expr synthesise(const Expr& set, std::span<const Event> events,
                              const LabelClasses& labels, std::size_t max_length,
                              const Limits& limits);

}  // namespace lightsieve::lpe
