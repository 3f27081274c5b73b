#include "lpe/dialects/writer.h"

#include <set>
#include <utility>

#include "lpe/limits.h"
#include "lpe/parse.h"

namespace lightsieve::lpe::dialects {
namespace {

[[noreturn]] void too_long() {
    throw OverBudget{Code::LimitLpeLength,
                     "is longer than " + std::to_string(kMaxTextLength) + " bytes",
                     "kMaxTextLength"};
}

std::string quantifier(const Pattern& repeat, Repeats repeats) {
    const bool unbounded = repeat.max == Pattern::kUnbounded;
    if (unbounded && repeat.min == 0) return "*";
    if (unbounded && repeat.min == 1) return "+";
    if (repeats == Repeats::All && repeat.min == 0 && repeat.max == 1) return "?";
    const std::string min = std::to_string(repeat.min);
    if (unbounded) return "{" + min + ",}";
    if (repeat.min == repeat.max) return "{" + min + "}";
    return "{" + min + "," + std::to_string(repeat.max) + "}";
}

std::string print(const Pattern& pattern, Repeats repeats) {
    std::string out;
    switch (pattern.form) {
        case Pattern::Form::Event: return pattern.text;
        case Pattern::Form::Sequence:
            for (const PatternPtr& part : pattern.parts)
                out += print(*part, repeats);
            break;
        case Pattern::Form::Alternation:
            for (const PatternPtr& part : pattern.parts)
                out += (out.empty() ? "((" : "|(") + print(*part, repeats) + ")";
            out += ")";
            break;
        case Pattern::Form::Repeat: {
            const Pattern& body = *pattern.parts[0];
            const bool open =
                body.form == Pattern::Form::Sequence || body.form == Pattern::Form::Repeat;
            out = print(body, repeats);
            if (open) out = "(" + out + ")";
            out += quantifier(pattern, repeats);
            break;
        }
        default: break;
    }
    if (out.size() > kMaxTextLength) too_long();
    return out;
}

/// Repeats that are not * or + written out. A part that may be left out becomes two alternatives,
/// with it and without it.
class Expander {
  public:
    /// What a part takes: `rest`, and the path of no events if `maybe_none` (or if `rest` does).
    struct Split {
        bool maybe_none = false;
        PatternPtr rest;
    };

    Split split(const Pattern& pattern) {
        count(1);
        switch (pattern.form) {
            case Pattern::Form::Empty: return {true, make_nothing()};
            case Pattern::Form::Sequence: {
                Split out{true, make_nothing()};
                for (std::size_t i = pattern.parts.size(); i-- > 0;)
                    out = before(split(*pattern.parts[i]), std::move(out));
                return out;
            }
            case Pattern::Form::Alternation: {
                Split out;
                std::vector<PatternPtr> parts;
                for (const PatternPtr& part : pattern.parts) {
                    Split one = split(*part);
                    out.maybe_none = out.maybe_none || one.maybe_none;
                    parts.push_back(std::move(one.rest));
                }
                out.rest = one_of(std::move(parts));
                return out;
            }
            case Pattern::Form::Repeat: return split_repeat(pattern);
            default: return {false, std::make_shared<Pattern>(pattern)};
        }
    }

  private:
    void count(std::size_t n) {
        n_nodes_ += n;
        if (n_nodes_ > kMaxTextLength) too_long();
    }

    /// a, then b.
    Split before(const Split& a, Split b) {
        if (b.maybe_none && b.rest->form == Pattern::Form::Nothing) return a;
        count(count_nodes(*b.rest));
        std::vector<PatternPtr> parts{make_sequence({a.rest, b.rest})};
        if (b.maybe_none) parts.push_back(a.rest);
        if (a.maybe_none) parts.push_back(b.rest);
        return {a.maybe_none && b.maybe_none, one_of(std::move(parts))};
    }

    /// Alternatives without duplicates.
    static PatternPtr one_of(std::vector<PatternPtr> parts) {
        PatternPtr all = make_alternation(std::move(parts));
        if (all->form != Pattern::Form::Alternation) return all;
        std::set<std::string> texts;
        std::vector<PatternPtr> distinct;
        for (const PatternPtr& part : all->parts)
            if (texts.insert(print(*part, Repeats::All)).second) distinct.push_back(part);
        return make_alternation(std::move(distinct));
    }

    Split split_repeat(const Pattern& pattern) {
        const Split body = split(*pattern.parts[0]);
        const std::uint32_t min = body.maybe_none ? 0 : pattern.min;
        if (pattern.max == Pattern::kUnbounded) {
            PatternPtr many = make_repeat(body.rest, min == 0 ? 0 : 1, Pattern::kUnbounded);
            std::vector<PatternPtr> parts(min > 1 ? min - 1 : 0, body.rest);
            count(parts.size() * count_nodes(*body.rest));
            parts.push_back(std::move(many));
            return {false, make_sequence(std::move(parts))};
        }
        Split out{true, make_nothing()};
        for (std::uint32_t i = pattern.max; i-- > 0;)
            out = before({i >= min, body.rest}, std::move(out));
        return out;
    }

    std::size_t n_nodes_ = 0;
};

/// Does something follow the parenthesis that the text starts with?
bool goes_on_after_parenthesis(std::string_view text) {
    if (!text.starts_with('(')) return false;
    std::size_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        quoted = quoted != (text[i] == '\'');
        if (quoted) continue;
        if (text[i] == '(') ++depth;
        if (text[i] == ')' && --depth == 0) return i + 1 < text.size();
    }
    return false;
}

}  // namespace

std::string write(const Pattern& pattern, Repeats repeats) {
    PatternPtr expanded;
    if (repeats == Repeats::StarAndPlus) expanded = Expander().split(pattern).rest;
    std::string text = print(expanded ? *expanded : pattern, repeats);
    return goes_on_after_parenthesis(text) ? "(" + text + ")" : text;
}

}  // namespace lightsieve::lpe::dialects
