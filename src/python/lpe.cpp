#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>

#include "embed/flat_tables.h"
#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "lpe/cursor.h"
#include "lpe/describe.h"
#include "lpe/enumerate.h"
#include "lpe/explain.h"
#include "lpe/graph.h"
#include "lpe/lint.h"
#include "lpe/match.h"
#include "lpe/parse.h"
#include "lpe/print.h"
#include "lpe/regions.h"
#include "lpe/rest.h"
#include "lpe/words.h"
#include "python/errors.h"
#include "python/layers.h"
#include "python/text.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace lightsieve::python {
namespace {

lpe::BuiltinTable table_named(std::string_view name) {
    if (name == "reference") return lpe::BuiltinTable::Reference;
    if (name == "arnold7") return lpe::BuiltinTable::Arnold7;
    throw nb::value_error("table must be \"reference\" or \"arnold7\"");
}

/// An expression that was read without an error.
struct Expression {
    std::string text;  ///< as it was written, or what the name stands for
    std::string name;  ///< of the AOV, if a name was given
    lpe::Expr tree;    ///< never null
    std::vector<Error> lints;
};

/// What expressions are read in: the names that `$name` may mean, and whether our extensions are
/// allowed.
struct Names {
    lpe::ExpressionTable table;
    bool standard;

    Names(std::string_view table_name, const std::vector<std::string>& definitions,
          bool only_standard)
        : table(table_named(table_name)), standard(only_standard) {
        Diagnostics diagnostics;
        if (standard) table.require_standard();
        for (const std::string& definition : definitions)
            table.define(definition, lpe::stand_alone(definition, "<definition>"), diagnostics);
        table.resolve(diagnostics);
        diagnostics.throw_if_errors();
    }

    [[nodiscard]] std::optional<Expression> find(std::string_view name) const {
        const lpe::NamedExpr* found = table.find(name);
        if (found == nullptr || !found->expr) return std::nullopt;
        return Expression{found->text, found->name, found->expr, {}};
    }
};

/// Could a person have meant this as an AOV's name? Expressions start with a capital C.
bool looks_like_a_name(std::string_view text) {
    const auto is_name_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
    };
    return !text.empty() && !text.starts_with('C') && std::ranges::all_of(text, is_name_letter);
}

/// Reads an expression, or finds the AOV of that name where no expression reads so.
Expression read(const std::string& text, const Names& names) {
    Diagnostics diagnostics;
    lpe::ParseOptions options;
    options.standard = names.standard;
    options.names = &names.table;
    lpe::Expr tree = lpe::parse(text, lpe::stand_alone(text), diagnostics, options);
    if (!diagnostics.has_errors()) {
        lpe::lint_expression(text, lpe::stand_alone(text), "", tree, diagnostics);
        return {text, "", std::move(tree), diagnostics.items()};
    }
    if (std::optional<Expression> named = names.find(text)) return *std::move(named);
    std::string hint = did_you_mean(text, names.table.names());
    if (looks_like_a_name(text) && !hint.empty())
        throw InputError(Error{Code::LpeUnknownAov, "no AOV is called " + lpe::in_quotes(text),
                               lpe::stand_alone(text), std::move(hint)});
    diagnostics.throw_if_errors();
    throw nb::value_error("unreachable");
}

lpe::Path parse_path(const std::string& text) {
    Diagnostics diagnostics;
    std::optional<lpe::Path> path = lpe::parse_path(text, diagnostics);
    diagnostics.throw_if_errors();
    return std::move(*path);
}

/// Events as a scene prints them: `RS'coat'`, `L'key'`.
std::vector<Event> parse_events(const std::vector<std::string>& texts) {
    std::vector<Event> out;
    for (const std::string& text : texts) {
        const bool ends = text.find_first_of("LOBA") == 0;
        const lpe::Path path = parse_path(ends ? "C RD " + text : "C " + text + " L");
        out.push_back(ends ? path.back() : path[1]);
    }
    return out;
}

/// What paths are made of; nothing: all of them.
using Events = std::optional<std::vector<std::string>>;
/// A path as text, and in words.
using Witness = std::pair<std::string, std::string>;
using NamedExpression = std::pair<std::string, Expression>;

std::vector<lpe::Expr> trees(const std::vector<Expression>& expressions) {
    std::vector<lpe::Expr> out;
    for (const Expression& expression : expressions)
        out.push_back(expression.tree);
    return out;
}

