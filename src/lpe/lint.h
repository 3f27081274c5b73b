// Expressions that are legal, but probably not what was meant.
//
// Lints about spelling come from the parser; these need to know which paths an expression takes,
// or what is in the scene. A lint never changes a result. One that would cost more than the
// proofs' budgets is left out silently.
#pragma once

#include <span>
#include <string_view>

#include "core/diagnostics.h"
#include "core/event.h"
#include "lpe/ast.h"

namespace lightsieve::lpe {

/// What is wrong with the expression in every scene: it, or one of its alternatives, can never
/// take a path; it takes light and probes; OSL and RenderMan would read a `|` in it differently.
///
/// text, base, aov_name   as they were given to `parse`
/// expr                   what `parse` returned; nothing is done for null
void lint_expression(std::string_view text, const SourceSpan& base, std::string_view aov_name,
                     const Expr& expr, Diagnostics& diagnostics);

/// What is wrong with it in this scene: a label or light group that nothing carries (with the
/// nearest names), a bare label that is also a light group's name, no path of the scene at all.
///
/// events  every scattering and terminal event that the scene can produce
void lint_in_scene(const Expr& expr, std::string_view aov_name, std::span<const Event> events,
                   Diagnostics& diagnostics);

/// One light path AOV among a render's outputs.
struct LintOutput {
    std::string_view name;  ///< the expression's name
    Expr expr;
    SourceSpan where{};  ///< the output
};

/// Outputs that people add up (built-in names of different parts of the beauty) but that take some
/// paths twice, as `specular` and `sheen` do in the reference table.
void lint_overlaps(std::span<const LintOutput> outputs, Diagnostics& diagnostics);

}  // namespace lightsieve::lpe
