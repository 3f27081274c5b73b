// The fuzzers' corpus and every text that once was a finding, without a fuzzer.
#include <gtest/gtest.h>

#include "core/testing/fuzz_replay.h"
#include "scene/testing/fuzz_targets.h"

namespace lightsieve {
namespace {

TEST(FuzzReplay, Ass) { testing::replay("ass", testing::fuzz_ass, 20); }
TEST(FuzzReplay, Packed) { testing::replay("packed", testing::fuzz_packed, 20); }

TEST(FuzzReplay, PropertiesOfPackedDataCanFail) {
    // 'z' is the word 0; four bytes of base 64 need six characters.
    EXPECT_NO_THROW(testing::fuzz_packed(std::string("\0\1z", 3)));
    EXPECT_NO_THROW(testing::fuzz_packed("\1\1AAAAAA"));
    EXPECT_NO_THROW(testing::fuzz_packed(""));
}

}  // namespace
}  // namespace lightsieve
