// Does an expression take a path?
//
// For a person's question about one path; a renderer asks a Program.
#pragma once

#include <span>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/limits.h"
#include "lpe/path.h"

namespace lightsieve::lpe {

/// Does the expression take the path? Decided by the states of its automaton that the path goes
/// through, made one by one, so that an expression whose whole automaton is over budget can be
/// asked too.
///
/// path     any events; what is no path (see `is_path`) is taken by no expression
/// throws   InputError (limit) if even this exceeds a budget
[[nodiscard]] bool match(const Expr& expr, std::span<const Event> path, const Limits& limits = {});

}  // namespace lightsieve::lpe
