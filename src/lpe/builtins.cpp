#include "lpe/builtins.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lpe/cursor.h"
#include "lpe/lint.h"
#include "lpe/parse.h"
#include "lpe/references.h"

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kSpecular = "C<RS[^'coat']>.*";

// name, expression, Arnold 7's expression where it differs, meaning, part of the beauty
constexpr std::array kBuiltins{
    Builtin{"RGBA", "C.*", "", "all light: the beauty", ""},
    Builtin{"direct", "C[DSV]L", "", "direct light from all surfaces and volumes", ""},
    Builtin{"indirect", "C[DSV][DSVOB].*", "", "indirect light from all surfaces and volumes", ""},
    Builtin{"emission", "C[LO]", "", "lights and emissive objects seen directly by the camera",
            "emission"},
    Builtin{"background", "CB", "", "the background seen directly by the camera", "background"},
    Builtin{"diffuse", "C<RD>.*", "", "diffuse reflection", "diffuse"},
    Builtin{"specular", kSpecular, "C<RS[^'coat''sheen']>.*", "specular reflection without coat",
            "specular"},
    Builtin{"coat", "C<RS'coat'>.*", "", "coat reflection", "coat"},
    Builtin{"transmission", "C<TS>.*", "", "specular transmission", "transmission"},
    Builtin{"sss", "C<TD>.*", "", "subsurface scattering and diffuse transmission", "sss"},
    Builtin{"volume", "CV.*", "", "volume scattering", "volume"},
    Builtin{"albedo", "C[DSV]A", "", "albedo (reflectivity) at the first hit", ""},
    Builtin{"denoise_albedo", "((C<TD>A) (CVA) (C<RD>A))", "",
            "albedo of diffuse lobes and volumes, for denoisers", ""},
    Builtin{"diffuse_direct", "C<RD>L", "", "diffuse reflection, direct light", "diffuse"},
    Builtin{"diffuse_indirect", "C<RD>[DSVOB].*", "", "diffuse reflection, indirect light",
            "diffuse"},
    Builtin{"diffuse_albedo", "C<RD>A", "", "diffuse albedo", "diffuse"},
    Builtin{"specular_direct", "C<RS[^'coat']>L", "C<RS[^'coat''sheen']>L",
            "specular reflection, direct light", "specular"},
    Builtin{"specular_indirect", "C<RS[^'coat']>[DSVOB].*", "C<RS[^'coat''sheen']>[DSVOB].*",
            "specular reflection, indirect light", "specular"},
    Builtin{"specular_albedo", "C<RS[^'coat']>A", "C<RS[^'coat''sheen']>A", "specular albedo",
            "specular"},
    Builtin{"coat_direct", "C<RS'coat'>L", "", "coat reflection, direct light", "coat"},
    Builtin{"coat_indirect", "C<RS'coat'>[DSVOB].*", "", "coat reflection, indirect light",
            "coat"},
    Builtin{"coat_albedo", "C<RS'coat'>A", "", "coat albedo", "coat"},
    Builtin{"sheen", "C<RS'sheen'>.*", "", "sheen reflection", "sheen"},
    Builtin{"transmission_direct", "C<TS>L", "", "specular transmission, direct light",
            "transmission"},
    Builtin{"transmission_indirect", "C<TS>[DSVOB].*", "", "specular transmission, indirect light",
            "transmission"},
    Builtin{"transmission_albedo", "C<TS>A", "", "transmission albedo", "transmission"},
    Builtin{"sheen_direct", "C<RS'sheen'>L", "", "sheen reflection, direct light", "sheen"},
    Builtin{"sheen_indirect", "C<RS'sheen'>[DSVOB].*", "", "sheen reflection, indirect light",
            "sheen"},
    Builtin{"sheen_albedo", "C<RS'sheen'>A", "", "sheen albedo", "sheen"},
    Builtin{"sss_direct", "C<TD>L", "",
            "subsurface scattering and diffuse transmission, direct light", "sss"},
    Builtin{"sss_indirect", "C<TD>[DSVOB].*", "",
            "subsurface scattering and diffuse transmission, indirect light", "sss"},
    Builtin{"sss_albedo", "C<TD>A", "", "subsurface and diffuse transmission albedo", "sss"},
    Builtin{"volume_direct", "CVL", "", "volume scattering, direct light", "volume"},
    Builtin{"volume_indirect", "CV[DSVOB].*", "", "volume scattering, indirect light", "volume"},
    Builtin{"volume_albedo", "CVA", "", "single-scattering albedo of volumes", "volume"},
};

}  // namespace

