// A second, deliberately naive matcher: for tests only, never in the library.
//
// It walks the tree over the path and tries every way to divide the path among the parts; no
// classes, no derivatives, no states, not one line shared with the engine but the tree itself.
// Slow (it may try every split) but so simple that it can be checked by reading, which makes it a
// good judge. Link lightsieve_lpe_testing.
#pragma once

#include <span>

#include "core/event.h"
#include "lpe/ast.h"

namespace lightsieve::lpe::testing {

/// Does the expression take the path? What is no light path (C, scattering events, one
/// terminal event) is taken by
/// nothing.
[[nodiscard]] bool naive_match(const Expr& expr, std::span<const Event> path);

}  // namespace lightsieve::lpe::testing
