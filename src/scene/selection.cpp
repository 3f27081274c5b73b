#include "scene/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <regex>
#include <variant>

namespace lightsieve {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           c == '_' || c == ':';
}

enum class Compare : std::uint8_t { Exists, Equal, Differs, Less, LessEqual, More, MoreEqual };

/// A number, or a text.
using Value = std::variant<double, std::string>;

/// A value of a parameter or of user data.
struct Operand {
    ParamType type{};
    const std::byte* data = nullptr;
    std::uint32_t n = 0;
};

double number_of(const Operand& operand, std::size_t component) {
    const auto load = [&]<class T>(T) {
        T out{};
        std::memcpy(&out, operand.data + component * sizeof(T), sizeof(T));
        return static_cast<double>(out);
    };
    switch (operand.type) {
        case ParamType::Bool: return load(bool{});
        case ParamType::Byte: return load(std::uint8_t{});
        case ParamType::Int:
        case ParamType::Enum: return load(std::int32_t{});
        case ParamType::UInt: return load(std::uint32_t{});
        default: return load(float{});
    }
}

/// `PARAM`, `PARAM[2]`, `PARAM.r`.
struct ParamPath {
    std::string name;
    std::int64_t element = -1;
    int component = -1;
};

Operand operand_of(const NodeInstance& node, const ParamPath& path, const ParamInfo*& info) {
    info = node.type().find(path.name);
    if (info == nullptr) {
        const UserData* data = node.find_user_data(path.name);
        if (data == nullptr || data->data == nullptr) return {};
        return {data->type, static_cast<const std::byte*>(data->data), data->n};
    }
    const auto* at = static_cast<const std::byte*>(node.block()) + info->offset;
    if (!info->is_array) return {info->type, at, 1};
    const auto& array = *reinterpret_cast<const Array<std::byte>*>(at);
    return {info->type, array.data, array.n};
}

}  // namespace

// ---- expressions ----

/// Without back references, and so in polynomial time: files of other people bring expressions.
constexpr auto kRegexSyntax =
    std::regex_constants::ECMAScript | std::regex_constants::__polynomial;
/// Longer ones and longer names take too long all the same [bytes].
constexpr std::size_t kMaxRegex = 256, kMaxRegexName = 1024;

struct Selection::Term {
    enum class Kind : std::uint8_t {
        Any,
        All,
        Not,
        Pattern,
        Regex,
        Collection,
        Type,
        Name,
        Param
    };
    Kind kind{};
    std::vector<Term> parts;  ///< of Any, All and Not
    std::string text;         ///< a pattern, a collection's or a type's name
    std::shared_ptr<const std::regex> regex;
    ParamPath param;
    Compare compare{};
    Value value;

    [[nodiscard]] bool matches(const Candidate& c, const InCollection& collections) const;
    [[nodiscard]] bool matches_text(std::string_view name) const;

  private:
    [[nodiscard]] bool fits(std::string_view name) const;
    [[nodiscard]] bool name_matches(const Candidate& c) const;
    [[nodiscard]] bool param_matches(const NodeInstance& node) const;
    [[nodiscard]] bool compare_text(std::string_view text_of_node) const;
};

bool Selection::Term::fits(std::string_view name) const {
    if (kind == Kind::Pattern) return glob_matches(text, name);
    return name.size() <= kMaxRegexName && std::regex_match(name.begin(), name.end(), *regex);
}

bool Selection::Term::name_matches(const Candidate& c) const {
    const std::string_view name = c.node->name().view();
    if (fits(name)) return true;
    if (c.prefix.empty()) return false;
    std::string path = std::string(c.prefix) + std::string(name);
    if (fits(path)) return true;
    std::replace(path.begin(), path.end(), '^', '/');
    return fits(path);
}

bool Selection::Term::compare_text(std::string_view text_of_node) const {
    const auto* wanted = std::get_if<std::string>(&value);
    if (wanted == nullptr) return compare == Compare::Differs;
    const bool same = glob_matches(*wanted, text_of_node);
    return compare == Compare::Differs ? !same : same;
}