/// Do lights of several groups matter to a reader of these paths?
bool names_groups(const std::vector<lpe::Expr>& exprs, const Events& events) {
    return events ? lpe::EventNames(parse_events(*events)).tells_groups()
                  : lpe::EventNames(std::span<const lpe::Expr>(exprs)).tells_groups();
}

Witness witness(const lpe::Path& path, bool with_groups) {
    return {lpe::print_path(path), lpe::path_in_words(path, with_groups)};
}

std::string_view relation_text(lpe::Relation relation) {
    switch (relation) {
        case lpe::Relation::Equal: return "equal";
        case lpe::Relation::Subset: return "subset";
        case lpe::Relation::Superset: return "superset";
        case lpe::Relation::Overlapping: return "overlapping";
        case lpe::Relation::Disjoint: break;
    }
    return "disjoint";
}

std::string_view fault_text(lpe::PartitionReport::Fault fault) {
    switch (fault) {
        case lpe::PartitionReport::Fault::None: return "none";
        case lpe::PartitionReport::Fault::Lost: return "lost";
        case lpe::PartitionReport::Fault::Twice: return "twice";
        case lpe::PartitionReport::Fault::Outside: break;
    }
    return "outside";
}

/// Fault, witness (nothing if there is none), numbers of the two parts for `twice`.
std::tuple<std::string_view, std::optional<Witness>, std::size_t, std::size_t> partition(
    const Expression& whole, const std::vector<Expression>& parts, const Events& events) {
    std::vector<lpe::Expr> exprs = trees(parts);
    const lpe::PartitionReport report =
        events ? lpe::check_partition(whole.tree, exprs, parse_events(*events))
               : lpe::check_partition(whole.tree, exprs);
    exprs.push_back(whole.tree);
    std::optional<Witness> shown;
    if (!report.holds()) shown = witness(report.witness, names_groups(exprs, events));
    return {fault_text(report.fault), shown, report.first, report.second};
}

std::tuple<std::string_view, std::optional<Witness>, std::optional<Witness>,
           std::optional<Witness>>
compare(const Expression& a, const Expression& b, const Events& events) {
    const lpe::Comparison found = events ? lpe::compare(a.tree, b.tree, parse_events(*events))
                                         : lpe::compare(a.tree, b.tree);
    const bool with_groups = names_groups({a.tree, b.tree}, events);
    const auto shown = [&](const std::optional<lpe::Path>& path) {
        return path ? std::optional(witness(*path, with_groups)) : std::nullopt;
    };
    return {relation_text(found.relation), shown(found.only_a), shown(found.only_b),
            shown(found.both)};
}

std::optional<std::string> rest(const Expression& whole, const std::vector<Expression>& parts,
                                const Events& events) {
    const std::vector<lpe::Expr> exprs = trees(parts);
    const lpe::Expr left = events ? lpe::rest(whole.tree, exprs, parse_events(*events))
                                  : lpe::rest(whole.tree, exprs);
    return left ? std::optional(lpe::print(left)) : std::nullopt;
}

/// Everything that `explain` says, ready to show.
struct ExplanationTexts {
    std::string words, paragraph;
    std::vector<std::string> notes;
    std::vector<Witness> taken;
    std::vector<std::tuple<std::string, std::string, std::string>> near_misses;
    std::vector<std::pair<std::string, std::string_view>> related;
    std::vector<Error> lints;
};

ExplanationTexts explain(const Expression& expression, const std::string& subject,
                         const std::vector<NamedExpression>& others, const Events& events) {
    std::vector<lpe::NamedExpr> named;
    for (const auto& [name, other] : others)
        named.push_back({name, other.text, other.tree});
    const std::vector<Event> scene = events ? parse_events(*events) : std::vector<Event>();
    const lpe::Explanation found =
        lpe::explain(expression.tree, {.others = named, .events = scene});
    ExplanationTexts out;
    out.words = found.words;
    out.paragraph = found.paragraph(subject);
    out.notes = found.notes;
    for (const lpe::TakenPath& taken : found.taken)
        out.taken.emplace_back(lpe::print_path(taken.path), taken.words);
    for (const lpe::NearMiss& miss : found.near_misses)
        out.near_misses.emplace_back(lpe::print_path(miss.path), miss.words, miss.reason);
    for (const lpe::RelatedAov& aov : found.related)
        out.related.emplace_back(aov.name, relation_text(aov.relation));
    out.lints = expression.lints;
    if (events) {
        Diagnostics diagnostics;
        lpe::lint_in_scene(expression.tree, "", scene, diagnostics);
        out.lints.insert(out.lints.end(), diagnostics.items().begin(), diagnostics.items().end());
    }
    return out;
}

