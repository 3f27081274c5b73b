// The fuzzers' corpus and every text that once was a finding, without a fuzzer.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace lightsieve::testing {

/// Runs all texts of a target; fails if one throws or if there are fewer than that.
inline void replay(const std::string& target, void (*run)(std::string_view),
                   std::size_t at_least) {
    namespace fs = std::filesystem;
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

}  // namespace lightsieve::testing
