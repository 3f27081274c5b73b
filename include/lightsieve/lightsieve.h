// Light path expressions for any renderer: the C interface of Lightsieve's engine.
//
// Before rendering, AOVs (a name and an expression each) and the events that the scene can make
// are added to a compiler. `lightsieve_compile` turns them into a program: flat arrays of 32-bit
// numbers. A path carries one number, its state; each scattering event moves it by one load from
// the table, and each terminal event looks up one atom. Two paths have the same atom exactly when
// the same AOVs take them.
//
// Nothing here throws, and after compiling nothing allocates or locks: a program never changes and
// may be used by any number of threads. A compiler is for one thread at a time. The inline
// functions work on the arrays alone, so a copy of the arrays on a GPU works the same way. C++ has
// a thinner pen for the same things: lightsieve/lpe.h. docs/embedding.md is the guide.
#pragma once

#include <stddef.h>
#include <stdint.h>

/// Version of these headers. Until 1.0 a change of MINOR may break callers; from then on of MAJOR.
#define LIGHTSIEVE_VERSION_MAJOR 0
#define LIGHTSIEVE_VERSION_MINOR 1
#define LIGHTSIEVE_VERSION_PATCH 0

/// No atom (the path ends in no AOV), no index (what was given cannot be added).
#define LIGHTSIEVE_NONE UINT32_MAX

