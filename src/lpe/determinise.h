// A set of expressions to one deterministic automaton that says, at every end of a path, which of
// them take it.
//
// A state is a vector with one derivative for each expression; stepping it steps all of them, and
// equal vectors are one state. Only scattering events move between states: what a terminal event
// yields is a state's output. Source: Owens, Reppy, Turon 2009, section 5 (regular vectors).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lpe/alphabet.h"
#include "lpe/ast.h"
#include "lpe/interner.h"
#include "lpe/limits.h"

namespace lightsieve::lpe {

/// A complete deterministic automaton with one output per state.
struct Dfa {
    std::size_t n_classes =
        0;  ///< scattering classes; class c of the alphabet is column c - kFirstScatter
    std::vector<std::uint32_t> next;    ///< next[state * n_classes + column]
    std::vector<std::uint32_t> output;  ///< per state; output 0 is "no path ends here"
    std::uint32_t start = 0;            ///< the state after the camera event

    /// State 0 exists always: output 0, and it leads to itself only.
    [[nodiscard]] std::size_t n_states() const { return output.size(); }
    [[nodiscard]] std::uint32_t step(std::uint32_t state, EventClass c) const {
        return next[state * n_classes + (c - Alphabet::kFirstScatter)];
    }
};

/// An automaton whose outputs say which expressions take the path that ends with each terminal
/// class.
struct Determinised {
    Dfa dfa;
    Interner outputs;         ///< per output: a number of `sets` for each terminal class
    Interner sets;            ///< indices of expressions, ascending; set 0 is empty
    std::size_t n_steps = 0;  ///< derivative steps that it took

    /// Does expression `expr` take the path that ends in `state` with a terminal of class c?
    [[nodiscard]] bool accepts(const Alphabet& alphabet, std::uint32_t state, EventClass c,
                               std::uint32_t expr) const;
};

/// Builds the automaton. Throws OverBudget.
[[nodiscard]] Determinised determinise(std::span<const Expr> exprs, const Alphabet& alphabet,
                                       const Limits& limits);

}  // namespace lightsieve::lpe