/// One AOV of a set: its expression (nothing: none could be read) and the light group that it is
/// restricted to (empty: none; `default`: what is in no named one).
using SetMember = std::tuple<std::optional<Expression>, std::string>;

lpe::AovRequest request_of(const SetMember& member) {
    const auto& [expression, group] = member;
    lpe::AovRequest out;
    if (expression) out.expr = expression->tree;
    out.group = group;
    if (!group.empty())
        out.select = group == "default" ? lpe::GroupSelect::Default : lpe::GroupSelect::Named;
    return out;
}

/// How a set of AOVs divides the light.
class AovSet {
  public:
    AovSet(const std::vector<SetMember>& members, const std::vector<std::string>& groups,
           const Events& events)
        : n_aovs_(members.size()) {
        std::vector<lpe::AovRequest> requests;
        std::vector<lpe::Expr> exprs;
        for (const SetMember& member : members) {
            requests.push_back(request_of(member));
            exprs.push_back(requests.back().expr);
        }
        with_groups_ = !groups.empty() || names_groups(exprs, events);
        regions_ = lpe::regions(
            requests, events ? parse_events(*events) : lpe::possible_events(requests, groups));
    }

    [[nodiscard]] std::string_view relation(std::uint32_t a, std::uint32_t b) const {
        return relation_text(lpe::relation(regions_, index(a), index(b)));
    }
    /// A shortest path of one that is in all of `in` and in none of `out`.
    [[nodiscard]] std::optional<Witness> example(const std::vector<std::uint32_t>& in,
                                                 const std::vector<std::uint32_t>& out) const {
        for (const lpe::Region& region : regions_) {
            const auto holds = [&](std::uint32_t aov) {
                return std::ranges::binary_search(region.aovs, aov);
            };
            if (std::ranges::all_of(in, holds) && std::ranges::none_of(out, holds))
                return witness(region.example, with_groups_);
        }
        return std::nullopt;
    }
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> sums(std::uint32_t whole) const {
        std::vector<std::vector<std::uint32_t>> out;
        for (lpe::Sum& sum : lpe::find_sums(regions_, n_aovs_, index(whole)))
            out.push_back(std::move(sum.parts));
        return out;
    }
    [[nodiscard]] std::vector<std::uint32_t> nearest(std::uint32_t whole) const {
        return lpe::nearest_parts(regions_, n_aovs_, index(whole));
    }

  private:
    [[nodiscard]] std::uint32_t index(std::uint32_t aov) const {
        if (aov >= n_aovs_) throw nb::index_error("the set has no such AOV");
        return aov;
    }

    std::size_t n_aovs_;
    bool with_groups_ = false;
    std::vector<lpe::Region> regions_;
};

std::string graph(const std::vector<NamedExpression>& expressions, const Events& events) {
    std::vector<lpe::NamedExpr> named;
    for (const auto& [name, expression] : expressions)
        named.push_back({name, expression.text, expression.tree});
    return lpe::graph(named, events ? parse_events(*events) : std::vector<Event>());
}

void add_expressions(nb::module_& module) {
    nb::class_<Expression>(module, "Expression",
                           "A light path expression that was read without an error.")
        .def_ro("text", &Expression::text,
                "The expression as it was written, also where a name was given.")
        .def_ro("name", &Expression::name, "The AOV's name if one was given; else empty.")
        .def_prop_ro(
            "lints", [](const Expression& e) { return to_python(e.lints); },
            nb::sig("def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]"),
            "What is legal in it but probably not meant.")
        .def_prop_ro(
            "normal", [](const Expression& e) { return lpe::print(e.tree); },
            "The expression in its normal spelling.");
    nb::class_<Names>(module, "Names", "What `$name` and names of AOVs mean.")
        .def(nb::init<std::string_view, const std::vector<std::string>&, bool>(),
             "table"_a = "reference", "definitions"_a = std::vector<std::string>{},
             "standard"_a = false,
             "The built-ins of a table and `NAME EXPRESSION` definitions; raises LightsieveError "
             "with every error in them.")
        .def("find", &Names::find, "name"_a, "The expression of that name, or None.")
        .def("names", [](const Names& n) { return n.table.names(); }, "All names, sorted.");
    module.def("read", &read, "text"_a, "names"_a,
               "Reads an expression, or finds the AOV of that name where no expression reads so; "
               "raises LightsieveError with every error in it.");
}

