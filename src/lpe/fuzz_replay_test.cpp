// The fuzzers' corpus and every text that once was a finding, without a fuzzer.
#include <gtest/gtest.h>

#include "core/testing/fuzz_replay.h"
#include "lpe/testing/fuzz_targets.h"

namespace lightsieve::lpe {
namespace {

TEST(FuzzReplay, Parser) { lightsieve::testing::replay("parser", testing::fuzz_parser, 20); }
TEST(FuzzReplay, Compiler) { lightsieve::testing::replay("compiler", testing::fuzz_compiler, 20); }

TEST(FuzzReplay, Dialects) { lightsieve::testing::replay("dialects", testing::fuzz_dialects, 20); }

}  // namespace
}  // namespace lightsieve::lpe
