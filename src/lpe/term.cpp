#include "lpe/term.h"

#include <algorithm>
#include <array>

namespace lightsieve::lpe {
namespace {

constexpr TermId kUnknown = UINT32_MAX;
/// A node is at most four words, but for alternations, whose parts count as nodes of their own.
constexpr std::size_t kWordsPerNode = 4;

bool contains(std::span<const std::uint32_t> set, EventClass c) {
    return (set[c / 32] >> (c % 32) & 1U) != 0;
}

}  // namespace

TermPool::TermPool(const Alphabet& alphabet, const Limits& limits)
    : alphabet_(alphabet), limits_(limits) {
    store(std::array<std::uint32_t, 1>{kNothingKind}, 0);
    store(std::array<std::uint32_t, 1>{kEmptyKind}, kNullable);
}

// ---- making terms in normal form ----

TermId TermPool::store(std::span<const std::uint32_t> words, unsigned flags) {
    const TermId term = terms_.intern(words);
    if (term < flags_.size()) return term;
    flags_.push_back(static_cast<std::uint8_t>(flags));
    memo_row_.push_back(0);
    if (terms_.n_words() > limits_.max_nodes * kWordsPerNode)
        throw OverBudget{Code::LimitLpeNodes,
                         "needs more than " + std::to_string(limits_.max_nodes) +
                             " nodes of derived expressions",
                         "max_nodes"};
    return term;
}

TermId TermPool::make_set(std::span<const std::uint32_t> classes) {
    const bool none = std::ranges::all_of(classes, [](std::uint32_t word) { return word == 0; });
    if (none) return kNothing;
    unsigned flags = 0;
    for (EventClass c = 0; c < alphabet_.n_classes(); ++c)
        if (is_rare(c) && contains(classes, c)) flags = kTakesRare;
    return store(std::array<std::uint32_t, 2>{kSetKind, sets_.intern(classes)}, flags);
}

/// Nothing absorbs, the empty path vanishes, (ab)c becomes a(bc), and `.*` swallows what may be
/// empty after it.
TermId TermPool::make_sequence(TermId head, TermId tail) {
    if (head == kNothing || tail == kNothing) return kNothing;
    if (head == kEmpty) return tail;
    if (tail == kEmpty) return head;
    std::vector<TermId> heads;
    for (; kind(head) == kSequenceKind; head = field(head, 2))
        heads.push_back(field(head, 1));
    heads.push_back(head);
    for (std::size_t i = heads.size(); i-- > 0;) {
        if (is_universal(heads[i]) && accepts_empty(tail) && !takes_rare(tail)) {
            tail = heads[i];
            continue;
        }
        const unsigned both = flags_[heads[i]] & flags_[tail] & kNullable;
        const unsigned either = (flags_[heads[i]] | flags_[tail]) & kTakesRare;
        tail = store(std::array<std::uint32_t, 3>{kSequenceKind, heads[i], tail}, both | either);
    }
    return tail;
}

/// Flattened, single events united to one set, sorted, without duplicates and without what `.*`
/// takes anyway. Uses `parts` as scratch space.
TermId TermPool::make_alternation(std::vector<TermId>& parts) {
    count_steps(parts.size());
    std::vector<std::uint32_t> classes(alphabet_.n_words(), 0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const TermId part = parts[i];
        if (kind(part) == kAlternationKind) {
            const std::span<const std::uint32_t> inner = terms_[part].subspan(1);
            parts.insert(parts.end(), inner.begin(), inner.end());
            parts[i] = kNothing;
        } else if (kind(part) == kSetKind) {
            const std::span<const std::uint32_t> set = sets_[field(part, 1)];
            for (std::size_t w = 0; w < classes.size(); ++w)
                classes[w] |= set[w];
            parts[i] = kNothing;
        }
    }
    parts.push_back(make_set(classes));
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    std::erase(parts, kNothing);
    const auto universal =
        std::ranges::find_if(parts, [&](TermId part) { return is_universal(part); });
    if (universal != parts.end())
        std::erase_if(parts, [&, all = *universal](TermId part) {
            return part != all && !takes_rare(part);
        });
    // Ending here is already possible if another part allows it.
    const auto ends = [&](TermId part) { return part != kEmpty && accepts_empty(part); };
    if (std::ranges::any_of(parts, ends)) std::erase(parts, kEmpty);
    if (parts.empty()) return kNothing;
    if (parts.size() == 1) return parts[0];
    unsigned flags = 0;
    for (const TermId part : parts)
        flags |= flags_[part] & (kNullable | kTakesRare);
    parts.insert(parts.begin(), kAlternationKind);
    return store(parts, flags);
}

TermId TermPool::make_repeat(TermId body, std::uint32_t min, std::uint32_t max) {
    if (max == 0 || body == kEmpty) return kEmpty;
    if (body == kNothing) return min == 0 ? kEmpty : kNothing;
    if ((min == 1 && max == 1) || is_universal(body)) return body;
    // Repeating what may be empty: every count up to max is possible.
    if (accepts_empty(body)) min = 0;
    unsigned flags = flags_[body] & kTakesRare;
    if (min == 0) flags |= kNullable;
    if (min == 0 && max == Repeat::kUnbounded && takes_all_else(body)) flags |= kUniversal;
    return store(std::array<std::uint32_t, 4>{kRepeatKind, body, min, max}, flags);
}

/// Nested ones flattened, sorted, without duplicates; differences are taken after all parts are
/// met: a & (b - c) is (a & b) - c. Uses `parts` as scratch space.
TermId TermPool::make_intersection(std::vector<TermId>& parts) {
    count_steps(parts.size());
    std::vector<TermId> removed;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        while (kind(parts[i]) == kDifferenceKind) {
            removed.push_back(field(parts[i], 2));
            parts[i] = field(parts[i], 1);
        }
        if (kind(parts[i]) == kIntersectionKind) {
            const std::vector<TermId> inner(terms_[parts[i]].begin() + 1, terms_[parts[i]].end());
            parts[i] = inner[0];
            parts.insert(parts.end(), inner.begin() + 1, inner.end());
        }
    }
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    if (parts[0] == kNothing) return kNothing;
    // What `.*` forbids another part may forbid as well.
    const auto universal = std::ranges::find_if(parts, [&](TermId p) { return is_universal(p); });
    if (universal != parts.end() &&
        std::ranges::any_of(parts, [&](TermId p) { return p != *universal && !takes_rare(p); }))
        parts.erase(universal);
    TermId met = parts[0];
    if (parts.size() > 1) {
        unsigned flags = kNullable | kTakesRare;
        for (const TermId part : parts)
            flags &= flags_[part];
        parts.insert(parts.begin(), kIntersectionKind);
        met = store(parts, flags);
    }
    if (removed.empty()) return met;
    return make_difference(met, make_alternation(removed));
}

