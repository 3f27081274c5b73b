// What a set of AOVs leaves over, as an expression that a person can read.
//
// An automaton turned into text by the textbook (state elimination) is a page long. What is left
// over of the beauty is rarely complicated: some first events, some continuations. So the set is
// written down one event at a time, events that have the same continuation together, each group of
// events in the shortest way that the language has (a letter, `<RS'coat'>`, `[^'coat']`, `[TVLOB]`),
// and the text may be wrong about what is no light path anyway. The automata prove that it is right.
#pragma once

#include <span>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/limits.h"

namespace lightsieve::lpe {

/// An expression for the paths of `whole` that no part takes; null if there are none.
///
/// returns  an expression that takes exactly those, over all paths. Where the language of Arnold
///          needs more than kMaxReadableLength for it, the shorter `whole - (a|b)`
/// throws   InputError (limit)
[[nodiscard]] Expr rest(const Expr& whole, std::span<const Expr> parts, const Limits& limits = {});
/// The same among the paths made of these events (a scene's): it may say something else about
/// others.
[[nodiscard]] Expr rest(const Expr& whole, std::span<const Expr> parts,
                        std::span<const Event> events, const Limits& limits = {});

/// The expression in the shortest form that is found; null for null and if it takes no path.
[[nodiscard]] Expr simplify(const Expr& expr, const Limits& limits = {});

/// A text up to this length is preferred to a difference, and longer ones are not looked for than
/// kMaxRestLength [bytes].
inline constexpr std::size_t kMaxReadableLength = 80, kMaxRestLength = 400;

}  // namespace lightsieve::lpe
