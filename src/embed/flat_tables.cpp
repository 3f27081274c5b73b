#include "embed/flat_tables.h"

namespace lightsieve::embed {
namespace {

/// Adds the rows of one automaton but its dead state, which is row 0 of the table.
///
/// shift  what turns a state of the automaton into one of the table
void add_rows(const lpe::Program& program, const lpe::Automaton& automaton, std::uint32_t shift,
              FlatTables& out) {
    const auto moved = [&](lpe::State state) {
        return state == lpe::kDead ? lpe::kDead : state + shift;
    };
    for (std::size_t s = 1; s < automaton.n_states(); ++s) {
        const lpe::State state = automaton.state(s);
        out.table.push_back((automaton.live_light(state) ? 1U : 0U) |
                            (automaton.live_probe(state) ? 2U : 0U));
        for (std::uint32_t c = lpe::Program::kFirstClass; c < out.first_terminal; ++c)
            out.table.push_back(moved(automaton.step(state, c)));
        for (std::uint32_t t = 0; t < program.n_terminals(); ++t)
            out.table.push_back(automaton.atom(state, out.first_terminal + t));
    }
    out.starts.push_back(moved(automaton.start()));
}

}  // namespace

std::optional<FlatTables> flatten(const lpe::Program& program, std::span<const Event> events,
                                  std::size_t max_words) {
    FlatTables out;
    out.first_terminal = program.first_terminal();
    out.stride = out.first_terminal + static_cast<std::uint32_t>(program.n_terminals());
    std::size_t n_rows = 1;
    for (std::size_t i = 0; i < program.n_automata(); ++i)
        n_rows += program.automaton(i).n_inner_states();
    if (n_rows * out.stride > max_words) return std::nullopt;

    // Row 0: nothing is reached, whatever happens.
    out.table.reserve(n_rows * out.stride);
    out.table.assign(out.first_terminal, 0);
    out.table.resize(out.stride, lpe::kNoAtom);
    for (std::size_t i = 0; i < program.n_automata(); ++i) {
        // The automaton's own first row is left out.
        const auto shift = static_cast<std::uint32_t>(out.table.size()) - out.stride;
        add_rows(program, program.automaton(i), shift, out);
    }

    for (const Event& event : events)
        out.event_columns.push_back(is_terminal(event.kind) ? program.terminal(event)
                                                            : program.scatter_class(event));
    out.atom_begin.push_back(0);
    for (lpe::AtomId atom = 0; atom < program.n_atoms(); ++atom) {
        const auto aovs = program.aovs_of(atom);
        out.atom_aovs.insert(out.atom_aovs.end(), aovs.begin(), aovs.end());
        out.atom_begin.push_back(static_cast<std::uint32_t>(out.atom_aovs.size()));
    }
    return out;
}

}  // namespace lightsieve::embed
