#include "lpe/enumerate.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "lpe/algebra.h"
#include "lpe/alphabet.h"
#include "lpe/determinise.h"

namespace lightsieve::lpe {
namespace {

std::uint64_t add(std::uint64_t a, std::uint64_t b) {
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}
std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
    return a != 0 && b > UINT64_MAX / a ? UINT64_MAX : a * b;
}

/// The different events that paths are made of, in order, without the camera.
std::vector<Event> distinct(std::span<const Event> events) {
    std::vector<Event> out;
    std::set<Event> seen;
    for (const Event& event : events)
        if (event.kind != EventKind::Camera && seen.insert(event).second) out.push_back(event);
    return out;
}

/// One expression's automaton over given events.
struct Machine {
    std::vector<Event> events;
    Alphabet alphabet;
    Determinised made;

    Machine(const Expr& expr, std::span<const Event> given, const Limits& limits)
        : events(distinct(given)),
          alphabet({&expr, 1}, events),
          made(determinise({&expr, 1}, alphabet, limits)) {}

    [[nodiscard]] bool accepts(std::uint32_t state, EventClass terminal) const {
        return made.accepts(alphabet, state, terminal, 0);
    }
    [[nodiscard]] std::size_t n_states() const { return made.dfa.n_states(); }
};

template <class Result>
auto within_budget(const Expr& expr, const Result& result) {
    try {
        return result();
    } catch (const OverBudget& over) {
        throw InputError(over.error("the proof", expr->where));
    }
}

/// Finds paths by what happens on them: a "shape" is a kind and a lobe; the events of one shape
/// differ in labels only.
class Finder {
  public:
    Finder(const Machine& machine, const Limits& limits) : m_(machine), limits_(limits) {
        std::map<std::pair<EventKind, EventLobe>, std::size_t> number;
        for (std::size_t i = 0; i < m_.events.size(); ++i) {
            const Event& event = m_.events[i];
            const auto [entry, is_new] =
                number.emplace(std::pair{event.kind, event.lobe}, shapes_.size());
            if (is_new) shapes_.emplace_back();
            shapes_[entry->second].push_back(i);
        }
    }

    std::vector<Path> run(std::size_t n) {
        wanted_ = n;
        std::vector<bool> now = ends();
        // If there are infinitely many paths, no two lengths in a row are further apart than the
        // number of states.
        std::size_t last_length = 2;
        for (std::size_t length = 2; found_.size() < n; ++length) {
            if (length > last_length + m_.n_states()) break;
            reach_.push_back(now);
            const std::size_t n_before = found_.size();
            if (now[m_.made.dfa.start]) extend({{m_.made.dfa.start, {}}}, length - 2);
            if (found_.size() > n_before) last_length = length;
            now = before(now);
        }
        return std::move(found_);
    }

  private:
    /// A state that a shape's events can lead to, and the first events that do.
    struct Place {
        std::uint32_t state;
        Path events;
    };

    void count(std::size_t n) {
        n_steps_ += n;
        if (n_steps_ > limits_.max_steps)
            throw OverBudget{
                Code::LimitLpeSteps,
                "needs more than " + std::to_string(limits_.max_steps) + " derivative steps",
                "max_steps"};
    }

    /// The states in which a path can end with the next event.
    [[nodiscard]] std::vector<bool> ends() const {
        std::vector<bool> out(m_.n_states(), false);
        for (std::uint32_t s = 0; s < m_.n_states(); ++s)
            for (EventClass c = m_.alphabet.first_terminal(); c < m_.alphabet.n_classes(); ++c)
                if (m_.accepts(s, c)) out[s] = true;
        return out;
    }
    /// The states from which one scattering event leads to one of these.
    std::vector<bool> before(const std::vector<bool>& set) {
        count(m_.n_states());
        std::vector<bool> out(m_.n_states(), false);
        for (std::uint32_t s = 0; s < m_.n_states(); ++s)
            for (EventClass c = Alphabet::kFirstScatter; c < m_.alphabet.first_terminal(); ++c)
                if (set[m_.made.dfa.step(s, c)]) out[s] = true;
        return out;
    }