/// (a - b) - c is a - (b|c).
TermId TermPool::make_difference(TermId whole, TermId removed) {
    count_steps(1);
    if (whole == kNothing || removed == kNothing) return whole;
    if (kind(whole) == kDifferenceKind) {
        std::vector<TermId> both{field(whole, 2), removed};
        removed = make_alternation(both);
        whole = field(whole, 1);
    }
    if (whole == removed || (is_universal(removed) && !takes_rare(whole))) return kNothing;
    if (whole == kEmpty) return accepts_empty(removed) ? kNothing : kEmpty;
    unsigned flags = flags_[whole] & kTakesRare;
    if (accepts_empty(whole) && !accepts_empty(removed)) flags |= kNullable;
    return store(std::array<std::uint32_t, 3>{kDifferenceKind, whole, removed}, flags);
}

/// Is it a single event that may be any but the camera and a probe?
bool TermPool::takes_all_else(TermId term) const {
    if (kind(term) != kSetKind || takes_rare(term)) return false;
    for (EventClass c = 0; c < alphabet_.n_classes(); ++c)
        if (!is_rare(c) && !contains(sets_[field(term, 1)], c)) return false;
    return true;
}

bool TermPool::is_rare(EventClass c) const {
    return c == Alphabet::kCamera || alphabet_.is_probe(c);
}

/// The set of the classes that belong.
TermId TermPool::set_of(const auto& belongs) {
    std::vector<std::uint32_t> classes(alphabet_.n_words(), 0);
    for (EventClass c = 0; c < alphabet_.n_classes(); ++c)
        if (belongs(c)) classes[c / 32] |= std::uint32_t{1} << (c % 32);
    return make_set(classes);
}

TermId TermPool::lower(const Expr& expr) { return expr ? lower_node(*expr) : kNothing; }

