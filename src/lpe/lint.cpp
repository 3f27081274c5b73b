#include "lpe/lint.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "lpe/cursor.h"
#include "lpe/parse.h"
#include "lpe/predicate.h"
#include "lpe/references.h"

namespace lightsieve::lpe {
namespace {

/// Labels that shaders of our own give, whether or not a scene has them: excluding them is no
/// mistake.
constexpr std::array<std::string_view, 3> kWellKnownLabels{"coat", "sheen", "hair"};

std::string prefix(std::string_view aov_name) {
    return aov_name.empty() ? "" : "AOV " + in_quotes(aov_name) + ": ";
}

/// Runs a lint that proves something; one over budget says nothing.
template <class Lint>
void within_budget(const Lint& lint) {
    try {
        lint();
    } catch (const InputError&) {
    }
}

Expr make(auto form) { return std::make_shared<const Node>(Node{std::move(form), {}}); }

bool takes_kind(const Node& test, EventKind kind) {
    for (const EventLobe lobe : {EventLobe::None, EventLobe::Diffuse, EventLobe::Specular})
        if (takes(test, {kind, lobe, {}})) return true;
    return false;
}

/// `L'key'`: a label right after a test of light, which people mean as the light's group.
bool has_group_after_light(const Node& root) {
    bool found = false;
    for_each_written_node(root, [&](const Node& node) {
        const auto* sequence = std::get_if<Sequence>(&node.form);
        if (sequence == nullptr) return;
        for (std::size_t i = 0; i + 1 < sequence->parts.size(); ++i) {
            const Node& part = *sequence->parts[i];
            found = found || (is_event_test(part) && takes_kind(part, EventKind::Light) &&
                              !takes_kind(part, EventKind::Volume) &&
                              std::holds_alternative<Label>(sequence->parts[i + 1]->form));
        }
    });
    return found;
}

/// Is it a sequence of whole expressions, each of which would take paths on its own?
bool is_sequence_of_expressions(const Node& root) {
    const auto* sequence = std::get_if<Sequence>(&root.form);
    return sequence != nullptr && std::ranges::all_of(sequence->parts, [](const Expr& part) {
               return shortest_path(part).has_value();
           });
}

/// Why an expression that takes no path takes none.
std::string never_hint(const Expr& expr) {
    const Expr any = make(Repeat{make(Dot{}), 0, Repeat::kUnbounded});
    const Expr end = make(Brackets{false, {make(Dot{}), make(Letter{'A'})}});
    if (is_sequence_of_expressions(*expr)) return "alternatives are written ((..)|(..))";
    if (has_group_after_light(*expr)) return "light of a group is written <L.'key'>";
    if (shortest_path(make(Sequence{{make(Letter{'C'}), expr}})))
        return "start it with the camera C";
    if (shortest_path(make(Sequence{{expr, any, end}})))
        return "end it with one of L O B A, or .*";
    return "C can stand only first, L O B A only last";
}

/// The operands of an expression, each of which should take something, and what is wrong if not.
std::pair<std::span<const Expr>, const char*> operands(const Node& node) {
    if (std::holds_alternative<Alternation>(node.form))
        return {children(node), "this alternative can never take any path"};
    if (std::holds_alternative<Difference>(node.form))
        return {children(node).subspan(1), "this takes nothing away: it can never take any path"};
    if (std::holds_alternative<Complement>(node.form))
        return {children(node), "this excludes nothing: it can never take any path"};
    return {};
}

void lint_never(const Expr& expr, std::string_view aov_name, Diagnostics& diagnostics) {
    if (!shortest_path(expr))
        return diagnostics.lint(Code::LpeNever, prefix(aov_name) + "this can never take any path",
                                expr->where, never_hint(expr));
    const auto [parts, problem] = operands(*expr);
    for (const Expr& part : parts)
        if (!shortest_path(part))
            diagnostics.lint(Code::LpeNever, prefix(aov_name) + problem, part->where,
                             never_hint(part));
}

void lint_mixed(const Expr& expr, std::string_view aov_name, Diagnostics& diagnostics) {
    if (takes_light(expr) && takes_probe(expr))
        diagnostics.lint(Code::LpeMixed,
                         prefix(aov_name) + "this takes light and albedo probes together",
                         expr->where, "the sum means nothing: make it two AOVs");
}

/// Reads the text as OSL would and asks whether that makes a difference.
void lint_binding(std::string_view text, const SourceSpan& base, std::string_view aov_name,
                  const Expr& expr, Diagnostics& diagnostics) {
    // What a name stands for does not change how far a bar reaches.
    Diagnostics unused;
    const auto read = [&](AlternationBinding binding) {
        ParseOptions options{aov_name, binding};
        options.keep_references = true;
        return parse(text, base, unused, options);
    };
    const Expr tight = read(AlternationBinding::Tight);
    if (equal(tight, read(AlternationBinding::Loose))) return;
    if (tight && !has_unresolved(tight) && equivalent(tight, expr)) return;
    Cursor in(text, base, aov_name, diagnostics);
    // The first bar outside of labels.
    while (in.peek() != '|' && !in.at_end())
        if (in.peek() == '\'')
            (void)in.read_label();
        else
            in.take();
    in.lint(Code::LpeBinding, "OSL and RenderMan would choose between the two events beside \"|\"",
            in.position(), in.position() + 1, "write ((..)|(..)), which all of them read alike");
}

// ---- in a scene ----

/// The labels that a scene's events carry.
struct SceneLabels {
    std::set<std::string> lobes;   ///< of scattering and emission
    std::set<std::string> groups;  ///< of lights

