#include "lpe/algebra.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "lpe/alphabet.h"
#include "lpe/interner.h"
#include "lpe/predicate.h"
#include "lpe/term.h"

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kDefaultGroup = "default";
/// What no object label may be; the names of light groups are not known here.
constexpr std::array<std::string_view, 4> kNeverObjectLabels{"coat", "sheen", "hair",
                                                             kDefaultGroup};

/// Light groups that a proof tells apart for each label of lobes.
constexpr std::size_t kGroupsPerLabel = 10;

bool may_be_object_label(const std::string& label) {
    return std::ranges::find(kNeverObjectLabels, label) == kNeverObjectLabels.end();
}

/// For each label, the tests that name it. Labels that the same tests name are alike.
using LabelUses = std::map<std::string, std::vector<std::size_t>>;

/// The labels in tests that scattering and emission can pass, and those in tests that lights can
/// pass.
struct AllLabelUses {
    LabelUses lobes, groups;
    std::size_t n_tests = 0;

    explicit AllLabelUses(std::span<const Expr> exprs) {
        for (const Expr& expr : exprs)
            if (expr) for_each_node(*expr, [&](const Node& node) { collect(node); });
    }

  private:
    void collect(const Node& node) {
        if (const auto* label = std::get_if<Label>(&node.form)) add({label->label}, true, true);
        const auto* angle = std::get_if<Angle>(&node.form);
        if (angle == nullptr) return;
        const auto may_be = [&](EventKind kind) { return may_be_kind(angle->kind, kind); };
        const bool lobe = may_be(EventKind::Reflection) || may_be(EventKind::Transmission) ||
                          may_be(EventKind::Volume) || may_be(EventKind::Object);
        const bool light = may_be(EventKind::Light) || may_be(EventKind::Background);
        for (const LabelTest& test : angle->labels)
            add(test.labels, lobe, light);
    }
    void add(const std::vector<std::string>& labels, bool lobe, bool light) {
        for (const std::string& label : std::set<std::string>(labels.begin(), labels.end())) {
            if (lobe) lobes[label].push_back(n_tests);
            if (light) groups[label].push_back(n_tests);
        }
        ++n_tests;
    }
};

/// The labels that are alike, together; the first is one that may be an object label where there is
/// one.
std::vector<std::vector<std::string>> alike(const LabelUses& uses) {
    std::map<std::vector<std::size_t>, std::vector<std::string>> by_use;
    for (const auto& [label, use] : uses) {
        std::vector<std::string>& labels = by_use[use];
        labels.push_back(label);
        if (!may_be_object_label(labels.front()) && may_be_object_label(label))
            std::swap(labels.front(), labels.back());
    }
    std::vector<std::vector<std::string>> classes;
    for (auto& [use, labels] : by_use)
        classes.push_back(std::move(labels));
    std::ranges::sort(classes);
    return classes;
}

/// One label of each class.
std::vector<std::string> distinct_labels(const LabelUses& uses, std::size_t limit) {
    const std::vector<std::vector<std::string>> classes = alike(uses);
    if (classes.size() > limit)
        throw InputError(OverBudget{
            Code::LimitLpeLabels,
            "would have to tell " + std::to_string(classes.size()) + " labels apart", "max_labels"}
                             .error("the proof", {}));
    std::vector<std::string> labels;
    for (const std::vector<std::string>& same : classes)
        labels.push_back(same.front());
    return labels;
}

/// Every set of labels that a lobe on an object can carry.
std::vector<std::vector<std::string>> label_sets(const std::vector<std::string>& labels) {
    std::vector<std::vector<std::string>> sets{{}};
    for (const std::string& label : labels)
        sets.push_back({label});
    for (std::size_t i = 0; i < labels.size(); ++i)
        for (std::size_t j = i + 1; j < labels.size(); ++j)
            if (may_be_object_label(labels[i]) || may_be_object_label(labels[j]))
                sets.push_back({labels[i], labels[j]});
    return sets;
}

/// A light group that no expression names: `default` unless one does.
std::string unnamed_group(const LabelUses& uses) {
    std::string group(kDefaultGroup);
    for (int i = 1; uses.contains(group); ++i)
        group = "group" + std::to_string(i);
    return group;
}

/// Decides whether a path is what is looked for, from what each expression says and the path's
/// last event.
using Wanted = std::function<bool(const std::vector<bool>& taken, const Event& last)>;

