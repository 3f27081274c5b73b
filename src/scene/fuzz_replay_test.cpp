// The fuzzers' corpus and every text that once was a finding, without a fuzzer.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "scene/testing/fuzz_targets.h"

namespace lightsieve {
namespace {

namespace fs = std::filesystem;

void replay(const std::string& target, void (*run)(std::string_view), std::size_t at_least) {
    std::size_t n = 0;
    for (const char* kind : {"corpus", "regressions"}) {
        const fs::path folder = fs::path(LIGHTSIEVE_SOURCE_DIR "/fuzz") / kind / target;
        if (!fs::exists(folder)) continue;
        for (const auto& file : fs::directory_iterator(folder)) {
            std::ifstream in(file.path(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(in), {}};
            EXPECT_NO_THROW(run(text)) << file.path();
            ++n;
        }
    }
    EXPECT_GE(n, at_least) << "the corpus was not found";
}

TEST(FuzzReplay, Ass) { replay("ass", testing::fuzz_ass, 20); }
TEST(FuzzReplay, Packed) { replay("packed", testing::fuzz_packed, 20); }

TEST(FuzzReplay, PropertiesOfPackedDataCanFail) {
    // 'z' is the word 0; four bytes of base 64 need six characters.
    EXPECT_NO_THROW(testing::fuzz_packed(std::string("\0\1z", 3)));
    EXPECT_NO_THROW(testing::fuzz_packed("\1\1AAAAAA"));
    EXPECT_NO_THROW(testing::fuzz_packed(""));
}

}  // namespace
}  // namespace lightsieve
