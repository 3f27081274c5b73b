#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>

#include "core/diagnostics.h"
#include "lpe/dialects/dialect.h"
#include "lpe/dialects/translate.h"
#include "lpe/parse.h"
#include "python/errors.h"
#include "python/layers.h"
#include "python/text.h"

namespace nb = nanobind;
namespace dialects = lightsieve::lpe::dialects;
using namespace nb::literals;

namespace lightsieve::python {
namespace {

/// A path: its text and its words.
using Witness = std::optional<std::pair<std::string, std::string>>;

Witness witness(const std::optional<dialects::CommonPath>& path) {
    if (!path) return std::nullopt;
    return std::pair(dialects::print_path(*path), dialects::describe_path(*path));
}

struct TranslationResult {
    dialects::Translation translation;
    std::vector<Error> lints;
};
struct ReadingResult {
    dialects::AsRead reading;
    std::vector<Error> lints;
};

const dialects::Dialect& dialect_named(const std::string& name) {
    if (const dialects::Dialect* dialect = dialects::find_dialect(name)) return *dialect;
    std::vector<std::string> names;
    for (const dialects::Dialect* dialect : dialects::dialects())
        names.emplace_back(dialect->name);
    std::string hint = did_you_mean(name, names);
    if (hint.empty())
        for (const std::string& known : names)
            hint += (hint.empty() ? "there is " : ", ") + known;
    throw InputError(Error{Code::UnknownChoice, "no dialect \"" + name + "\"", {}, hint});
}

dialects::Without without_named(const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < dialects::kWithouts; ++i) {
        const auto without = static_cast<dialects::Without>(i);
        names.emplace_back(dialects::without_name(without));
        if (names.back() == name) return without;
    }
    throw InputError(Error{Code::UnknownChoice,
                           "a scene cannot be without \"" + name + "\"",
                           {},
                           did_you_mean(name, names)});
}

TranslationResult translate(const std::string& text, const std::string& source,
                            const std::string& target, const std::vector<std::string>& without) {
    std::vector<dialects::Without> left_out;
    for (const std::string& name : without)
        left_out.push_back(without_named(name));
    const dialects::Dialect &from = dialect_named(source), &to = dialect_named(target);
    Diagnostics diagnostics;
    auto out = dialects::translate(text, lpe::stand_alone(text), from, to, diagnostics,
                                   {.without = left_out});
    diagnostics.throw_if_errors();
    return {*std::move(out), diagnostics.items()};
}

ReadingResult read_as(const std::string& text, const std::string& dialect) {
    Diagnostics diagnostics;
    auto out =
        dialects::read_as(text, lpe::stand_alone(text), dialect_named(dialect), diagnostics);
    diagnostics.throw_if_errors();
    return {*std::move(out), diagnostics.items()};
}

std::vector<std::string> names_of(const std::vector<dialects::Without>& all) {
    std::vector<std::string> out;
    for (const dialects::Without without : all)
        out.emplace_back(dialects::without_name(without));
    return out;
}

void add_results(nb::module_& module) {
    constexpr auto kLints = "def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]";
    nb::class_<TranslationResult>(module, "TranslationResult", "What a translation came to.")
        .def_prop_ro("text", [](const TranslationResult& r) { return r.translation.text; })
        .def_prop_ro("exact", [](const TranslationResult& r) { return r.translation.exact; })
        .def_prop_ro("lost",
                     [](const TranslationResult& r) { return witness(r.translation.lost); })
        .def_prop_ro("added",
                     [](const TranslationResult& r) { return witness(r.translation.added); })
        .def_prop_ro("lost_prefixes",
                     [](const TranslationResult& r) { return r.translation.lost_prefixes; })
        .def_prop_ro(
            "exact_without",
            [](const TranslationResult& r) { return names_of(r.translation.exact_without); })
        .def_prop_ro("notes", [](const TranslationResult& r) { return r.translation.notes; })
        .def_prop_ro("unverified",
                     [](const TranslationResult& r) { return r.translation.unverified; })
        .def_prop_ro(
            "lints", [](const TranslationResult& r) { return to_python(r.lints); },
            nb::sig(kLints));
    nb::class_<ReadingResult>(module, "ReadingResult", "What a renderer reads a text as.")
        .def_prop_ro("text", [](const ReadingResult& r) { return r.reading.text; })
        .def_prop_ro("meant", [](const ReadingResult& r) { return r.reading.meant; })
        .def_prop_ro("differs", [](const ReadingResult& r) { return r.reading.differs; })
        .def_prop_ro("missed", [](const ReadingResult& r) { return witness(r.reading.missed); })
        .def_prop_ro("extra", [](const ReadingResult& r) { return witness(r.reading.extra); })
        .def_prop_ro("notes", [](const ReadingResult& r) { return r.reading.notes; })
        .def_prop_ro(
            "lints", [](const ReadingResult& r) { return to_python(r.lints); }, nb::sig(kLints));
}

}  // namespace

void add_dialects(nb::module_& module) {
    add_results(module);
    module.def("translate_dialect", &translate, "text"_a, "source"_a, "target"_a, "without"_a,
               "Translates an expression from one renderer's dialect to another's.");
    module.def("read_dialect", &read_as, "text"_a, "dialect"_a,
               "What a renderer does with a text, and what was most likely meant.");
    module.def(
        "dialects",
        [] {
            using Fact = std::pair<std::string_view, bool>;
            std::vector<std::tuple<std::string_view, std::string_view, std::vector<Fact>,
                                   std::vector<std::string_view>>>
                out;
            for (const dialects::Dialect* dialect : dialects::dialects()) {
                std::vector<Fact> facts;
                for (const dialects::Fact& fact : dialect->facts)
                    facts.emplace_back(fact.text, fact.verified);
                std::vector<std::string_view> prefixes;
                for (const dialects::Prefix& prefix : dialect->prefixes)
                    prefixes.push_back(prefix.spelled);
                out.emplace_back(dialect->name, dialect->title, std::move(facts),
                                 std::move(prefixes));
            }
            return out;
        },
        "Name, title, facts (text, verified) and prefixes of every dialect.");
    module.def(
        "scene_properties",
        [] {
            std::vector<std::pair<std::string_view, std::string_view>> out;
            for (std::size_t i = 0; i < dialects::kWithouts; ++i) {
                const auto without = static_cast<dialects::Without>(i);
                out.emplace_back(dialects::without_name(without),
                                 dialects::without_meaning(without));
            }
            return out;
        },
        "What a scene may be without, by name, with its meaning.");
}

}  // namespace lightsieve::python
