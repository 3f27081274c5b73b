#include "lpe/minimise.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lightsieve::lpe {
namespace {

using Index = std::uint32_t;

/// Who leads to a state by a class: predecessors(state, class), all in one array.
class Inverse {
  public:
    explicit Inverse(const Dfa& dfa)
        : n_states_(dfa.n_states()),
          begin_(dfa.n_classes * dfa.n_states() + 1, 0),
          from_(dfa.next.size()) {
        const auto row = [&](std::size_t i) {
            return (i % dfa.n_classes) * n_states_ + dfa.next[i];
        };
        for (std::size_t i = 0; i < dfa.next.size(); ++i)
            ++begin_[row(i) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<Index> end(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < dfa.next.size(); ++i)
            from_[end[row(i)]++] = static_cast<Index>(i / dfa.n_classes);
    }
    [[nodiscard]] std::span<const Index> predecessors(Index state, std::size_t column) const {
        const std::size_t row = column * n_states_ + state;
        return std::span(from_).subspan(begin_[row], begin_[row + 1] - begin_[row]);
    }

  private:
    std::size_t n_states_;
    std::vector<Index> begin_, from_;
};

/// A partition of 0..n-1 in blocks, each a run of one array, so that marking an element is a swap.
class Partition {
  public:
    explicit Partition(const std::vector<Index>& key)
        : elements_(key.size()), place_(key.size()), block_(key.size()) {
        std::iota(elements_.begin(), elements_.end(), 0);
        std::ranges::stable_sort(elements_, {}, [&](Index e) { return key[e]; });
        for (std::size_t i = 0; i < elements_.size(); ++i) {
            const bool opens = i == 0 || key[elements_[i]] != key[elements_[i - 1]];
            if (opens) blocks_.push_back({static_cast<Index>(i), static_cast<Index>(i), 0});
            ++blocks_.back().end;
            place_[elements_[i]] = static_cast<Index>(i);
            block_[elements_[i]] = static_cast<Index>(blocks_.size() - 1);
        }
    }
    [[nodiscard]] std::size_t n_blocks() const { return blocks_.size(); }
    [[nodiscard]] Index block_of(Index element) const { return block_[element]; }
    [[nodiscard]] Index size(Index block) const {
        return blocks_[block].end - blocks_[block].begin;
    }
    [[nodiscard]] std::span<const Index> elements(Index block) const {
        return std::span(elements_).subspan(blocks_[block].begin, size(block));
    }
    /// Moves the element to the marked front of its block; returns true if it is the first one
    /// marked there.
    bool mark(Index element) {
        Block& block = blocks_[block_[element]];
        const Index front = block.begin + block.n_marked;
        if (place_[element] < front) return false;
        const Index other = elements_[front];
        std::swap(elements_[front], elements_[place_[element]]);
        std::swap(place_[other], place_[element]);
        return block.n_marked++ == 0;
    }
    /// Makes the marked elements a block of their own and unmarks them; returns it, or `block` if
    /// all were marked.
    Index split(Index block) {
        const Index n_marked = std::exchange(blocks_[block].n_marked, 0);
        if (n_marked == size(block)) return block;
        const Index begin = blocks_[block].begin;
        blocks_[block].begin += n_marked;
        blocks_.push_back({begin, begin + n_marked, 0});
        const auto made = static_cast<Index>(blocks_.size() - 1);
        for (const Index element : elements(made))
            block_[element] = made;
        return made;
    }

  private:
    struct Block {
        Index begin, end, n_marked;
    };
    std::vector<Index> elements_, place_, block_;
    std::vector<Block> blocks_;
};

Partition refine(const Dfa& dfa) {
    const Inverse inverse(dfa);
    Partition partition(dfa.output);
    std::vector<Index> waiting(partition.n_blocks());
    std::iota(waiting.begin(), waiting.end(), 0);
    std::vector<bool> is_waiting(waiting.size(), true);
    std::vector<Index> splitter, touched;
    while (!waiting.empty()) {
        const Index chosen = waiting.back();
        waiting.pop_back();
        is_waiting[chosen] = false;
        // A copy: the block itself may be split on the way.
        const std::span<const Index> members = partition.elements(chosen);
        splitter.assign(members.begin(), members.end());
        for (std::size_t column = 0; column < dfa.n_classes; ++column) {
            touched.clear();
            for (const Index state : splitter)
                for (const Index from : inverse.predecessors(state, column))
                    if (partition.mark(from)) touched.push_back(partition.block_of(from));
            for (const Index block : touched) {
                const Index made = partition.split(block);
                if (made == block) continue;
                // The smaller half suffices, unless the whole was still to be looked at.
                const bool take_made =
                    is_waiting[block] || partition.size(made) <= partition.size(block);
                const Index next = take_made ? made : block;
                is_waiting.resize(partition.n_blocks(), false);
                is_waiting[next] = true;
                waiting.push_back(next);
            }
        }
    }
    return partition;
}

}  // namespace

Dfa minimise(const Dfa& dfa) {
    const Partition partition = refine(dfa);
    // Number the blocks: the dead state, then breadth first from the start.
    constexpr Index kUnseen = UINT32_MAX;
    std::vector<Index> number(partition.n_blocks(), kUnseen);
    std::vector<Index> representative;
    const auto visit = [&](Index state) {
        Index& n = number[partition.block_of(state)];
        if (n == kUnseen) {
            n = static_cast<Index>(representative.size());
            representative.push_back(state);
        }
        return n;
    };
    Dfa out;
    out.n_classes = dfa.n_classes;
    visit(0);
    out.start = visit(dfa.start);
    for (std::size_t i = 0; i < representative.size(); ++i) {
        const std::size_t row = representative[i] * dfa.n_classes;
        for (std::size_t column = 0; column < dfa.n_classes; ++column)
            out.next.push_back(visit(dfa.next[row + column]));
        out.output.push_back(dfa.output[representative[i]]);
    }
    return out;
}

}  // namespace lightsieve::lpe
