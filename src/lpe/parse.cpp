#include "lpe/parse.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "lpe/builtins.h"
#include "lpe/cursor.h"
#include "lpe/parse_event.h"
#include "lpe/references.h"

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kQuantifiers = "*+?{";
constexpr std::string_view kDigits = "0123456789";
/// What ends a sequence.
constexpr std::string_view kOperators = "|)&-";

/// A recursive-descent parser, one method per rule of the grammar, in the grammar's order.
///
/// A method that finds an error reports it, skips what is wrong and returns null; its caller goes
/// on without that part. Any error makes the whole result null, so such parts are never looked at.
/// Nesting is bounded, so the recursion is.
class Parser {
  public:
    Parser(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
           const ParseOptions& options)
        : in_(text, base, options.aov_name, diagnostics),
          binding_(options.binding),
          standard_(options.standard) {}

    Expr parse_all();

  private:
    /// One part of a sequence and what the blank rule needs to know about it.
    struct Part {
        Expr expr;
        std::size_t begin = 0, end = 0;  ///< bytes, parentheses and quantifier included
        bool is_group = false;           ///< is `(..)`
        bool has_quantifier = false;
        bool blank_before = false;
    };

    Expr parse_alternation(bool in_parentheses);
    Expr parse_algebra(Expr left, std::size_t begin);
    bool take_operator(char c);
    std::vector<Part> parse_sequence();
    Part parse_item();
    Part parse_repeat();
    std::optional<Repeat> parse_quantifier();
    std::optional<Repeat> parse_counts(std::size_t begin);
    std::optional<std::uint32_t> parse_number();
    Expr parse_group();
    Expr parse_complement();
    Expr parse_reference();

    void reject_extension(const std::string& what, std::size_t begin);
    void reject_empty(bool whole, bool in_parentheses);
    [[nodiscard]] bool blanks_make_alternatives(const std::vector<Part>& parts);
    [[nodiscard]] Expr sequence_of(std::vector<Part> parts) const;
    [[nodiscard]] Expr alternation_of(std::vector<Expr> parts, std::size_t begin) const;
    [[nodiscard]] bool too_many_errors() const {
        return in_.n_errors() >= kMaxErrorsPerExpression;
    }
    template <class Form>
    [[nodiscard]] Expr make(Form form, std::size_t begin, std::size_t end) const {
        return std::make_shared<const Node>(Node{std::move(form), in_.span(begin, end)});
    }

    Cursor in_;
    AlternationBinding binding_;
    bool standard_;
    std::size_t depth_ = 0;
    std::size_t n_chained_ = 0;  ///< operators that make the tree deeper without parentheses
    bool first_ = true;  ///< no event stands before the cursor: a small c may be the camera
};

Expr Parser::parse_all() {
    const std::size_t length = in_.text().size();
    if (length > kMaxTextLength) {
        in_.error(Code::LimitLpeLength, "the expression has " + std::to_string(length) + " bytes",
                  0, 1, "the limit kMaxTextLength is " + std::to_string(kMaxTextLength));
        return nullptr;
    }
    Expr expr = parse_alternation(false);
    // Outside parentheses only a ")" too many stops an alternation; read on for further errors.
    while (!in_.at_end() && !too_many_errors()) {
        in_.reject_character();
        in_.skip_blanks();
        if (!in_.at_end() && in_.peek() != ')') (void)parse_alternation(false);
    }
    return in_.n_errors() == 0 ? expr : nullptr;
}

/// alternation = algebra { "|" algebra }; in parentheses also the alternatives that blanks make.
Expr Parser::parse_alternation(bool in_parentheses) {
    in_.skip_blanks();
    const std::size_t begin = in_.position();
    const bool first = first_;
    std::vector<Expr> alternatives;
    do {
        first_ = first;
        const std::size_t errors_before = in_.n_errors();
        std::vector<Part> parts = parse_sequence();
        const bool whole = alternatives.empty() && !in_.peek_is_one_of("|&-");
        if (parts.empty() && in_.n_errors() == errors_before) reject_empty(whole, in_parentheses);
        if (whole && in_parentheses && blanks_make_alternatives(parts)) {
            for (Part& part : parts)
                alternatives.push_back(std::move(part.expr));
            break;
        }
        const std::size_t left_begin = parts.empty() ? in_.position() : parts.front().begin;
        first_ = first;
        alternatives.push_back(parse_algebra(sequence_of(std::move(parts)), left_begin));
    } while (!too_many_errors() && in_.take_if('|'));
    if (alternatives.size() == 1) return alternatives[0];
    return alternation_of(std::move(alternatives), begin);
}

