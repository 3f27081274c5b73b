// What a renderer runs: every AOV of a render compiled, once, to one automaton (rarely to
// several).
//
// A path carries a State. It starts after the camera event; each scattering event moves it with
// one table load; each terminal event (light, emission, background, a probe) looks up an Atom with
// one more. Two paths have the same atom exactly when the same AOVs take them, so light is added
// to one number whatever the number of AOVs, and an AOV is the sum of its atoms. States from which
// nothing can be reached any more say so, so that work can be left undone.
//
//     Diagnostics diagnostics;
//     const Program program = Program::compile(aovs, events, {}, diagnostics);
//     const Automaton& a = program.automaton(0);
//     // At scene build:
//     const ClassId diffuse = program.scatter_class({EventKind::Reflection, EventLobe::Diffuse, {}});
//     const TerminalId key = program.terminal({EventKind::Light, EventLobe::None, {"key"}});
//     // In the hot path:
//     const AtomId atom = a.atom(a.step(a.start(), diffuse), key);
//     if (atom != kNoAtom) film.add(atom, radiance);
//
// Light groups never enter the automaton's states: a request's group is decided by the terminal
// alone. The stages behind `compile`: alphabet.h, term.h, determinise.h, minimise.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/limits.h"

namespace lightsieve::lpe {

/// A state: an offset into the automaton's table, opaque to callers.
using State = std::uint32_t;
/// A class of scattering events that no expression of the program tells apart.
using ClassId = std::uint32_t;
/// A class of terminal events that no request of the program (expression or group) tells apart.
using TerminalId = std::uint32_t;
/// Index of an atom, dense from 0 over all automata of a program.
using AtomId = std::uint32_t;

/// The state from which no AOV is ever reached.
inline constexpr State kDead = 0;
/// The path ends in no AOV.
inline constexpr AtomId kNoAtom = UINT32_MAX;

/// Which of an expression's paths an AOV takes.
enum class GroupSelect : std::uint8_t {
    All,      ///< every one
    Named,    ///< those whose terminal (L, or a skydome's B) carries `group`
    Default,  ///< the other light paths: O, B of no skydome, group `default`; no probe
};

/// One AOV that a renderer wants.
struct AovRequest {
    std::string name;  ///< for messages
    Expr expr;         ///< null: takes nothing, the AOV is black
    GroupSelect select = GroupSelect::All;
    std::string group{};  ///< for GroupSelect::Named; `default` means GroupSelect::Default
};

/// One automaton over the program's common alphabet. Immutable; safe to share between threads.
class Automaton {
  public:
    /// The state after the camera event.
    [[nodiscard]] State start() const noexcept { return start_; }
    /// The state after one more scattering event. Cost: one load. kDead stays kDead.
    [[nodiscard]] State step(State state, ClassId scatter) const noexcept {
        return table_[state + scatter];
    }
    /// The atom of the path that ends now with this terminal event, or kNoAtom. Cost: one load.
    /// A probe needs a vertex: never ask the start state for one.
    [[nodiscard]] AtomId atom(State state, TerminalId terminal) const noexcept {
        return table_[state + terminal];
    }
    /// Can light (L, O, B) that arrives now or after more scattering still reach an AOV?
    [[nodiscard]] bool live_light(State state) const noexcept {
        return (table_[state] & kLiveLight) != 0;
    }
    /// Can a probe (A) now or after more scattering still reach an AOV?
    [[nodiscard]] bool live_probe(State state) const noexcept {
        return (table_[state] & kLiveProbe) != 0;
    }
    /// Can this AOV (index of the request) still be reached, by light or by a probe?
    [[nodiscard]] bool live_aov(State state, std::size_t aov) const noexcept;

    /// States, kDead included.
    [[nodiscard]] std::size_t n_states() const noexcept { return table_.size() / stride_; }
    /// States but kDead: what a path can be in while an AOV can still be reached.
    [[nodiscard]] std::size_t n_inner_states() const noexcept { return n_states() - 1; }
    /// Bytes that `step`, `atom` and `live_*` read.
    [[nodiscard]] std::size_t table_bytes() const noexcept {
        return table_.size() * sizeof(std::uint32_t);
    }
    /// Position of a state in 0..n_states()-1, for dumps and per-state arrays; kDead is 0.
    [[nodiscard]] std::size_t index(State state) const noexcept { return state / stride_; }
    /// Inverse of `index`.
    [[nodiscard]] State state(std::size_t state_index) const noexcept {
        return static_cast<State>(state_index * stride_);
    }

