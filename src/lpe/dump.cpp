#include "lpe/dump.h"

#include "lpe/path.h"
#include "lpe/print.h"

namespace lightsieve::lpe {
namespace {

struct NodeName {
    std::string operator()(const Letter&) const { return "letter"; }
    std::string operator()(const Dot&) const { return "any"; }
    std::string operator()(const Label&) const { return "label"; }
    std::string operator()(const Angle&) const { return "event"; }
    std::string operator()(const Brackets&) const { return "one of"; }
    std::string operator()(const Sequence&) const { return "sequence"; }
    std::string operator()(const Alternation&) const { return "alternatives"; }
    std::string operator()(const Repeat& repeat) const {
        const bool unbounded = repeat.max == Repeat::kUnbounded;
        return "repeat " + std::to_string(repeat.min) + ".." +
               (unbounded ? "" : std::to_string(repeat.max));
    }
    std::string operator()(const Intersection&) const { return "all of"; }
    std::string operator()(const Difference&) const { return "first without the others"; }
    std::string operator()(const Complement&) const { return "all light but"; }
    std::string operator()(const Reference& reference) const {
        return "what is called " + reference.name;
    }
};

void dump_node(const Node& node, std::size_t indent, std::string& out) {
    out += std::string(2 * indent, ' ') + std::visit(NodeName{}, node.form);
    if (is_event_test(node)) {
        out += " " + print(node) + "\n";
        return;
    }
    out += "\n";
    for (const Expr& child : children(node))
        dump_node(*child, indent + 1, out);
}

std::string aovs_text(const Program& program, AtomId atom) {
    std::string out;
    for (const std::uint32_t aov : program.aovs_of(atom))
        out += (out.empty() ? "" : " ") + std::to_string(aov);
    return "{" + out + "}";
}

void dump_state(const Program& program, const Automaton& automaton, State state,
                std::string& out) {
    out += "  state " + std::to_string(automaton.index(state));
    if (state == automaton.start()) out += " start";
    if (automaton.live_light(state)) out += " light";
    if (automaton.live_probe(state)) out += " probe";
    out += "\n   ";
    for (ClassId c = Program::kFirstClass; c < program.first_terminal(); ++c)
        out += " " + print_event(program.example(c)) + "->" +
               std::to_string(automaton.index(automaton.step(state, c)));
    out += "\n";
    for (std::size_t t = 0; t < program.n_terminals(); ++t) {
        const TerminalId terminal = program.first_terminal() + static_cast<TerminalId>(t);
        const AtomId atom = automaton.atom(state, terminal);
        if (atom == kNoAtom) continue;
        out += "    " + print_event(program.example(terminal)) + ": atom " + std::to_string(atom) +
               " AOVs " + aovs_text(program, atom) + "\n";
    }
}

}  // namespace

std::string dump(const Expr& expr) {
    std::string out;
    if (expr) dump_node(*expr, 0, out);
    return out;
}

std::string dump(const Dfa& dfa) {
    std::string out = "start " + std::to_string(dfa.start) + "\n";
    for (std::size_t state = 0; state < dfa.n_states(); ++state) {
        out += std::to_string(state) + ":";
        for (std::size_t column = 0; column < dfa.n_classes; ++column)
            out += " " + std::to_string(dfa.next[state * dfa.n_classes + column]);
        out += " output " + std::to_string(dfa.output[state]) + "\n";
    }
    return out;
}

std::string dump(const Program& program) {
    std::string out = std::to_string(program.n_aovs()) + " AOVs, " +
                      std::to_string(program.n_atoms()) + " atoms, " +
                      std::to_string(program.n_classes()) + " classes, " +
                      std::to_string(program.n_terminals()) + " terminals\n";
    for (std::size_t i = 0; i < program.n_automata(); ++i) {
        const Automaton& automaton = program.automaton(i);
        out += "automaton " + std::to_string(i) + "\n";
        for (std::size_t s = 0; s < automaton.n_states(); ++s)
            dump_state(program, automaton, automaton.state(s), out);
    }
    return out;
}

}  // namespace lightsieve::lpe
