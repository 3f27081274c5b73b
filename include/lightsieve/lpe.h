// Light path expressions for any renderer: the C++ interface of Lightsieve's engine.
//
//     lightsieve::embed::Compiler compiler;
//     compiler.add_aov("diffuse", "C<RD>.*");
//     const auto diffuse = compiler.add_event({Kind::Reflection, Lobe::Diffuse});
//     const auto lamp = compiler.add_event({Kind::Light, Lobe::None, {"key"}});
//     const lightsieve::embed::Program program = compiler.compile();
//     for (const auto& found : compiler.diagnostics()) std::cerr << found.text;
//     // For each path:
//     State state = program.start();
//     state = program.step(state, program.column(diffuse));
//     if (const Atom atom = program.atom(state, program.column(lamp)); atom != kNoAtom)
//         film.add(atom, radiance);
//
// A wrapper in this header alone around the C interface (lightsieve/lightsieve.h, which describes
// the arrays), so the library fits any C++17 compiler and standard library. Errors are values. The
// only exception that can leave a function here is std::bad_alloc, before rendering; what is
// noexcept neither allocates nor locks. Programs are immutable: any thread may use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "lightsieve/lightsieve.h"

namespace lightsieve::embed {

/// What happens at a vertex of a path, see lightsieve_kind.
enum class Kind : std::uint8_t {
    Reflection = LIGHTSIEVE_REFLECTION,      ///< R, with a lobe
    Transmission = LIGHTSIEVE_TRANSMISSION,  ///< T, with a lobe
    Volume = LIGHTSIEVE_VOLUME,              ///< V
    Light = LIGHTSIEVE_LIGHT,                ///< L, terminal
    Object = LIGHTSIEVE_OBJECT,              ///< O, terminal: emission of an object
    Background = LIGHTSIEVE_BACKGROUND,      ///< B, terminal
    Albedo = LIGHTSIEVE_ALBEDO,              ///< A, terminal: a probe, not light
};

/// How light leaves a surface.
enum class Lobe : std::uint8_t {
    None = LIGHTSIEVE_NO_LOBE,      ///< of every event but reflection and transmission
    Diffuse = LIGHTSIEVE_DIFFUSE,   ///< D
    Specular = LIGHTSIEVE_SPECULAR  ///< S, glossy included
};

/// One event that the scene can make.
struct Event {
    Kind kind;
    Lobe lobe = Lobe::None;
    /// Labels of the lobe and of the object; for a light its light group or nothing.
    std::vector<std::string> labels{};
};

/// How bad a diagnostic is.
enum class Severity : std::uint8_t {
    Lint = LIGHTSIEVE_LINT,        ///< legal, but probably not what was meant
    Warning = LIGHTSIEVE_WARNING,  ///< something was left out
    Error = LIGHTSIEVE_ERROR,      ///< the AOV is black
};

/// What is wrong with an expression.
struct Diagnostic {
    Severity severity;
    std::string code;        ///< "lpe-unclosed"
    std::string message;     ///< what is wrong, one line
    std::string hint;        ///< what to do about it, or empty
    std::string expression;  ///< the text that it is about, or empty
    std::uint32_t column;    ///< in that text, in characters, counted from 1; 0: not known
    std::string text;        ///< all of this as a person should see it, with the place marked
};

/// A path's place in an automaton.
using State = std::uint32_t;
/// A class of events: a column of the table.
using Column = std::uint32_t;
/// A set of AOVs, numbered densely from 0.
using Atom = std::uint32_t;

/// The path ends in no AOV.
inline constexpr Atom kNoAtom = LIGHTSIEVE_NONE;
/// What `Compiler::add_event` returns for an event that cannot be.
inline constexpr std::uint32_t kNoEvent = LIGHTSIEVE_NONE;

/// The AOVs of an atom, for range-based for.
struct AovList {
    const std::uint32_t *first, *last;
    [[nodiscard]] const std::uint32_t* begin() const noexcept { return first; }
    [[nodiscard]] const std::uint32_t* end() const noexcept { return last; }
    [[nodiscard]] std::size_t size() const noexcept {
        return static_cast<std::size_t>(last - first);
    }
};

/// The AOVs of a render, compiled. `Compiler::compile` makes it.
class Program {
  public:
    /// The arrays, for a GPU or a renderer of other habits; they live as long as the program.
    [[nodiscard]] const lightsieve_tables& tables() const noexcept { return tables_; }