std::span<const Builtin> builtins() { return kBuiltins; }

const Builtin* find_builtin(std::string_view name) {
    const std::string canonical = canonical_name(name);
    const auto row = std::ranges::find(kBuiltins, canonical, &Builtin::name);
    return row == kBuiltins.end() ? nullptr : &*row;
}

std::vector<std::vector<std::string_view>> additive_sets(BuiltinTable table) {
    std::vector<std::vector<std::string_view>> sets{
        {"direct", "indirect", "emission", "background"},
        {"diffuse", "specular", "coat", "transmission", "sss", "volume", "emission", "background"},
        {"diffuse_direct", "diffuse_indirect", "specular_direct", "specular_indirect", "coat",
         "transmission", "sss", "volume", "emission", "background"},
    };
    // Arnold 7 takes sheen out of specular.
    if (table == BuiltinTable::Arnold7)
        for (std::size_t i = 1; i < sets.size(); ++i)
            sets[i].push_back("sheen");
    return sets;
}

std::string canonical_name(std::string_view name) {
    if (name == "RGB") return "RGBA";
    if (name.starts_with("RGB_")) return "RGBA" + std::string(name.substr(3));
    return std::string(name);
}

ExpressionTable::ExpressionTable(BuiltinTable table) : table_(table) {
    Diagnostics diagnostics;
    for (const Builtin& row : kBuiltins) {
        const std::string_view text = row.expression_in(table);
        Expr expr = parse(text, stand_alone(text, "<built-in " + std::string(row.name) + ">"),
                          diagnostics);
        entries_.emplace(
            row.name, Entry{{std::string(row.name), std::string(text), std::move(expr)}, false});
    }
    LIGHTSIEVE_ASSERT(diagnostics.items().empty(), diagnostics.render());
}

void ExpressionTable::define(std::string_view definition, const SourceSpan& base,
                             Diagnostics& diagnostics) {
    Cursor in(definition, base, "", diagnostics);
    in.skip_blanks();
    const std::size_t name_begin = in.position();
    const std::size_t name_end =
        std::min(definition.find_first_of(kBlanks, name_begin), definition.size());
    in.move_to(name_end);
    in.skip_blanks();
    const std::size_t begin = in.position();
    if (name_begin == name_end)
        return in.error(Code::LpeEmpty, "a light path expression without a name", 0, 0,
                        "write the AOV's name, a blank, the expression");
    const std::string_view written = definition.substr(name_begin, name_end - name_begin);
    const std::string name = canonical_name(written);
    const std::string_view text = definition.substr(begin);
    // The expression's place is a part of the definition's, if that holds the text byte for byte.
    const SourceSpan where = in.span(begin, definition.size());
    Expr expr = parse(text, where, diagnostics,
                      {.aov_name = written, .standard = standard_, .keep_references = true});
    Expr unresolved = has_unresolved(expr) ? std::exchange(expr, nullptr) : nullptr;
    lint_expression(text, where, written, expr, diagnostics);
    const auto known = entries_.find(name);
    if (known != entries_.end() && known->second.is_custom)
        return in.error(Code::LpeTwice, "AOV " + in_quotes(written) + " is defined twice",
                        name_begin, name_end, "keep one of the two, or rename one");
    entries_.insert_or_assign(name, Entry{{name, std::string(text), std::move(expr)},
                                          true,
                                          std::string(written),
                                          where,
                                          std::move(unresolved)});
}

const NamedExpr* ExpressionTable::find(std::string_view name) const {
    const auto entry = entries_.find(canonical_name(name));
    return entry == entries_.end() ? nullptr : &entry->second.named;
}

std::vector<std::string> ExpressionTable::names() const {
    std::vector<std::string> names;
    for (const auto& [name, entry] : entries_)
        names.push_back(name);
    return names;
}

std::vector<NamedExpr> ExpressionTable::custom() const {
    std::vector<NamedExpr> out;
    for (const auto& [name, entry] : entries_)
        if (entry.is_custom) out.push_back(entry.named);
    return out;
}

}  // namespace lightsieve::lpe
