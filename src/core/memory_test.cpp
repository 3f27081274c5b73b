// What the system says about its memory.
#include "core/memory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

namespace lightsieve {
namespace {

TEST(Memory, WhatTheSystemSays) {
    const std::string root = testing::TempDir() + "lightsieve_memory";
    std::filesystem::create_directories(root + "/proc");
    std::filesystem::create_directories(root + "/sys/fs/cgroup");
    EXPECT_EQ(available_memory(root), std::numeric_limits<std::size_t>::max());
    std::ofstream(root + "/proc/meminfo")
        << "MemTotal:  9000 kB\nMemAvailable:   2000 kB\nCached: 5 kB\n";
    EXPECT_EQ(available_memory(root), 2000U * 1024);
    std::ofstream(root + "/sys/fs/cgroup/memory.max") << "max\n";
    std::ofstream(root + "/sys/fs/cgroup/memory.current") << "900000\n";
    EXPECT_EQ(available_memory(root), 2000U * 1024);
    std::ofstream(root + "/sys/fs/cgroup/memory.max") << "1000000\n";
    EXPECT_EQ(available_memory(root), 100000U);
    std::ofstream(root + "/sys/fs/cgroup/memory.max") << "1\n";
    EXPECT_EQ(available_memory(root), 0U);
    std::filesystem::remove_all(root);
}

TEST(Memory, ThereIsSomeHere) { EXPECT_GT(available_memory(), 1U << 20U); }

TEST(Memory, WhatTheProcessHolds) {
    const std::size_t before = resident_memory();
    EXPECT_GT(before, 1U << 20U);
    std::vector<char> block(std::size_t{64} << 20U, 1);
    EXPECT_GE(resident_memory(), before + (std::size_t{60} << 20U)) << block[7];
    EXPECT_GE(peak_memory(), resident_memory());
    EXPECT_EQ(resident_memory("/nowhere"), 0U);
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
// Small blocks of a thread, freed but for every thousandth: what keeps its heap from shrinking by itself.
TEST(Memory, WhatThreadsFreedGoesBackToTheSystem) {
    constexpr std::size_t kBlocks = 64 * 1024, kBlock = 1024;
    std::vector<std::unique_ptr<char[]>> blocks(kBlocks);
    std::thread([&] {
        for (auto& block : blocks) {
            block = std::make_unique<char[]>(kBlock);
        }
    }).join();
    for (std::size_t i = 0; i < kBlocks; ++i)
        if (i % 1000 != 999) blocks[i].reset();
    const std::size_t before = resident_memory();
    release_freed_memory();
    EXPECT_LT(resident_memory() + kBlocks * kBlock / 2, before);
}
#endif

}  // namespace
}  // namespace lightsieve
