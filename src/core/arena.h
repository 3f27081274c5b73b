// A bump allocator for things that live as long as one path: shaders' scratch memory, closures.
//
// Nothing is destroyed one by one: only trivially destructible types. One arena a thread; `reset` keeps the memory.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace lightsieve {

class Arena {
  public:
    explicit Arena(std::size_t block_size = 64 * 1024) : block_size_(block_size) {}
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Uninitialised memory, aligned to `align` (a power of two up to 64).
    [[nodiscard]] void* allocate(std::size_t size, std::size_t align = alignof(std::max_align_t)) {
        std::size_t at = (used_ + align - 1) & ~(align - 1);
        if (current_ >= blocks_.size() || at + size > blocks_[current_].size) {
            next_block(size);
            at = 0;
        }
        used_ = at + size;
        return blocks_[current_].bytes.get() + at;
    }
    template <class T>
    [[nodiscard]] std::span<T> allocate_array(std::size_t count) {
        static_assert(std::is_trivially_destructible_v<T>);
        return {static_cast<T*>(allocate(count * sizeof(T), alignof(T))), count};
    }
    /// Forgets everything allocated; keeps the blocks for the next path.
    void reset() {
        current_ = 0;
        used_ = 0;
    }
    /// A point to come back to; memory allocated since then is free again.
    struct Mark {
        std::size_t block, used;
    };
    [[nodiscard]] Mark mark() const { return {current_, used_}; }
    void release(Mark mark) {
        current_ = mark.block;
        used_ = mark.used;
    }

  private:
    struct AlignedDelete {
        void operator()(std::byte* p) const { ::operator delete[](p, std::align_val_t{64}); }
    };
    struct Block {
        std::unique_ptr<std::byte[], AlignedDelete> bytes;
        std::size_t size;
    };
    void next_block(std::size_t at_least) {
        if (!blocks_.empty()) ++current_;
        while (current_ < blocks_.size() && blocks_[current_].size < at_least)
            ++current_;
        if (current_ < blocks_.size()) return;
        const std::size_t size = at_least > block_size_ ? at_least : block_size_;
        blocks_.push_back({std::unique_ptr<std::byte[], AlignedDelete>(static_cast<std::byte*>(
                               ::operator new[](size, std::align_val_t{64}))),
                           size});
        current_ = blocks_.size() - 1;
    }

    std::size_t block_size_;
    std::vector<Block> blocks_;
    std::size_t current_ = 0, used_ = 0;
};

}  // namespace lightsieve
