// Sets of common paths as automata: how two expressions of different dialects are compared.
//
// A resolved pattern becomes an automaton over its positions (Glushkov 1961), then a deterministic
// one by subsets. What a dialect does not see (a cut-out, for Arnold) may happen anywhere: such
// events lead from every state back to it. Every automaton here takes light paths only, as
// `CommonAlphabet::step` defines them. Everything may throw OverBudget (lpe/limits.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "lpe/dialects/common.h"
#include "lpe/dialects/pattern.h"
#include "lpe/limits.h"

namespace lightsieve::lpe::dialects {

/// A complete deterministic automaton over the common alphabet.
struct Automaton {
    std::vector<std::uint32_t> class_of;  ///< per symbol
    std::uint32_t n_classes = 0;
    std::vector<std::uint32_t> next;  ///< next[state * n_classes + class]
    std::vector<bool> accepts;        ///< per state
    std::uint32_t start = 0;

    [[nodiscard]] std::size_t n_states() const { return accepts.size(); }
    [[nodiscard]] std::uint32_t step(std::uint32_t state, Symbol s) const {
        return next[state * n_classes + class_of[s]];
    }
};

/// The paths of a resolved pattern.
///
/// invisible  the events that the pattern's dialect does not see
[[nodiscard]] Automaton paths_of(const Pattern& pattern, const CommonAlphabet& alphabet,
                                 const SymbolSet& invisible, const Limits& limits);

/// The smallest automaton that takes the same paths.
[[nodiscard]] Automaton minimise(const Automaton& automaton, const Limits& limits);

/// A shortest path, of these events, that `a` takes and `b` does not; nothing if there is none.
[[nodiscard]] std::optional<CommonPath> path_outside(const Automaton& a, const Automaton& b,
                                                     const CommonAlphabet& alphabet,
                                                     const SymbolSet& events,
                                                     const Limits& limits);
/// A shortest path that the automaton takes.
[[nodiscard]] std::optional<CommonPath> shortest_path(const Automaton& automaton,
                                                      const CommonAlphabet& alphabet,
                                                      const Limits& limits);
[[nodiscard]] bool same_paths(const Automaton& a, const Automaton& b,
                              const CommonAlphabet& alphabet, const Limits& limits);

/// Where in paths an event of a pattern stands.
struct EventUse {
    SymbolSet taken;  ///< of its events: those that it takes in some path of the whole pattern
    SymbolSet free;   ///< events that it might take as well without a path being added
};
/// The use of every Event node of a resolved pattern without booleans.
[[nodiscard]] std::unordered_map<const Pattern*, EventUse> event_uses(
    const Pattern& pattern, const CommonAlphabet& alphabet, const SymbolSet& invisible,
    const Limits& limits);

/// A pattern for the automaton's paths, in which nothing is invisible: states are eliminated one
/// by one. Made for reading by a writer, not by people.
[[nodiscard]] PatternPtr to_pattern(const Automaton& automaton, const CommonAlphabet& alphabet,
                                    const Limits& limits);

}  // namespace lightsieve::lpe::dialects