    explicit SceneLabels(std::span<const Event> events) {
        for (const Event& event : events) {
            const bool light =
                event.kind == EventKind::Light || event.kind == EventKind::Background;
            (light ? groups : lobes).insert(event.labels.begin(), event.labels.end());
        }
        groups.insert("default");
    }
};

std::string nearest_hint(const std::string& label, const std::set<std::string>& names,
                         const char* what) {
    const std::string guess = did_you_mean(label, {names.begin(), names.end()});
    if (!guess.empty()) return guess;
    if (names.empty()) return std::string("nothing in the scene has a ") + what;
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + in_quotes(name);
    return std::string("the scene has the ") + what + "s " + list;
}

class SceneLint {
  public:
    SceneLint(std::string_view aov_name, std::span<const Event> events, Diagnostics& diagnostics)
        : prefix_(prefix(aov_name)), labels_(events), diagnostics_(diagnostics) {}

    void check(const Node& node) {
        if (const auto* label = std::get_if<Label>(&node.form)) check_bare(*label, node.where);
        const auto* angle = std::get_if<Angle>(&node.form);
        if (angle == nullptr) return;
        const auto may_be = [&](EventKind kind) { return may_be_kind(angle->kind, kind); };
        const bool light = may_be(EventKind::Light) || may_be(EventKind::Background);
        const bool lobe = may_be(EventKind::Reflection) || may_be(EventKind::Transmission) ||
                          may_be(EventKind::Volume) || may_be(EventKind::Object);
        for (const LabelTest& test : angle->labels)
            for (const std::string& label : test.labels)
                check_label(label, light, lobe, test.form == LabelTest::Form::NoneOf, test.where);
    }
    [[nodiscard]] bool found() const { return found_; }

  private:
    void check_bare(const Label& label, const SourceSpan& where) {
        if (labels_.groups.contains(label.label))
            diagnostics_.lint(Code::LpeLabelIsGroup,
                              prefix_ + in_quotes(label.label) + " is also a light group", where,
                              "its light is <L.'" + label.label + "'>; this takes lobes too");
        else
            check_label(label.label, true, true, false, where);
    }

