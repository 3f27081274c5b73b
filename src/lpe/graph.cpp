#include "lpe/graph.h"

#include <array>
#include <map>
#include <set>
#include <vector>

#include "lpe/program.h"
#include "lpe/words.h"

namespace lightsieve::lpe {
namespace {

/// A fill and an outline for each atom, told apart by the colour-blind too (after Okabe and Ito
/// 2008, "Color universal design").
struct Colour {
    std::string_view fill, line;
};
constexpr std::array kColours{
    Colour{"#cfe8f7", "#0072b2"}, Colour{"#fbe3c4", "#d55e00"}, Colour{"#cdeee3", "#009e73"},
    Colour{"#f3d9e9", "#b5508c"}, Colour{"#f8f3bf", "#8f8300"}, Colour{"#dcdcf6", "#5b5bb5"},
    Colour{"#e4e4e4", "#555555"}, Colour{"#f6cfcf", "#aa2222"},
};

/// Characters of an edge's text before it goes on in a new line.
constexpr std::size_t kLineLength = 20;

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

/// With line breaks after commas and blanks where lines get long.
std::string wrapped(const std::string& text) {
    std::string out;
    std::size_t column = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t next = std::min(text.find(' ', i + 1), text.size());
        if (text[i] == ' ' && column + (next - i) > kLineLength) {
            out += "\\n";
            column = 0;
            continue;
        }
        out += escaped(text.substr(i, 1));
        ++column;
    }
    return out;
}

class Graph {
  public:
    Graph(std::span<const NamedExpr> exprs, const Program& program, const EventNames& names)
        : exprs_(exprs), program_(program), automaton_(program.automaton(0)), names_(names) {}

    std::string run() {
        gather();
        std::string out =
            "digraph lpe {\n"
            "  rankdir=LR; bgcolor=\"white\"; pad=0.2; nodesep=0.3; ranksep=0.55;\n"
            "  node [fontname=\"Helvetica,Arial,sans-serif\" fontsize=12 penwidth=1.4];\n"
            "  edge [fontname=\"Helvetica,Arial,sans-serif\" fontsize=10 color=\"#555555\" "
            "fontcolor=\"#222222\" arrowsize=0.7];\n"
            "  camera [shape=plaintext label=\"camera\" fontcolor=\"#555555\"];\n";
        for (const std::size_t state : states_)
            out += "  s" + std::to_string(state) +
                   " [shape=circle label=\"\" width=0.28 style=filled fillcolor=\"#f4f4f4\" "
                   "color=\"#555555\"];\n";
        for (const auto& [atom, colour] : atoms_)
            out += "  a" + std::to_string(atom) + " [shape=box style=\"rounded,filled\" label=\"" +
                   wrapped(atom_name(atom)) + "\" fillcolor=\"" +
                   std::string(kColours[colour % kColours.size()].fill) + "\" color=\"" +
                   std::string(kColours[colour % kColours.size()].line) + "\"];\n";
        out += "  camera -> s" + std::to_string(automaton_.index(automaton_.start())) +
               " [label=\"C\"];\n";
        for (const auto& [edge, events] : scatter_)
            out += "  s" + std::to_string(edge.first) + " -> s" + std::to_string(edge.second) +
                   " [label=\"" + wrapped(names_.label(events)) + "\"];\n";
        for (const auto& [edge, events] : ends_) {
            const std::string line(kColours[atoms_.at(edge.second) % kColours.size()].line);
            out += "  s" + std::to_string(edge.first) + " -> a" + std::to_string(edge.second) +
                   " [label=\"" + wrapped(names_.label(events)) + "\" color=\"" + line +
                   "\" fontcolor=\"" + line + "\"];\n";
        }
        return out + "}\n";
    }

  private:
    using Edge = std::pair<std::size_t, std::size_t>;
    using End = std::pair<std::size_t, AtomId>;

    /// Walks from the start; events between the same two nodes become one edge.
    void gather() {
        states_.push_back(automaton_.index(automaton_.start()));
        std::set<std::size_t> seen(states_.begin(), states_.end());
        bool comes_back = false;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const State state = automaton_.state(states_[i]);
            for (std::size_t e = 0; e < names_.events().size(); ++e) {
                const Event& event = names_.events()[e];
                if (is_terminal(event.kind)) {
                    // A probe needs a vertex: at the start it counts only if paths come back to it.
                    if (i > 0 || event.kind != EventKind::Albedo) add_end(state, event, e);
                    continue;
                }
                const State next = automaton_.step(state, program_.scatter_class(event));
                if (next == kDead) continue;
                comes_back = comes_back || next == automaton_.start();
                const std::size_t index = automaton_.index(next);
                mark(scatter_, Edge{states_[i], index}, e);
                if (seen.insert(index).second) states_.push_back(index);
            }
            if (states_.size() > kMaxDrawnStates)
                throw InputError(OverBudget{
                    Code::LimitLpeStates,
                    "would show more than " + std::to_string(kMaxDrawnStates) + " states",
                    "kMaxDrawnStates"}
                                     .error("the graph", {}));
        }
        for (std::size_t e = 0; comes_back && e < names_.events().size(); ++e)
            if (names_.events()[e].kind == EventKind::Albedo)
                add_end(automaton_.start(), names_.events()[e], e);
    }

    void add_end(State state, const Event& event, std::size_t e) {
        const AtomId atom = automaton_.atom(state, program_.terminal(event));
        if (atom == kNoAtom) return;
        atoms_.try_emplace(atom, atoms_.size());
        mark(ends_, End{automaton_.index(state), atom}, e);
    }

    template <class Key>
    void mark(std::map<Key, EventSet>& edges, const Key& edge, std::size_t event) {
        EventSet& set = edges[edge];
        set.resize(names_.events().size());
        set[event] = true;
    }

    std::string atom_name(AtomId atom) const {
        std::string out;
        for (const std::uint32_t aov : program_.aovs_of(atom))
            out += (out.empty() ? "" : " + ") + exprs_[aov].name;
        return out;
    }

    std::span<const NamedExpr> exprs_;
    const Program& program_;
    const Automaton& automaton_;
    const EventNames& names_;
    std::vector<std::size_t> states_;      ///< in the order of the walk
    std::map<AtomId, std::size_t> atoms_;  ///< with the number of its colour
    std::map<Edge, EventSet> scatter_;     ///< between states
    std::map<End, EventSet> ends_;         ///< from a state to an atom
};

}  // namespace

std::string graph(std::span<const NamedExpr> exprs, std::span<const Event> events,
                  const Limits& limits) {
    std::vector<Expr> trees;
    std::vector<AovRequest> requests;
    for (const NamedExpr& expr : exprs) {
        trees.push_back(expr.expr);
        requests.push_back({expr.name, expr.expr, GroupSelect::All, ""});
    }
    const EventNames names =
        events.empty() ? EventNames(std::span<const Expr>(trees)) : EventNames(events);
    Diagnostics diagnostics;
    const Program program = Program::compile(requests, names.events(), limits, diagnostics);
    diagnostics.throw_if_errors();
    if (program.n_automata() != 1)
        throw InputError(
            OverBudget{Code::LimitLpeStates, "needs more than one automaton", "max_states"}.error(
                "the graph", {}));
    return Graph(exprs, program, names).run();
}

}  // namespace lightsieve::lpe