  private:
    friend class ProgramBuilder;
    static constexpr std::uint32_t kLiveLight = 1, kLiveProbe = 2;

    /// One row per state: flags, the next state for each scatter class, the atom for each
    /// terminal. A State is its row's offset, so that a step needs no multiplication.
    std::vector<std::uint32_t> table_;
    std::size_t stride_ = 1;
    State start_ = kDead;
    std::vector<std::uint64_t> live_sets_;  ///< per state: a bit set of AOVs, live_words_ words
    std::size_t live_words_ = 0;
};

/// All AOVs of a render. Immutable after `compile`; safe to share between threads.
class Program {
  public:
    /// Compiles the AOVs to automata.
    ///
    /// aovs         what is wanted; equal expressions are compiled once, so give each (expression,
    ///              group) its own request
    /// events       every scattering and terminal event that the scene can produce, duplicates
    ///              allowed (camera events are ignored); events outside this list have no class
    /// diagnostics  gets a limit error for each AOV whose expression alone exceeds a budget
    /// returns      always a usable program; AOVs with an error (or a null expression) are in no
    ///              atom: black
    [[nodiscard]] static Program compile(std::span<const AovRequest> aovs,
                                         std::span<const Event> events, const Limits& limits,
                                         Diagnostics& diagnostics);

    /// Automata that a path steps together: 1, unless the set exceeded a budget; 0 without AOVs.
    [[nodiscard]] std::size_t n_automata() const noexcept { return automata_.size(); }
    [[nodiscard]] const Automaton& automaton(std::size_t i) const noexcept { return automata_[i]; }

    /// Class of a scattering event, the same for all automata. Call at scene build: a look-up by
    /// value. An event that was not given to `compile` is a bug of the caller (assertion).
    [[nodiscard]] ClassId scatter_class(const Event& event) const;
    /// Class of a terminal event, the same for all automata. Call at scene build, as
    /// `scatter_class`.
    [[nodiscard]] TerminalId terminal(const Event& event) const;

    [[nodiscard]] std::size_t n_aovs() const noexcept { return n_aovs_; }
    /// Atoms of all automata; AtomId runs from 0 to n_atoms() - 1.
    [[nodiscard]] std::size_t n_atoms() const noexcept { return atom_begin_.size() - 1; }
    /// The AOVs (indices of the requests, ascending) that take the atom; never empty.
    [[nodiscard]] std::span<const std::uint32_t> aovs_of(AtomId atom) const noexcept {
        return std::span(atom_aovs_)
            .subspan(atom_begin_[atom], atom_begin_[atom + 1] - atom_begin_[atom]);
    }
    /// Where atoms outnumber the AOVs, a film does better to store the AOVs themselves: false
    /// then, and a contribution to an atom is added to each AOV of `aovs_of`.
    [[nodiscard]] bool film_stores_atoms() const noexcept { return n_atoms() <= n_aovs_; }

    /// Classes of scattering events.
    [[nodiscard]] std::size_t n_classes() const noexcept { return n_classes_; }
    /// Classes of terminal events.
    [[nodiscard]] std::size_t n_terminals() const noexcept { return n_terminals_; }
    /// ClassIds run from kFirstClass to kFirstClass + n_classes() - 1.
    static constexpr ClassId kFirstClass = 1;
    /// TerminalIds run from first_terminal() to first_terminal() + n_terminals() - 1.
    [[nodiscard]] TerminalId first_terminal() const noexcept {
        return kFirstClass + static_cast<ClassId>(n_classes_);
    }
    /// An event of the class (the first one of the list given to `compile`), for dumps.
    [[nodiscard]] const Event& example(ClassId scatter_or_terminal) const {
        return examples_[scatter_or_terminal - kFirstClass];
    }
    /// Sum of all automata's tables [bytes].
    [[nodiscard]] std::size_t table_bytes() const noexcept;

  private:
    friend class ProgramBuilder;
    Program() = default;

    std::vector<Automaton> automata_;
    std::size_t n_aovs_ = 0, n_classes_ = 0, n_terminals_ = 0;
    std::map<Event, std::uint32_t> columns_;  ///< every given event: its ClassId or TerminalId
    std::vector<Event> examples_;             ///< one event per class, then one per terminal
    std::vector<std::uint32_t> atom_begin_{0};
    std::vector<std::uint32_t> atom_aovs_;
};

}  // namespace lightsieve::lpe