/// A program as flat arrays, with the texts of its events.
struct Tables {
    embed::FlatTables flat;
    std::vector<std::string> events;
};

/// The arrays of a program of all these expressions, over these events or one event of each class.
Tables tables(const std::vector<NamedExpression>& expressions, const Events& events) {
    std::vector<lpe::AovRequest> requests;
    std::vector<lpe::Expr> exprs;
    for (const auto& [name, expression] : expressions) {
        requests.push_back({name, expression.tree});
        exprs.push_back(expression.tree);
    }
    const std::vector<Event> made = events ? parse_events(*events) : lpe::abstract_events(exprs);
    Diagnostics diagnostics;
    const lpe::Program program = lpe::Program::compile(requests, made, {}, diagnostics);
    diagnostics.throw_if_errors();
    std::optional<embed::FlatTables> flat = embed::flatten(program, made);
    if (!flat)
        throw InputError(Error{Code::LimitLpeTable,
                               "the AOVs together need too large a table",
                               {},
                               "ask for fewer AOVs at once"});
    Tables out{*std::move(flat), {}};
    for (const Event& event : made)
        out.events.push_back(lpe::print_event(event));
    return out;
}

/// Numbers of 32 bits in the machine's order.
nb::bytes to_bytes(const std::vector<std::uint32_t>& numbers) {
    return nb::bytes(numbers.data(), numbers.size() * sizeof(std::uint32_t));
}

void add_flat_tables(nb::module_& module) {
    using embed::FlatTables;
    const auto bytes_of = [](std::vector<std::uint32_t> FlatTables::* field) {
        return [field](const Tables& t) { return to_bytes(t.flat.*field); };
    };
    nb::class_<Tables>(module, "Tables", "A program as flat arrays of 32-bit numbers.")
        .def_prop_ro("table", bytes_of(&FlatTables::table), "Rows: flags, next states, atoms.")
        .def_prop_ro(
            "stride", [](const Tables& t) { return t.flat.stride; }, "Numbers a row.")
        .def_prop_ro(
            "first_terminal", [](const Tables& t) { return t.flat.first_terminal; },
            "Column of the first atom.")
        .def_prop_ro("starts", bytes_of(&FlatTables::starts), "Start of each automaton.")
        .def_prop_ro("event_columns", bytes_of(&FlatTables::event_columns), "Of each event.")
        .def_prop_ro("atom_begin", bytes_of(&FlatTables::atom_begin), "Into `atom_aovs`.")
        .def_prop_ro("atom_aovs", bytes_of(&FlatTables::atom_aovs), "The AOVs of each atom.")
        .def_ro("events", &Tables::events, "The events as paths write them.");
    module.def("tables", &tables, "expressions"_a, "events"_a = nb::none(),
               "Compiles named expressions to flat arrays.");
}

