// How a set of AOVs divides the light: each region is the paths that exactly the same AOVs take.
//
// With the regions every question about a set is simple arithmetic on sets of small numbers: two
// AOVs are equal if they are in the same regions, one is contained in another, one is dead if it is
// in none, and AOVs add up to a whole if each of the whole's regions is in exactly one of them. So
// sums are looked for among all AOVs, not only among well-known sets, by an exact-cover search, and
// what is found is proved. Regions are a Program's atoms that some path really reaches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/event.h"
#include "lpe/algebra.h"
#include "lpe/limits.h"
#include "lpe/path.h"
#include "lpe/program.h"

namespace lightsieve::lpe {

/// Paths that the same AOVs take.
struct Region {
    std::vector<std::uint32_t> aovs;  ///< indices of the requests, ascending, never empty
    Path example;                     ///< a shortest one of its paths
    double share = 0;  ///< of a random walk that ends at half of its vertices: to compare sizes
};

/// The events to give to `regions` for an answer about every scene whose lights are in these groups
/// (or in none): as `abstract_events`, for AOVs that are restricted to a group.
[[nodiscard]] std::vector<Event> possible_events(std::span<const AovRequest> aovs,
                                                 std::span<const std::string> groups,
                                                 const Limits& limits = {});

/// The regions of these AOVs among the paths that can be made of `events`, shortest example first.
///
/// throws  InputError (limit) if the AOVs together exceed the budget of one automaton
[[nodiscard]] std::vector<Region> regions(std::span<const AovRequest> aovs,
                                          std::span<const Event> events,
                                          const Limits& limits = {});

/// How the paths of AOVs a and b lie to one another. A dead AOV is a subset of every other.
[[nodiscard]] Relation relation(std::span<const Region> regions, std::uint32_t a, std::uint32_t b);

/// AOVs that take each path of a whole exactly once, and nothing else.
struct Sum {
    std::uint32_t whole = 0;
    std::vector<std::uint32_t> parts;  ///< two or more, ascending
};

/// Sums for `whole` among AOVs 0..n_aovs-1, fewest parts first. Left out: dead AOVs, all but the
/// first of equal ones, and sums in which some parts could be replaced by another AOV that is their
/// sum (that one is listed instead). The search ends after a fixed number of steps; what it has
/// found by then holds.
[[nodiscard]] std::vector<Sum> find_sums(std::span<const Region> regions, std::size_t n_aovs,
                                         std::uint32_t whole, std::size_t max_sums = 20);

/// AOVs of which no two share a path and which take as much of the whole as possible, and nothing
/// else; the fewest among equals. Empty if no AOV is a part of the whole.
[[nodiscard]] std::vector<std::uint32_t> nearest_parts(std::span<const Region> regions,
                                                       std::size_t n_aovs, std::uint32_t whole);

}  // namespace lightsieve::lpe
