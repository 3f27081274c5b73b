#include "lpe/program.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "lpe/alphabet.h"
#include "lpe/determinise.h"
#include "lpe/interner.h"
#include "lpe/minimise.h"
#include "lpe/print.h"
#include "lpe/term.h"

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kDefaultGroup = "default";
/// Work spent on putting expressions together, in units of Limits::max_steps, before the rest stay
/// apart.
constexpr std::size_t kSplitEffort = 4;
/// Automata of several expressions that were split get this part of the budget: what does not fit
/// is found out soon, and more states would hold few expressions more.
constexpr std::size_t kJointShare = 25;

/// What a terminal's group means to the requests: a number per group that one of them names, and
/// these.
enum : std::uint32_t {
    kProbeGroup,  ///< a probe: in no group
    kDefault,     ///< light of no named group
    kOtherGroup,  ///< light of a group that no request names
    kFirstNamed,
};

/// The requests of one distinct expression. The expression is one component of the automaton
/// whatever their number.
struct Component {
    Expr expr;
    std::uint32_t first_request;
    std::vector<std::uint32_t> all, by_default;  ///< requests, by GroupSelect
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>
        named;  ///< requests, by group number
};

/// The bounded repeat that multiplies most, if there is one: what makes an automaton explode.
const Node* largest_repeat(const Node& node, std::uint64_t& size) {
    const Node* largest = nullptr;
    std::uint64_t largest_size = 1;
    for (const Expr& child : children(node)) {
        std::uint64_t child_size = 1;
        const Node* found = largest_repeat(*child, child_size);
        if (child_size > largest_size) {
            largest = found;
            largest_size = child_size;
        }
    }
    size = largest_size;
    const auto* repeat = std::get_if<Repeat>(&node.form);
    if (repeat == nullptr) return largest;
    const std::uint32_t count = repeat->max == Repeat::kUnbounded ? repeat->min : repeat->max;
    if (count < 2) return largest;
    // Nested 255 deep the product would overflow: saturate.
    size = largest_size > UINT32_MAX ? largest_size : largest_size * count;
    return &node;
}

Error budget_error(const AovRequest& request, const OverBudget& over) {
    std::uint64_t size = 0;
    const Node* culprit = largest_repeat(*request.expr, size);
    const SourceSpan where = culprit != nullptr ? culprit->where : request.expr->where;
    std::string hint = "the limit is " + over.limit;
    if (culprit != nullptr) hint = "\"" + print(*culprit) + "\" is what explodes; " + hint;
    return {over.code, "AOV \"" + request.name + "\": its automaton " + over.message,
            where,     hint,
            {},        Severity::Error};
}

}  // namespace

/// Fills a Program, stage by stage; one method a stage, in the order of `build`.
class ProgramBuilder {
  public:
    ProgramBuilder(std::span<const AovRequest> aovs, std::span<const Event> events,
                   const Limits& limits, Diagnostics& diagnostics)
        : aovs_(aovs), limits_(limits), diagnostics_(diagnostics) {
        collect_events(events);
        collect_components();
    }

    Program build() {
        const std::vector<Expr> exprs = exprs_of(all_components());
        const Alphabet alphabet(exprs, events_);
        alphabet_ = &alphabet;
        number_columns();
        compile_together(all_components());
        finish_atoms();
        return std::move(program_);
    }

  private:
    using Components = std::vector<std::uint32_t>;

    void collect_events(std::span<const Event> events);
    void collect_components();
    void number_columns();
    void compile_together(const Components& components);
    void compile_apart(const Components& components);
    std::size_t run_that_fits(std::span<const std::uint32_t> queue);
    std::optional<Determinised> try_determinise(const Components& components, const Limits& limits,
                                                OverBudget* over);
    void add_automaton(const Components& components, Determinised determinised);
    AtomId atom_of(const Components& components, std::span<const std::uint32_t> accepting,
                   std::uint32_t group);
    std::uint32_t group_of(const Event& event) const;
    void fill_live(Automaton& automaton) const;
    void finish_atoms();

    [[nodiscard]] Components all_components() const {
        Components all(components_.size());
        std::iota(all.begin(), all.end(), 0);
        return all;
    }
    [[nodiscard]] std::vector<Expr> exprs_of(const Components& components) const {
        std::vector<Expr> exprs;
        for (const std::uint32_t c : components)
            exprs.push_back(components_[c].expr);
        return exprs;
    }

    /// A column of the atom table: a terminal class, for one group.
    struct Terminal {
        EventClass event_class;
        std::uint32_t group;
    };

