#include "scene/assignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/error.h"
#include "scene/ass_lexer.h"
#include "scene/ass_write.h"

namespace lightsieve {
namespace {

class Reader {
  public:
    Reader(std::string_view text, const SourceSpan& where) : text_(text), where_(where) {}

    Assignment read() {
        const std::size_t equals = text_.find('=');
        if (equals == std::string_view::npos)
            fail("an = is missing", text_.size(), "write PARAMETER=VALUE");
        Assignment out;
        target(text_.substr(0, equals), out);
        at_ = equals + 1;
        out.value = value();
        return out;
    }

  private:
    [[noreturn]] void fail(const std::string& problem, std::size_t at, std::string hint = "") {
        throw InputError(
            {Code::OperatorSelection,
             fmt::format("{} (column {} of the assignment \"{}\")", problem, at + 1, text_),
             where_, std::move(hint)});
    }

    static bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

    /// `[CLASS] [TYPE[[]]] NAME`.
    void target(std::string_view written, Assignment& out) {
        std::vector<std::string> words;
        for (std::size_t i = 0; i < written.size();) {
            if (is_blank(written[i])) {
                ++i;
                continue;
            }
            const std::size_t begin = i;
            while (i < written.size() && !is_blank(written[i]))
                ++i;
            words.emplace_back(written.substr(begin, i - begin));
        }
        if (words.empty()) fail("a parameter's name is expected", 0, "write PARAMETER=VALUE");
        out.param = words.back();
        words.pop_back();
        if (!words.empty()) type(words.back(), out);
        if (words.size() > 1) user_class(words.front(), out);
        if (words.size() > 2) fail("more words than a type and a name", 0);
    }
    void type(std::string word, Assignment& out) {
        if (word.ends_with("[]")) {
            out.is_array = true;
            word.resize(word.size() - 2);
        }
        std::transform(word.begin(), word.end(), word.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        out.declared = parse_type(word);
        if (!out.declared)
            fail(fmt::format("\"{}\" is no type", word), 0,
                 "types are bool byte int uint float rgb rgba vector vector2 string node matrix");
    }
    void user_class(const std::string& word, Assignment& out) {
        if (word != "constant")
            fail(fmt::format("\"{}\" cannot be declared by an operator", word), 0,
                 "only constant user data can");
        out.user_class = UserDataClass::Constant;
    }

    std::string value() {
        std::string out;
        const auto add = [&](const std::string& item) {
            if (!out.empty()) out += ' ';
            out += item;
        };
        for (skip(); at_ < text_.size(); skip()) {
            const char quote = text_[at_];
            if (quote == '\'' || quote == '"') {
                const std::size_t begin = at_ + 1, end = text_.find(quote, begin);
                if (end == std::string_view::npos)
                    fail("a text does not end", at_, "add the closing quote");
                add(quote_ass(text_.substr(begin, end - begin)));
                at_ = end + 1;
                continue;
            }
            const std::size_t begin = at_;
            while (at_ < text_.size() && !is_separator(text_[at_]))
                ++at_;
            add(std::string(text_.substr(begin, at_ - begin)));
        }
        if (out.empty()) fail("a value is missing", text_.size(), "a text without letters is ''");
        return out;
    }
    static bool is_separator(char c) { return is_blank(c) || c == ',' || c == '[' || c == ']'; }
    void skip() {
        while (at_ < text_.size() && is_separator(text_[at_]))
            ++at_;
    }

    std::string_view text_;
    const SourceSpan& where_;
    std::size_t at_ = 0;
};

}  // namespace

Assignment parse_assignment(std::string_view text, const SourceSpan& where) {
    return Reader(text, where).read();
}

}  // namespace lightsieve
