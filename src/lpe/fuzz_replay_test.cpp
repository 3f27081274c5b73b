// The fuzzers' corpus and every text that once was a finding, without a fuzzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "lpe/testing/fuzz_targets.h"

namespace lightsieve::lpe {
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

TEST(FuzzReplay, Parser) { replay("parser", testing::fuzz_parser, 20); }
TEST(FuzzReplay, Compiler) { replay("compiler", testing::fuzz_compiler, 20); }

TEST(FuzzReplay, Dialects) { replay("dialects", testing::fuzz_dialects, 20); }

}  // namespace
}  // namespace lightsieve::lpe
