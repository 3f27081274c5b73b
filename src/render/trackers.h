// Who follows the terms of a path: the AOVs' automata, or a log of whole histories.
//
// The integrator is the same for both; a tracker is told of every vertex and of all light that arrives. A tracker's
// values come as functions of (group) or (group, channel), because multipliers and limits go by groups.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/film.h"
#include "render/path_terms.h"
#include "render/scene.h"

namespace lightsieve {

/// The end of a path: the engine's terminal, and the event for logs.
struct Terminal {
    lpe::TerminalId id = 0;
    std::uint32_t event = 0;
};

/// Steps one automaton of the program.
struct AutomatonMachine {
    using State = lpe::State;
    static constexpr std::size_t kMaxTerms = 24;
    const lpe::Automaton* automaton = nullptr;
    [[nodiscard]] State start() const { return automaton->start(); }
    [[nodiscard]] State step(State state, const LobeRecord& record) const {
        return record.makes_no_event ? state : automaton->step(state, record.event_class);
    }
    [[nodiscard]] bool live(State state) const {
        return automaton->live_light(state) || automaton->live_probe(state);
    }
};

/// Adds light to atoms. One set of terms for each automaton.
class AovTracker {
  public:
    explicit AovTracker(const Scene& scene) : probe_event_(scene.probe_event) {
        for (std::size_t i = 0; i < scene.plan.program->n_automata(); ++i)
            sets_.push_back({{&scene.plan.program->automaton(i)}, {}});
    }

    /// No AOV gets anything any more.
    void follow_nothing() { sets_.clear(); }

    /// The terms of one path, put aside.
    using Saved = std::vector<PathTerms<AutomatonMachine>>;

    void start(Color throughput, SampleBuffer& out) {
        out_ = &out;
        for (Set& set : sets_)
            set.terms.start(set.machine, throughput);
    }
    void save(Saved& to) const {
        to.resize(sets_.size());
        for (std::size_t i = 0; i < sets_.size(); ++i)
            to[i].copy_from(sets_[i].terms);
    }
    void restore(const Saved& from) {
        for (std::size_t i = 0; i < sets_.size(); ++i)
            sets_[i].terms.copy_from(from[i]);
    }
    void scale(Color factor) {
        for (Set& set : sets_)
            set.terms.scale(factor);
    }
    void keep_only(std::size_t group, float factor) {
        for (Set& set : sets_)
            set.terms.keep_only(group, factor);
    }
    template <class Random>
    void scatter(std::span<const Channel> channels, std::span<const Color> factors,
                 const PathGroups::Step& step, const Random& random) {
        for (Set& set : sets_)
            set.terms.scatter(set.machine, channels, factors, step, random);
    }
    /// Whether any AOV can still receive something from this path.
    [[nodiscard]] bool live() const {
        for (const Set& set : sets_)
            if (!set.terms.empty()) return true;
        return false;
    }
    /// Whether any AOV can still receive an albedo from this path.
    [[nodiscard]] bool live_probe() const {
        for (const Set& set : sets_)
            for (const auto& t : set.terms.all())
                if (set.machine.automaton->live_probe(t.state)) return true;
        return false;
    }

    /// Whether any AOV takes light of a kind that arrives now.
    [[nodiscard]] bool takes(lpe::TerminalId terminal) const {
        for (const Set& set : sets_)
            for (const auto& t : set.terms.all())
                if (set.machine.automaton->atom(t.state, terminal) != lpe::kNoAtom) return true;
        return false;
    }
    /// Whether any AOV takes light of a kind that arrives after scattering by any of the channels.
    [[nodiscard]] bool takes(std::span<const Channel> channels, lpe::TerminalId terminal) const {
        for (const Set& set : sets_)
            for (const auto& t : set.terms.all())
                for (const Channel& channel : channels) {
                    const lpe::State state = set.machine.step(t.state, *channel.record);
                    if (set.machine.automaton->atom(state, terminal) != lpe::kNoAtom) return true;
                }
        return false;
    }
    /// Whether any AOV can still receive something after scattering by the channel.
    [[nodiscard]] bool goes_on(const Channel& channel) const {
        for (const Set& set : sets_)
            for (const auto& t : set.terms.all())
                if (set.machine.live(set.machine.step(t.state, *channel.record))) return true;
        return false;
    }

    /// Light that arrives without another scattering event: value(group).
    template <class Value>
    void add(Terminal terminal, const Value& value, float scale) {
        for (const Set& set : sets_)
            for (const auto& t : set.terms.all()) {
                const lpe::AtomId atom = set.machine.automaton->atom(t.state, terminal.id);
                if (atom != lpe::kNoAtom)
                    store(terminal, atom, t.throughput * value(t.group) * scale);
            }
    }
    /// Light that arrives after scattering by each channel: value(group, channel).
    template <class Value>
    void add_scattered(std::span<const Channel> channels, Terminal terminal, const Value& value,
                       float scale) {
        for (const Set& set : sets_)
            for (const auto& t : set.terms.all())
                for (std::size_t c = 0; c < channels.size(); ++c) {
                    const lpe::State state = set.machine.step(t.state, *channels[c].record);
                    const lpe::AtomId atom = set.machine.automaton->atom(state, terminal.id);
                    if (atom != lpe::kNoAtom)
                        store(terminal, atom, t.throughput * value(t.group, c) * scale);
                }
    }

  private:
    struct Set {
        AutomatonMachine machine;
        PathTerms<AutomatonMachine> terms;
    };
    void store(Terminal terminal, lpe::AtomId atom, Color value) {
        if (!is_black(value))
            (terminal.event == probe_event_ ? out_->probes : out_->contributions)
                .push_back({atom, value, out_->slot});
    }

    std::vector<Set> sets_;
    SampleBuffer* out_ = nullptr;
    std::uint32_t probe_event_;
};

}  // namespace lightsieve
