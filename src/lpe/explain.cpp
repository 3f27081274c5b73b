#include "lpe/explain.h"

#include <algorithm>
#include <array>
#include <optional>

#include "lpe/describe.h"
#include "lpe/enumerate.h"
#include "lpe/match.h"
#include "lpe/program.h"
#include "lpe/regions.h"
#include "lpe/words.h"

namespace lightsieve::lpe {
namespace {

using Texts = std::vector<std::string>;

/// AOVs that a paragraph names in one sentence; the others are counted.
constexpr std::size_t kMaxNamed = 8;

/// What one path differs in from another, in the order in which people are told.
enum class Change : std::uint8_t { Labels, Terminal, Scattering, Removed, Added, ToProbe };
constexpr std::array kChanges{Change::Labels,  Change::Terminal, Change::Scattering,
                              Change::Removed, Change::Added,    Change::ToProbe};

bool is_probe(const Event& event) { return event.kind == EventKind::Albedo; }
bool same_kind(const Event& a, const Event& b) { return a.kind == b.kind && a.lobe == b.lobe; }

/// The expression's automaton over a list of events, asked event by event.
class Judge {
  public:
    Judge(const Expr& expr, std::vector<Event> events, const Limits& limits)
        : events_(std::move(events)), program_(compile(expr, events_, limits)) {}

    /// The number of the first event that cannot stand where it does; nothing if the path is taken.
    [[nodiscard]] std::optional<std::size_t> first_fault(const Path& path) const {
        State state = automaton().start();
        for (std::size_t i = 1; i < path.size(); ++i) {
            if (!fits(state, path[i])) return i;
            if (!is_terminal(path[i].kind))
                state = automaton().step(state, program_.scatter_class(path[i]));
        }
        return std::nullopt;
    }

    /// Which events of `names` could stand after the first n events of the path.
    [[nodiscard]] EventSet possible(const Path& path, std::size_t n,
                                    const EventNames& names) const {
        State state = automaton().start();
        for (std::size_t i = 1; i < n; ++i)
            state = automaton().step(state, program_.scatter_class(path[i]));
        EventSet out;
        for (const Event& event : names.events())
            out.push_back(fits(state, event) && !(n == 1 && event.kind == EventKind::Albedo));
        return out;
    }

  private:
    static Program compile(const Expr& expr, std::span<const Event> events, const Limits& limits) {
        const std::array<AovRequest, 1> request{{{"", expr, GroupSelect::All, ""}}};
        Diagnostics diagnostics;
        Program program = Program::compile(request, events, limits, diagnostics);
        diagnostics.throw_if_errors();
        return program;
    }
    [[nodiscard]] const Automaton& automaton() const { return program_.automaton(0); }
    [[nodiscard]] bool fits(State state, const Event& event) const {
        if (is_terminal(event.kind))
            return automaton().atom(state, program_.terminal(event)) != kNoAtom;
        const State next = automaton().step(state, program_.scatter_class(event));
        return automaton().live_light(next) || automaton().live_probe(next);
    }

    std::vector<Event> events_;
    Program program_;
};

/// Finds near misses of the paths that are taken.
class NearMisses {
  public:
    NearMisses(const Judge& judge, const EventNames& names, std::span<const TakenPath> taken)
        : judge_(judge), names_(names), taken_(taken) {}

    std::vector<NearMiss> find(std::size_t n) {
        for (const Change change : kChanges)
            for (const TakenPath& taken : taken_)
                if (found_.size() < n && try_change(taken.path, change)) break;
        return std::move(found_);
    }

  private:
    /// Adds the first path that differs so from the taken one and is not taken itself.
    bool try_change(const Path& path, Change change) {
        for (std::size_t i = path.size(); i-- > 1;) {
            if (change == Change::Removed) {
                Path shorter = path;
                shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
                if (!is_terminal(path[i].kind) && add(std::move(shorter))) return true;
                continue;
            }
            for (const Event& event : names_.events())
                if (const std::optional<Path> other = changed(path, i, event, change))
                    if (add(*other)) return true;
        }
        return false;
    }

    [[nodiscard]] std::optional<Path> changed(const Path& path, std::size_t i, const Event& event,
                                              Change change) const {
        const bool terminal = is_terminal(path[i].kind);
        const bool is_other = event.labels == Texts{names_.other_group()};
        if (is_terminal(event.kind) != (terminal && change != Change::Added) || is_other)
            return std::nullopt;
        const Change kind_of_change = same_kind(event, path[i]) ? Change::Labels
                                      : is_probe(event)         ? Change::ToProbe
                                      : terminal                ? Change::Terminal
                                                                : Change::Scattering;
        Path out = path;
        if (change == Change::Added)
            out.insert(out.begin() + static_cast<std::ptrdiff_t>(i), event);
        else if (change == kind_of_change)
            out[i] = event;
        else
            return std::nullopt;
        return out;
    }

