// A set of symbols of the common alphabet, as bits.
//
// Every test of an event, in whatever dialect, becomes such a set; translation is arithmetic on
// them. Sets that are combined must be of the same size.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lightsieve::lpe::dialects {

/// Index of an event of the common alphabet.
using Symbol = std::uint32_t;

class SymbolSet {
  public:
    SymbolSet() = default;
    /// The empty set over n symbols.
    explicit SymbolSet(std::size_t n) : words_((n + 63) / 64, 0) {}

    void add(Symbol s) { words_[s / 64] |= std::uint64_t{1} << (s % 64); }
    [[nodiscard]] bool has(Symbol s) const { return (words_[s / 64] >> (s % 64) & 1U) != 0; }
    [[nodiscard]] bool empty() const {
        for (const std::uint64_t word : words_)
            if (word != 0) return false;
        return true;
    }
    [[nodiscard]] std::size_t count() const {
        std::size_t n = 0;
        for (const std::uint64_t word : words_)
            n += static_cast<std::size_t>(std::popcount(word));
        return n;
    }
    /// Is every symbol of `other` in this set?
    [[nodiscard]] bool contains(const SymbolSet& other) const {
        for (std::size_t i = 0; i < words_.size(); ++i)
            if ((other.words_[i] & ~words_[i]) != 0) return false;
        return true;
    }
    [[nodiscard]] bool intersects(const SymbolSet& other) const {
        for (std::size_t i = 0; i < words_.size(); ++i)
            if ((other.words_[i] & words_[i]) != 0) return true;
        return false;
    }

    SymbolSet& operator|=(const SymbolSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i)
            words_[i] |= other.words_[i];
        return *this;
    }
    SymbolSet& operator&=(const SymbolSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i)
            words_[i] &= other.words_[i];
        return *this;
    }
    SymbolSet& operator-=(const SymbolSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i)
            words_[i] &= ~other.words_[i];
        return *this;
    }
    friend SymbolSet operator|(SymbolSet a, const SymbolSet& b) { return a |= b; }
    friend SymbolSet operator&(SymbolSet a, const SymbolSet& b) { return a &= b; }
    friend SymbolSet operator-(SymbolSet a, const SymbolSet& b) { return a -= b; }
    friend auto operator<=>(const SymbolSet&, const SymbolSet&) = default;

  private:
    std::vector<std::uint64_t> words_;
};

}  // namespace lightsieve::lpe::dialects
