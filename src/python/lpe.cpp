#include "lpe/builtins.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <string>

#include "lpe/match.h"
#include "lpe/parse.h"
#include "python/errors.h"
#include "python/layers.h"

namespace nb = nanobind;

namespace lightsieve::python {
namespace {

/// An expression that was read without an error.
struct Expression {
    std::string text;  ///< as it was written
    lpe::Expr tree;    ///< never null
    std::vector<Error> lints;
};

lpe::BuiltinTable table_named(std::string_view name) {
    if (name == "reference") return lpe::BuiltinTable::Reference;
    if (name == "arnold7") return lpe::BuiltinTable::Arnold7;
    throw nb::value_error("table must be \"reference\" or \"arnold7\"");
}

Expression parse(const std::string& text) {
    Diagnostics diagnostics;
    lpe::Expr tree = lpe::parse(text, diagnostics);
    diagnostics.throw_if_errors();
    return {text, std::move(tree), diagnostics.items()};
}

lpe::Path parse_path(const std::string& text) {
    Diagnostics diagnostics;
    std::optional<lpe::Path> path = lpe::parse_path(text, diagnostics);
    diagnostics.throw_if_errors();
    return std::move(*path);
}

}  // namespace

void add_lpe(nb::module_& module) {
    nb::class_<Expression>(module, "Expression",
                           "A light path expression that was read without an error.")
        .def_ro("text", &Expression::text, "The expression as it was written.")
        .def_prop_ro(
            "lints", [](const Expression& e) { return to_python(e.lints); },
            nb::sig("def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]"),
            "What is legal in it but probably not meant.")
        .def("__repr__", [](const Expression& e) {
            return "lightsieve.lpe.parse(" + nb::cast<std::string>(nb::repr(nb::cast(e.text))) +
                   ")";
        });
    module.def("parse", &parse, nb::arg("text"),
               "Reads an expression; raises LightsieveError with every error in it.");

    module.def(
        "match",
        [](const Expression& e, const std::string& path) {
            return lpe::match(e.tree, parse_path(path));
        },
        nb::arg("expression"), nb::arg("path"), "Does the expression take the path?");
    module.def(
        "print_path", [](const std::string& path) { return lpe::print_path(parse_path(path)); },
        nb::arg("path"), "The path in its normal spelling.");

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
            nb::arg("table") = "reference",
            "Its expression in the table `reference` or `arnold7`.");
    module.def(
        "builtins",
        [] {
            const auto all = lpe::builtins();
            return std::vector<lpe::Builtin>(all.begin(), all.end());
        },
        "All built-in AOVs, in the order of the reference page.");
    module.def(
        "find_builtin",
        [](std::string_view name) -> std::optional<lpe::Builtin> {
            const lpe::Builtin* row = lpe::find_builtin(name);
            return row == nullptr ? std::nullopt : std::optional(*row);
        },
        nb::arg("name"), "The built-in AOV of that name, or None.");
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
        nb::arg("table") = "reference", "The sets of built-ins that add up to the beauty.");
}

}  // namespace lightsieve::python