void add_questions(nb::module_& module) {
    module.def(
        "match",
        [](const Expression& e, const std::string& path) {
            return lpe::match(e.tree, parse_path(path));
        },
        "expression"_a, "path"_a, "Does the expression take the path?");
    module.def(
        "print_path", [](const std::string& path) { return lpe::print_path(parse_path(path)); },
        "path"_a, "The path in its normal spelling.");
    module.def(
        "path_in_words",
        [](const std::string& path) { return lpe::path_in_words(parse_path(path)); }, "path"_a,
        "The path in words.");
    module.def("partition", &partition, "whole"_a, "parts"_a, "events"_a = nb::none(),
               "Fault (none, lost, twice, outside), its witness, and the two parts of `twice`.");
    module.def("compare", &compare, "a"_a, "b"_a, "events"_a = nb::none(),
               "Relation, and shortest paths of only a, only b, and both.");
    module.def("rest", &rest, "whole"_a, "parts"_a, "events"_a = nb::none(),
               "What the parts leave over of the whole, or None.");
    module.def(
        "shortest_paths",
        [](const Expression& e, std::size_t n, const Events& events) {
            std::vector<std::string> out;
            for (const lpe::Path& path :
                 events ? lpe::shortest_paths(e.tree, parse_events(*events), n)
                        : lpe::shortest_paths(e.tree, n))
                out.push_back(lpe::print_path(path));
            return out;
        },
        "expression"_a, "n"_a, "events"_a = nb::none(),
        "The shortest paths that the expression takes, differing in more than labels.");
    module.def(
        "count_paths",
        [](const Expression& e, std::size_t length, const Events& events) {
            return lpe::count_paths(
                e.tree,
                events ? parse_events(*events) : lpe::abstract_events(std::span(&e.tree, 1)),
                length);
        },
        "expression"_a, "length"_a, "events"_a = nb::none(),
        "How many different paths of that many events the expression takes; 2^64 - 1: at least.");
    module.def("graph", &graph, "expressions"_a, "events"_a = nb::none(),
               "The smallest automaton of named expressions as Graphviz text.");
    nb::class_<ExplanationTexts>(module, "Explanation", "What an expression takes, in words.")
        .def_ro("words", &ExplanationTexts::words, "A noun.")
        .def_ro("paragraph", &ExplanationTexts::paragraph, "All but the paths.")
        .def_ro("notes", &ExplanationTexts::notes, "What is easily misread.")
        .def_ro("taken", &ExplanationTexts::taken, "Paths, each with its words.")
        .def_ro("near_misses", &ExplanationTexts::near_misses,
                "Paths that are not taken, each with its words and the reason.")
        .def_ro("related", &ExplanationTexts::related, "Names of AOVs with how it lies to them.")
        .def_prop_ro(
            "lints", [](const ExplanationTexts& e) { return to_python(e.lints); },
            nb::sig("def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]"),
            "What is legal in it but probably not meant.");
    module.def("explain", &explain, "expression"_a, "subject"_a, "others"_a,
               "events"_a = nb::none(), "Explains an expression; `subject` starts the paragraph.");
    nb::class_<AovSet>(module, "AovSet", "How a set of AOVs divides the light.")
        .def(nb::init<const std::vector<SetMember>&, const std::vector<std::string>&,
                      const Events&>(),
             "members"_a, "groups"_a, "events"_a = nb::none(),
             "Each member is an expression, or None, and a light group or an empty string; "
             "`groups` "
             "are all that lights can be in.")
        .def("relation", &AovSet::relation, "a"_a, "b"_a,
             "equal, subset, superset, overlapping or disjoint.")
        .def("example", &AovSet::example, "inside"_a, "outside"_a,
             "A shortest path in all AOVs of the first list and in none of the second, or None.")
        .def("sums", &AovSet::sums, "whole"_a, "Sets of AOVs that add up to it.")
        .def("nearest", &AovSet::nearest, "whole"_a,
             "AOVs without common paths that take the most of it.");
}

void add_tables(nb::module_& module) {
    nb::class_<lpe::Builtin>(module, "Builtin", "A built-in AOV.")
        .def_ro("name", &lpe::Builtin::name, "Its name in `options.outputs`.")
        .def_ro("meaning", &lpe::Builtin::meaning, "One line for people.")
        .def_ro("part", &lpe::Builtin::part,
                "The part of the beauty that it belongs to; empty for sums of parts.")
        .def(
            "expression",
            [](const lpe::Builtin& b, std::string_view table) {
                return b.expression_in(table_named(table));
            },
            "table"_a = "reference", "Its expression in the table `reference` or `arnold7`.");
    module.def(
        "builtins",
        [] {
            const auto all = lpe::builtins();
            return std::vector<lpe::Builtin>(all.begin(), all.end());
        },
        "All built-in AOVs, in the order of the reference page.");
    module.def(
        "error_codes",
        [] {
            std::vector<std::pair<std::string_view, std::string_view>> out;
            for (Code code : all_codes())
                out.emplace_back(code_text(code), code_meaning(code));
            return out;
        },
        "Every code with what it means, in the order of the reference.");
    module.def(
        "additive_sets",
        [](std::string_view table) { return lpe::additive_sets(table_named(table)); },
        "table"_a = "reference", "The sets of built-ins that add up to the beauty.");
}

}  // namespace

void add_lpe(nb::module_& module) {
    add_expressions(module);
    add_questions(module);
    add_flat_tables(module);
    add_tables(module);
}

}  // namespace lightsieve::python