/// algebra = sequence { ("&" | "-") sequence }, from left to right; the first sequence, which began
/// at `begin`, is `left`. A run of one operator is one node.
Expr Parser::parse_algebra(Expr left, std::size_t begin) {
    const bool first = first_;
    char last = '\0';
    while (in_.peek_is_one_of("&-") && !too_many_errors()) {
        const char c = in_.peek();
        if (!take_operator(c)) return nullptr;
        first_ = first;
        const std::size_t errors_before = in_.n_errors();
        std::vector<Part> parts = parse_sequence();
        const std::size_t end = parts.empty() ? in_.position() : parts.back().end;
        if (parts.empty() && in_.n_errors() == errors_before)
            in_.error(Code::LpeOperator, "nothing after " + in_quotes({&c, 1}), in_.position(),
                      in_.position() + (in_.at_end() ? 0 : 1),
                      "both sides are expressions: C.* - CD.*");
        const Expr right = sequence_of(std::move(parts));
        std::vector<Expr> all{left, right};
        if (c == last) {
            const std::span<const Expr> before = children(*left);
            all.assign(before.begin(), before.end());
            all.push_back(right);
        }
        left = c == '&' ? make(Intersection{std::move(all)}, begin, end)
                        : make(Difference{std::move(all)}, begin, end);
        last = c;
    }
    return left;
}

/// Takes `&` or `-`; false if it is one too many.
bool Parser::take_operator(char c) {
    const std::size_t at = in_.position();
    const auto is_blank = [&](std::size_t i) {
        return i < in_.text().size() && kBlanks.find(in_.text()[i]) != std::string_view::npos;
    };
    in_.take();
    const std::string written = in_quotes({&c, 1});
    if (standard_)
        reject_extension(written, at);
    else if (at == 0 || !is_blank(at - 1) || !is_blank(at + 1))
        in_.error(Code::LpeOperator, written + " without blanks round it", at, at + 1,
                  "write \"a " + std::string{c} + " b\"");
    if (++n_chained_ <= kMaxNesting) return true;
    in_.error(Code::LimitLpeNesting, "too many & and -", at, at + 1,
              "the limit kMaxNesting is " + std::to_string(kMaxNesting) +
                  "; many expressions together are ((..)|(..))");
    in_.abandon();
    return false;
}

void Parser::reject_extension(const std::string& what, std::size_t begin) {
    in_.error(Code::LpeStandard, what + " is no part of Arnold's language", begin, in_.position(),
              "only the standard language is allowed here (--lpe-standard)");
}

/// sequence = item { item }, up to an operator, `)` or the end.
std::vector<Parser::Part> Parser::parse_sequence() {
    std::vector<Part> parts;
    const bool first = first_;
    bool only_groups = true;
    bool blank = in_.skip_blanks();
    while (!in_.at_end() && !in_.peek_is_one_of(kOperators) && !too_many_errors()) {
        // In ((cDL) (cVL)) each group may turn out to start an alternative.
        if (first && only_groups && blank && in_.peek() == '(') first_ = true;
        Part part = parse_item();
        part.blank_before = blank;
        blank = in_.skip_blanks();
        first_ = false;
        only_groups = only_groups && part.is_group && !part.has_quantifier;
        if (part.expr) parts.push_back(std::move(part));
    }
    return parts;
}

/// item = repeat; where `|` binds tightly: repeat { "|" repeat }.
Parser::Part Parser::parse_item() {
    Part item = parse_repeat();
    if (binding_ == AlternationBinding::Loose) return item;
    std::vector<Expr> alternatives{item.expr};
    const bool first = first_;
    in_.skip_blanks();
    while (in_.take_if('|')) {
        in_.skip_blanks();
        if (in_.at_end() || in_.peek_is_one_of(kOperators)) break;
        first_ = first;
        Part next = parse_repeat();
        item.end = next.end;
        item.is_group = false;
        alternatives.push_back(std::move(next.expr));
        in_.skip_blanks();
    }
    in_.move_to(item.end);
    if (alternatives.size() > 1) item.expr = alternation_of(std::move(alternatives), item.begin);
    return item;
}