    void check_label(const std::string& label, bool light, bool lobe, bool negated,
                     const SourceSpan& where) {
        const bool known =
            (light && labels_.groups.contains(label)) || (lobe && labels_.lobes.contains(label));
        if (known) return;
        // Excluding what is not there is harmless, unless it looks like a slip.
        std::set<std::string> names = lobe ? labels_.lobes : std::set<std::string>{};
        if (light) names.insert(labels_.groups.begin(), labels_.groups.end());
        if (negated && (std::ranges::find(kWellKnownLabels, label) != kWellKnownLabels.end() ||
                        did_you_mean(label, {names.begin(), names.end()}).empty()))
            return;
        found_ = true;
        const std::string what = !lobe    ? "no light in group "
                                 : !light ? "no lobe labelled "
                                          : "no lobe or light group ";
        const char* kind = !lobe ? "light group" : "label";
        const bool is_group = !light && labels_.groups.contains(label);
        diagnostics_.lint(Code::LpeLabelUnknown, prefix_ + what + in_quotes(label), where,
                          is_group ? "it is a light group: <L.'" + label + "'>"
                                   : nearest_hint(label, names, kind));
    }

    std::string prefix_;
    SceneLabels labels_;
    Diagnostics& diagnostics_;
    bool found_ = false;
};

}  // namespace

void lint_expression(std::string_view text, const SourceSpan& base, std::string_view aov_name,
                     const Expr& expr, Diagnostics& diagnostics) {
    if (!expr) return;
    within_budget([&] { lint_never(expr, aov_name, diagnostics); });
    within_budget([&] { lint_mixed(expr, aov_name, diagnostics); });
    within_budget([&] { lint_binding(text, base, aov_name, expr, diagnostics); });
}

void lint_in_scene(const Expr& expr, std::string_view aov_name, std::span<const Event> events,
                   Diagnostics& diagnostics) {
    if (!expr) return;
    SceneLint lint(aov_name, events, diagnostics);
    for_each_written_node(*expr, [&](const Node& node) { lint.check(node); });
    if (lint.found()) return;
    // Say it only where the scene, not the expression itself, is the reason.
    within_budget([&] {
        if (!shortest_path(expr, events) && shortest_path(expr))
            diagnostics.lint(Code::LpeNothingHere,
                             prefix(aov_name) + "this takes no path of this scene", expr->where,
                             "no shader, light or medium of the scene makes the events it needs");
    });
}

void lint_overlaps(std::span<const LintOutput> outputs, Diagnostics& diagnostics) {
    const auto part_of = [](const LintOutput& output) {
        const Builtin* row = find_builtin(output.name);
        return row == nullptr ? std::string_view{} : row->part;
    };
    // Only AOVs of different parts of the beauty are added up: nobody adds `diffuse` to
    // `diffuse_direct`. Where two parts overlap so do their direct, indirect and albedo AOVs; the
    // first pair stands for all of them.
    struct Overlap {
        const LintOutput *a, *b;
        Path both;
        std::size_t n_more = 0;
    };
    std::map<std::pair<std::string_view, std::string_view>, Overlap> overlaps;
    const auto check = [&](const LintOutput& a, const LintOutput& b) {
        const std::string_view part_a = part_of(a), part_b = part_of(b);
        if (part_a.empty() || part_b.empty() || part_a == part_b) return;
        std::optional<Path> both = shortest_common_path(a.expr, b.expr);
        if (!both) return;
        const auto [entry, is_new] =
            overlaps.try_emplace(std::minmax(part_a, part_b), Overlap{&a, &b, {}});
        if (is_new)
            entry->second.both = *std::move(both);
        else
            ++entry->second.n_more;
    };
    within_budget([&] {
        for (std::size_t i = 0; i < outputs.size(); ++i)
            for (std::size_t j = i + 1; j < outputs.size(); ++j)
                check(outputs[i], outputs[j]);
    });
    for (const auto& [parts, overlap] : overlaps) {
        const bool sheen = parts.first == "sheen" || parts.second == "sheen";
        const std::string more =
            overlap.n_more == 0
                ? ""
                : " (so do " + std::to_string(overlap.n_more) + " more pairs like this)";
        diagnostics.lint(Code::LpeOverlap,
                         in_quotes(overlap.a->name) + " and " + in_quotes(overlap.b->name) +
                             " both take " + in_quotes(print_path(overlap.both)) +
                             ": added up, that counts twice" + more,
                         overlap.b->where,
                         sheen ? "the table of Arnold 7 takes sheen out of specular"
                               : "leave one of them out of the sum");
    }
}

}  // namespace lightsieve::lpe
