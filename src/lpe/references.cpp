#include "lpe/references.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "lpe/builtins.h"
#include "lpe/cursor.h"
#include "lpe/lint.h"

namespace lightsieve::lpe {
namespace {

/// How large a tree is with everything that references stand for.
struct Extent {
    std::size_t nodes = 0, depth = 0;
};

std::string prefix(std::string_view aov_name) {
    return aov_name.empty() ? "" : "AOV " + in_quotes(aov_name) + ": ";
}

/// Calls `visit(reference, where)` for each reference that is written in the tree.
template <class Visit>
void for_each_reference(const Expr& expr, const Visit& visit) {
    if (!expr) return;
    for_each_written_node(*expr, [&](const Node& node) {
        if (const auto* reference = std::get_if<Reference>(&node.form))
            visit(*reference, node.where);
    });
}

Expr with_children(const Node& node, std::vector<Expr> parts);

/// The tree with `body_of(name)` put into each reference; shares what has none.
template <class BodyOf>
Expr substitute(const Expr& expr, const BodyOf& body_of) {
    if (const auto* reference = std::get_if<Reference>(&expr->form))
        return std::make_shared<const Node>(
            Node{Reference{reference->name, body_of(reference->name)}, expr->where});
    if (is_event_test(*expr)) return expr;
    std::vector<Expr> parts;
    bool changed = false;
    for (const Expr& child : children(*expr)) {
        parts.push_back(substitute(child, body_of));
        changed = changed || parts.back() != child;
    }
    return changed ? with_children(*expr, std::move(parts)) : expr;
}

Expr with_children(const Node& node, std::vector<Expr> parts) {
    const auto make = [&](auto form) {
        return std::make_shared<const Node>(Node{std::move(form), node.where});
    };
    if (const auto* repeat = std::get_if<Repeat>(&node.form))
        return make(Repeat{std::move(parts[0]), repeat->min, repeat->max});
    if (std::holds_alternative<Complement>(node.form))
        return make(Complement{std::move(parts[0])});
    if (std::holds_alternative<Sequence>(node.form)) return make(Sequence{std::move(parts)});
    if (std::holds_alternative<Alternation>(node.form)) return make(Alternation{std::move(parts)});
    if (std::holds_alternative<Intersection>(node.form))
        return make(Intersection{std::move(parts)});
    return make(Difference{std::move(parts)});
}

/// Measures trees; what references share is measured once.
class Measure {
  public:
    Extent operator()(const Node& node) {
        if (const auto known = known_.find(&node); known != known_.end()) return known->second;
        Extent extent{1, 1};
        for (const Expr& child : children(node)) {
            const Extent inner = (*this)(*child);
            extent.nodes = std::min(extent.nodes + inner.nodes, kMaxExpandedNodes + 1);
            extent.depth = std::max(extent.depth, inner.depth + 1);
        }
        known_.emplace(&node, extent);
        return extent;
    }

  private:
    std::map<const Node*, Extent> known_;
};

Error too_large(std::string_view aov_name, const Expr& expr, const Extent& extent) {
    const bool deep = extent.depth > kMaxExpandedDepth;
    const std::size_t limit = deep ? kMaxExpandedDepth : kMaxExpandedNodes;
    return {
        Code::LimitLpeExpansion,
        prefix(aov_name) + "with what its names stand for it is too " + (deep ? "deep" : "large"),
        expr->where,
        std::string("the limit ") + (deep ? "kMaxExpandedDepth" : "kMaxExpandedNodes") + " is " +
            std::to_string(limit),
        {},
        Severity::Error};
}

bool within_limits(const Extent& extent) {
    return extent.nodes <= kMaxExpandedNodes && extent.depth <= kMaxExpandedDepth;
}

}  // namespace

/// Resolves the definitions of a table in an order in which each comes after those it names.
class ReferenceResolver {
  public:
    ReferenceResolver(ExpressionTable& table, Diagnostics& diagnostics)
        : table_(table), diagnostics_(diagnostics) {}

    void run() {
        for (auto& [name, entry] : table_.entries_)
            if (entry.unresolved) walk_from(entry);
    }

