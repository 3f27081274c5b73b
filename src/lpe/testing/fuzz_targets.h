// What the fuzzers ask of the engine, as plain functions: fuzz/ runs them on texts that libFuzzer
// invents, fuzz_replay_test.cpp on the texts that are kept in fuzz/corpus and fuzz/regressions.
//
// A target throws std::logic_error when a property does not hold. Anything else that ends it (a
// crash, a sanitizer's report, minutes of work) is a finding too.
#pragma once

#include <string_view>

namespace lightsieve::lpe::testing {

/// Reads the text as an expression and as a path. Errors must point into the text; what is accepted
/// must print to a text that reads as the same tree.
void fuzz_parser(std::string_view text);

/// Reads each line as an expression and compiles all of them together within small limits. The
/// program must take exactly the short paths that the naive matcher takes; each expression must be
/// equal to what `simplify` makes of it, and witnesses of `compare` must be right.
void fuzz_compiler(std::string_view text);

/// The first two characters choose dialects, the rest is read in the first and translated to the
/// second. Errors must point into the text; a translation must be readable in its dialect, and one
/// that claims to be exact must not come with a path that shows a loss.
void fuzz_dialects(std::string_view text);

}  // namespace lightsieve::lpe::testing
