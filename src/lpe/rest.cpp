#include "lpe/rest.h"

#include <utility>
#include <vector>

#include "lpe/algebra.h"
#include "lpe/predicate.h"
#include "lpe/print.h"
#include "lpe/synthesis.h"

namespace lightsieve::lpe {
namespace {

Expr make(auto form) { return std::make_shared<const Node>(Node{std::move(form), {}}); }

/// The tree without references: what is left over must be readable where their names mean nothing.
Expr spelled_out(const Expr& expr) {
    if (const auto* reference = std::get_if<Reference>(&expr->form))
        return spelled_out(reference->body);
    return expr;
}

/// `whole - (a|b)`, or `whole` alone.
Expr difference(const Expr& whole, std::span<const Expr> parts) {
    Difference out{{spelled_out(whole)}};
    Alternation removed;
    for (const Expr& part : parts)
        if (part) removed.parts.push_back(spelled_out(part));
    if (removed.parts.empty()) return whole;
    out.parts.push_back(removed.parts.size() == 1 ? removed.parts[0] : make(std::move(removed)));
    return make(std::move(out));
}

/// Among what paths `rest` has to be right.
struct Universe {
    std::vector<Event> events;
    LabelClasses labels;
    bool all;  ///< all paths, not only those that can be made of the events
};

bool same_paths(const Expr& a, const Expr& b, const Universe& universe, const Limits& limits) {
    if (universe.all) return equivalent(a, b, limits);
    return compare(a, b, universe.events, limits).relation == Relation::Equal;
}

/// The set in one word more or less: C A is no path, so it does not matter whether it is taken.
std::vector<Expr> variants(const Expr& set) {
    bool may_take_probes = false;
    for_each_event_test(*set, [&](const Node& test) {
        may_take_probes = may_take_probes || takes(test, {EventKind::Albedo, {}, {}});
    });
    if (!may_take_probes) return {set};
    const Expr no_path = make(Sequence{{make(Letter{'C'}), make(Letter{'A'})}});
    return {set, make(Alternation{{set, no_path}}), make(Difference{{set, no_path}})};
}

/// What `synthesise` writes for the set, the shortest of its variants; null if that is too long or
/// too much work.
Expr written(const Expr& set, const Universe& universe, const Limits& limits) {
    Expr best;
    for (const Expr& variant : variants(set)) {
        try {
            const Expr text =
                synthesise(variant, universe.events, universe.labels, kMaxRestLength, limits);
            if (text && (!best || print(text).size() < print(best).size())) best = text;
        } catch (const OverBudget&) {
            return nullptr;
        }
    }
    return best;
}

/// `set`, written shortly and proved to be the same; null if it takes no path.
Expr shortest(const Expr& set, const Universe& universe, const Limits& limits) {
    if (!shortest_path(set, universe.events, limits)) return nullptr;
    const Expr text = written(set, universe, limits);
    if (!text) return set;
    const std::size_t length = print(text).size();
    if (length > kMaxReadableLength && length > print(set).size()) return set;
    LIGHTSIEVE_ASSERT(same_paths(text, set, universe, limits),
                      print(text) + " is not " + print(set));
    return text;
}

std::vector<Expr> with(const Expr& whole, std::span<const Expr> parts) {
    std::vector<Expr> all(parts.begin(), parts.end());
    all.push_back(whole);
    return all;
}

}  // namespace

Expr rest(const Expr& whole, std::span<const Expr> parts, const Limits& limits) {
    if (!whole) return nullptr;
    const std::vector<Expr> all = with(whole, parts);
    return shortest(difference(whole, parts),
                    {abstract_events(all, limits), label_classes(all), true}, limits);
}

Expr rest(const Expr& whole, std::span<const Expr> parts, std::span<const Event> events,
          const Limits& limits) {
    if (!whole) return nullptr;
    return shortest(difference(whole, parts),
                    {{events.begin(), events.end()}, label_classes(with(whole, parts)), false},
                    limits);
}

Expr simplify(const Expr& expr, const Limits& limits) { return rest(expr, {}, limits); }

}  // namespace lightsieve::lpe