TermId TermPool::lower_node(const Node& node) {
    if (is_event_test(node)) return make_set(alphabet_.taken_by(node));
    if (const auto* repeat = std::get_if<Repeat>(&node.form))
        return make_repeat(lower(repeat->body), repeat->min, repeat->max);
    if (const auto* complement = std::get_if<Complement>(&node.form))
        return lower_complement(complement->body);
    if (const auto* reference = std::get_if<Reference>(&node.form)) {
        LIGHTSIEVE_ASSERT(reference->body, "$" + reference->name + " was not resolved");
        return lower(reference->body);
    }
    std::vector<TermId> parts;
    for (const Expr& child : children(node))
        parts.push_back(lower(child));
    if (std::holds_alternative<Alternation>(node.form)) return make_alternation(parts);
    if (std::holds_alternative<Intersection>(node.form)) return make_intersection(parts);
    if (std::holds_alternative<Difference>(node.form)) {
        for (std::size_t i = 1; i < parts.size(); ++i)
            parts[0] = make_difference(parts[0], parts[i]);
        return parts[0];
    }
    TermId sequence = kEmpty;
    for (std::size_t i = parts.size(); i-- > 0;)
        sequence = make_sequence(parts[i], sequence);
    return sequence;
}

/// !(a) is C.* - (a).
TermId TermPool::lower_complement(const Expr& body) {
    const TermId camera = set_of([](EventClass c) { return c == Alphabet::kCamera; });
    const TermId any = set_of([&](EventClass c) { return !is_rare(c); });
    const TermId light = make_sequence(camera, make_repeat(any, 0, Repeat::kUnbounded));
    return make_difference(light, lower(body));
}

// ---- derivatives ----

void TermPool::count_steps(std::size_t n) {
    n_steps_ += n;
    if (n_steps_ > limits_.max_steps)
        throw OverBudget{
            Code::LimitLpeSteps,
            "needs more than " + std::to_string(limits_.max_steps) + " derivative steps",
            "max_steps"};
}

TermId TermPool::derive(TermId term, EventClass c) {
    if (term <= kEmpty) return kNothing;
    if (memo_row_[term] == 0) {
        memo_.resize(memo_.size() + alphabet_.n_classes(), kUnknown);
        memo_row_[term] = static_cast<std::uint32_t>(memo_.size() / alphabet_.n_classes());
    }
    const std::size_t slot = (memo_row_[term] - 1) * alphabet_.n_classes() + c;
    if (memo_[slot] == kUnknown) {
        const TermId derivative = derive_now(term, c);
        memo_[slot] = derivative;
    }
    return memo_[slot];
}

TermId TermPool::derive_now(TermId term, EventClass c) {
    count_steps(1);
    switch (kind(term)) {
        case kSetKind: return contains(sets_[field(term, 1)], c) ? kEmpty : kNothing;
        case kSequenceKind: return derive_sequence(term, c);
        case kAlternationKind: return derive_alternation(term, c);
        case kRepeatKind: return derive_repeat(term, c);
        case kIntersectionKind: return derive_intersection(term, c);
        case kDifferenceKind: {
            const TermId whole = derive(field(term, 1), c);
            // What is not there needs no taking away.
            if (whole == kNothing) return kNothing;
            return make_difference(whole, derive(field(term, 2), c));
        }
        default: return kNothing;
    }
}

/// The head moves on, or, if it may be empty, the tail. A loop along the tails, so that long
/// sequences need no stack.
TermId TermPool::derive_sequence(TermId term, EventClass c) {
    std::vector<TermId> parts;
    TermId rest = term;
    for (; kind(rest) == kSequenceKind; rest = field(rest, 2)) {
        const TermId head = field(rest, 1), tail = field(rest, 2);
        const TermId moved = derive(head, c);
        parts.push_back(make_sequence(moved, tail));
        if (!accepts_empty(head)) return make_alternation(parts);
    }
    parts.push_back(derive(rest, c));
    return make_alternation(parts);
}

TermId TermPool::derive_alternation(TermId term, EventClass c) {
    std::vector<TermId> parts;
    for (std::size_t i = 1; i < terms_[term].size(); ++i)
        parts.push_back(derive(field(term, i), c));
    return make_alternation(parts);
}

TermId TermPool::derive_intersection(TermId term, EventClass c) {
    std::vector<TermId> parts;
    for (std::size_t i = 1; i < terms_[term].size(); ++i) {
        parts.push_back(derive(field(term, i), c));
        if (parts.back() == kNothing) return kNothing;
    }
    return make_intersection(parts);
}

/// One round moves on, the others are left. That also holds where a round may be empty, as min is
/// 0 then.
TermId TermPool::derive_repeat(TermId term, EventClass c) {
    const TermId body = field(term, 1);
    const std::uint32_t min = field(term, 2), max = field(term, 3);
    const TermId moved = derive(body, c);
    if (moved == kNothing) return kNothing;
    const TermId others =
        make_repeat(body, min == 0 ? 0 : min - 1, max == Repeat::kUnbounded ? max : max - 1);
    return make_sequence(moved, others);
}

}  // namespace lightsieve::lpe