bool Selection::Term::param_matches(const NodeInstance& node) const {
    const ParamInfo* info = nullptr;
    const Operand operand = operand_of(node, param, info);
    if (operand.data == nullptr) return compare == Compare::Differs && info != nullptr;
    const auto element = static_cast<std::size_t>(std::max<std::int64_t>(param.element, 0));
    if (element >= operand.n) return false;
    Operand one = operand;
    one.data += element * type_size(operand.type);
    if (operand.type == ParamType::String) {
        Name text_of_node;
        std::memcpy(&text_of_node, one.data, sizeof(text_of_node));
        return compare == Compare::Exists ? !text_of_node.empty()
                                          : compare_text(text_of_node.view());
    }
    if (operand.type == ParamType::Node || operand.type == ParamType::Closure) {
        const NodeInstance* linked = nullptr;
        std::memcpy(&linked, one.data, sizeof(linked));
        if (compare == Compare::Exists) return linked != nullptr;
        return compare_text(linked == nullptr ? "" : linked->name().view());
    }
    if (operand.type == ParamType::Matrix) return compare == Compare::Exists;
    const auto component = static_cast<std::size_t>(std::max(param.component, 0));
    if (component >= type_size(operand.type) / std::min<std::size_t>(type_size(operand.type), 4))
        return false;
    const double number = number_of(one, component);
    if (const auto* wanted = std::get_if<std::string>(&value); wanted != nullptr) {
        if (operand.type != ParamType::Enum || info == nullptr) return compare == Compare::Differs;
        const auto index = static_cast<std::size_t>(number);
        return compare_text(index < info->enumerators.size() ? info->enumerators[index] : "");
    }
    const double wanted = std::get<double>(value);
    switch (compare) {
        case Compare::Exists: return number != 0;
        // Files hold seven digits: 0.1 is the float that is nearest to it.
        case Compare::Equal: return static_cast<float>(number) == static_cast<float>(wanted);
        case Compare::Differs: return static_cast<float>(number) != static_cast<float>(wanted);
        case Compare::Less: return number < wanted;
        case Compare::LessEqual: return number <= wanted;
        case Compare::More: return number > wanted;
        case Compare::MoreEqual: return number >= wanted;
    }
    return false;
}

bool Selection::Term::matches(const Candidate& c, const InCollection& collections) const {
    const auto fits = [&](const Term& part) { return part.matches(c, collections); };
    switch (kind) {
        case Kind::Any: return std::any_of(parts.begin(), parts.end(), fits);
        case Kind::All: return std::all_of(parts.begin(), parts.end(), fits);
        case Kind::Not: return !fits(parts.front());
        case Kind::Pattern:
        case Kind::Regex: return name_matches(c);
        case Kind::Collection: return collections && collections(text, c);
        case Kind::Type: return compare_text(c.node->type().name.view());
        case Kind::Name: return compare_text(c.node->name().view());
        case Kind::Param: return param_matches(*c.node);
    }
    return false;
}

bool Selection::Term::matches_text(std::string_view name) const {
    const auto fits_part = [&](const Term& part) { return part.matches_text(name); };
    switch (kind) {
        case Kind::Any: return std::any_of(parts.begin(), parts.end(), fits_part);
        case Kind::All: return std::all_of(parts.begin(), parts.end(), fits_part);
        case Kind::Not: return !fits_part(parts.front());
        case Kind::Pattern:
        case Kind::Regex: return fits(name);
        case Kind::Collection:
        case Kind::Type:
        case Kind::Name:
        case Kind::Param: break;
    }
    return false;
}

Selection::Selection(std::unique_ptr<Term> root) : root_(std::move(root)) {}
Selection::Selection(Selection&&) noexcept = default;
Selection& Selection::operator=(Selection&&) noexcept = default;
Selection::~Selection() = default;

bool Selection::matches(const Candidate& candidate, const InCollection& collections) const {
    return root_->matches(candidate, collections);
}