/// repeat = atom [ quantifier ]
Parser::Part Parser::parse_repeat() {
    Part part;
    part.begin = in_.position();
    if (in_.peek_is_one_of(kQuantifiers)) {
        if (parse_quantifier())
            in_.error(Code::LpeQuantifier, "a quantifier with nothing before it", part.begin,
                      in_.position(), "any number of any events is .*");
        part.end = in_.position();
        return part;
    }
    part.is_group = in_.peek() == '(';
    part.expr = part.is_group            ? parse_group()
                : in_.peek() == '!'      ? parse_complement()
                : in_.starts_reference() ? parse_reference()
                                         : parse_event(in_, first_);
    for (part.end = in_.position(); in_.skip_blanks(), in_.peek_is_one_of(kQuantifiers);
         part.end = in_.position()) {
        const std::size_t begin = in_.position();
        std::optional<Repeat> repeat = parse_quantifier();
        if (repeat && part.has_quantifier)
            in_.error(Code::LpeQuantifier, "a second quantifier", begin, in_.position(),
                      "to repeat a repetition use parentheses: (" +
                          std::string(in_.text(part.begin, part.end)) + ")" +
                          std::string(in_.text(begin, in_.position())));
        part.has_quantifier = true;
        if (!repeat || !part.expr) continue;
        repeat->body = std::move(part.expr);
        part.expr = make(*std::move(repeat), part.begin, in_.position());
    }
    in_.move_to(part.end);
    return part;
}

/// quantifier = "*" | "+" | "?" | "{" n [ "," [ m ] ] "}"; the body is left null.
std::optional<Repeat> Parser::parse_quantifier() {
    const std::size_t begin = in_.position();
    switch (in_.take()) {
        case '*': return Repeat{nullptr, 0, Repeat::kUnbounded};
        case '+': return Repeat{nullptr, 1, Repeat::kUnbounded};
        case '?': return Repeat{nullptr, 0, 1};
        default: return parse_counts(begin);
    }
}

/// The counts of a repeat, the "{" at `begin` being read.
std::optional<Repeat> Parser::parse_counts(std::size_t begin) {
    const std::optional<std::uint32_t> min = parse_number();
    const bool comma = in_.take_if(',');
    const std::optional<std::uint32_t> max = comma ? parse_number() : min;
    const auto reject = [&](Code code, std::string message, std::string hint) {
        in_.error(code, std::move(message), begin, in_.position(), std::move(hint));
        return std::nullopt;
    };
    if (!in_.take_if('}')) {
        const std::size_t close = in_.text().find('}', begin);
        if (close == std::string_view::npos)
            return reject(Code::LpeUnclosed, "\"{\" is never closed",
                          "a repeat is {n}, {n,} or {n,m}");
        in_.move_to(close + 1);
        return reject(Code::LpeQuantifier,
                      in_quotes(in_.text(begin, in_.position())) + " is no repeat",
                      "a repeat is {n}, {n,} or {n,m}");
    }
    const std::string written = in_quotes(in_.text(begin, in_.position()));
    if (!min)
        return reject(
            Code::LpeQuantifier, written + " is no repeat",
            max ? "write {0," + std::to_string(*max) + "}" : "a repeat is {n}, {n,} or {n,m}");
    if (std::max(*min, max.value_or(0)) > kMaxRepeat)
        return reject(
            Code::LimitLpeRepeat, "a repeat of more than " + std::to_string(kMaxRepeat),
            "the limit kMaxRepeat is " + std::to_string(kMaxRepeat) + "; any number is * or {n,}");
    if (max && *max < *min)
        return reject(Code::LpeQuantifier, written + " ends before it starts",
                      "write {" + std::to_string(*max) + "," + std::to_string(*min) + "}");
    return Repeat{nullptr, *min, max.value_or(Repeat::kUnbounded)};
}

/// Digits between blanks; a number over the limit becomes the limit + 1.
std::optional<std::uint32_t> Parser::parse_number() {
    in_.skip_blanks();
    if (!in_.peek_is_one_of(kDigits)) return std::nullopt;
    std::uint32_t value = 0;
    while (in_.peek_is_one_of(kDigits)) {
        const auto digit = static_cast<std::uint32_t>(in_.take() - '0');
        value = std::min(value * 10 + digit, kMaxRepeat + 1);
    }
    in_.skip_blanks();
    return value;
}

/// "(" alternation ")"
Expr Parser::parse_group() {
    const std::size_t begin = in_.position();
    in_.take();
    if (depth_ >= kMaxNesting) {
        in_.error(Code::LimitLpeNesting, "parentheses are nested too deep", begin, begin + 1,
                  "the limit kMaxNesting is " + std::to_string(kMaxNesting));
        in_.abandon();
        return nullptr;
    }
    ++depth_;
    Expr inner = parse_alternation(true);
    --depth_;
    if (in_.take_if(')')) return inner;
    if (!in_.abandoned() && !too_many_errors())
        in_.error(Code::LpeUnclosed, "\"(\" is never closed", begin, begin + 1,
                  "close it with \")\"");
    return nullptr;
}