    /// Every list of `n_left` scattering shapes and a terminal, in order.
    void extend(const std::vector<Place>& places, std::size_t n_left) {
        for (const std::vector<std::size_t>& shape : shapes_) {
            if (found_.size() >= wanted_) return;
            const bool terminal = is_terminal(m_.events[shape[0]].kind);
            if (n_left == 0 && terminal) finish(places, shape);
            if (n_left > 0 && !terminal) {
                const std::vector<Place> next = step(places, shape, n_left - 1);
                if (!next.empty()) extend(next, n_left - 1);
            }
        }
    }

    std::vector<Place> step(const std::vector<Place>& places,
                            const std::vector<std::size_t>& shape, std::size_t n_left) {
        std::vector<Place> out;
        std::set<std::uint32_t> seen;
        for (const Place& place : places)
            for (const std::size_t e : shape) {
                count(1);
                const std::uint32_t next = m_.made.dfa.step(place.state, m_.alphabet.class_of(e));
                if (!reach_[n_left][next] || !seen.insert(next).second) continue;
                out.push_back({next, place.events});
                out.back().events.push_back(m_.events[e]);
            }
        return out;
    }

    void finish(const std::vector<Place>& places, const std::vector<std::size_t>& shape) {
        for (const Place& place : places)
            for (const std::size_t e : shape) {
                count(1);
                const bool probe = m_.events[e].kind == EventKind::Albedo;
                // A probe needs a vertex: C A is no path.
                if ((probe && place.events.empty()) ||
                    !m_.accepts(place.state, m_.alphabet.class_of(e)))
                    continue;
                Path path{Event{}};
                path.insert(path.end(), place.events.begin(), place.events.end());
                path.push_back(m_.events[e]);
                found_.push_back(std::move(path));
                return;
            }
    }

    const Machine& m_;
    const Limits& limits_;
    std::vector<std::vector<std::size_t>> shapes_;  ///< events, by kind and lobe
    std::vector<std::vector<bool>>
        reach_;  ///< [n]: states from which n events and an end are left
    std::size_t wanted_ = 0, n_steps_ = 0;
    std::vector<Path> found_;
};

}  // namespace

std::uint64_t count_paths(const Expr& expr, std::span<const Event> events, std::size_t length,
                          const Limits& limits) {
    if (!expr || length < 2) return 0;
    return within_budget(expr, [&] {
        const Machine m(expr, events, limits);
        std::vector<std::uint64_t> n_events(m.alphabet.n_classes(), 0);
        for (std::size_t i = 0; i < m.events.size(); ++i)
            ++n_events[m.alphabet.class_of(i)];
        // In how many ways each state is reached by so many events.
        std::vector<std::uint64_t> ways(m.n_states(), 0);
        ways[m.made.dfa.start] = 1;
        for (std::size_t i = 2; i < length; ++i) {
            if (i * m.n_states() > limits.max_steps)
                throw OverBudget{Code::LimitLpeSteps,
                                 "needs more than " + std::to_string(limits.max_steps) + " steps",
                                 "max_steps"};
            std::vector<std::uint64_t> next(m.n_states(), 0);
            for (std::uint32_t s = 0; s < m.n_states(); ++s)
                for (EventClass c = Alphabet::kFirstScatter; c < m.alphabet.first_terminal();
                     ++c) {
                    std::uint64_t& to = next[m.made.dfa.step(s, c)];
                    to = add(to, multiply(ways[s], n_events[c]));
                }
            ways = std::move(next);
        }
        std::uint64_t n = 0;
        for (std::uint32_t s = 0; s < m.n_states(); ++s)
            for (EventClass c = m.alphabet.first_terminal(); c < m.alphabet.n_classes(); ++c) {
                // A probe needs a vertex: C A is no path.
                if (length == 2 && m.alphabet.is_probe(c)) continue;
                if (m.accepts(s, c)) n = add(n, multiply(ways[s], n_events[c]));
            }
        return n;
    });
}

std::vector<Path> shortest_paths(const Expr& expr, std::span<const Event> events, std::size_t n,
                                 const Limits& limits) {
    if (!expr) return {};
    return within_budget(expr, [&] {
        const Machine machine(expr, events, limits);
        return Finder(machine, limits).run(n);
    });
}

std::vector<Path> shortest_paths(const Expr& expr, std::size_t n, const Limits& limits) {
    return shortest_paths(expr, abstract_events({&expr, 1}, limits), n, limits);
}

}  // namespace lightsieve::lpe