    bool add(Path path) {
        if (!is_path(path)) return false;
        const std::optional<std::size_t> fault = judge_.first_fault(path);
        const auto is_same = [&](const NearMiss& other) { return other.path == path; };
        if (!fault || std::ranges::any_of(found_, is_same)) return false;
        const Path before(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(*fault));
        std::string reason = "after " + print_path(before) + " it must " +
                             names_.doings(judge_.possible(path, *fault, names_));
        found_.push_back({path, path_in_words(path, names_.tells_groups()), std::move(reason)});
        return true;
    }

    const Judge& judge_;
    const EventNames& names_;
    std::span<const TakenPath> taken_;
    std::vector<NearMiss> found_;
};

/// How it lies to the other AOVs, equal ones first.
std::vector<RelatedAov> related_aovs(const Expr& expr, const ExplainOptions& options) {
    std::vector<AovRequest> requests{{"", expr, GroupSelect::All, ""}};
    std::vector<Expr> exprs{expr};
    for (const NamedExpr& other : options.others) {
        requests.push_back({other.name, other.expr, GroupSelect::All, ""});
        exprs.push_back(other.expr);
    }
    const std::vector<Event> all =
        options.events.empty() ? abstract_events(exprs, options.limits) : std::vector<Event>();
    const std::vector<Region> found =
        regions(requests, options.events.empty() ? all : options.events, options.limits);
    std::vector<RelatedAov> out;
    for (std::uint32_t i = 1; i < requests.size(); ++i) {
        const bool meets = std::ranges::any_of(found, [&](const Region& region) {
            return region.aovs.front() == 0 && std::ranges::binary_search(region.aovs, i);
        });
        if (meets) out.push_back({requests[i].name, relation(found, 0, i)});
    }
    std::ranges::stable_sort(out, {}, &RelatedAov::relation);
    return out;
}

/// What is easily misread in the expression, as sentences.
Texts notes_on(const Expr& expr, const Explanation& explanation) {
    bool names_default = false, transmits_diffusely = false;
    for_each_node(*expr, [&](const Node& node) {
        const auto* angle = std::get_if<Angle>(&node.form);
        if (angle == nullptr) return;
        transmits_diffusely =
            transmits_diffusely || (angle->kind.form == LetterTest::Form::One &&
                                    angle->kind.letters == "T" && angle->lobe.letters == "D");
        for (const LabelTest& test : angle->labels)
            names_default =
                names_default || std::ranges::find(test.labels, "default") != test.labels.end();
    });
    Texts out;
    if (names_default)
        out.emplace_back(
            "The group 'default' is literal in an expression: lights of no group. Light that "
            "comes "
            "from no light at all (O, B) is in an output named ..._default, but not here.");
    if (transmits_diffusely)
        out.emplace_back("Diffuse transmission includes subsurface scattering.");
    const auto ends_as_probe = [](const TakenPath& taken) {
        return taken.path.back().kind == EventKind::Albedo;
    };
    if (std::ranges::any_of(explanation.taken, ends_as_probe))
        out.emplace_back(
            "A probe is no light: it measures how much the surface or volume reflects.");
    return out;
}

std::string names_sentence(const Texts& names) {
    Texts shown(names.begin(),
                names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMaxNamed)));
    if (names.size() > kMaxNamed)
        shown.push_back(std::to_string(names.size() - kMaxNamed) + " more");
    return join_words(shown, "and");
}

}  // namespace

std::string Explanation::paragraph(const std::string& name) const {
    std::string out = name + " takes " + words + ".";
    Texts notes_and_relations = notes;
    const auto tell = [&](Relation wanted, const std::string& before, const std::string& after) {
        Texts names;
        for (const RelatedAov& aov : related)
            if (aov.relation == wanted) names.push_back(aov.name);
        if (!names.empty()) notes_and_relations.push_back(before + names_sentence(names) + after);
    };
    tell(Relation::Equal, "It is the same as ", ".");
    tell(Relation::Subset, "It is a part of ", ".");
    tell(Relation::Superset, "It contains ", ".");
    tell(Relation::Overlapping, "It shares some paths with ", ", which also have others.");
    for (const std::string& sentence : notes_and_relations)
        out += " " + sentence;
    return out;
}

Explanation explain(const Expr& expr, const ExplainOptions& options) {
    Explanation out;
    const EventNames names(std::span(&expr, 1));
    out.words = expression_in_words(expr, names);
    if (!expr) return out;
    const bool everywhere = options.events.empty();
    const std::vector<Path> paths =
        everywhere ? shortest_paths(expr, options.n_paths, options.limits)
                   : shortest_paths(expr, options.events, options.n_paths, options.limits);
    const EventNames scene_names(options.events);
    const EventNames& here = everywhere ? names : scene_names;
    for (const Path& path : paths)
        out.taken.push_back({path, path_in_words(path, here.tells_groups())});
    std::vector<Event> events = here.events();
    for (const Path& path : paths)
        events.insert(events.end(), path.begin() + 1, path.end());
    const Judge judge(expr, std::move(events), options.limits);
    out.near_misses = NearMisses(judge, here, out.taken).find(options.n_paths);
    out.related = related_aovs(expr, options);
    out.notes = notes_on(expr, out);
    return out;
}

}  // namespace lightsieve::lpe
