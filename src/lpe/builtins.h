// The built-in light path AOVs, as data, and the table of names that a scene's own expressions
// extend.
//
// The reference page's table is the list; Arnold 7's differs in `specular` only, so a row holds
// both readings. Adding a built-in is one row in builtins.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "lpe/ast.h"

namespace lightsieve::lpe {

/// Which reading of the built-ins a render uses.
enum class BuiltinTable : std::uint8_t {
    Reference,  ///< Arnold 5's page: `specular` includes sheen
    Arnold7,    ///< `specular` excludes sheen
};

struct Builtin {
    std::string_view name;
    std::string_view expression;  ///< as the reference page writes it
    std::string_view arnold7;     ///< the same in Arnold 7's table; empty: no difference
    std::string_view meaning;     ///< one line for people
    std::string_view
        part;  ///< the part of the beauty that it belongs to (`specular` for `specular_direct`);
               ///< AOVs of different parts get added up. Empty: it is a sum of parts

    [[nodiscard]] std::string_view expression_in(BuiltinTable table) const {
        return table == BuiltinTable::Arnold7 && !arnold7.empty() ? arnold7 : expression;
    }
};

/// All built-ins, in the order of the reference page, each name once.
[[nodiscard]] std::span<const Builtin> builtins();
/// The row of that name (`RGB` finds `RGBA`), or null.
[[nodiscard]] const Builtin* find_builtin(std::string_view name);

/// The sets of built-ins that the reference page says add up to the beauty; with sheen where the
/// table needs it.
[[nodiscard]] std::vector<std::vector<std::string_view>> additive_sets(BuiltinTable table);

/// `RGB` is another name of `RGBA`, also before a group suffix (`RGB_key`, `RGB_*`); other names
/// are kept.
[[nodiscard]] std::string canonical_name(std::string_view name);

/// Every expression that an output can name: the custom ones first, then the built-ins they do not
/// replace.
class ExpressionTable {
  public:
    explicit ExpressionTable(BuiltinTable table = BuiltinTable::Reference);

    /// Refuse what we add to Arnold's language in every `define` from now on (lpe-standard).
    void require_standard() { standard_ = true; }

    /// Adds one string of options.light_path_expressions, "name expression", split at the first
    /// white space.
    ///
    /// definition   the string
    /// base         where it stands, see `parse`
    /// diagnostics  gets syntax errors, lints, a second definition of the name, a missing
    ///              expression
    /// An expression with an error is kept with a null tree: its AOV is black, not unknown. So is
    /// one that names others (`$name`) until `resolve`.
    void define(std::string_view definition, const SourceSpan& base, Diagnostics& diagnostics);
    /// Puts in what `$name` stands for, in whatever order the expressions were defined. Call it once
    /// after the last `define`.
    ///
    /// diagnostics  gets unknown names, cycles (also of a custom expression with itself, even if a
    ///              built-in has its name), and the lints of the expressions that name others
    void resolve(Diagnostics& diagnostics);

    /// The expression of that name (`RGB` finds `RGBA`), or null. The pointer lives until the next
    /// `define`.
    [[nodiscard]] const NamedExpr* find(std::string_view name) const;
    /// All names, sorted.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] BuiltinTable table() const { return table_; }
    /// The custom expressions, by name.
    [[nodiscard]] std::vector<NamedExpr> custom() const;

  private:
    struct Entry {
        NamedExpr named;
        bool is_custom;
        std::string written{};  ///< the name as the definition writes it
        SourceSpan where{};     ///< of the text
        Expr unresolved{};  ///< with references whose bodies are null; null: nothing to resolve
    };
    friend class ReferenceResolver;
    BuiltinTable table_;
    bool standard_ = false;
    std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace lightsieve::lpe
