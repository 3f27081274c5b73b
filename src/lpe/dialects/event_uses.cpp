// Where in light paths the events of a pattern stand, and a pattern for an automaton.
#include <algorithm>
#include <array>
#include <map>

#include "lpe/dialects/language.h"
#include "lpe/dialects/positions.h"

namespace lightsieve::lpe::dialects {
namespace {

using PathState = CommonAlphabet::PathState;
using PathStates = std::array<bool, CommonAlphabet::kPathStates>;
constexpr std::array kOpenStates{CommonAlphabet::kStart, CommonAlphabet::kAtCamera,
                                 CommonAlphabet::kAfterVertex};

/// The walk of light paths through a pattern's positions: how far a path can be before and after
/// each of them.
class Walk {
  public:
    Walk(const Pattern& pattern, const CommonAlphabet& alphabet, const SymbolSet& invisible,
         const Limits& limits)
        : alphabet_(alphabet),
          invisible_(invisible),
          positions_(positions_of(pattern, limits)),
          before_(positions_.node.size()),
          after_(positions_.node.size()),
          ends_(positions_.node.size()) {
        walk_forward();
        walk_backward();
    }

    std::unordered_map<const Pattern*, EventUse> uses() const {
        std::unordered_map<const Pattern*, EventUse> out;
        for (std::size_t p = 0; p < positions_.node.size(); ++p) {
            const Pattern* node = positions_.node[p];
            const auto [entry, is_new] =
                out.try_emplace(node, EventUse{alphabet_.none(), alphabet_.all()});
            for (Symbol s = 0; s < alphabet_.size(); ++s) {
                if (!can_stand(p, s)) continue;
                // What could stand here and is not meant must not be added.
                if (node->events.has(s)) entry->second.taken.add(s);
                SymbolSet one = alphabet_.none();
                one.add(s);
                entry->second.free -= one;
            }
        }
        return out;
    }

  private:
    /// May a path have the symbol at the position, and still come to an end somehow?
    [[nodiscard]] bool can_stand(std::size_t p, Symbol s) const {
        return std::ranges::any_of(kOpenStates, [&](PathState state) {
            return before_[p][state] && ends_[p][alphabet_.step(state, s)];
        });
    }

    /// Adds what a path can become by events that the pattern does not see.
    void add_invisible(PathStates& states) const {
        for (const PathState state : kOpenStates)
            for (Symbol s = 0; states[state] && s < alphabet_.size(); ++s)
                if (invisible_.has(s)) states[alphabet_.step(state, s)] = true;
    }

    void walk_forward() {
        std::vector<std::uint32_t> open;
        const auto reach = [&](std::uint32_t p, const PathStates& states) {
            bool changed = false;
            for (const PathState state : kOpenStates)
                if (states[state] && !before_[p][state]) before_[p][state] = changed = true;
            if (changed) open.push_back(p);
        };
        PathStates begin{};
        begin[CommonAlphabet::kStart] = true;
        add_invisible(begin);
        for (const std::uint32_t p : positions_.first)
            reach(p, begin);
        while (!open.empty()) {
            const std::uint32_t p = open.back();
            open.pop_back();
            for (const PathState state : kOpenStates)
                for (Symbol s = 0; before_[p][state] && s < alphabet_.size(); ++s)
                    if (positions_.node[p]->events.has(s))
                        after_[p][alphabet_.step(state, s)] = true;
            add_invisible(after_[p]);
            for (const std::uint32_t q : positions_.follow[p])
                reach(q, after_[p]);
        }
    }

    /// From which states after each position can a path end, whatever the later events take?
    void walk_backward() {
        std::array<PathStates, CommonAlphabet::kPathStates> leads{};
        for (const PathState state : kOpenStates)
            for (Symbol s = 0; s < alphabet_.size(); ++s)
                leads[state][alphabet_.step(state, s)] = true;
        for (std::size_t p = 0; p < positions_.node.size(); ++p)
            ends_[p][CommonAlphabet::kEnd] = positions_.is_last[p];
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t p = positions_.node.size(); p-- > 0;)
                for (const PathState state : kOpenStates)
                    for (const std::uint32_t q : positions_.follow[p])
                        for (std::size_t to = 0; to < CommonAlphabet::kPathStates; ++to)
                            if (!ends_[p][state] && leads[state][to] && ends_[q][to])
                                ends_[p][state] = changed = true;
        }
    }

