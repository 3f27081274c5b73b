// Every intermediate as text, for people who look for a mistake and for tests that compare whole
// results.
#pragma once

#include <string>

#include "lpe/ast.h"
#include "lpe/determinise.h"
#include "lpe/program.h"

namespace lightsieve::lpe {

/// The tree, one node a line, children indented.
[[nodiscard]] std::string dump(const Expr& expr);
/// The transitions and output numbers, one state a line.
[[nodiscard]] std::string dump(const Dfa& dfa);
/// Classes with an example event each, then for every automaton its states: where each class
/// leads, what each terminal yields, what is still alive.
[[nodiscard]] std::string dump(const Program& program);

}  // namespace lightsieve::lpe
