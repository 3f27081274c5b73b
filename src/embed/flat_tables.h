// A program of the engine as a few flat arrays, for renderers that embed it, for GPUs and for
// files.
//
// All automata lie in one table, one row a state, so that a state says which automaton it belongs
// to. The dead states of all automata become row 0. The layout is public: it is described at
// `lightsieve_tables` in include/lightsieve/lightsieve.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/event.h"
#include "lpe/program.h"

namespace lightsieve::embed {

/// What `lightsieve_tables` points into.
struct FlatTables {
    std::vector<std::uint32_t> table;          ///< rows: flags, next states, atoms
    std::uint32_t stride = 1;                  ///< numbers a row
    std::uint32_t first_terminal = 1;          ///< column of the first atom
    std::vector<std::uint32_t> starts;         ///< the start of each automaton
    std::vector<std::uint32_t> event_columns;  ///< of each event that was given
    std::vector<std::uint32_t> atom_begin;     ///< into atom_aovs, one more than there are atoms
    std::vector<std::uint32_t> atom_aovs;      ///< the AOVs of each atom, one after the other
};

/// Most numbers that a table may have: offsets are 32 bits, and 1 GiB is enough.
inline constexpr std::size_t kMaxTableWords = std::size_t{1} << 28U;

/// Flattens a program.
///
/// events   those whose columns are wanted; all of them were given to `Program::compile`
/// returns  the arrays; nothing if the table would have more than `max_words` numbers
[[nodiscard]] std::optional<FlatTables> flatten(const lpe::Program& program,
                                                std::span<const Event> events,
                                                std::size_t max_words = kMaxTableWords);

}  // namespace lightsieve::embed
