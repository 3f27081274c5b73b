// Gives equal runs of integers the same small number.
//
// Derived expressions, states (vectors of expressions), sets of classes and of AOVs are all runs
// of 32-bit words that are met again and again; stored once and numbered from 0 they compare in
// one instruction and index arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lightsieve::lpe {

class Interner {
  public:
    /// The number of the run; numbers are given in order of first appearance.
    std::uint32_t intern(std::span<const std::uint32_t> words);
    /// The run of that number. Valid until the next `intern`.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t id) const {
        return std::span(words_).subspan(begin_[id], begin_[id + 1] - begin_[id]);
    }
    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    /// Sum of the lengths of all runs.
    [[nodiscard]] std::size_t n_words() const { return words_.size(); }

  private:
    void grow();

    std::vector<std::uint32_t> words_;
    std::vector<std::size_t> begin_{0};
    std::vector<std::uint64_t> hashes_;
    std::vector<std::uint32_t> slots_;  ///< open addressing, power of two; kFree or a number
};

}  // namespace lightsieve::lpe