    std::span<const AovRequest> aovs_;
    const Limits& limits_;
    Diagnostics& diagnostics_;
    const Alphabet* alphabet_ = nullptr;
    std::vector<Event> events_;  ///< distinct, in order of first appearance
    std::vector<Component> components_;
    std::unordered_map<std::string, std::uint32_t> group_numbers_;
    std::vector<Terminal> terminals_;
    Interner atoms_;
    std::size_t total_steps_ = 0;
    Program program_;
};

void ProgramBuilder::collect_events(std::span<const Event> events) {
    for (const Event& event : events) {
        if (event.kind == EventKind::Camera) continue;
        if (program_.columns_.emplace(event, 0).second) events_.push_back(event);
    }
}

void ProgramBuilder::collect_components() {
    program_.n_aovs_ = aovs_.size();
    // Expressions are the same if they print the same; most requests share the tree itself.
    std::unordered_map<const Node*, std::uint32_t> by_tree;
    std::unordered_map<std::string, std::uint32_t> by_text;
    for (std::uint32_t i = 0; i < aovs_.size(); ++i) {
        const AovRequest& request = aovs_[i];
        if (!request.expr) continue;
        const auto [tree, new_tree] = by_tree.emplace(request.expr.get(), 0);
        if (new_tree) {
            const auto next = static_cast<std::uint32_t>(components_.size());
            const auto [text, new_text] = by_text.emplace(print(request.expr), next);
            if (new_text) components_.push_back({request.expr, i, {}, {}, {}});
            tree->second = text->second;
        }
        Component& component = components_[tree->second];
        if (request.select == GroupSelect::All) {
            component.all.push_back(i);
        } else if (request.select == GroupSelect::Default || request.group == kDefaultGroup) {
            component.by_default.push_back(i);
        } else {
            const auto next = static_cast<std::uint32_t>(kFirstNamed + group_numbers_.size());
            const std::uint32_t group = group_numbers_.emplace(request.group, next).first->second;
            component.named[group].push_back(i);
        }
    }
}

std::uint32_t ProgramBuilder::group_of(const Event& event) const {
    if (event.kind == EventKind::Albedo) return kProbeGroup;
    // Only lights have groups: the labels of an emissive object are none.
    if (event.kind == EventKind::Object || event.labels.empty()) return kDefault;
    if (event.labels.front() == kDefaultGroup) return kDefault;
    const auto found = group_numbers_.find(event.labels.front());
    return found == group_numbers_.end() ? std::uint32_t{kOtherGroup} : found->second;
}

/// Scattering events keep their class as column; terminals get one for each (class, group) that
/// occurs.
void ProgramBuilder::number_columns() {
    program_.n_classes_ = alphabet_->n_scatter();
    for (EventClass c = Alphabet::kFirstScatter; c < alphabet_->first_terminal(); ++c)
        program_.examples_.push_back(alphabet_->example(c));
    std::map<std::pair<EventClass, std::uint32_t>, std::uint32_t> column_of;
    for (std::size_t i = 0; i < events_.size(); ++i) {
        const EventClass event_class = alphabet_->class_of(i);
        if (!is_terminal(events_[i].kind)) {
            program_.columns_[events_[i]] = event_class;
            continue;
        }
        const std::uint32_t group = group_of(events_[i]);
        const auto next =
            program_.first_terminal() + static_cast<std::uint32_t>(terminals_.size());
        const auto [entry, is_new] = column_of.emplace(std::pair{event_class, group}, next);
        if (is_new) {
            terminals_.push_back({event_class, group});
            program_.examples_.push_back(events_[i]);
        }
        program_.columns_[events_[i]] = entry->second;
    }
    program_.n_terminals_ = terminals_.size();
}

std::optional<Determinised> ProgramBuilder::try_determinise(const Components& components,
                                                            const Limits& limits,
                                                            OverBudget* over) {
    try {
        Determinised made = determinise(exprs_of(components), *alphabet_, limits);
        total_steps_ += made.n_steps;
        const std::size_t stride = 1 + program_.n_classes_ + program_.n_terminals_;
        if (made.dfa.n_states() * stride * sizeof(std::uint32_t) > limits.max_table_bytes)
            throw OverBudget{
                Code::LimitLpeTable,
                "needs a table of more than " + std::to_string(limits.max_table_bytes) + " bytes",
                "max_table_bytes"};
        return made;
    } catch (const OverBudget& exceeded) {
        total_steps_ += limits.max_steps;
        if (over != nullptr) *over = exceeded;
        return std::nullopt;
    }
}