/// Breadth-first search for a shortest path that the first expression takes and `wanted` accepts,
/// through the product of the expressions' automata.
class Search {
  public:
    Search(std::span<const Expr> exprs, std::span<const Event> events, const Limits& limits)
        : alphabet_(exprs, events), limits_(limits), pool_(alphabet_, limits), n_(exprs.size()) {
        std::vector<TermId> start;
        for (const Expr& expr : exprs)
            start.push_back(pool_.derive(pool_.lower(expr), Alphabet::kCamera));
        start.push_back(kAtCamera);
        add(start, 0, Alphabet::kCamera);
    }

    std::optional<Path> run(const Wanted& wanted) {
        std::vector<TermId> now, next(n_ + 1, kAfterVertex);
        std::vector<bool> taken(n_);
        for (std::uint32_t state = 0; state < states_.size(); ++state) {
            const std::span<const TermId> vector = states_[state];
            now.assign(vector.begin(), vector.end());
            for (EventClass c = alphabet_.first_terminal(); c < alphabet_.n_classes(); ++c) {
                // A probe needs a vertex: C A is no path.
                if (now[n_] == kAtCamera && !alphabet_.is_light(c)) continue;
                for (std::size_t i = 0; i < n_; ++i)
                    taken[i] = pool_.accepts(now[i], c);
                if (taken[0] && wanted(taken, alphabet_.example(c))) return path_to(state, c);
            }
            for (EventClass c = Alphabet::kFirstScatter; c < alphabet_.first_terminal(); ++c) {
                for (std::size_t i = 0; i < n_; ++i)
                    next[i] = pool_.derive(now[i], c);
                pool_.count_steps(n_);
                if (next[0] != TermPool::kNothing) add(next, state, c);
            }
        }
        return std::nullopt;
    }

  private:
    /// The last word of a state: has the path had a vertex?
    static constexpr TermId kAtCamera = 0, kAfterVertex = 1;

    struct Arrival {
        std::uint32_t from;
        EventClass by;
    };

    void add(const std::vector<TermId>& vector, std::uint32_t from, EventClass by) {
        if (states_.intern(vector) < arrivals_.size()) return;
        arrivals_.push_back({from, by});
        if (arrivals_.size() > limits_.max_states)
            throw OverBudget{Code::LimitLpeStates,
                             "needs more than " + std::to_string(limits_.max_states) + " states",
                             "max_states"};
    }

    [[nodiscard]] Path path_to(std::uint32_t state, EventClass last) const {
        Path path{alphabet_.example(last)};
        for (; state != 0; state = arrivals_[state].from)
            path.push_back(alphabet_.example(arrivals_[state].by));
        path.push_back(Event{});
        std::ranges::reverse(path);
        return path;
    }

    Alphabet alphabet_;
    const Limits& limits_;
    TermPool pool_;
    std::size_t n_;
    Interner states_;  ///< one term for each expression, and the last word; 0 is the start
    std::vector<Arrival> arrivals_;  ///< per state: how it was first reached
};

/// Any path that the first expression takes.
bool any(const std::vector<bool>&, const Event&) { return true; }

/// Paths that a takes and b takes too, or does not.
bool in_both(const std::vector<bool>& taken, const Event&) { return taken[1]; }
bool in_first_only(const std::vector<bool>& taken, const Event&) { return !taken[1]; }

std::optional<Path> search(std::initializer_list<Expr> exprs, std::span<const Event> events,
                           const Wanted& wanted, const Limits& limits) {
    if (!*exprs.begin()) return std::nullopt;
    try {
        return Search({exprs.begin(), exprs.size()}, events, limits).run(wanted);
    } catch (const OverBudget& over) {
        throw InputError(over.error("the proof", (*exprs.begin())->where));
    }
}

std::optional<Path> search(std::initializer_list<Expr> exprs, const Wanted& wanted,
                           const Limits& limits) {
    const std::span<const Expr> all(exprs.begin(), exprs.size());
    return search(exprs, abstract_events(all, limits), wanted, limits);
}

}  // namespace

std::vector<Event> abstract_events(std::span<const Expr> exprs, const Limits& limits) {
    const AllLabelUses uses(exprs);
    const std::vector<std::vector<std::string>> lobes =
        label_sets(distinct_labels(uses.lobes, limits.max_labels));
    // A light is in one group: no pairs, so there may be many more of them.
    const std::vector<std::string> groups =
        distinct_labels(uses.groups, kGroupsPerLabel * limits.max_labels);
    std::vector<Event> events;
    const auto add_lobes = [&](EventKind kind, EventLobe lobe) {
        for (const std::vector<std::string>& labels : lobes)
            events.push_back({kind, lobe, labels});
    };
    const auto add_lights = [&](EventKind kind, const std::vector<std::string>& unnamed) {
        events.push_back({kind, EventLobe::None, unnamed});
        for (const std::string& group : groups)
            events.push_back({kind, EventLobe::None, {group}});
    };
    add_lobes(EventKind::Reflection, EventLobe::Diffuse);
    add_lobes(EventKind::Reflection, EventLobe::Specular);
    add_lobes(EventKind::Transmission, EventLobe::Diffuse);
    add_lobes(EventKind::Transmission, EventLobe::Specular);
    add_lobes(EventKind::Volume, EventLobe::None);
    add_lights(EventKind::Light, {unnamed_group(uses.groups)});
    add_lobes(EventKind::Object, EventLobe::None);
    add_lights(EventKind::Background, {});
    events.push_back({EventKind::Albedo, EventLobe::None, {}});
    return events;
}

