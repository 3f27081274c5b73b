// The arena as shaders use it: a stack of blocks that nest.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "core/arena.h"

namespace lightsieve {
namespace {

TEST(Arena, AlignsAndKeepsAllocationsApart) {
    Arena arena(256);
    auto* a = static_cast<std::byte*>(arena.allocate(3, 1));
    auto* b = static_cast<std::byte*>(arena.allocate(64, 64));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b) % 64, 0U);
    std::memset(a, 1, 3);
    std::memset(b, 2, 64);
    EXPECT_EQ(a[2], std::byte{1});
}

TEST(Arena, ReleaseGivesTheSameMemoryAgainAlsoAcrossBlocks) {
    Arena arena(128);
    void* first = arena.allocate(100, 16);
    const Arena::Mark mark = arena.mark();
    void* second = arena.allocate(100, 16);  // does not fit: a second block
    void* large = arena.allocate(5000, 16);  // larger than a block
    arena.release(mark);
    EXPECT_EQ(arena.allocate(100, 16), second);
    EXPECT_EQ(arena.allocate(5000, 16), large);
    arena.reset();
    EXPECT_EQ(arena.allocate(100, 16), first);
}

TEST(Arena, ArraysHaveTheirCount) {
    Arena arena;
    const auto numbers = arena.allocate_array<double>(7);
    EXPECT_EQ(numbers.size(), 7U);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % alignof(double), 0U);
}

}  // namespace
}  // namespace lightsieve
