#include "lpe/regions.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <string>

namespace lightsieve::lpe {
namespace {

/// Looks at regions of AOVs that a search may take: about a hundredth of a second.
constexpr std::size_t kMaxSearchSteps = 5'000'000;
/// Events of a random walk after which what is left of it is too little to compare sizes.
constexpr std::size_t kWalkLength = 32;
/// Shares of a random walk that differ by less are equal.
constexpr double kShareNoise = 1e-9;

constexpr std::size_t kKinds = 8, kLobes = 3;

std::size_t kind_index(const Event& event) {
    return static_cast<std::size_t>(event.kind) * kLobes + static_cast<std::size_t>(event.lobe);
}

/// How likely a random walk takes each class: half of the time it scatters, every kind of scattering
/// alike; light arrives from every kind of terminal alike.
class WalkWeights {
  public:
    WalkWeights(const Program& program, std::span<const Event> events)
        : weights_(Program::kFirstClass + program.n_classes() + program.n_terminals()) {
        std::array<double, kKinds * kLobes> n_of_kind{};
        for (const Event& event : events)
            n_of_kind[kind_index(event)] += 1;
        double n_scatter = 0, n_light = 0;
        for (std::size_t i = 0; i < n_of_kind.size(); ++i) {
            if (n_of_kind[i] == 0) continue;
            const auto kind = static_cast<EventKind>(i / kLobes);
            if (kind == EventKind::Camera || kind == EventKind::Albedo) continue;
            (is_terminal(kind) ? n_light : n_scatter) += 1;
        }
        for (const Event& event : events) {
            if (event.kind == EventKind::Camera || event.kind == EventKind::Albedo) continue;
            const bool ends = is_terminal(event.kind);
            const std::uint32_t column =
                ends ? program.terminal(event) : program.scatter_class(event);
            weights_[column] += 0.5 / (ends ? n_light : n_scatter) / n_of_kind[kind_index(event)];
        }
    }
    [[nodiscard]] double operator[](std::uint32_t column) const { return weights_[column]; }

  private:
    std::vector<double> weights_;
};

/// Walks an automaton breadth first and notes the first path to each atom.
class Explorer {
  public:
    explicit Explorer(const Program& program)
        : program_(program), automaton_(program.automaton(0)), seen_(2 * automaton_.n_states()) {}

    std::map<AtomId, Path> run() {
        visit(automaton_.start(), false, Path{Event{}});
        for (std::size_t i = 0; i < queue_.size(); ++i) {
            const Arrival here = queue_[i];
            for (std::size_t t = 0; t < program_.n_terminals(); ++t)
                end(here, program_.first_terminal() + static_cast<TerminalId>(t));
            for (std::size_t c = 0; c < program_.n_classes(); ++c) {
                const ClassId column = Program::kFirstClass + static_cast<ClassId>(c);
                const State next = automaton_.step(here.state, column);
                if (next == kDead) continue;
                Path path = here.path;
                path.push_back(program_.example(column));
                visit(next, true, std::move(path));
            }
        }
        return std::move(found_);
    }

  private:
    struct Arrival {
        State state;
        bool after_vertex;
        Path path;
    };

    void visit(State state, bool after_vertex, Path path) {
        const std::size_t key = 2 * automaton_.index(state) + (after_vertex ? 1 : 0);
        if (seen_[key]) return;
        seen_[key] = true;
        queue_.push_back({state, after_vertex, std::move(path)});
    }

    void end(const Arrival& here, TerminalId column) {
        const AtomId atom = automaton_.atom(here.state, column);
        const Event& last = program_.example(column);
        // A probe needs a vertex.
        if (atom == kNoAtom || (last.kind == EventKind::Albedo && !here.after_vertex)) return;
        const auto [entry, is_new] = found_.try_emplace(atom, here.path);
        if (is_new) entry->second.push_back(last);
    }

    const Program& program_;
    const Automaton& automaton_;
    std::vector<bool> seen_;  ///< per state, before and after the first vertex
    std::vector<Arrival> queue_;
    std::map<AtomId, Path> found_;
};

/// How much of a random walk ends in each atom.
std::vector<double> atom_shares(const Program& program, std::span<const Event> events) {
    const WalkWeights weights(program, events);
    const Automaton& automaton = program.automaton(0);
    std::vector<double> shares(program.n_atoms()), now(automaton.n_states()), next;
    now[automaton.index(automaton.start())] = 1;
    for (std::size_t i = 0; i < kWalkLength; ++i) {
        next.assign(now.size(), 0);
        for (std::size_t s = 1; s < now.size(); ++s) {
            if (now[s] == 0) continue;
            const State state = automaton.state(s);
            for (ClassId c = Program::kFirstClass; c < program.first_terminal(); ++c)
                next[automaton.index(automaton.step(state, c))] += now[s] * weights[c];
            for (std::size_t t = 0; t < program.n_terminals(); ++t) {
                const TerminalId column = program.first_terminal() + static_cast<TerminalId>(t);
                const AtomId atom = automaton.atom(state, column);
                if (atom != kNoAtom) shares[atom] += now[s] * weights[column];
            }
        }
        now.swap(next);
    }
    return shares;
}

/// The regions that an AOV consists of.
using Members = std::vector<std::uint32_t>;

/// Regions of the whole, and the AOVs that are parts of it.
struct Parts {
    std::vector<bool> in_whole;             ///< per region
    std::vector<Members> members;           ///< per AOV: its regions, ascending
    std::vector<std::uint32_t> candidates;  ///< AOVs within the whole, largest first
    std::vector<double> share;              ///< per AOV