  private:
    using Entry = ExpressionTable::Entry;
    enum class Mark : std::uint8_t { New, Open, Done };
    /// An entry on the way down, and the definitions that it names and are still to be looked at.
    struct Step {
        Entry* entry;
        std::vector<std::pair<Entry*, SourceSpan>> todo{};
    };

    /// Depth first, without recursion: chains of definitions may be long.
    void walk_from(Entry& start) {
        if (mark_[&start] != Mark::New) return;
        std::vector<Step> way{open(start)};
        while (!way.empty()) {
            Step& step = way.back();
            if (step.todo.empty()) {
                close(*step.entry);
                way.pop_back();
                continue;
            }
            const auto [next, where] = step.todo.back();
            step.todo.pop_back();
            if (mark_[next] == Mark::Open)
                report_cycle(way, *next, where);
            else if (mark_[next] == Mark::New)
                way.push_back(open(*next));
        }
    }

    Step open(Entry& entry) {
        mark_[&entry] = Mark::Open;
        Step step{&entry, {}};
        for_each_reference(
            entry.unresolved, [&](const Reference& reference, const SourceSpan& at) {
                const auto found = table_.entries_.find(canonical_name(reference.name));
                if (found != table_.entries_.end() && found->second.unresolved)
                    step.todo.emplace_back(&found->second, at);
            });
        std::ranges::reverse(step.todo);
        return step;
    }

    void close(Entry& entry) {
        mark_[&entry] = Mark::Done;
        if (in_cycle_[&entry]) return;
        entry.named.expr =
            resolve_references(entry.unresolved, table_, entry.written, diagnostics_);
        lint_expression(entry.named.text, entry.where, entry.written, entry.named.expr,
                        diagnostics_);
    }

    void report_cycle(const std::vector<Step>& way, const Entry& again, const SourceSpan& where) {
        const auto start = std::ranges::find(way, &again, &Step::entry);
        std::string names;
        for (auto step = start; step != way.end(); ++step) {
            in_cycle_[step->entry] = true;
            names += in_quotes(step->entry->written) + " names ";
        }
        const bool replaces = find_builtin(again.written) != nullptr;
        diagnostics_.error(
            Code::LpeCycle,
            prefix(way.back().entry->written) + names + in_quotes(again.written) + ", a circle",
            where,
            replaces ? "a custom expression takes the place of the built-in of its "
                       "name: rename it"
                     : "write one of them without naming the other");
    }

    ExpressionTable& table_;
    Diagnostics& diagnostics_;
    std::map<const Entry*, Mark> mark_;
    std::map<const Entry*, bool> in_cycle_;
};

void ExpressionTable::resolve(Diagnostics& diagnostics) {
    ReferenceResolver(*this, diagnostics).run();
}

bool has_unresolved(const Expr& expr) {
    bool found = false;
    for_each_reference(expr, [&](const Reference& reference, const SourceSpan&) {
        found = found || !reference.body;
    });
    return found;
}

Expr resolve_references(const Expr& expr, const ExpressionTable& table, std::string_view aov_name,
                        Diagnostics& diagnostics) {
    if (!has_unresolved(expr)) return expr;
    bool good = true;
    for_each_reference(expr, [&](const Reference& reference, const SourceSpan& where) {
        const NamedExpr* named = table.find(reference.name);
        if (named != nullptr && named->expr) return;
        good = false;
        const std::string written = in_quotes("$" + reference.name);
        if (named != nullptr)
            return diagnostics.error(Code::LpeReference,
                                     prefix(aov_name) + written + " has an error of its own",
                                     where, "correct that one first");
        std::string hint = did_you_mean(reference.name, table.names());
        if (hint.empty()) hint = "a name is that of an AOV, built in or custom: $diffuse";
        diagnostics.error(
            Code::LpeReference,
            prefix(aov_name) + "no expression is called " + in_quotes(reference.name), where,
            std::move(hint));
    });
    if (!good) return nullptr;
    Expr resolved =
        substitute(expr, [&](const std::string& name) { return table.find(name)->expr; });
    const Extent extent = Measure()(*resolved);
    if (within_limits(extent)) return resolved;
    diagnostics.add(too_large(aov_name, expr, extent));
    return nullptr;
}

}  // namespace lightsieve::lpe
