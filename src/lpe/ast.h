// An expression as it was written: tests of single events, put together by sequences,
// alternatives and repeats.
//
// Nodes are immutable and shared. Later stages only read them: print writes them back to text,
// lint looks for mistakes, term.h lowers them to what automata are made of. Every node remembers
// where it stood, so that a stage that finds something wrong can point at it; places do not take
// part in equality. The meaning of a single event's test (which events `D`, `'coat'` or `[^LO]`
// take) is in predicate.h.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/source.h"

namespace lightsieve::lpe {

struct Node;
/// Shared, because one expression is wanted by many AOVs (one for each light group) and outlives
/// the parser. Null stands for an expression that could not be read: it takes no path.
using Expr = std::shared_ptr<const Node>;

/// A test of the kind or of the lobe inside `<..>`.
struct LetterTest {
    enum class Form : std::uint8_t {
        Missing,  ///< nothing was written (a lobe only): always holds
        Any,      ///< `.`
        One,      ///< a letter
        OneOf,    ///< `[..]`
        NoneOf,   ///< `[^..]`
    };
    Form form = Form::Missing;
    std::string letters{};  ///< as written, for One, OneOf and NoneOf

    friend bool operator==(const LetterTest&, const LetterTest&) = default;
};

/// A test of an event's labels inside `<..>`.
struct LabelTest {
    enum class Form : std::uint8_t {
        Any,     ///< `.`: always holds
        One,     ///< `'a'`: carries a
        OneOf,   ///< `['a''b']`: carries one of them
        NoneOf,  ///< `[^'a''b']`: carries none of them
    };
    Form form = Form::Any;
    std::vector<std::string> labels{};  ///< as written
    SourceSpan where{};

    /// Places do not count.
    friend bool operator==(const LabelTest& a, const LabelTest& b) {
        return a.form == b.form && a.labels == b.labels;
    }
};

/// One of the letters C D S R T V L O B A.
struct Letter {
    char letter = 'C';
    friend bool operator==(const Letter&, const Letter&) = default;
};
/// `.`
struct Dot {
    friend bool operator==(const Dot&, const Dot&) = default;
};
/// `'coat'` outside `<..>`: any event that carries the label.
struct Label {
    std::string label;
    friend bool operator==(const Label&, const Label&) = default;
};
/// `<RS'coat'>`
struct Angle {
    LetterTest kind;
    LetterTest lobe;
    std::vector<LabelTest> labels;  ///< all of them must hold
    friend bool operator==(const Angle&, const Angle&) = default;
};
/// `[DSV]` and `[^'coat']`; every item is a single-event node other than Brackets.
struct Brackets {
    bool negated = false;
    std::vector<Expr> items;
};
/// Two or more parts, one after the other.
struct Sequence {
    std::vector<Expr> parts;
};
/// Two or more parts, one of which is taken.
struct Alternation {
    std::vector<Expr> parts;
};
/// `body{min,max}`; `*` is {0,}, `+` is {1,}, `?` is {0,1}.
struct Repeat {
    static constexpr std::uint32_t kUnbounded = UINT32_MAX;
    Expr body;
    std::uint32_t min = 0;
    std::uint32_t max = kUnbounded;
};

// ---- what we add to Arnold's language (docs/lpe-language.md, "Extensions") ----

/// `a & b`: two or more parts, all of which must take it.
struct Intersection {
    std::vector<Expr> parts;
};
/// `a - b - c`: what the first part takes and none of the others.
struct Difference {
    std::vector<Expr> parts;
};
/// `!(a)`: the light paths that `a` does not take, the same as `(C.* - (a))`.
struct Complement {
    Expr body;
};
/// `$name`: the expression of another AOV, as a group.
struct Reference {
    std::string name;
    Expr body;  ///< what the name stands for, shared with its owner; null until it is resolved
};

struct Node {
    std::variant<Letter, Dot, Label, Angle, Brackets, Sequence, Alternation, Repeat, Intersection,
                 Difference, Complement, Reference>
        form;
    SourceSpan where{};  ///< the node's text; unknown for trees that were built, not read
};

/// Same tree; places do not matter. Null equals only null.
[[nodiscard]] bool equal(const Expr& a, const Expr& b);

/// Does the node test a single event (a letter, `.`, a label, `<..>`, `[..]`)?
[[nodiscard]] bool is_event_test(const Node& node);

/// What the node is directly made of; nothing for a letter, `.`, a label, `<..>` and a reference that
/// was not resolved. The child of a reference is written elsewhere: its places are in that text.
[[nodiscard]] std::span<const Expr> children(const Node& node);

/// Calls `visit(node)` for the node and everything below it, parents first, left to right.
template <class Visit>
void for_each_node(const Node& node, const Visit& visit) {
    visit(node);
    for (const Expr& child : children(node))
        for_each_node(*child, visit);
}

/// The same without what references stand for: only what is written in this text.
template <class Visit>
void for_each_written_node(const Node& node, const Visit& visit) {
    visit(node);
    if (std::holds_alternative<Reference>(node.form)) return;
    for (const Expr& child : children(node))
        for_each_written_node(*child, visit);
}

/// Calls `visit(test)` for every test of a single event, left to right; `[..]` is one test, not
/// its items.
template <class Visit>
void for_each_event_test(const Node& node, const Visit& visit) {
    if (is_event_test(node)) return visit(node);
    for (const Expr& child : children(node))
        for_each_event_test(*child, visit);
}

/// An expression with its name, as options.light_path_expressions defines it.
struct NamedExpr {
    std::string name;
    std::string text;  ///< as written
    Expr expr;         ///< null if the text has an error
};

}  // namespace lightsieve::lpe