void ProgramBuilder::compile_together(const Components& components) {
    if (components.empty()) return;
    if (std::optional<Determinised> whole = try_determinise(components, limits_, nullptr))
        return add_automaton(components, *std::move(whole));
    compile_apart(components);
}

/// Each expression alone, to find those that can never be compiled; then, smallest first, as many
/// in a row to one automaton as fit.
void ProgramBuilder::compile_apart(const Components& components) {
    std::vector<std::pair<std::size_t, std::uint32_t>> by_size;
    for (const std::uint32_t c : components) {
        OverBudget over;
        if (const std::optional<Determinised> alone = try_determinise({c}, limits_, &over))
            by_size.emplace_back(alone->dfa.n_states(), c);
        else
            diagnostics_.add(budget_error(aovs_[components_[c].first_request], over));
    }
    std::ranges::sort(by_size);
    Components queue;
    for (const auto& [size, c] : by_size)
        queue.push_back(c);
    total_steps_ = 0;
    std::size_t n_parts = 0;
    for (std::size_t at = 0; at < queue.size();) {
        const std::size_t n = run_that_fits(std::span(queue).subspan(at));
        Components part(queue.begin() + static_cast<std::ptrdiff_t>(at),
                        queue.begin() + static_cast<std::ptrdiff_t>(at + n));
        at += n;
        std::ranges::sort(part);
        if (++n_parts <= limits_.max_automata) {
            // It was within the budget when it was tried.
            add_automaton(part, determinise(exprs_of(part), *alphabet_, limits_));
            continue;
        }
        for (const std::uint32_t c : part) {
            const OverBudget over{Code::LimitLpeAutomata,
                                  "would be in number " + std::to_string(n_parts) +
                                      " of those that a path steps together",
                                  "max_automata"};
            diagnostics_.add(budget_error(aovs_[components_[c].first_request], over));
        }
    }
}

/// How many components from the front fit into one automaton, found in few tries: twice as many
/// more each time, then half as many. At least one, which fits alone.
std::size_t ProgramBuilder::run_that_fits(std::span<const std::uint32_t> queue) {
    Limits narrow = limits_;
    narrow.max_states = std::max<std::size_t>(1, limits_.max_states / kJointShare);
    narrow.max_steps = std::max<std::size_t>(1, limits_.max_steps / kJointShare);
    const auto fits = [&](std::size_t n) {
        if (total_steps_ > kSplitEffort * limits_.max_steps) return false;
        return try_determinise({queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(n)},
                               narrow, nullptr)
            .has_value();
    };
    std::size_t n = 1, step = 1;
    for (; n + step <= queue.size() && fits(n + step); step *= 2)
        n += step;
    for (; step > 0; step /= 2)
        if (n + step <= queue.size() && fits(n + step)) n += step;
    return n;
}

/// The atom of the paths that these components take and whose terminal is in `group`.
AtomId ProgramBuilder::atom_of(const Components& components,
                               std::span<const std::uint32_t> accepting, std::uint32_t group) {
    std::vector<std::uint32_t> aovs;
    const auto add = [&](const std::vector<std::uint32_t>& requests) {
        aovs.insert(aovs.end(), requests.begin(), requests.end());
    };
    for (const std::uint32_t i : accepting) {
        const Component& component = components_[components[i]];
        add(component.all);
        if (group == kDefault) add(component.by_default);
        const auto named = component.named.find(group);
        if (named != component.named.end()) add(named->second);
    }
    if (aovs.empty()) return kNoAtom;
    std::ranges::sort(aovs);
    return atoms_.intern(aovs);
}

