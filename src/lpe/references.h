// Puts the expressions that `$name` stands for into a tree.
//
// A reference shares the tree of the expression that it names, so a chain of definitions that each
// name the one before twice costs little to write but doubles in size at each step: how large and
// how deep an expression may become is limited. ExpressionTable::resolve does the same for
// expressions that name one another, and finds the cycles.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/diagnostics.h"
#include "lpe/ast.h"

namespace lightsieve::lpe {

class ExpressionTable;  // builtins.h

/// Nodes of an expression with everything that its references stand for.
inline constexpr std::size_t kMaxExpandedNodes = std::size_t{1} << 18U;
/// Height of its tree.
inline constexpr std::size_t kMaxExpandedDepth = 1280;

/// The expression with every reference resolved by the table (custom expressions first).
///
/// aov_name     put before every message, if not empty
/// diagnostics  gets names that the table does not have, with the nearest ones; names whose own
///              expression has an error; an expression that becomes too large
/// returns      null if there was an error, or for null; the same tree if there is nothing to do
[[nodiscard]] Expr resolve_references(const Expr& expr, const ExpressionTable& table,
                                      std::string_view aov_name, Diagnostics& diagnostics);

/// Does a reference stand in it that is not resolved?
[[nodiscard]] bool has_unresolved(const Expr& expr);

}  // namespace lightsieve::lpe
