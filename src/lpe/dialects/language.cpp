#include "lpe/dialects/language.h"

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "lpe/dialects/positions.h"
#include "lpe/interner.h"

namespace lightsieve::lpe::dialects {
namespace {

[[noreturn]] void too_many_states(const Limits& limits) {
    throw OverBudget{Code::LimitLpeStates,
                     "needs more than " + std::to_string(limits.max_states) + " states",
                     "max_states"};
}

class Steps {
  public:
    explicit Steps(const Limits& limits) : limits_(limits) {}
    void count(std::size_t n) {
        n_ += n;
        // A step here is one position or transition looked at.
        if (n_ > limits_.max_steps)
            throw OverBudget{Code::LimitLpeSteps,
                             "needs more than " + std::to_string(limits_.max_steps) + " steps",
                             "max_steps"};
    }

  private:
    const Limits& limits_;
    std::size_t n_ = 0;
};

/// Numbers symbols by what `key` says of them; equal keys are one class.
template <class Key>
void classify(Automaton& automaton, const CommonAlphabet& alphabet, const Key& key) {
    std::map<std::vector<std::uint32_t>, std::uint32_t> classes;
    automaton.class_of.resize(alphabet.size());
    for (Symbol s = 0; s < alphabet.size(); ++s) {
        const auto next = static_cast<std::uint32_t>(classes.size());
        automaton.class_of[s] = classes.emplace(key(s), next).first->second;
    }
    automaton.n_classes = static_cast<std::uint32_t>(classes.size());
}

/// The first symbol of each class.
std::vector<Symbol> examples(const Automaton& automaton) {
    std::vector<Symbol> out(automaton.n_classes);
    for (Symbol s = static_cast<Symbol>(automaton.class_of.size()); s-- > 0;)
        out[automaton.class_of[s]] = s;
    return out;
}

/// Fills an automaton whose states are runs of words: `expand(state, symbol)` gives the next run.
template <class Expand, class Accepts>
void explore(Automaton& automaton, std::vector<std::uint32_t> start, const Limits& limits,
             const Expand& expand, const Accepts& accepts) {
    const std::vector<Symbol> symbols = examples(automaton);
    Interner states;
    automaton.start = states.intern(start);
    for (std::uint32_t state = 0; state < states.size(); ++state) {
        if (states.size() > limits.max_states) too_many_states(limits);
        const std::vector<std::uint32_t> words(states[state].begin(), states[state].end());
        for (const Symbol s : symbols)
            automaton.next.push_back(states.intern(expand(words, s)));
        automaton.accepts.push_back(accepts(words));
    }
}

/// The subset construction over a pattern's positions; the first word of a state is how far the
/// light path is, the others are positions.
Automaton subsets(const Pattern& pattern, const CommonAlphabet& alphabet,
                  const SymbolSet& invisible, const Limits& limits) {
    const Positions positions = positions_of(pattern, limits);
    std::set<SymbolSet> sets;
    for (const Pattern* node : positions.node)
        sets.insert(node->events);
    Automaton out;
    classify(out, alphabet, [&](Symbol s) {
        std::vector<std::uint32_t> key{invisible.has(s) ? 1U : 0U};
        for (const auto state : {CommonAlphabet::kAtCamera, CommonAlphabet::kAfterVertex})
            key.push_back(alphabet.step(state, s));
        key.push_back(alphabet.step(CommonAlphabet::kStart, s));
        for (const SymbolSet& set : sets)
            key.push_back(set.has(s) ? 1 : 0);
        return key;
    });
    constexpr std::uint32_t kBegin = UINT32_MAX;  // before the first position
    Steps steps(limits);
    const auto expand = [&](const std::vector<std::uint32_t>& state, Symbol s) {
        const auto path = alphabet.step(static_cast<CommonAlphabet::PathState>(state[0]), s);
        std::vector<std::uint32_t> next{path};
        if (path == CommonAlphabet::kNoPath) return next;
        if (invisible.has(s)) {
            next.insert(next.end(), state.begin() + 1, state.end());
            return next;
        }
        for (std::size_t i = 1; i < state.size(); ++i) {
            const std::vector<std::uint32_t>& follow =
                state[i] == kBegin ? positions.first : positions.follow[state[i]];
            steps.count(follow.size() + 1);
            for (const std::uint32_t position : follow)
                if (positions.node[position]->events.has(s)) next.push_back(position);
        }
        std::sort(next.begin() + 1, next.end());
        next.erase(std::unique(next.begin() + 1, next.end()), next.end());
        if (next.size() == 1) next[0] = CommonAlphabet::kNoPath;
        return next;
    };
    const auto accepts = [&](const std::vector<std::uint32_t>& state) {
        const auto is_last = [&](std::uint32_t p) { return p != kBegin && positions.is_last[p]; };
        return state[0] == CommonAlphabet::kEnd &&
               std::any_of(state.begin() + 1, state.end(), is_last);
    };
    explore(out, {CommonAlphabet::kStart, kBegin}, limits, expand, accepts);
    return out;
}

/// All light: what `C.*` takes in a dialect that sees everything.
Automaton all_light(const CommonAlphabet& alphabet, const Limits& limits) {
    Automaton out;
    const auto is_light = [&](Symbol s) {
        const CommonKind kind = alphabet.event(s).kind;
        return kind != CommonKind::Probe && kind != CommonKind::ForeignEnd;
    };
    classify(out, alphabet, [&](Symbol s) {
        return std::vector<std::uint32_t>{
            alphabet.step(CommonAlphabet::kStart, s), alphabet.step(CommonAlphabet::kAtCamera, s),
            alphabet.step(CommonAlphabet::kAfterVertex, s), is_light(s) ? 1U : 0U};
    });
    const auto expand = [&](const std::vector<std::uint32_t>& state, Symbol s) {
        const auto path = static_cast<CommonAlphabet::PathState>(state[0]);
        return std::vector<std::uint32_t>{is_light(s) ? alphabet.step(path, s)
                                                      : CommonAlphabet::kNoPath};
    };
    explore(
        out, {CommonAlphabet::kStart}, limits, expand,
        [](const std::vector<std::uint32_t>& state) { return state[0] == CommonAlphabet::kEnd; });
    return out;
}

/// Steps several automata together; `accepts` decides from what each of them says.
Automaton combine(const std::vector<Automaton>& parts, const CommonAlphabet& alphabet,
                  const Limits& limits,
                  const std::function<bool(const std::vector<bool>&)>& accepts) {
    Automaton out;
    classify(out, alphabet, [&](Symbol s) {
        std::vector<std::uint32_t> key;
        for (const Automaton& part : parts)
            key.push_back(part.class_of[s]);
        return key;
    });
    std::vector<std::uint32_t> start;
    for (const Automaton& part : parts)
        start.push_back(part.start);
    const auto expand = [&](std::vector<std::uint32_t> state, Symbol s) {
        for (std::size_t i = 0; i < parts.size(); ++i)
            state[i] = parts[i].step(state[i], s);
        return state;
    };
    explore(out, start, limits, expand, [&](const std::vector<std::uint32_t>& state) {
        std::vector<bool> each(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i)
            each[i] = parts[i].accepts[state[i]];
        return accepts(each);
    });
    return out;
}

/// The paths of an intersection, difference or complement.
Automaton boolean_paths(const Pattern& pattern, const CommonAlphabet& alphabet,
                        const SymbolSet& invisible, const Limits& limits) {
    std::vector<Automaton> parts;
    for (const PatternPtr& part : pattern.parts)
        parts.push_back(paths_of(*part, alphabet, invisible, limits));
    if (pattern.form == Pattern::Form::Intersection)
        return combine(parts, alphabet, limits, [](const std::vector<bool>& each) {
            return std::ranges::all_of(each, [](bool yes) { return yes; });
        });
    if (pattern.form == Pattern::Form::Complement)
        parts.insert(parts.begin(), all_light(alphabet, limits));
    return combine(parts, alphabet, limits, [](const std::vector<bool>& each) {
        return each[0] && std::none_of(each.begin() + 1, each.end(), [](bool yes) { return yes; });
    });
}

bool has_boolean(const Pattern& pattern) {
    return is_boolean(pattern.form) ||
           std::ranges::any_of(pattern.parts,
                               [](const PatternPtr& part) { return has_boolean(*part); });
}

/// A boolean takes whole light paths, from the camera to the end: so it can be one of several
/// alternatives, or all there is. Inside a sequence, whatever stands beside it must be empty.
Automaton mixed_paths(const Pattern& pattern, const CommonAlphabet& alphabet,
                      const SymbolSet& invisible, const Limits& limits) {
    const auto any = [](const std::vector<bool>& each) {
        return std::ranges::any_of(each, [](bool yes) { return yes; });
    };
    std::vector<Automaton> parts;
    switch (pattern.form) {
        case Pattern::Form::Alternation:
            for (const PatternPtr& part : pattern.parts)
                parts.push_back(paths_of(*part, alphabet, invisible, limits));
            return combine(parts, alphabet, limits, any);
        case Pattern::Form::Repeat:
            // Two light paths in a row are none.
            if (pattern.min > 1 && !is_nullable(*pattern.parts[0])) break;
            return paths_of(*pattern.parts[0], alphabet, invisible, limits);
        case Pattern::Form::Sequence: {
            for (std::size_t i = 0; i < pattern.parts.size(); ++i) {
                bool alone = true;
                for (std::size_t j = 0; j < pattern.parts.size(); ++j)
                    alone = alone && (i == j || is_nullable(*pattern.parts[j]));
                if (alone && has_boolean(*pattern.parts[i]))
                    parts.push_back(paths_of(*pattern.parts[i], alphabet, invisible, limits));
            }
            // Or the booleans are left out, where they may be.
            std::vector<PatternPtr> others;
            for (const PatternPtr& part : pattern.parts)
                others.push_back(!has_boolean(*part)  ? part
                                 : is_nullable(*part) ? make_empty()
                                                      : make_nothing());
            parts.push_back(
                paths_of(*make_sequence(std::move(others)), alphabet, invisible, limits));
            return combine(parts, alphabet, limits, any);
        }
        default: break;
    }
    return paths_of(*make_nothing(), alphabet, invisible, limits);
}

}  // namespace

Automaton paths_of(const Pattern& pattern, const CommonAlphabet& alphabet,
                   const SymbolSet& invisible, const Limits& limits) {
    if (is_boolean(pattern.form)) return boolean_paths(pattern, alphabet, invisible, limits);
    if (has_boolean(pattern)) return mixed_paths(pattern, alphabet, invisible, limits);
    return subsets(pattern, alphabet, invisible, limits);
}

Automaton minimise(const Automaton& automaton, const Limits& limits) {
    // Moore's refinement: states are alike as long as no path of the length looked at tells them
    // apart.
    Steps steps(limits);
    const std::size_t n = automaton.n_states(), k = automaton.n_classes;
    std::vector<std::uint32_t> block(n);
    for (std::size_t i = 0; i < n; ++i)
        block[i] = automaton.accepts[i] ? 1 : 0;
    std::size_t n_blocks = 0;
    while (true) {
        Interner signatures;
        std::vector<std::uint32_t> refined(n), words(k + 1);
        steps.count(n * k);
        for (std::size_t i = 0; i < n; ++i) {
            words[0] = block[i];
            for (std::size_t c = 0; c < k; ++c)
                words[c + 1] = block[automaton.next[i * k + c]];
            refined[i] = signatures.intern(words);
        }
        block = std::move(refined);
        if (signatures.size() == n_blocks) break;
        n_blocks = signatures.size();
    }
    Automaton out{automaton.class_of, automaton.n_classes,
                  std::vector<std::uint32_t>(n_blocks * k), std::vector<bool>(n_blocks),
                  block[automaton.start]};
    for (std::size_t i = 0; i < n; ++i) {
        out.accepts[block[i]] = automaton.accepts[i];
        for (std::size_t c = 0; c < k; ++c)
            out.next[block[i] * k + c] = block[automaton.next[i * k + c]];
    }
    return out;
}

std::optional<CommonPath> path_outside(const Automaton& a, const Automaton& b,
                                       const CommonAlphabet& alphabet, const SymbolSet& events,
                                       const Limits& limits) {
    // Symbols that both automata treat alike need one representative, the plainest.
    std::map<std::pair<std::uint32_t, std::uint32_t>, Symbol> joint;
    for (Symbol s = static_cast<Symbol>(alphabet.size()); s-- > 0;)
        if (events.has(s)) joint[{a.class_of[s], b.class_of[s]}] = s;
    std::vector<Symbol> symbols;
    for (const auto& [classes, s] : joint)
        symbols.push_back(s);
    std::ranges::sort(symbols);

    struct Arrival {
        std::uint32_t in_a, in_b, from;
        Symbol by;
    };
    std::vector<Arrival> queue{{a.start, b.start, 0, 0}};
    std::set<std::pair<std::uint32_t, std::uint32_t>> met{{a.start, b.start}};
    for (std::uint32_t i = 0; i < queue.size(); ++i) {
        if (queue.size() > limits.max_states) too_many_states(limits);
        if (a.accepts[queue[i].in_a] && !b.accepts[queue[i].in_b]) {
            CommonPath path;
            for (std::uint32_t at = i; at != 0; at = queue[at].from)
                path.push_back(alphabet.event(queue[at].by));
            std::ranges::reverse(path);
            return path;
        }
        for (const Symbol s : symbols) {
            const std::uint32_t in_a = a.step(queue[i].in_a, s), in_b = b.step(queue[i].in_b, s);
            if (met.emplace(in_a, in_b).second) queue.push_back({in_a, in_b, i, s});
        }
    }
    return std::nullopt;
}

std::optional<CommonPath> shortest_path(const Automaton& automaton, const CommonAlphabet& alphabet,
                                        const Limits& limits) {
    Automaton nothing = automaton;
    nothing.accepts.assign(automaton.n_states(), false);
    return path_outside(automaton, nothing, alphabet, alphabet.all(), limits);
}

bool same_paths(const Automaton& a, const Automaton& b, const CommonAlphabet& alphabet,
                const Limits& limits) {
    const SymbolSet all = alphabet.all();
    return !path_outside(a, b, alphabet, all, limits) &&
           !path_outside(b, a, alphabet, all, limits);
}

}  // namespace lightsieve::lpe::dialects
