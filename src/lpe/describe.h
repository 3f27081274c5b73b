// An expression in plain English: "paths that leave the camera, are reflected diffusely, and end at
// a light".
//
// The words follow the tree, clause by clause, so that a person finds what was written; but each
// clause says only what can matter at its place: the `.*` of `C<RD>.*` is "go on in any way", the
// one of `C.*L` is "are scattered zero or more times", since a path ends once. For that the reader
// keeps account of where a path may be (not begun, under way, ended) before and after each part. An
// alternative that can never be taken is left out.
#pragma once

#include <string>

#include "lpe/ast.h"
#include "lpe/words.h"

namespace lightsieve::lpe {

/// What the expression takes, as a noun in the plural; "no path" for null and where the order of
/// events allows none. Longer expressions than kMaxWordNodes end in the notation itself.
///
/// names  made from this expression (and perhaps others)
[[nodiscard]] std::string expression_in_words(const Expr& expr, const EventNames& names);

/// Nodes of an expression that are told in words.
inline constexpr std::size_t kMaxWordNodes = 120;

}  // namespace lightsieve::lpe
