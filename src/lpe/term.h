// Regular expressions over event classes, and their derivatives.
//
// The derivative of an expression by a class is the expression for what may follow once an event
// of that class has been seen; an automaton's states are nothing but derivatives. Terms are stored
// once and kept in a normal form (alternatives sorted and without duplicates, sequences nested to
// the right, what `.*` takes anyway left out), which makes their number finite and small. Repeats
// {n,m} stay symbolic: they count down instead of being unrolled. `a & b` and `a - b` are derived
// part by part; there is no general "not", so that nothing takes what is no path. Source: Owens, Reppy, Turon,
// "Regular-expression derivatives re-examined", JFP 19 (2009).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lpe/alphabet.h"
#include "lpe/ast.h"
#include "lpe/interner.h"
#include "lpe/limits.h"

namespace lightsieve::lpe {

using TermId = std::uint32_t;

/// All terms of one compilation or proof. Every method that makes terms throws OverBudget when a
/// limit is exceeded.
class TermPool {
  public:
    static constexpr TermId kNothing = 0;  ///< takes no path
    static constexpr TermId kEmpty = 1;    ///< takes the path of no events

    /// The alphabet must have been made from every expression that will be lowered, and must
    /// outlive the pool.
    TermPool(const Alphabet& alphabet, const Limits& limits);

    /// The expression as a term; null is kNothing.
    [[nodiscard]] TermId lower(const Expr& expr);
    /// What may follow an event of class c. Remembered: asking twice costs one load.
    [[nodiscard]] TermId derive(TermId term, EventClass c);
    /// May the path end here?
    [[nodiscard]] bool accepts_empty(TermId term) const { return (flags_[term] & kNullable) != 0; }
    /// May the path end with one more event of class c?
    [[nodiscard]] bool accepts(TermId term, EventClass c) {
        return accepts_empty(derive(term, c));
    }
    /// Counts work that callers do for each derivative they ask for, against the same budget.
    void count_steps(std::size_t n);

    [[nodiscard]] std::size_t n_steps() const { return n_steps_; }
    [[nodiscard]] const Alphabet& alphabet() const { return alphabet_; }

  private:
    enum Kind : std::uint32_t {
        kNothingKind,
        kEmptyKind,
        kSetKind,           ///< one event: number of a set of classes
        kSequenceKind,      ///< head, tail
        kAlternationKind,   ///< the parts
        kRepeatKind,        ///< body, min, max
        kIntersectionKind,  ///< the parts
        kDifferenceKind,    ///< what is taken, what of it is not
    };
    enum Flags : std::uint8_t {
        kNullable = 1,   ///< takes the path of no events
        kTakesRare = 2,  ///< has a test that takes the camera or a probe
        kUniversal = 4,  ///< `.*`: takes whatever has no camera and no probe
    };

    [[nodiscard]] Kind kind(TermId term) const { return static_cast<Kind>(terms_[term][0]); }
    [[nodiscard]] std::uint32_t field(TermId term, std::size_t i) const { return terms_[term][i]; }

    [[nodiscard]] bool is_universal(TermId term) const { return (flags_[term] & kUniversal) != 0; }
    [[nodiscard]] bool takes_rare(TermId term) const { return (flags_[term] & kTakesRare) != 0; }

    TermId store(std::span<const std::uint32_t> words, unsigned flags);
    TermId make_set(std::span<const std::uint32_t> classes);
    TermId make_sequence(TermId head, TermId tail);
    TermId make_alternation(std::vector<TermId>& parts);
    TermId make_repeat(TermId body, std::uint32_t min, std::uint32_t max);
    TermId make_intersection(std::vector<TermId>& parts);
    TermId make_difference(TermId whole, TermId removed);
    [[nodiscard]] bool takes_all_else(TermId term) const;
    [[nodiscard]] bool is_rare(EventClass c) const;
    [[nodiscard]] TermId set_of(const auto& belongs);
    TermId lower_node(const Node& node);
    TermId lower_complement(const Expr& body);
    TermId derive_now(TermId term, EventClass c);
    TermId derive_sequence(TermId term, EventClass c);
    TermId derive_alternation(TermId term, EventClass c);
    TermId derive_repeat(TermId term, EventClass c);
    TermId derive_intersection(TermId term, EventClass c);

    const Alphabet& alphabet_;
    Limits limits_;
    Interner terms_;                       ///< kind, then its fields
    Interner sets_;                        ///< bit sets of classes
    std::vector<std::uint8_t> flags_;      ///< per term
    std::vector<std::uint32_t> memo_row_;  ///< per term: its row of memo_ plus 1, or 0
    std::vector<TermId> memo_;             ///< derivatives by each class, or kUnknown
    std::size_t n_steps_ = 0;
};

}  // namespace lightsieve::lpe