/// "!" "(" alternation ")"
Expr Parser::parse_complement() {
    const std::size_t begin = in_.position();
    in_.take();
    if (standard_) reject_extension("\"!\"", begin);
    in_.skip_blanks();
    if (in_.peek() != '(') {
        in_.error(Code::LpeOperator, "\"!\" without parentheses", begin, begin + 1,
                  "all light but that of a is !(a); an event that is no D is [^D]");
        return nullptr;
    }
    Expr body = parse_group();
    if (!body) return nullptr;
    return make(Complement{std::move(body)}, begin, in_.position());
}

/// "$" name | "$" "{" name "}"
Expr Parser::parse_reference() {
    const std::size_t begin = in_.position();
    in_.take();
    std::string name;
    if (in_.take_if('{')) {
        const std::size_t close = in_.text().find('}', begin);
        if (close == std::string_view::npos) {
            in_.error(Code::LpeUnclosed, "\"${\" is never closed", begin, begin + 2,
                      "close it: ${diffuse}");
            in_.abandon();
            return nullptr;
        }
        name = in_.text(begin + 2, close);
        in_.move_to(close + 1);
        if (name.empty()) {
            in_.error(Code::LpeReference, "a name of no letters", begin, in_.position(),
                      "name an AOV: ${diffuse}");
            return nullptr;
        }
    } else {
        while (is_name_character(in_.peek()))
            name += in_.take();
    }
    if (standard_) reject_extension(in_quotes(in_.text(begin, in_.position())), begin);
    return make(Reference{std::move(name), nullptr}, begin, in_.position());
}

/// whole: it is the whole expression or group that is empty, not one of its alternatives.
void Parser::reject_empty(bool whole, bool in_parentheses) {
    const std::size_t begin = in_.position();
    const std::size_t end = begin + (in_.at_end() ? 0 : 1);
    if (in_.peek_is_one_of("&-"))
        in_.error(Code::LpeOperator, "nothing before " + in_quotes(in_.text(begin, end)), begin,
                  end, "both sides are expressions: C.* - CD.*");
    else if (!whole)
        in_.error(Code::LpeEmpty, "nothing on one side of \"|\"", begin, end,
                  "a part that may be missing is written (..)?");
    else if (in_parentheses)
        in_.error(Code::LpeEmpty, "nothing between the parentheses", begin, end,
                  "a part that may be missing is written (..)?");
    else
        in_.error(Code::LpeEmpty, "the expression is empty", begin, end, "all light is C.*");
}

/// The reference page writes alternatives as ((C<TD>A) (CVA)): a parenthesis that holds nothing
/// but groups, every pair of them separated by blanks.
bool Parser::blanks_make_alternatives(const std::vector<Part>& parts) {
    const auto is_group = [](const Part& part) { return part.is_group; };
    const auto is_repeated = [](const Part& part) { return part.has_quantifier; };
    if (parts.size() < 2 || !std::all_of(parts.begin(), parts.end(), is_group)) return false;
    const auto n_blanks = std::count_if(parts.begin() + 1, parts.end(),
                                        [](const Part& part) { return part.blank_before; });
    const bool all_blank = n_blanks == static_cast<std::ptrdiff_t>(parts.size()) - 1;
    const bool repeated = std::any_of(parts.begin(), parts.end(), is_repeated);
    if (all_blank && !repeated) return true;
    if (all_blank || (n_blanks > 0 && !repeated))
        in_.lint(Code::LpeBlank,
                 all_blank ? "groups with a quantifier are a sequence, blanks or not"
                           : "only some groups are separated by blanks: read as a sequence",
                 parts.front().begin, parts.back().end, "alternatives are written ((..)|(..))");
    return false;
}

Expr Parser::sequence_of(std::vector<Part> parts) const {
    if (parts.empty()) return nullptr;
    if (parts.size() == 1) return std::move(parts[0].expr);
    const std::size_t begin = parts.front().begin, end = parts.back().end;
    Sequence sequence;
    for (Part& part : parts)
        sequence.parts.push_back(std::move(part.expr));
    return make(std::move(sequence), begin, end);
}

Expr Parser::alternation_of(std::vector<Expr> parts, std::size_t begin) const {
    return make(Alternation{std::move(parts)}, begin, in_.position());
}

}  // namespace

Expr parse(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
           const ParseOptions& options) {
    Expr expr = Parser(text, base, diagnostics, options).parse_all();
    if (options.keep_references || !has_unresolved(expr)) return expr;
    if (options.names != nullptr)
        return resolve_references(expr, *options.names, options.aov_name, diagnostics);
    static const ExpressionTable builtins_only;
    return resolve_references(expr, builtins_only, options.aov_name, diagnostics);
}

Expr parse(std::string_view text, Diagnostics& diagnostics) {
    return parse(text, SourceSpan{}, diagnostics);
}

}  // namespace lightsieve::lpe
