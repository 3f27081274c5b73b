// What the fuzzers ask of the reader of scenes, as plain functions: fuzz/ runs them on texts that libFuzzer invents,
// fuzz_replay_test.cpp on those that are kept in fuzz/corpus and fuzz/regressions.
//
// A target throws std::logic_error when a property does not hold. Anything else that ends it (a crash, a sanitizer's
// report, minutes of work) is a finding too.
#pragma once

#include <string_view>

namespace lightsieve::testing {

/// Reads the text as a scene in which `include` finds one small file, makes the graph of it, and writes both. What is
/// reported must point into its text; a document must be written as it was read; what is written of a graph that had
/// no errors must be readable.
void fuzz_ass(std::string_view text);

/// The first character chooses base 85 or 64 and a type, the second how many numbers; the rest is packed data. What is
/// found to be complete must end within the text, decode to the same numbers with other text behind it, and be incomplete
/// without its last character.
void fuzz_packed(std::string_view text);

}  // namespace lightsieve::testing