void ProgramBuilder::add_automaton(const Components& components, Determinised determinised) {
    // Turn each output (sets of expressions) into a row of atoms; row 0 is the one of no atoms.
    Interner rows;
    std::vector<std::uint32_t> row(terminals_.size(), kNoAtom);
    rows.intern(row);
    std::map<std::pair<std::uint32_t, std::uint32_t>, AtomId> atom_of_set;
    std::vector<std::uint32_t> row_of_output(determinised.outputs.size());
    for (std::uint32_t output = 0; output < determinised.outputs.size(); ++output) {
        for (std::size_t t = 0; t < terminals_.size(); ++t) {
            const EventClass column = terminals_[t].event_class - alphabet_->first_terminal();
            const std::uint32_t set = determinised.outputs[output][column];
            const auto [atom, is_new] =
                atom_of_set.emplace(std::pair{set, terminals_[t].group}, 0);
            if (is_new)
                atom->second = atom_of(components, determinised.sets[set], terminals_[t].group);
            row[t] = atom->second;
        }
        row_of_output[output] = rows.intern(row);
    }
    for (std::uint32_t& output : determinised.dfa.output)
        output = row_of_output[output];

    // The smallest automaton with these rows as outputs, as one table.
    const Dfa dfa = minimise(determinised.dfa);
    Automaton automaton;
    automaton.stride_ = 1 + program_.n_classes_ + program_.n_terminals_;
    const std::size_t table_size = dfa.n_states() * automaton.stride_;
    LIGHTSIEVE_ASSERT(table_size < kNoAtom, std::to_string(table_size) + " entries");
    automaton.table_.reserve(table_size);
    for (std::size_t state = 0; state < dfa.n_states(); ++state) {
        automaton.table_.push_back(0);  // flags, filled in below
        for (std::size_t column = 0; column < dfa.n_classes; ++column)
            automaton.table_.push_back(automaton.state(dfa.next[state * dfa.n_classes + column]));
        const std::span<const std::uint32_t> atoms = rows[dfa.output[state]];
        automaton.table_.insert(automaton.table_.end(), atoms.begin(), atoms.end());
    }
    automaton.start_ = automaton.state(dfa.start);
    fill_live(automaton);
    program_.automata_.push_back(std::move(automaton));
}

/// What each state can still reach: its own atoms and what its successors can reach, until nothing
/// changes.
void ProgramBuilder::fill_live(Automaton& automaton) const {
    const std::size_t n_words = (aovs_.size() + 63) / 64;
    const std::size_t n_states = automaton.n_states();
    std::vector<std::uint64_t> reach(n_states * n_words, 0);
    for (std::size_t s = 0; s < n_states; ++s) {
        const State state = automaton.state(s);
        for (std::uint32_t t = 0; t < terminals_.size(); ++t) {
            const AtomId atom = automaton.atom(state, program_.first_terminal() + t);
            if (atom == kNoAtom) continue;
            automaton.table_[state] |=
                terminals_[t].group == kProbeGroup ? Automaton::kLiveProbe : Automaton::kLiveLight;
            for (const std::uint32_t aov : atoms_[atom])
                reach[s * n_words + aov / 64] |= std::uint64_t{1} << (aov % 64);
        }
    }
    // States are numbered breadth first: going backwards most facts travel in one pass.
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t s = n_states; s-- > 0;) {
            const State state = automaton.state(s);
            const auto merge = [&](auto& into, auto from) {
                changed = changed || (into | from) != into;
                into |= from;
            };
            for (ClassId c = Program::kFirstClass; c < program_.first_terminal(); ++c) {
                const State next = automaton.step(state, c);
                if (next == state) continue;
                merge(automaton.table_[state], automaton.table_[next]);
                for (std::size_t w = 0; w < n_words; ++w)
                    merge(reach[s * n_words + w], reach[automaton.index(next) * n_words + w]);
            }
        }
    }
    automaton.live_words_ = n_words;
    automaton.live_sets_ = std::move(reach);
}

void ProgramBuilder::finish_atoms() {
    for (AtomId atom = 0; atom < atoms_.size(); ++atom) {
        const std::span<const std::uint32_t> aovs = atoms_[atom];
        program_.atom_aovs_.insert(program_.atom_aovs_.end(), aovs.begin(), aovs.end());
        program_.atom_begin_.push_back(static_cast<std::uint32_t>(program_.atom_aovs_.size()));
    }
}

bool Automaton::live_aov(State state, std::size_t aov) const noexcept {
    return (live_sets_[index(state) * live_words_ + aov / 64] >> (aov % 64) & 1U) != 0;
}

Program Program::compile(std::span<const AovRequest> aovs, std::span<const Event> events,
                         const Limits& limits, Diagnostics& diagnostics) {
    return ProgramBuilder(aovs, events, limits, diagnostics).build();
}

ClassId Program::scatter_class(const Event& event) const {
    const auto found = columns_.find(event);
    LIGHTSIEVE_ASSERT(found != columns_.end() && !is_terminal(event.kind),
                      "the program was compiled without this scattering event");
    return found->second;
}

TerminalId Program::terminal(const Event& event) const {
    const auto found = columns_.find(event);
    LIGHTSIEVE_ASSERT(found != columns_.end() && is_terminal(event.kind),
                      "the program was compiled without this terminal event");
    return found->second;
}

std::size_t Program::table_bytes() const noexcept {
    std::size_t bytes = 0;
    for (const Automaton& automaton : automata_)
        bytes += automaton.table_bytes();
    return bytes;
}

}  // namespace lightsieve::lpe
