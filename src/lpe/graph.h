// The smallest automaton of one or several expressions, drawn: text for the program `dot` of
// Graphviz.
//
// Circles are where a path can be, boxes are atoms: the sets of expressions that take a path which
// ends there, each in a colour of its own. Edges carry the events in short words (`RS except coat`,
// `any light`). The state in which all is lost is left out, and so is what leads to it.
#pragma once

#include <span>
#include <string>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/limits.h"

namespace lightsieve::lpe {

/// Most states that are drawn; more is no picture.
inline constexpr std::size_t kMaxDrawnStates = 200;

/// The automaton as Graphviz text.
///
/// exprs   one or more; `name` labels the atoms
/// events  what paths are made of; empty: all paths
/// throws  InputError (limit): a budget of the engine or kMaxDrawnStates is exceeded
[[nodiscard]] std::string graph(std::span<const NamedExpr> exprs,
                                std::span<const Event> events = {}, const Limits& limits = {});

}  // namespace lightsieve::lpe