bool Selection::matches_text(std::string_view name) const { return root_->matches_text(name); }

std::vector<std::string> Selection::patterns() const {
    std::vector<std::string> out;
    std::vector<const Term*> open{root_.get()};
    while (!open.empty()) {
        const Term& term = *open.back();
        open.pop_back();
        if (term.kind == Term::Kind::Pattern) out.push_back(term.text);
        for (const Term& part : term.parts)
            open.push_back(&part);
    }
    return out;
}

// ---- reading ----

class SelectionParser {
  public:
    SelectionParser(std::string_view text, const SourceSpan& where) : text_(text), where_(where) {}

    Selection parse() {
        if (peek() == '\0') fail("the selection is empty", 0, "* selects every node");
        Term root = any();
        if (peek() == ')') fail("this parenthesis closes nothing", at_, "take it out");
        if (peek() != '\0') fail("a name or a condition is expected here", at_);
        return Selection(std::make_unique<Term>(std::move(root)));
    }

  private:
    using Term = Selection::Term;
    using Kind = Term::Kind;

    [[noreturn]] void fail(const std::string& problem, std::size_t at, std::string hint = "") {
        SourceSpan place = where_;
        // Within the quotes of the file, if none of its characters is escaped.
        const std::string_view written = where_.known() ? where_.text() : std::string_view{};
        if (written.size() == text_.size() + 2) {
            place.offset += at + 1;
            place.length = 1;
        }
        throw InputError({Code::OperatorSelection,
                          fmt::format("{} (column {} of \"{}\")", problem, at + 1, text_), place,
                          std::move(hint)});
    }

    char peek() {
        while (at_ < text_.size() && is_blank(text_[at_]))
            ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(std::string_view token) {
        peek();
        if (text_.substr(at_, token.size()) != token) return false;
        const std::size_t end = at_ + token.size();
        // A word ends where the token does: "order" is no "or".
        const bool spelt = is_word(token.front()) || token == "|" || token == "&";
        if (spelt && end < text_.size() && !is_blank(text_[end]) && text_[end] != '(')
            return false;
        at_ = end;
        return true;
    }
    bool take_or() { return take("or") || take("||") || take("|"); }
    bool take_and() { return take("and") || take("&&") || take("&"); }

    Term any() {
        Term out;
        out.kind = Kind::Any;
        out.parts.push_back(all());
        // Rows of words mean any of them, too.
        while (take_or() || (peek() != '\0' && peek() != ')'))
            out.parts.push_back(all());
        return out.parts.size() == 1 ? Term(std::move(out.parts.front())) : out;
    }
    Term all() {
        Term out;
        out.kind = Kind::All;
        out.parts.push_back(one());
        while (take_and())
            out.parts.push_back(one());
        return out.parts.size() == 1 ? Term(std::move(out.parts.front())) : out;
    }
    Term one() {
        if (++depth_ > Selection::kMaxNesting) fail("parentheses are nested too deep", at_);
        Term out = primary();
        --depth_;
        return out;
    }
    Term primary() {
        const std::size_t begin = (peek(), at_);
        if (take("not") || take("!")) {
            Term out;
            out.kind = Kind::Not;
            out.parts.push_back(one());
            return out;
        }
        if (take("(")) {
            Term out = any();
            if (!take(")"))
                fail("this parenthesis is never closed", begin, "add the closing parenthesis");
            return out;
        }
        Term out = name();
        // `.(conditions)` after a name.
        if (text_.substr(at_, 2) != ".(") return out;
        at_ += 1;
        const std::size_t open = at_++;
        Term both;
        both.kind = Kind::All;
        both.parts.push_back(std::move(out));
        both.parts.push_back(any_condition());
        if (!take(")"))
            fail("this parenthesis is never closed", open, "add the closing parenthesis");
        return both;
    }
    Term regex() {
        const std::size_t begin = at_ + 2;
        const char quote = text_[at_ + 1];
        const std::size_t end = text_.find(quote, begin);
        if (end == std::string_view::npos)
            fail("this regular expression does not end", at_, "add the quote");
        if (end - begin > kMaxRegex) fail("this regular expression is too long", at_);
        Term out;
        out.kind = Kind::Regex;
        out.text = text_.substr(begin, end - begin);
        // Counts within counts make expressions of a few characters as large as a hundred thousand.
        if (const std::size_t count = out.text.find('{'); count != std::string::npos)
            fail("regular expressions with counts are not taken", begin + count,
                 "write the part as often as it is to be there, or with * or +");
        at_ = end + 1;
        try {
            out.regex = std::make_shared<const std::regex>(out.text, kRegexSyntax);
        } catch (const std::regex_error&) {
            fail("this is no regular expression", begin, "write it as in ECMAScript");
        }
        return out;
    }
    Term name() {
        peek();
        const std::string_view start = text_.substr(at_, 2);
        if (start == "r'" || start == "r\"") return regex();
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != ')' &&
               text_[at_] != '(' && text_.substr(at_, 2) != ".(")
            ++at_;
        Term out;
        out.kind = Kind::Pattern;
        out.text = text_.substr(begin, at_ - begin);
        if (out.text.empty() && text_.substr(at_, 2) == ".(") out.text = "*";
        if (out.text.empty()) fail("a name is expected here", begin);
        if (out.text[0] != '#') return out;
        out.kind = Kind::Collection;
        out.text.erase(0, 1);
        if (out.text.empty()) fail("a collection's name is expected after #", begin);
        return out;
    }