#ifdef __cplusplus
extern "C" {
#endif

/// The version of the library that the program was linked with, "0.1.0".
const char* lightsieve_version(void);

/// What happens at a vertex of a path; the letters are those of expressions. The camera is no
/// event: every path starts after it.
typedef enum lightsieve_kind {
    LIGHTSIEVE_REFLECTION = 0,    ///< R, with a lobe
    LIGHTSIEVE_TRANSMISSION = 1,  ///< T, with a lobe
    LIGHTSIEVE_VOLUME = 2,        ///< V
    LIGHTSIEVE_LIGHT = 3,         ///< L, terminal
    LIGHTSIEVE_OBJECT = 4,        ///< O, terminal: emission of an object
    LIGHTSIEVE_BACKGROUND = 5,    ///< B, terminal
    LIGHTSIEVE_ALBEDO = 6         ///< A, terminal: a probe of a surface's colour, not light
} lightsieve_kind;

/// How light leaves a surface.
typedef enum lightsieve_lobe {
    LIGHTSIEVE_NO_LOBE = 0,  ///< of every event but reflection and transmission
    LIGHTSIEVE_DIFFUSE = 1,  ///< D
    LIGHTSIEVE_SPECULAR = 2  ///< S, glossy included
} lightsieve_lobe;

/// One event that the scene can make.
typedef struct lightsieve_event {
    lightsieve_kind kind;
    lightsieve_lobe lobe;
    /// Labels of the lobe and of the object, in any order; for a light, and for a background that
    /// a light makes, the name of its light group or nothing.
    const char* const* labels;
    size_t n_labels;  ///< of `labels`; 0 allows a null pointer
} lightsieve_event;

/// How bad a diagnostic is.
typedef enum lightsieve_severity {
    LIGHTSIEVE_LINT = 0,     ///< legal, but probably not what was meant
    LIGHTSIEVE_WARNING = 1,  ///< something was left out
    LIGHTSIEVE_ERROR = 2     ///< the AOV is black
} lightsieve_severity;

/// What is wrong with an expression. No pointer is null.
typedef struct lightsieve_diagnostic {
    lightsieve_severity severity;
    const char* code;        ///< "lpe-unclosed"; the project's reference page lists all of them
    const char* message;     ///< what is wrong, one line
    const char* hint;        ///< what to do about it, or ""
    const char* expression;  ///< the text that it is about, or ""
    uint32_t column;         ///< in that text, in characters, counted from 1; 0: not known
    const char* text;        ///< all of this as a person should see it, with the place marked
} lightsieve_diagnostic;

/// Gathers AOVs and events. Opaque.
typedef struct lightsieve_compiler lightsieve_compiler;
/// What was compiled. Opaque, immutable.
typedef struct lightsieve_program lightsieve_program;

/// A compiler without AOVs and events; null if there is no memory.
lightsieve_compiler* lightsieve_compiler_create(void);
/// Ends its life; null is allowed. Programs that it made live on.
void lightsieve_compiler_destroy(lightsieve_compiler* compiler);

/// Adds an AOV.
///
/// name        for messages
/// expression  "C<RD>L"; `$diffuse` names a built-in AOV
/// group       null: every path that the expression takes; a light group's name: those whose light
///             is in it; "default": the light paths of no other group
/// returns     its index, counted from 0; LIGHTSIEVE_NONE for a null pointer or without memory.
///             Mistakes in the expression are found by `lightsieve_compile`
uint32_t lightsieve_add_aov(lightsieve_compiler* compiler, const char* name,
                            const char* expression, const char* group);
/// Adds an event that the scene can make. Twice the same event is allowed.
///
/// returns  its index, counted from 0, for `lightsieve_tables.event_columns`; LIGHTSIEVE_NONE for
///          an event that cannot be: a lobe where none belongs or none where one does, two groups
///          of one light, an empty label
uint32_t lightsieve_add_event(lightsieve_compiler* compiler, const lightsieve_event* event);
/// Refuse what Lightsieve adds to Arnold's language (`&`, `-`, `!( )`, `$name`) if `standard` is
/// not 0. The default is 0.
void lightsieve_set_standard(lightsieve_compiler* compiler, int standard);

/// Compiles what has been added so far. May be called again, after more has been added.
///
/// returns  a program in which AOVs with an error are black; null only if there is no memory.
///          The caller destroys it
/// cost     milliseconds for a hundred AOVs; budgets bound it for any expression
lightsieve_program* lightsieve_compile(lightsieve_compiler* compiler);
/// Ends a program's life, with its arrays; null is allowed.
void lightsieve_program_destroy(lightsieve_program* program);

/// How many diagnostics the last `lightsieve_compile` left.
size_t lightsieve_n_diagnostics(const lightsieve_compiler* compiler);
/// Fills `out` with diagnostic number i; its texts live until the next call of
/// `lightsieve_compile` or the compiler's end. Returns 0, and leaves `out`, if there is none.
int lightsieve_get_diagnostic(const lightsieve_compiler* compiler, size_t i,
                              lightsieve_diagnostic* out);

/// The arrays of a program. Copy them anywhere: they hold offsets and no addresses.
///
/// `table` has n_states rows of `stride` numbers, one row a state:
///
///     column 0                                    flags: LIGHTSIEVE_LIVE_*
///     columns first_class ... first_terminal - 1  the next state, for each class of scattering
///                                                 events
///     columns first_terminal ... stride - 1       the atom, for each class of terminal events
///
/// A state is the offset of its row. Row 0 is the state from which nothing can be reached.
typedef struct lightsieve_tables {
    const uint32_t* table;
    uint32_t n_states, stride;
    uint32_t first_class, first_terminal;
    /// Where a path starts, one state for each automaton: one, unless the expressions together
    /// exceed a budget; none if no AOV can be reached. A path carries a state for each.
    const uint32_t* starts;
    uint32_t n_automata;
    /// For each event, by the index that `lightsieve_add_event` returned: its column.
    const uint32_t* event_columns;
    uint32_t n_events;
    /// The AOVs (indices, ascending) of atom i: atom_aovs[atom_begin[i]] ... up to
    /// atom_aovs[atom_begin[i + 1] - 1]. `atom_begin` has n_atoms + 1 entries.
    const uint32_t *atom_begin, *atom_aovs;
    uint32_t n_atoms, n_aovs;
} lightsieve_tables;

/// Flag of a state: light that arrives now or after more scattering can still reach an AOV.
#define LIGHTSIEVE_LIVE_LIGHT 1u
/// Flag of a state: a probe now or after more scattering can still reach an AOV.
#define LIGHTSIEVE_LIVE_PROBE 2u

/// The arrays of a program; they live as long as it does.
lightsieve_tables lightsieve_program_tables(const lightsieve_program* program);

/// The state after one more scattering event, whose column is `column`. Cost: one load.
static inline uint32_t lightsieve_step(const uint32_t* table, uint32_t state, uint32_t column) {
    return table[state + column];
}
/// The atom of the path that ends now with the terminal event of that column, or LIGHTSIEVE_NONE.
/// Cost: one load. A probe needs a vertex: never ask a start state for one.
static inline uint32_t lightsieve_atom(const uint32_t* table, uint32_t state, uint32_t column) {
    return table[state + column];
}
/// What a path in this state can still reach: LIGHTSIEVE_LIVE_* flags; 0: nothing. Cost: one load.
static inline uint32_t lightsieve_live(const uint32_t* table, uint32_t state) {
    return table[state];
}

#ifdef __cplusplus
}
#endif