    const CommonAlphabet& alphabet_;
    const SymbolSet& invisible_;
    Positions positions_;
    std::vector<PathStates> before_, after_;  ///< per position: how far a path can be
    std::vector<PathStates> ends_;            ///< per position: from where it can still end
};

/// Edges between states, for elimination; a pattern each.
using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, PatternPtr>;

void join(Edges& edges, std::pair<std::uint32_t, std::uint32_t> key, PatternPtr pattern) {
    const auto [entry, is_new] = edges.try_emplace(key, pattern);
    if (!is_new) entry->second = make_alternation({entry->second, std::move(pattern)});
}

/// States from which a path can end.
std::vector<bool> live_states(const Automaton& automaton) {
    std::vector<bool> live(automaton.accepts);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < automaton.n_states(); ++i)
            for (std::size_t c = 0; !live[i] && c < automaton.n_classes; ++c)
                if (live[automaton.next[i * automaton.n_classes + c]]) live[i] = changed = true;
    }
    return live;
}

}  // namespace

std::unordered_map<const Pattern*, EventUse> event_uses(const Pattern& pattern,
                                                        const CommonAlphabet& alphabet,
                                                        const SymbolSet& invisible,
                                                        const Limits& limits) {
    return Walk(pattern, alphabet, invisible, limits).uses();
}

PatternPtr to_pattern(const Automaton& automaton, const CommonAlphabet& alphabet,
                      const Limits& limits) {
    const std::vector<bool> live = live_states(automaton);
    const auto n = static_cast<std::uint32_t>(automaton.n_states());
    // Two more states: one before the start, one after every end.
    const std::uint32_t begin = n, end = n + 1;
    std::map<std::pair<std::uint32_t, std::uint32_t>, SymbolSet> sets;
    for (std::uint32_t i = 0; i < n; ++i)
        for (Symbol s = 0; live[i] && s < alphabet.size(); ++s)
            if (const std::uint32_t to = automaton.step(i, s); live[to])
                sets.try_emplace({i, to}, alphabet.none()).first->second.add(s);
    Edges edges;
    for (const auto& [key, set] : sets)
        edges[key] = make_events(set);
    edges[{begin, automaton.start}] = make_empty();
    for (std::uint32_t i = 0; i < n; ++i)
        if (automaton.accepts[i]) edges[{i, end}] = make_empty();

    std::vector<std::uint32_t> states;
    for (std::uint32_t i = 0; i < n; ++i)
        if (live[i]) states.push_back(i);
    while (!states.empty()) {
        // The state with the fewest ways through it goes first: it is copied least.
        const auto ways = [&](std::uint32_t state) {
            std::size_t in = 0, out = 0;
            for (const auto& [key, pattern] : edges) {
                in += key.second == state && key.first != state ? count_nodes(*pattern) : 0;
                out += key.first == state && key.second != state ? count_nodes(*pattern) : 0;
            }
            return in * out;
        };
        const auto next = std::ranges::min_element(states, {}, ways);
        const std::uint32_t state = *next;
        states.erase(next);
        PatternPtr loop = make_empty();
        std::vector<std::pair<std::uint32_t, PatternPtr>> in, out;
        std::size_t n_nodes = 0;
        for (const auto& [key, pattern] : edges) {
            if (key.first == state && key.second == state)
                loop = make_repeat(pattern, 0, Pattern::kUnbounded);
            else if (key.first == state)
                out.emplace_back(key.second, pattern);
            else if (key.second == state)
                in.emplace_back(key.first, pattern);
            n_nodes += count_nodes(*pattern);
        }
        if (n_nodes > limits.max_nodes / 100)
            throw OverBudget{Code::LimitLpeNodes, "becomes too long an expression", "max_nodes"};
        std::erase_if(edges, [&](const auto& edge) {
            return edge.first.first == state || edge.first.second == state;
        });
        for (const auto& [from, before] : in)
            for (const auto& [to, after] : out)
                join(edges, {from, to}, make_sequence({before, loop, after}));
    }
    const auto whole = edges.find({begin, end});
    return whole == edges.end() ? make_nothing() : whole->second;
}

}  // namespace lightsieve::lpe::dialects