    Term any_condition() {
        Term out;
        out.kind = Kind::Any;
        do
            out.parts.push_back(all_conditions());
        while (take_or());
        return out.parts.size() == 1 ? Term(std::move(out.parts.front())) : out;
    }
    Term all_conditions() {
        Term out;
        out.kind = Kind::All;
        do
            out.parts.push_back(condition());
        while (take_and());
        return out.parts.size() == 1 ? Term(std::move(out.parts.front())) : out;
    }
    Term condition() {
        if (++depth_ > Selection::kMaxNesting) fail("parentheses are nested too deep", at_);
        const std::size_t begin = (peek(), at_);
        Term out;
        if (take("not") || take("!")) {
            out.kind = Kind::Not;
            out.parts.push_back(condition());
        } else if (take("(")) {
            out = any_condition();
            if (!take(")"))
                fail("this parenthesis is never closed", begin, "add the closing parenthesis");
        } else {
            out = comparison();
        }
        --depth_;
        return out;
    }
    Term comparison() {
        Term out;
        out.kind = Kind::Param;
        const std::size_t begin = (peek(), at_);
        const bool special = take("@");
        out.param.name = word();
        if (out.param.name.empty())
            fail("a parameter or @node is expected here", at_, "for example .(@node=='polymesh')");
        if (special) {
            if (out.param.name == "node" || out.param.name == "type")
                out.kind = Kind::Type;
            else if (out.param.name == "name")
                out.kind = Kind::Name;
            else
                fail("\"@" + out.param.name + "\" is not known", begin, "@node and @name are");
        } else {
            suffixes(out.param);
        }
        out.compare = comparator();
        if (out.compare == Compare::Exists) {
            if (special) fail("== or != is expected here", at_);
            out.value = 0.0;
            return out;
        }
        const bool ordered = out.compare != Compare::Equal && out.compare != Compare::Differs;
        const std::size_t at = (peek(), at_);
        out.value = value();
        if ((ordered || special) && std::holds_alternative<std::string>(out.value) == ordered)
            fail(ordered ? "a number is expected here" : "a name in quotes is expected here", at);
        return out;
    }
    std::string word() {
        peek();
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_word(text_[at_]))
            ++at_;
        return std::string(text_.substr(begin, at_ - begin));
    }
    void suffixes(ParamPath& path) {
        if (at_ < text_.size() && text_[at_] == '[') {
            const std::size_t close = text_.find(']', at_);
            const char* first = text_.data() + at_ + 1;
            const char* last = text_.data() + std::min(close, text_.size());
            const auto [end, error] = std::from_chars(first, last, path.element);
            if (close == std::string_view::npos || error != std::errc() || end != last ||
                path.element < 0)
                fail("the number of an element is expected here", at_ + 1);
            at_ = close + 1;
        }
        if (at_ + 1 < text_.size() && text_[at_] == '.' && is_word(text_[at_ + 1])) {
            static constexpr std::string_view kLetters = "rgbaxyzw";
            const std::size_t letter = kLetters.find(text_[at_ + 1]);
            if (letter == std::string_view::npos ||
                (at_ + 2 < text_.size() && is_word(text_[at_ + 2])))
                fail("components are .r .g .b .a or .x .y .z", at_ + 1);
            path.component = static_cast<int>(letter % 4);
            at_ += 2;
        }
    }
    Compare comparator() {
        if (take("==")) return Compare::Equal;
        if (take("!=")) return Compare::Differs;
        if (take("<=")) return Compare::LessEqual;
        if (take(">=")) return Compare::MoreEqual;
        if (take("<")) return Compare::Less;
        if (take(">")) return Compare::More;
        if (take("=")) return Compare::Equal;
        return Compare::Exists;
    }
    Value value() {
        const char quote = peek();
        if (quote == '\'' || quote == '"') {
            const std::size_t begin = at_ + 1, end = text_.find(quote, begin);
            if (end == std::string_view::npos)
                fail("this text does not end", at_, "add the quote");
            at_ = end + 1;
            return std::string(text_.substr(begin, end - begin));
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != ')' &&
               text_[at_] != '&' && text_[at_] != '|')
            ++at_;
        const std::string_view written = text_.substr(begin, at_ - begin);
        if (written.empty()) fail("a value is expected here", begin);
        if (written == "on" || written == "true" || written == "True") return 1.0;
        if (written == "off" || written == "false" || written == "False") return 0.0;
        double number = 0;
        const auto [end, error] =
            std::from_chars(written.data(), written.data() + written.size(), number);
        if (error == std::errc() && end == written.data() + written.size()) return number;
        return std::string(written);
    }

    std::string_view text_;
    const SourceSpan& where_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