    Parts(std::span<const Region> regions, std::size_t n_aovs, std::uint32_t whole)
        : in_whole(regions.size()), members(n_aovs), share(n_aovs) {
        for (std::uint32_t r = 0; r < regions.size(); ++r)
            for (const std::uint32_t aov : regions[r].aovs) {
                members[aov].push_back(r);
                share[aov] += regions[r].share;
                if (aov == whole) in_whole[r] = true;
            }
        for (std::uint32_t aov = 0; aov < n_aovs; ++aov)
            if (members[aov] != members[whole] && is_part(aov) && is_first_of_equals(aov))
                candidates.push_back(aov);
        std::ranges::stable_sort(candidates, [&](std::uint32_t a, std::uint32_t b) {
            return share[a] > share[b] + kShareNoise;
        });
    }

  private:
    [[nodiscard]] bool is_part(std::uint32_t aov) const {
        return !members[aov].empty() &&
               std::ranges::all_of(members[aov], [&](std::uint32_t r) { return in_whole[r]; });
    }
    [[nodiscard]] bool is_first_of_equals(std::uint32_t aov) const {
        return std::find(members.begin(), members.begin() + aov, members[aov]) ==
               members.begin() + aov;
    }
};

/// Exact cover by trying, for a region that few AOVs take, each of them.
class SumSearch {
  public:
    SumSearch(const Parts& parts, std::size_t max_sums)
        : parts_(parts), max_sums_(max_sums), covered_(parts.in_whole.size()) {
        for (std::uint32_t r = 0; r < parts.in_whole.size(); ++r)
            if (!parts.in_whole[r]) covered_[r] = true;
        for (const std::uint32_t aov : parts.candidates)
            steps_per_node_ += parts.members[aov].size();
    }

    std::vector<Members> run() {
        search();
        return std::move(found_);
    }

  private:
    void search() {
        n_steps_ += steps_per_node_;
        if (n_steps_ > kMaxSearchSteps || found_.size() >= max_sums_) return;
        const std::uint32_t region = hardest_region();
        if (region == covered_.size()) {
            Members sum = chosen_;
            std::ranges::sort(sum);
            found_.push_back(std::move(sum));
            return;
        }
        for (const std::uint32_t aov : parts_.candidates) {
            const Members& members = parts_.members[aov];
            if (!std::ranges::binary_search(members, region) || !is_free(members)) continue;
            mark(members, true);
            chosen_.push_back(aov);
            search();
            chosen_.pop_back();
            mark(members, false);
        }
    }

    /// The uncovered region that the fewest AOVs can still cover; covered_.size() if none is left.
    [[nodiscard]] std::uint32_t hardest_region() const {
        const auto n_regions = static_cast<std::uint32_t>(covered_.size());
        std::uint32_t hardest = n_regions;
        std::size_t fewest = SIZE_MAX;
        std::vector<std::size_t> n_choices(n_regions);
        for (const std::uint32_t aov : parts_.candidates)
            if (is_free(parts_.members[aov]))
                for (const std::uint32_t r : parts_.members[aov])
                    ++n_choices[r];
        for (std::uint32_t r = 0; r < n_regions; ++r)
            if (!covered_[r] && n_choices[r] < fewest) {
                hardest = r;
                fewest = n_choices[r];
            }
        return hardest;
    }

    [[nodiscard]] bool is_free(const Members& members) const {
        return std::ranges::none_of(members, [&](std::uint32_t r) { return bool{covered_[r]}; });
    }
    void mark(const Members& members, bool covered) {
        for (const std::uint32_t r : members)
            covered_[r] = covered;
    }

    const Parts& parts_;
    std::size_t max_sums_, n_steps_ = 0, steps_per_node_ = 1;
    std::vector<bool> covered_;
    Members chosen_;
    std::vector<Members> found_;
};

/// Could some of the parts, but not all, be replaced by one AOV that is their sum?
bool is_reducible(const Parts& parts, const Members& sum) {
    const auto is_sum_of_some = [&](std::uint32_t aov) {
        if (std::ranges::binary_search(sum, aov)) return false;
        std::size_t n_inside = 0, n_regions = 0;
        for (const std::uint32_t part : sum) {
            const bool inside = std::ranges::includes(parts.members[aov], parts.members[part]);
            n_inside += inside ? 1 : 0;
            n_regions += inside ? parts.members[part].size() : 0;
        }
        return n_inside > 1 && n_regions == parts.members[aov].size();
    };
    return std::ranges::any_of(parts.candidates, is_sum_of_some);
}

/// The largest set of disjoint AOVs by branch and bound.
class NearestSearch {
  public:
    explicit NearestSearch(const Parts& parts)
        : parts_(parts), covered_(parts.in_whole.size()), left_(parts.candidates.size() + 1) {
        for (std::size_t i = parts.candidates.size(); i-- > 0;)
            left_[i] = left_[i + 1] + parts.share[parts.candidates[i]];
    }

