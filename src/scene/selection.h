// Selection expressions of operators: which nodes they act on.
//
//     /pSphere1/*                      names, with * ? [abc] as wildcards; * also takes the slashes of paths
//     *.(@node=='polymesh')            a type of node
//     car^*.(visibility==255 and matte==off)    values of parameters or user data, here of nodes in the procedural car
//     * and not (ground or #trees)     combined; #NAME is a collection
//     r'tree_(small|tall)[0-9]*'       a regular expression without counts, for the whole name
//
// A name is compared with the pattern as the file writes it and with its path through procedurals, PROCEDURAL^NAME or
// PROCEDURAL/NAME. Words of a row (`a b`) mean: any of them. Where Arnold's own rules are not public we take what its
// exporters write.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "scene/graph.h"

namespace lightsieve {

class Selection {
  public:
    /// Parentheses and `not`s within one another.
    static constexpr int kMaxNesting = 64;

    /// A node with the path of the procedurals around it, e.g. "car^"; empty for the scene's own nodes.
    struct Candidate {
        const NodeInstance* node = nullptr;
        std::string_view prefix;
    };
    /// Whether a node is in the collection of that name.
    using InCollection = std::function<bool(Name collection, const Candidate& candidate)>;

    /// Reads an expression. What is wrong is an InputError with code operator-selection and a place in `where`, the
    /// expression as a quoted text of the scene file, where that is known.
    [[nodiscard]] static Selection parse(std::string_view text, const SourceSpan& where);

    Selection(Selection&&) noexcept;
    Selection& operator=(Selection&&) noexcept;
    ~Selection();

    [[nodiscard]] bool matches(const Candidate& candidate, const InCollection& collections) const;
    /// The same for a name of something that is no node; conditions and collections hold for none.
    [[nodiscard]] bool matches_text(std::string_view name) const;
    /// The name patterns in it, for "did you mean".
    [[nodiscard]] std::vector<std::string> patterns() const;

  private:
    friend class SelectionParser;
    struct Term;
    explicit Selection(std::unique_ptr<Term> root);
    std::unique_ptr<Term> root_;
};

/// Whether `name` fits a pattern with * ? and [abc], [a-z], [!abc]. Linear in time and space but for the stars.
[[nodiscard]] bool glob_matches(std::string_view pattern, std::string_view name);

}  // namespace lightsieve