    /// The column of an event, by the index that `Compiler::add_event` returned.
    [[nodiscard]] Column column(std::uint32_t event) const noexcept {
        return tables_.event_columns[event];
    }
    /// How many states a path carries: 1 but for expressions that exceed a budget together.
    [[nodiscard]] std::uint32_t n_automata() const noexcept { return tables_.n_automata; }
    /// The state after the camera, in one of the automata. Without any it is the one from which
    /// nothing is reached.
    [[nodiscard]] State start(std::uint32_t automaton = 0) const noexcept {
        return automaton < tables_.n_automata ? tables_.starts[automaton] : 0;
    }
    /// The state after one more scattering event. Cost: one load.
    [[nodiscard]] State step(State state, Column scatter) const noexcept {
        return lightsieve_step(tables_.table, state, scatter);
    }
    /// The atom of the path that ends now with this terminal event, or kNoAtom. Cost: one load.
    /// A probe needs a vertex: never ask a start state for one.
    [[nodiscard]] Atom atom(State state, Column terminal) const noexcept {
        return lightsieve_atom(tables_.table, state, terminal);
    }
    /// Can light that arrives now or after more scattering still reach an AOV?
    [[nodiscard]] bool live_light(State state) const noexcept {
        return (lightsieve_live(tables_.table, state) & LIGHTSIEVE_LIVE_LIGHT) != 0;
    }
    /// Can a probe now or after more scattering still reach an AOV?
    [[nodiscard]] bool live_probe(State state) const noexcept {
        return (lightsieve_live(tables_.table, state) & LIGHTSIEVE_LIVE_PROBE) != 0;
    }

    /// AOVs that were added.
    [[nodiscard]] std::uint32_t n_aovs() const noexcept { return tables_.n_aovs; }
    /// Atoms; a film with a number for each needs no more.
    [[nodiscard]] std::uint32_t n_atoms() const noexcept { return tables_.n_atoms; }
    /// The AOVs (indices, ascending) that take the atom; at least one.
    [[nodiscard]] AovList aovs_of(Atom atom) const noexcept {
        return {tables_.atom_aovs + tables_.atom_begin[atom],
                tables_.atom_aovs + tables_.atom_begin[atom + 1]};
    }

  private:
    friend class Compiler;
    struct Destroy {
        void operator()(lightsieve_program* program) const noexcept {
            lightsieve_program_destroy(program);
        }
    };
    explicit Program(lightsieve_program* program)
        : program_(program, Destroy()), tables_(lightsieve_program_tables(program)) {}

    std::shared_ptr<const lightsieve_program> program_;  ///< copies are cheap and share it
    lightsieve_tables tables_;
};

/// Gathers AOVs and the events of a scene. For one thread at a time.
class Compiler {
  public:
    Compiler() : compiler_(lightsieve_compiler_create()) {
        if (!compiler_) throw std::bad_alloc();
    }

    /// Adds an AOV of every path that the expression takes; see `lightsieve_add_aov`.
    ///
    /// returns  its index, counted from 0
    std::uint32_t add_aov(const std::string& name, const std::string& expression) {
        return lightsieve_add_aov(compiler_.get(), name.c_str(), expression.c_str(), nullptr);
    }
    /// Adds an AOV of the paths whose light is in a group; group "default" is the light paths of
    /// no other.
    ///
    /// returns  its index, counted from 0
    std::uint32_t add_aov(const std::string& name, const std::string& expression,
                          const std::string& group) {
        return lightsieve_add_aov(compiler_.get(), name.c_str(), expression.c_str(),
                                  group.c_str());
    }
    /// Adds an event that the scene can make.
    ///
    /// returns  its index for `Program::column`; kNoEvent for one that cannot be (a lobe where
    ///          none belongs or none where one does, two groups of one light, an empty label)
    std::uint32_t add_event(const Event& event) {
        std::vector<const char*> labels;
        for (const std::string& label : event.labels)
            labels.push_back(label.c_str());
        const lightsieve_event plain{static_cast<lightsieve_kind>(event.kind),
                                     static_cast<lightsieve_lobe>(event.lobe), labels.data(),
                                     labels.size()};
        return lightsieve_add_event(compiler_.get(), &plain);
    }
    /// Refuse what Lightsieve adds to Arnold's language: `&`, `-`, `!( )`, `$name`.
    void set_standard(bool standard) {
        lightsieve_set_standard(compiler_.get(), standard ? 1 : 0);
    }

    /// Compiles what has been added so far; AOVs with an error are black.
    [[nodiscard]] Program compile() {
        lightsieve_program* program = lightsieve_compile(compiler_.get());
        if (program == nullptr) throw std::bad_alloc();
        return Program(program);
    }
    /// What the last `compile` found; see Severity.
    [[nodiscard]] std::vector<Diagnostic> diagnostics() const {
        std::vector<Diagnostic> out;
        lightsieve_diagnostic found;
        for (std::size_t i = 0; lightsieve_get_diagnostic(compiler_.get(), i, &found) != 0; ++i)
            out.push_back({static_cast<Severity>(found.severity), found.code, found.message,
                           found.hint, found.expression, found.column, found.text});
        return out;
    }

  private:
    struct Destroy {
        void operator()(lightsieve_compiler* compiler) const noexcept {
            lightsieve_compiler_destroy(compiler);
        }
    };
    std::unique_ptr<lightsieve_compiler, Destroy> compiler_;
};

}  // namespace lightsieve::embed
