// How much work an expression may make before it is refused: no expression, however built, hangs
// or eats the memory.
//
// The limits of the text itself (length, nesting, counts) are in parse.h.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "core/error.h"

namespace lightsieve::lpe {

/// Budgets of one automaton or proof. A set of expressions that exceeds one is split; a single
/// expression is an error.
struct Limits {
    std::size_t max_states = 100'000;           ///< states of one automaton, before minimisation
    std::size_t max_steps = 5'000'000;          ///< derivative steps
    std::size_t max_nodes = 1'000'000;          ///< nodes of derived expressions
    std::size_t max_table_bytes = 256U << 20U;  ///< transitions and atoms of one automaton [bytes]
    std::size_t max_automata = 64;              ///< automata stepped together
    std::size_t max_labels = 100;  ///< labels of lobes that one proof over all paths tells apart,
                                   ///< and ten times as many light groups
};

/// Thrown within the engine when a budget is exceeded; turned into an `Error` where the
/// expression's name is known.
struct OverBudget {
    Code code;            ///< one of the limit-lpe-* codes
    std::string message;  ///< "needs more than 100000 states"
    std::string limit;    ///< the field of `Limits`

    /// As an error about `what` ("the proof"), at a place that may be unknown.
    [[nodiscard]] Error error(const std::string& what, SourceSpan where) const {
        return {code, what + " " + message, std::move(where), "the limit is " + limit,
                {},   Severity::Error};
    }
};

}  // namespace lightsieve::lpe