    Members run() {
        search(0, 0);
        std::ranges::sort(best_);
        return best_;
    }

  private:
    void search(std::size_t i, double share) {
        if (n_steps_ > kMaxSearchSteps) return;
        n_steps_ += parts_.in_whole.size();
        const bool better = share > best_share_ + kShareNoise;
        const bool shorter = share > best_share_ - kShareNoise && chosen_.size() < best_.size();
        if (better || shorter) {
            best_ = chosen_;
            best_share_ = share;
        }
        if (i == parts_.candidates.size() || share + left_[i] < best_share_ + kShareNoise) return;
        const std::uint32_t aov = parts_.candidates[i];
        const Members& members = parts_.members[aov];
        if (std::ranges::none_of(members, [&](std::uint32_t r) { return bool{covered_[r]}; })) {
            mark(members, true);
            chosen_.push_back(aov);
            search(i + 1, share + parts_.share[aov]);
            chosen_.pop_back();
            mark(members, false);
        }
        search(i + 1, share);
    }
    void mark(const Members& members, bool covered) {
        for (const std::uint32_t r : members)
            covered_[r] = covered;
    }

    const Parts& parts_;
    std::vector<bool> covered_;
    std::vector<double> left_;  ///< what the candidates from i on take at most
    Members chosen_, best_;
    double best_share_ = 0;
    std::size_t n_steps_ = 0;
};

}  // namespace

std::vector<Event> possible_events(std::span<const AovRequest> aovs,
                                   std::span<const std::string> groups, const Limits& limits) {
    std::vector<Expr> exprs;
    for (const AovRequest& aov : aovs)
        exprs.push_back(aov.expr);
    for (const std::string& group : groups) {
        const LabelTest in_group{LabelTest::Form::One, {group}, {}};
        exprs.push_back(std::make_shared<const Node>(Node{
            Angle{{LetterTest::Form::OneOf, "LB"}, {LetterTest::Form::Any, ""}, {in_group}}, {}}));
    }
    return abstract_events(exprs, limits);
}

std::vector<Region> regions(std::span<const AovRequest> aovs, std::span<const Event> events,
                            const Limits& limits) {
    Diagnostics diagnostics;
    const Program program = Program::compile(aovs, events, limits, diagnostics);
    diagnostics.throw_if_errors();
    std::vector<Region> out;
    if (program.n_automata() == 0) return out;
    if (program.n_automata() > 1)
        throw InputError(OverBudget{Code::LimitLpeStates,
                                    "needs more than " + std::to_string(limits.max_states) +
                                        " states for all AOVs at once",
                                    "max_states"}
                             .error("the proof", {}));
    const std::vector<double> shares = atom_shares(program, events);
    for (auto& [atom, path] : Explorer(program).run()) {
        const std::span<const std::uint32_t> of = program.aovs_of(atom);
        out.push_back({{of.begin(), of.end()}, std::move(path), shares[atom]});
    }
    std::ranges::stable_sort(out, {}, [](const Region& region) { return region.example.size(); });
    return out;
}

Relation relation(std::span<const Region> regions, std::uint32_t a, std::uint32_t b) {
    bool only_a = false, only_b = false, both = false;
    for (const Region& region : regions) {
        const bool in_a = std::ranges::binary_search(region.aovs, a);
        const bool in_b = std::ranges::binary_search(region.aovs, b);
        both = both || (in_a && in_b);
        only_a = only_a || (in_a && !in_b);
        only_b = only_b || (in_b && !in_a);
    }
    if (!only_a) return only_b ? Relation::Subset : Relation::Equal;
    if (!only_b) return Relation::Superset;
    return both ? Relation::Overlapping : Relation::Disjoint;
}

std::vector<Sum> find_sums(std::span<const Region> regions, std::size_t n_aovs,
                           std::uint32_t whole, std::size_t max_sums) {
    const Parts parts(regions, n_aovs, whole);
    std::vector<Sum> out;
    // Some of what is found is left out, so more is looked for.
    for (Members& members : SumSearch(parts, 8 * max_sums).run())
        if (members.size() > 1 && !is_reducible(parts, members))
            out.push_back({whole, std::move(members)});
    std::ranges::sort(out, [](const Sum& a, const Sum& b) {
        return std::pair(a.parts.size(), a.parts) < std::pair(b.parts.size(), b.parts);
    });
    if (out.size() > max_sums) out.resize(max_sums);
    return out;
}

std::vector<std::uint32_t> nearest_parts(std::span<const Region> regions, std::size_t n_aovs,
                                         std::uint32_t whole) {
    return NearestSearch(Parts(regions, n_aovs, whole)).run();
}

}  // namespace lightsieve::lpe
