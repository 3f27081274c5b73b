#include "lpe/print.h"

#include <algorithm>

#include "lpe/cursor.h"

namespace lightsieve::lpe {
namespace {

std::string quoted(const std::string& label) { return "'" + label + "'"; }

std::string print_letters(const LetterTest& test) {
    switch (test.form) {
        case LetterTest::Form::Missing: return "";
        case LetterTest::Form::Any: return ".";
        case LetterTest::Form::One: return test.letters;
        case LetterTest::Form::OneOf: return "[" + test.letters + "]";
        case LetterTest::Form::NoneOf: return "[^" + test.letters + "]";
    }
    return "";
}

std::string print_labels(const LabelTest& test) {
    std::string labels;
    for (const std::string& label : test.labels)
        labels += quoted(label);
    switch (test.form) {
        case LabelTest::Form::Any: return ".";
        case LabelTest::Form::One: return labels;
        case LabelTest::Form::OneOf: return "[" + labels + "]";
        case LabelTest::Form::NoneOf: return "[^" + labels + "]";
    }
    return "";
}

std::string print_quantifier(const Repeat& repeat) {
    const bool unbounded = repeat.max == Repeat::kUnbounded;
    if (repeat.min == 0 && unbounded) return "*";
    if (repeat.min == 1 && unbounded) return "+";
    if (repeat.min == 0 && repeat.max == 1) return "?";
    const std::string min = std::to_string(repeat.min);
    if (unbounded) return "{" + min + ",}";
    if (repeat.min == repeat.max) return "{" + min + "}";
    return "{" + min + "," + std::to_string(repeat.max) + "}";
}

bool is_algebra(const Node& node) {
    return std::holds_alternative<Intersection>(node.form) ||
           std::holds_alternative<Difference>(node.form);
}

/// With parentheses where it would otherwise run into its surroundings: as the body of a repeat.
std::string print_as_item(const Node& node) {
    const bool open = std::holds_alternative<Sequence>(node.form) ||
                      std::holds_alternative<Repeat>(node.form) || is_algebra(node);
    return open ? "(" + print(node) + ")" : print(node);
}

std::string print_operands(const std::vector<Expr>& parts, const char* operation) {
    std::string out;
    for (const Expr& part : parts) {
        if (!out.empty()) out += operation;
        out += is_algebra(*part) ? "(" + print(*part) + ")" : print(*part);
    }
    return out;
}

/// `$name`, which a letter or digit must not follow.
bool is_open_ended(const Node& node) {
    const auto* reference = std::get_if<Reference>(&node.form);
    return reference != nullptr && std::ranges::all_of(reference->name, is_name_character);
}

struct Printer {
    std::string operator()(const Letter& letter) const { return {letter.letter}; }
    std::string operator()(const Dot&) const { return "."; }
    std::string operator()(const Label& label) const { return quoted(label.label); }
    std::string operator()(const Angle& angle) const {
        std::string out = "<" + print_letters(angle.kind) + print_letters(angle.lobe);
        for (const LabelTest& test : angle.labels)
            out += print_labels(test);
        return out + ">";
    }
    std::string operator()(const Brackets& brackets) const {
        std::string out = brackets.negated ? "[^" : "[";
        for (const Expr& item : brackets.items)
            out += print(*item);
        return out + "]";
    }
    std::string operator()(const Sequence& sequence) const {
        std::string out;
        bool open_ended = false;
        for (const Expr& part : sequence.parts) {
            const bool nested = std::holds_alternative<Sequence>(part->form) || is_algebra(*part);
            const std::string text = nested ? print_as_item(*part) : print(*part);
            if (open_ended && is_name_character(text[0])) out += ' ';
            out += text;
            open_ended = is_open_ended(*part);
        }
        return out;
    }
    std::string operator()(const Alternation& alternation) const {
        std::string out;
        for (const Expr& part : alternation.parts)
            out += (out.empty() ? "((" : "|(") + print(*part) + ")";
        return out + ")";
    }
    std::string operator()(const Repeat& repeat) const {
        return print_as_item(*repeat.body) + print_quantifier(repeat);
    }
    std::string operator()(const Intersection& all) const {
        return print_operands(all.parts, " & ");
    }
    std::string operator()(const Difference& difference) const {
        return print_operands(difference.parts, " - ");
    }
    std::string operator()(const Complement& complement) const {
        return "!(" + print(*complement.body) + ")";
    }
    std::string operator()(const Reference& reference) const {
        const bool plain = std::ranges::all_of(reference.name, is_name_character);
        return plain ? "$" + reference.name : "${" + reference.name + "}";
    }
};

}  // namespace

std::string print(const Node& node) { return std::visit(Printer{}, node.form); }
std::string print(const Expr& expr) { return expr ? print(*expr) : ""; }

}  // namespace lightsieve::lpe
