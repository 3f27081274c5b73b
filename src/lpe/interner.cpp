#include "lpe/interner.h"

#include <algorithm>

namespace lightsieve::lpe {
namespace {

constexpr std::uint32_t kFree = UINT32_MAX;
constexpr std::size_t kFirstSlots = 64;

/// Multiply and fold, one word at a time. Source: the mixing step of Wang Yi's wyhash.
std::uint64_t hash_of(std::span<const std::uint32_t> words) {
    std::uint64_t hash = 0x9e3779b97f4a7c15ULL ^ words.size();
    for (const std::uint32_t word : words) {
        hash = (hash ^ word) * 0xa0761d6478bd642fULL;
        hash ^= hash >> 32U;
    }
    return hash;
}

}  // namespace

std::uint32_t Interner::intern(std::span<const std::uint32_t> words) {
    // Keep the table at most half full.
    if (2 * (size() + 1) > slots_.size()) grow();
    const std::uint64_t hash = hash_of(words);
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash & mask;
    for (; slots_[slot] != kFree; slot = (slot + 1) & mask) {
        const std::uint32_t id = slots_[slot];
        if (hashes_[id] == hash && std::ranges::equal((*this)[id], words)) return id;
    }
    const auto id = static_cast<std::uint32_t>(size());
    slots_[slot] = id;
    hashes_.push_back(hash);
    words_.insert(words_.end(), words.begin(), words.end());
    begin_.push_back(words_.size());
    return id;
}

void Interner::grow() {
    slots_.assign(std::max(kFirstSlots, slots_.size() * 2), kFree);
    const std::size_t mask = slots_.size() - 1;
    for (std::uint32_t id = 0; id < size(); ++id) {
        std::size_t slot = hashes_[id] & mask;
        while (slots_[slot] != kFree)
            slot = (slot + 1) & mask;
        slots_[slot] = id;
    }
}

}  // namespace lightsieve::lpe
