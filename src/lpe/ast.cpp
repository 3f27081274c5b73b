#include "lpe/ast.h"

#include <algorithm>

namespace lightsieve::lpe {
namespace {

bool equal_all(const std::vector<Expr>& a, const std::vector<Expr>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

bool same(const Brackets& a, const Brackets& b) {
    return a.negated == b.negated && equal_all(a.items, b.items);
}
bool same(const Sequence& a, const Sequence& b) { return equal_all(a.parts, b.parts); }
bool same(const Alternation& a, const Alternation& b) { return equal_all(a.parts, b.parts); }
bool same(const Intersection& a, const Intersection& b) { return equal_all(a.parts, b.parts); }
bool same(const Difference& a, const Difference& b) { return equal_all(a.parts, b.parts); }
bool same(const Complement& a, const Complement& b) { return equal(a.body, b.body); }
bool same(const Reference& a, const Reference& b) {
    return a.name == b.name && equal(a.body, b.body);
}
bool same(const Repeat& a, const Repeat& b) {
    return a.min == b.min && a.max == b.max && equal(a.body, b.body);
}
template <class Leaf>
bool same(const Leaf& a, const Leaf& b) {
    return a == b;
}

}  // namespace

bool equal(const Expr& a, const Expr& b) {
    if (a == b) return true;
    if (!a || !b || a->form.index() != b->form.index()) return false;
    const auto same_as_b = [&](const auto& form) {
        return same(form, std::get<std::decay_t<decltype(form)>>(b->form));
    };
    return std::visit(same_as_b, a->form);
}

std::span<const Expr> children(const Node& node) {
    if (const auto* brackets = std::get_if<Brackets>(&node.form)) return brackets->items;
    if (const auto* sequence = std::get_if<Sequence>(&node.form)) return sequence->parts;
    if (const auto* alternation = std::get_if<Alternation>(&node.form)) return alternation->parts;
    if (const auto* all = std::get_if<Intersection>(&node.form)) return all->parts;
    if (const auto* difference = std::get_if<Difference>(&node.form)) return difference->parts;
    if (const auto* repeat = std::get_if<Repeat>(&node.form)) return {&repeat->body, 1};
    if (const auto* complement = std::get_if<Complement>(&node.form))
        return {&complement->body, 1};
    const auto* reference = std::get_if<Reference>(&node.form);
    if (reference != nullptr && reference->body) return {&reference->body, 1};
    return {};
}

bool is_event_test(const Node& node) {
    return std::holds_alternative<Letter>(node.form) || std::holds_alternative<Dot>(node.form) ||
           std::holds_alternative<Label>(node.form) || std::holds_alternative<Angle>(node.form) ||
           std::holds_alternative<Brackets>(node.form);
}

}  // namespace lightsieve::lpe