Selection Selection::parse(std::string_view text, const SourceSpan& where) {
    return SelectionParser(text, where).parse();
}

// ---- globs ----

namespace {

/// Reads `[...]` at `at`; moves behind it. Nothing if the bracket never closes.
std::optional<bool> in_brackets(std::string_view pattern, std::size_t& at, char c) {
    const std::size_t close = pattern.find(']', at + 2);
    if (close == std::string_view::npos) return std::nullopt;
    std::string_view inside = pattern.substr(at + 1, close - at - 1);
    const bool negated = inside.front() == '!' || inside.front() == '^';
    if (negated) inside.remove_prefix(1);
    bool found = false;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const bool range = i + 2 < inside.size() && inside[i + 1] == '-';
        found |= range ? inside[i] <= c && c <= inside[i + 2] : inside[i] == c;
        if (range) i += 2;
    }
    at = close + 1;
    return found != negated;
}

}  // namespace

bool glob_matches(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0;
    std::size_t star = std::string_view::npos, after_star = 0;
    while (n < name.size()) {
        std::size_t next = p + 1;
        bool fits = false;
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            after_star = n;
            continue;
        }
        if (p < pattern.size()) {
            fits = pattern[p] == '?' || pattern[p] == name[n];
            if (pattern[p] == '[') {
                std::size_t behind = p;
                if (const auto listed = in_brackets(pattern, behind, name[n])) {
                    fits = *listed;
                    next = behind;
                }
            }
        }
        if (fits) {
            p = next;
            ++n;
        } else if (star != std::string_view::npos) {
            // The last star takes one character more.
            p = star + 1;
            n = ++after_star;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*')
        ++p;
    return p == pattern.size();
}

}  // namespace lightsieve
