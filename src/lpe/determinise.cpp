#include "lpe/determinise.h"

#include <algorithm>

#include "lpe/term.h"

namespace lightsieve::lpe {
namespace {

/// Dead components that cost as much as one derivative step.
constexpr std::size_t kDeadPerStep = 16;

/// The state of the construction: state numbers are those of the interned vectors.
class Construction {
  public:
    Construction(std::span<const Expr> exprs, const Alphabet& alphabet, const Limits& limits)
        : alphabet_(alphabet), limits_(limits), pool_(alphabet, limits), n_exprs_(exprs.size()) {
        // State 0 is the dead one, output 0 its row, set 0 the empty set.
        scratch_.assign(n_exprs_, TermPool::kNothing);
        vectors_.intern(scratch_);
        out_.sets.intern({});
        out_.outputs.intern(std::vector<std::uint32_t>(alphabet.n_terminals(), 0));
        for (std::size_t i = 0; i < n_exprs_; ++i)
            scratch_[i] = pool_.derive(pool_.lower(exprs[i]), Alphabet::kCamera);
        out_.dfa.start = vectors_.intern(scratch_);
        out_.dfa.n_classes = alphabet.n_scatter();
    }

    Determinised run() {
        // New states are appended while the loop goes on; it ends when all have been stepped.
        for (std::uint32_t state = 0; state < vectors_.size(); ++state) {
            if (vectors_.size() > limits_.max_states)
                throw OverBudget{
                    Code::LimitLpeStates,
                    "needs more than " + std::to_string(limits_.max_states) + " states",
                    "max_states"};
            for (std::size_t i = 0; i < alphabet_.n_scatter(); ++i)
                out_.dfa.next.push_back(
                    step(state, Alphabet::kFirstScatter + static_cast<EventClass>(i)));
            out_.dfa.output.push_back(output_of(state));
        }
        out_.n_steps = pool_.n_steps();
        return std::move(out_);
    }

  private:
    std::uint32_t step(std::uint32_t state, EventClass c) {
        const std::span<const TermId> vector = vectors_[state];
        std::size_t n_live = 0;
        for (std::size_t i = 0; i < n_exprs_; ++i) {
            scratch_[i] = pool_.derive(vector[i], c);
            n_live += vector[i] != TermPool::kNothing ? 1 : 0;
        }
        // A component that is dead costs a look, not a derivative.
        pool_.count_steps(n_live + n_exprs_ / kDeadPerStep);
        return vectors_.intern(scratch_);
    }

    std::uint32_t output_of(std::uint32_t state) {
        const std::span<const TermId> vector = vectors_[state];
        std::vector<std::uint32_t> row, accepting;
        for (EventClass c = alphabet_.first_terminal(); c < alphabet_.n_classes(); ++c) {
            accepting.clear();
            for (std::uint32_t i = 0; i < n_exprs_; ++i)
                if (pool_.accepts(vector[i], c)) accepting.push_back(i);
            row.push_back(out_.sets.intern(accepting));
        }
        return out_.outputs.intern(row);
    }

    const Alphabet& alphabet_;
    const Limits& limits_;
    TermPool pool_;
    std::size_t n_exprs_;
    Interner vectors_;             ///< per state: the derivative of each expression
    std::vector<TermId> scratch_;  ///< the vector being made
    Determinised out_;
};

}  // namespace

bool Determinised::accepts(const Alphabet& alphabet, std::uint32_t state, EventClass c,
                           std::uint32_t expr) const {
    const std::uint32_t set = outputs[dfa.output[state]][c - alphabet.first_terminal()];
    return std::ranges::binary_search(sets[set], expr);
}

Determinised determinise(std::span<const Expr> exprs, const Alphabet& alphabet,
                         const Limits& limits) {
    return Construction(exprs, alphabet, limits).run();
}

}  // namespace lightsieve::lpe
