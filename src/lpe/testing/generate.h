// Expressions and paths for tests: all small ones, and random ones from a seed.
#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/path.h"

namespace lightsieve::lpe::testing {

/// Reads an expression that must be right; throws std::logic_error with the rendered errors
/// otherwise.
[[nodiscard]] Expr must_parse(const std::string& text);
/// Reads a path that must be right.
[[nodiscard]] Path must_path(const std::string& text);
/// The events of a text like "RD RS'coat' L'key'", in order.
[[nodiscard]] std::vector<Event> must_events(const std::string& text);

/// Every tree of exactly `n_nodes` nodes over these leaves with the operators * + ? {2}, sequence
/// and alternation.
/// extended  also with our extensions: `&`, `-` and `!( )`
[[nodiscard]] std::vector<Expr> all_expressions(const std::vector<Expr>& leaves,
                                                std::size_t n_nodes, bool extended = false);

/// Every light path of at most `n_events` events, the camera included, made of these events.
[[nodiscard]] std::vector<Path> all_paths(std::span<const Event> events, std::size_t n_events);

/// A random tree of about `n_nodes` nodes with every form of the language, as `parse` would make
/// it.
[[nodiscard]] Expr random_expression(std::mt19937& random, std::size_t n_nodes);
/// The same with our extensions; names are those of built-ins.
[[nodiscard]] Expr random_extended_expression(std::mt19937& random, std::size_t n_nodes);
/// A random tree behind a C, so that it is likely to take something.
[[nodiscard]] Expr random_light_expression(std::mt19937& random, std::size_t n_nodes);
/// A random light path of at most `n_events` events made of these events.
[[nodiscard]] Path random_path(std::mt19937& random, std::span<const Event> events,
                               std::size_t n_events);

}  // namespace lightsieve::lpe::testing
