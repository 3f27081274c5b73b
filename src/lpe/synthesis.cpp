#include "lpe/synthesis.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lpe/alphabet.h"
#include "lpe/determinise.h"
#include "lpe/event_cover.h"
#include "lpe/minimise.h"
#include "lpe/print.h"

namespace lightsieve::lpe {
namespace {

/// States of automata that are written down; text for more would help nobody.
constexpr std::size_t kMaxStates = 48;
/// States before minimisation: more rarely become few.
constexpr std::size_t kMaxUnminimised = 2000;

using State = std::uint32_t;
using Events = EventCover::Set;

Expr make(auto form) { return std::make_shared<const Node>(Node{std::move(form), {}}); }

/// a then b; null is the path of no events.
Expr sequence(const Expr& a, const Expr& b) {
    if (!a) return b;
    if (!b) return a;
    Sequence both;
    for (const Expr& part : {a, b}) {
        const auto* inner = std::get_if<Sequence>(&part->form);
        if (inner == nullptr)
            both.parts.push_back(part);
        else
            both.parts.insert(both.parts.end(), inner->parts.begin(), inner->parts.end());
    }
    return make(std::move(both));
}

Expr alternation(std::vector<Expr> parts) {
    return parts.size() == 1 ? parts[0] : make(Alternation{std::move(parts)});
}

Expr star(Expr body) { return make(Repeat{std::move(body), 0, Repeat::kUnbounded}); }

/// Does it take the path of no events? Only for what is made here: tests, sequences, alternatives
/// and stars.
bool may_be_empty(const Expr& expr) {
    if (!expr || std::holds_alternative<Repeat>(expr->form)) return true;
    if (is_event_test(*expr)) return false;
    const std::span<const Expr> parts = children(*expr);
    return std::holds_alternative<Alternation>(expr->form)
               ? std::ranges::any_of(parts, may_be_empty)
               : std::ranges::all_of(parts, may_be_empty);
}

bool is_any(const Expr& test) { return std::holds_alternative<Dot>(test->form); }

std::size_t length(const Expr& expr) { return expr ? print(expr).size() : 0; }

/// Too long: caught where the writing started.
struct TooLong {};

class Writer {
  public:
    Writer(const Expr& set, std::span<const Event> events, const LabelClasses& labels,
           std::size_t max_length, const Limits& limits)
        : events_(events),
          alphabet_({&set, 1}, events),
          made_(determinise({&set, 1}, alphabet_, limits)),
          dfa_(minimise(made_.dfa)),
          cover_(events, labels),
          max_length_(max_length) {
        for (std::size_t e = 0; e < events.size(); ++e)
            terminals_[e] = is_terminal(events[e].kind);
    }

    Expr write() {
        if (dfa_.n_states() > kMaxStates) return nullptr;
        find_ends();
        if (is_dead(dfa_.start)) return nullptr;
        find_inclusions();
        find_circles();
        written_.resize(dfa_.n_states());
        try {
            return limited(sequence(make(Letter{'C'}), after(dfa_.start)));
        } catch (const TooLong&) {
            return nullptr;
        }
    }

  private:
    /// Events with one continuation.
    struct Branch {
        Events events;
        Expr then;  ///< null: the path has ended
        State to;
    };

    [[nodiscard]] bool is_dead(State state) const {
        return state == 0;  // minimal: nothing else is dead
    }
    [[nodiscard]] State step(State state, std::size_t event) const {
        return dfa_.step(state, alphabet_.class_of(event));
    }
    [[nodiscard]] const Expr& limited(const Expr& expr) const {
        if (length(expr) > max_length_) throw TooLong{};
        return expr;
    }

    /// The terminals that may end a path, for each state.
    void find_ends() {
        ends_.resize(dfa_.n_states());
        for (State s = 0; s < dfa_.n_states(); ++s)
            for (std::size_t e = 0; e < events_.size(); ++e) {
                if (!terminals_[e]) continue;
                const std::size_t column = alphabet_.class_of(e) - alphabet_.first_terminal();
                ends_[s][e] = !made_.sets[made_.outputs[dfa_.output[s]][column]].empty();
            }
    }

    /// Which states allow all that another one allows: assumed, then refuted where a step shows it.
    void find_inclusions() {
        const std::size_t n = dfa_.n_states();
        allows_.assign(n * n, true);
        for (State a = 0; a < n; ++a)
            for (State b = 0; b < n; ++b)
                if ((ends_[b] & ~ends_[a]).any()) allows_[a * n + b] = false;
        for (bool changed = true; changed;) {
            changed = false;
            for (State a = 0; a < n; ++a)
                for (State b = 0; b < n; ++b)
                    for (std::size_t c = 0; allows_[a * n + b] && c < dfa_.n_classes; ++c)
                        if (!allows(dfa_.next[a * dfa_.n_classes + c],
                                    dfa_.next[b * dfa_.n_classes + c])) {
                            allows_[a * n + b] = false;
                            changed = true;
                        }
        }
    }
    /// Does a allow everything that b allows?
    [[nodiscard]] bool allows(State a, State b) const { return allows_[a * dfa_.n_states() + b]; }

