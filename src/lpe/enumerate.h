// How many paths an expression takes, and which are the shortest.
//
// For people: three examples say more than an automaton. Examples that differ in labels only would
// be copies of one another, so paths are listed by what happens on them (RD, TS, L ..) and each
// list of happenings once, with the first labels that the expression allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/limits.h"
#include "lpe/path.h"

namespace lightsieve::lpe {

/// How many different paths of exactly `length` events (the camera included) the expression takes
/// that are made of these events. UINT64_MAX stands for that number and all larger ones.
///
/// throws  InputError (limit)
[[nodiscard]] std::uint64_t count_paths(const Expr& expr, std::span<const Event> events,
                                        std::size_t length, const Limits& limits = {});

/// The n shortest paths that the expression takes, no two of which differ in labels only; fewer if
/// there are fewer. Sorted by length, then by the order of `events`.
///
/// throws  InputError (limit)
[[nodiscard]] std::vector<Path> shortest_paths(const Expr& expr, std::span<const Event> events,
                                               std::size_t n, const Limits& limits = {});
/// The same over all paths.
[[nodiscard]] std::vector<Path> shortest_paths(const Expr& expr, std::size_t n,
                                               const Limits& limits = {});

}  // namespace lightsieve::lpe