LabelClasses label_classes(std::span<const Expr> exprs) {
    const AllLabelUses uses(exprs);
    return {alike(uses.lobes), alike(uses.groups)};
}

std::optional<Path> shortest_path(const Expr& expr, const Limits& limits) {
    return search({expr}, any, limits);
}

std::optional<Path> shortest_path(const Expr& expr, std::span<const Event> events,
                                  const Limits& limits) {
    return search({expr}, events, any, limits);
}

std::optional<Path> shortest_common_path(const Expr& a, const Expr& b, const Limits& limits) {
    return search({a, b}, in_both, limits);
}

std::optional<Path> shortest_path_outside(const Expr& a, const Expr& b, const Limits& limits) {
    return search({a, b}, in_first_only, limits);
}

bool equivalent(const Expr& a, const Expr& b, const Limits& limits) {
    return !shortest_path_outside(a, b, limits) && !shortest_path_outside(b, a, limits);
}

bool takes_light(const Expr& expr, const Limits& limits) {
    const auto is_light = [](const std::vector<bool>&, const Event& last) {
        return last.kind != EventKind::Albedo;
    };
    return search({expr}, is_light, limits).has_value();
}

bool takes_probe(const Expr& expr, const Limits& limits) {
    const auto is_probe = [](const std::vector<bool>&, const Event& last) {
        return last.kind == EventKind::Albedo;
    };
    return search({expr}, is_probe, limits).has_value();
}

Comparison compare(const Expr& a, const Expr& b, std::span<const Event> events,
                   const Limits& limits) {
    Comparison out;
    out.only_a = search({a, b}, events, in_first_only, limits);
    out.only_b = search({b, a}, events, in_first_only, limits);
    out.both = search({a, b}, events, in_both, limits);
    if (!out.only_a && !out.only_b)
        out.relation = Relation::Equal;
    else if (!out.only_a)
        out.relation = Relation::Subset;
    else if (!out.only_b)
        out.relation = Relation::Superset;
    else
        out.relation = out.both ? Relation::Overlapping : Relation::Disjoint;
    return out;
}

Comparison compare(const Expr& a, const Expr& b, const Limits& limits) {
    return compare(a, b, abstract_events(std::array{a, b}, limits), limits);
}

namespace {

/// Proves it with `find(exprs, wanted)`, which searches for a path.
template <class Find>
PartitionReport partition_by(const Expr& whole, std::span<const Expr> parts, const Find& find) {
    PartitionReport report;
    const auto keep_shortest = [&](PartitionReport::Fault fault, std::optional<Path> witness,
                                   std::size_t first = 0, std::size_t second = 0) {
        if (!witness) return;
        if (report.holds() || witness->size() < report.witness.size())
            report = {fault, *std::move(witness), first, second};
    };
    Alternation all;
    for (const Expr& part : parts)
        if (part) all.parts.push_back(part);
    const Expr sum = std::make_shared<const Node>(Node{std::move(all), {}});
    keep_shortest(PartitionReport::Fault::Lost, find({whole, sum}, in_first_only));
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = i + 1; j < parts.size(); ++j)
            keep_shortest(PartitionReport::Fault::Twice, find({parts[i], parts[j]}, in_both), i,
                          j);
    keep_shortest(PartitionReport::Fault::Outside, find({sum, whole}, in_first_only));
    return report;
}

}  // namespace

PartitionReport check_partition(const Expr& whole, std::span<const Expr> parts,
                                std::span<const Event> events, const Limits& limits) {
    return partition_by(whole, parts,
                        [&](std::initializer_list<Expr> exprs, const Wanted& wanted) {
                            return search(exprs, events, wanted, limits);
                        });
}

PartitionReport check_partition(const Expr& whole, std::span<const Expr> parts,
                                const Limits& limits) {
    return partition_by(whole, parts,
                        [&](std::initializer_list<Expr> exprs, const Wanted& wanted) {
                            return search(exprs, wanted, limits);
                        });
}

}  // namespace lightsieve::lpe