    /// States that reach one another have one number.
    void find_circles() {
        const std::size_t n = dfa_.n_states();
        std::vector<bool> reaches(n * n, false);
        for (State a = 0; a < n; ++a)
            for (std::size_t c = 0; c < dfa_.n_classes; ++c)
                reaches[a * n + dfa_.next[a * dfa_.n_classes + c]] = true;
        for (State via = 0; via < n; ++via)
            for (State a = 0; a < n; ++a)
                for (State b = 0; reaches[a * n + via] && b < n; ++b)
                    if (reaches[via * n + b]) reaches[a * n + b] = true;
        circle_.resize(n);
        for (State a = 0; a < n; ++a) {
            circle_[a] = a;
            for (State b = 0; b < a && circle_[a] == a; ++b)
                if (reaches[a * n + b] && reaches[b * n + a]) circle_[a] = b;
        }
    }

    /// Events that lead from `from` to a state that allows all that `to` allows.
    [[nodiscard]] Events leading(State from, State to) const {
        Events out;
        for (std::size_t e = 0; e < events_.size(); ++e)
            out[e] = !terminals_[e] && allows(step(from, e), to);
        return out;
    }

    /// Terminals that do no harm before `then`: if that cannot be empty, no path goes on there.
    [[nodiscard]] Events harmless(State from, const Expr& then) const {
        return may_be_empty(then) ? ends_[from] : terminals_;
    }

    /// What may follow once a path has led to the state.
    Expr after(State state) {
        if (written_[state]) return written_[state];
        const bool in_circle = std::ranges::count(circle_, circle_[state]) > 1;
        Expr out = in_circle ? eliminate(state) : after_loop(state);
        return written_[state] = limited(out);
    }

    /// The events of a state that leave its circle, by where they lead.
    std::vector<Branch> branches(State state) {
        std::map<State, Events> by_target;
        std::vector<State> order;
        for (std::size_t e = 0; e < events_.size(); ++e) {
            if (terminals_[e]) continue;
            const State to = step(state, e);
            if (is_dead(to) || circle_[to] == circle_[state]) continue;
            const auto [entry, is_new] = by_target.emplace(to, Events{});
            if (is_new) order.push_back(to);
            entry->second[e] = true;
        }
        std::vector<Branch> out;
        for (const State to : order)
            out.push_back({by_target[to], after(to), to});
        return out;
    }

    Expr write_branch(State from, const Branch& branch, const Events& also) const {
        const Events optional = leading(from, branch.to) | harmless(from, branch.then);
        const Events required = branch.events | also;
        return sequence(cover_.test_for(required, optional & ~required), branch.then);
    }

    /// The last event: no path ends with one that scatters, so the test may take those.
    [[nodiscard]] Expr end_test(const Events& ends) const {
        return cover_.test_for(ends, ~terminals_);
    }

    /// One of the branches, or an end. Ends may join a branch whose continuation may be empty.
    Expr choice(State state, const std::vector<Branch>& branches, const Events& ends) const {
        if (branches.empty()) return end_test(ends);
        Expr best;
        // joined == branches.size(): the ends stand alone.
        for (std::size_t joined = 0; joined <= branches.size(); ++joined) {
            const bool alone = joined == branches.size();
            if (alone && ends.none() && best) break;
            if (!alone && ends.any() && !may_be_empty(branches[joined].then)) continue;
            std::vector<Expr> parts;
            for (std::size_t i = 0; i < branches.size(); ++i)
                parts.push_back(write_branch(state, branches[i], i == joined ? ends : Events{}));
            if (alone && ends.any()) parts.push_back(end_test(ends));
            Expr written = alternation(std::move(parts));
            if (!best || length(written) < length(best)) best = std::move(written);
        }
        return best;
    }

