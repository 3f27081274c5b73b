// Tree to text, in the one spelling that every renderer's dialect reads alike.
//
// Alternatives are always ((..)|(..)). Reading the text again gives an equal tree (for trees that
// `parse` made).
#pragma once

#include <string>

#include "lpe/ast.h"

namespace lightsieve::lpe {

/// The expression as text; "" for null.
[[nodiscard]] std::string print(const Expr& expr);
[[nodiscard]] std::string print(const Node& node);

}  // namespace lightsieve::lpe