    /// A state that no other leads back to: maybe a loop, then a choice.
    Expr after_loop(State state) {
        Events loop;
        for (std::size_t e = 0; e < events_.size(); ++e)
            loop[e] = !terminals_[e] && step(state, e) == state;
        const std::vector<Branch> out = branches(state);
        if (loop.none()) return choice(state, out, ends_[state]);
        const Events again = leading(state, state);
        if (out.empty()) {
            // The end is one more round.
            const Events required = loop | ends_[state];
            const Expr one = cover_.test_for(required, again & ~required);
            const Expr any = cover_.test_for(loop, (again | terminals_) & ~loop);
            // `.*[OB]` is easier to read than `[^L]*`.
            if (is_any(any) && !is_any(one)) return sequence(star(any), end_test(ends_[state]));
            return star(one);
        }
        const auto looped = [&](const Expr& then, const Events& required) {
            const Events optional = again | harmless(state, then);
            return sequence(star(cover_.test_for(required, optional & ~required)), then);
        };
        Expr best = looped(choice(state, out, ends_[state]), loop);
        // Or the ends are one more round, and what comes then may be left out.
        if (ends_[state].any()) {
            const Expr then = choice(state, out, {});
            const Expr maybe = may_be_empty(then) ? then : make(Repeat{then, 0, 1});
            const Expr other = looped(maybe, loop | ends_[state]);
            if (length(other) < length(best)) best = other;
        }
        return best;
    }

    /// The textbook's way, for the states of one circle: each but `state` is taken out, the ways
    /// through it are written beside those that there are.
    Expr eliminate(State state) {
        std::vector<State> states{state};
        for (State s = 0; s < dfa_.n_states(); ++s)
            if (s != state && circle_[s] == circle_[state]) states.push_back(s);
        const std::size_t n = states.size();
        std::vector<Expr> way(n * n), leave(n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                way[i * n + j] = test_between(states[i], states[j]);
            const std::vector<Branch> out = branches(states[i]);
            if (!out.empty() || ends_[states[i]].any())
                leave[i] = choice(states[i], out, ends_[states[i]]);
        }
        const auto either = [&](const Expr& a, const Expr& b) {
            return a ? limited(alternation({a, b})) : limited(b);
        };
        std::vector<bool> gone(n, false);
        for (std::size_t left = n; left > 1; --left) {
            const std::size_t k = least_connected(way, gone);
            gone[k] = true;
            const Expr round = way[k * n + k] ? star(way[k * n + k]) : nullptr;
            for (std::size_t i = 0; i < n; ++i) {
                if (gone[i] || !way[i * n + k]) continue;
                const Expr to = sequence(way[i * n + k], round);
                for (std::size_t j = 0; j < n; ++j)
                    if (!gone[j] && way[k * n + j])
                        way[i * n + j] = either(way[i * n + j], sequence(to, way[k * n + j]));
                if (leave[k]) leave[i] = either(leave[i], sequence(to, leave[k]));
            }
        }
        return way[0] ? sequence(star(way[0]), leave[0]) : leave[0];
    }

    [[nodiscard]] Expr test_between(State from, State to) const {
        Events required;
        for (std::size_t e = 0; e < events_.size(); ++e)
            required[e] = !terminals_[e] && step(from, e) == to;
        if (required.none()) return nullptr;
        return cover_.test_for(required, leading(from, to) & ~required);
    }

    /// The state, but the first, through which the fewest ways go.
    static std::size_t least_connected(const std::vector<Expr>& way,
                                       const std::vector<bool>& gone) {
        const std::size_t n = gone.size();
        std::size_t best = 0, fewest = SIZE_MAX;
        for (std::size_t k = 1; k < n; ++k) {
            if (gone[k]) continue;
            std::size_t in = 0, out = 0;
            for (std::size_t i = 0; i < n; ++i) {
                in += i != k && !gone[i] && way[i * n + k] ? 1 : 0;
                out += i != k && !gone[i] && way[k * n + i] ? 1 : 0;
            }
            if (in * out < fewest) best = k, fewest = in * out;
        }
        return best;
    }

    std::span<const Event> events_;
    Alphabet alphabet_;
    Determinised made_;
    Dfa dfa_;
    EventCover cover_;
    std::size_t max_length_;
    Events terminals_;
    std::vector<Events> ends_;   ///< per state: the terminals that may follow
    std::vector<bool> allows_;   ///< per pair of states, see `allows`
    std::vector<State> circle_;  ///< per state: the first state of its circle
    std::vector<Expr> written_;  ///< per state: what `after` gave
};

}  // namespace

Expr synthesise(const Expr& set, std::span<const Event> events, const LabelClasses& labels,
                std::size_t max_length, const Limits& limits) {
    std::vector<Event> distinct;
    std::set<Event> seen;
    for (const Event& event : events)
        if (event.kind != EventKind::Camera && seen.insert(event).second)
            distinct.push_back(event);
    if (distinct.size() > EventCover::kMaxEvents) return nullptr;
    Limits narrow = limits;
    narrow.max_states = std::min(limits.max_states, kMaxUnminimised);
    return Writer(set, distinct, labels, max_length, narrow).write();
}

}  // namespace lightsieve::lpe
