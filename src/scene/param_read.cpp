#include "scene/param_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/ass_lexer.h"
#include "scene/ass_packed.h"

namespace lightsieve {
namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

bool ends_token(char c) { return is_ass_blank(c) || c == '{' || c == '}' || c == '"'; }

/// Words of a 32-bit type in bytes that `new` aligned.
std::uint32_t* words_of(std::byte* bytes) { return reinterpret_cast<std::uint32_t*>(bytes); }

/// One value; a class because every step needs the same things.
class Conversion {
  public:
    Conversion(const ValueText& value, const std::shared_ptr<const SourceText>& source,
               const ReadTarget& target, const FindNode& find_node, std::uint64_t& run_bytes,
               Diagnostics& diagnostics)
        : value_(value),
          source_(source),
          target_(target),
          find_node_(find_node),
          run_bytes_(run_bytes),
          diagnostics_(diagnostics) {}

    std::optional<TypedValues> run() {
        bool ok = false;
        switch (target_.type) {
            case ParamType::String:
            case ParamType::Node:
            case ParamType::Closure: ok = texts(); break;
            case ParamType::Enum: ok = enums() && clamp_words(); break;
            default: ok = numbers() && clamp_words() && shrink(); break;
        }
        if (!ok || !fits_one()) return std::nullopt;
        return std::move(out_);
    }

  private:
    [[nodiscard]] SourceSpan where() const {
        return {source_, value_.range.offset, value_.range.length};
    }
    [[nodiscard]] SourceSpan where(const Token& token) const {
        return {source_, token.offset, token.length};
    }
    [[nodiscard]] bool is_array_form() const { return value_.form == ValueForm::Array; }
    [[nodiscard]] std::string_view text() const {
        return std::string_view(source_->text).substr(0, value_.range.end());
    }
    /// A lexer over the value's tokens, without the head of an array.
    [[nodiscard]] AssLexer tokens() const {
        return AssLexer(text(), is_array_form() ? value_.array.data_offset : value_.range.offset);
    }

    bool wrong_type(const std::string& got) {
        diagnostics_.error(Code::WrongType,
                           fmt::format("{} takes {}{}, not {}", target_.label,
                                       target_.is_array ? "values of type " : "one ",
                                       type_text(target_.type), got),
                           where());
        return false;
    }

    /// Room for `n` words.
    void allocate(std::uint64_t n) {
        out_.data = std::make_unique_for_overwrite<std::byte[]>(n * sizeof(std::uint32_t));
    }

    // ---- texts: STRING, NODE, CLOSURE ----

    bool texts() {
        if (is_array_form() && value_.array.type != ParamType::String &&
            value_.array.type != ParamType::Node && value_.array.n > 0)
            return wrong_type(fmt::format("an array of {}", type_text(value_.array.type)));
        std::vector<Token> all;
        AssLexer lexer = tokens();
        for (Token token = lexer.next(); token.kind != TokenKind::End; token = lexer.next())
            all.push_back(token);
        // "" and NULL in the place of an array are an array of nothing.
        if (target_.is_array && !is_array_form() && all.size() == 1 && is_nothing(all[0]))
            all.clear();
        out_.n_keys = is_array_form() ? value_.array.n_keys : 1;
        out_.n = static_cast<std::uint32_t>(all.size() / out_.n_keys);
        const std::size_t size = type_size(target_.type);
        out_.data = std::make_unique<std::byte[]>(all.size() * size);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string word = token_text(all[i]);
            std::byte* at = out_.data.get() + i * size;
            if (target_.type == ParamType::String) {
                new (at) Name(word);
            } else {
                const NodeInstance* node =
                    is_nothing(all[i]) ? nullptr : find_node_(word, where(all[i]));
                if (target_.type == ParamType::Node)
                    new (at) NodeRef{node};
                else
                    new (at) ShaderRef{node, nullptr};
            }
        }
        return true;
    }

    [[nodiscard]] std::string token_text(const Token& token) const {
        const std::string_view raw = text().substr(token.offset, token.length);
        return token.kind == TokenKind::String ? unquote(raw) : std::string(raw);
    }
    [[nodiscard]] bool is_nothing(const Token& token) const {
        const std::string word = token_text(token);
        return word.empty() || (word == "NULL" && target_.type != ParamType::String);
    }

    // ---- enumerations ----

    bool enums() {
        if (is_array_form() && value_.array.encoding != ArrayEncoding::Text) return packed();
        if (is_array_form() && component_count(value_.array.type) != 1)
            return wrong_type(fmt::format("an array of {}", type_text(value_.array.type)));
        const std::uint64_t limit = is_array_form()
                                        ? std::uint64_t{value_.array.n} * value_.array.n_keys
                                        : std::numeric_limits<std::uint64_t>::max();
        std::vector<std::uint32_t> indices;
        AssLexer lexer = tokens();
        for (Token token = lexer.next(); token.kind != TokenKind::End && indices.size() < limit;
             token = lexer.next()) {
            std::int32_t index = -1;
            if (!enumerator(token, index)) return false;
            indices.push_back(static_cast<std::uint32_t>(index));
        }
        out_.n_keys = is_array_form() ? value_.array.n_keys : 1;
        out_.n = static_cast<std::uint32_t>(indices.size() / out_.n_keys);
        allocate(indices.size());
        std::copy(indices.begin(), indices.end(), words_of(out_.data.get()));
        return true;
    }

    bool enumerator(const Token& token, std::int32_t& index) {
        const std::string word = token_text(token);
        index = target_.info == nullptr ? -1 : find_enumerator(*target_.info, word);
        if (index >= 0) return true;
        const std::optional<std::int64_t> number = parse_integer(word);
        if (number && *number >= 0 && *number <= std::numeric_limits<std::int32_t>::max()) {
            index = static_cast<std::int32_t>(*number);
            return true;
        }
        std::string hint;
        if (target_.info != nullptr) {
            hint = did_you_mean(word, target_.info->enumerators);
            if (hint.empty()) {
                hint = "one of";
                for (const std::string& choice : target_.info->enumerators)
                    hint += " " + choice;
            }
        }
        diagnostics_.error(Code::UnknownChoice,
                           fmt::format("{} cannot be \"{}\"", target_.label, word), where(token),
                           hint);
        return false;
    }

    // ---- numbers ----

    bool numbers() {
        if (!is_array_form()) return loose_numbers();
        if (value_.array.n == 0) return true;
        const ParamType from = value_.array.type;
        const bool no_number = from == ParamType::String || from == ParamType::Node ||
                               (from == ParamType::Enum && is_float_type(target_.type));
        const bool colors = (from == ParamType::Rgb && target_.type == ParamType::Rgba) ||
                            (from == ParamType::Rgba && target_.type == ParamType::Rgb);
        if (no_number || (component_count(from) != component_count(target_.type) && !colors))
            return wrong_type(fmt::format("an array of {}", type_text(from)));
        if (value_.array.encoding != ArrayEncoding::Text) {
            if (!packed()) return false;
        } else {
            const std::uint64_t n =
                std::uint64_t{value_.array.n} * value_.array.n_keys * component_count(from);
            allocate(n);
            std::uint64_t done = 0;
            if (!number_tokens(n, done, [&](std::uint64_t i, std::uint32_t word) {
                    words_of(out_.data.get())[i] = word;
                }))
                return false;
            out_.n = value_.array.n;
            out_.n_keys = value_.array.n_keys;
        }
        if (colors) change_channels(component_count(from), component_count(target_.type));
        return true;
    }

    /// One number where a colour or vector is expected stands for all channels, and of a colour where one number is expected the
    /// first channel counts: parameters changed from one to the other between versions.
    void adapt_channels(std::vector<std::uint32_t>& words) {
        const ParamType type = target_.type;
        const bool one_for_all =
            type == ParamType::Rgb || type == ParamType::Rgba || type == ParamType::Vector;
        if (words.size() == 1 && one_for_all) {
            words.resize(component_count(type), words[0]);
            if (type == ParamType::Rgba) words[3] = std::bit_cast<std::uint32_t>(1.0F);
        } else if (words.size() == 3 && type == ParamType::Float) {
            if (words[0] != words[1] || words[0] != words[2])
                diagnostics_.warning(
                    Code::WrongType,
                    fmt::format("{} takes one number (FLOAT), not a colour", target_.label),
                    where(), "the first of the three counts");
            words.resize(1);
        }
    }

    /// A run of numbers without a head: one value, or for arrays several.
    bool loose_numbers() {
        std::vector<std::uint32_t> words;
        std::uint64_t n = 0;
        if (!number_tokens(std::numeric_limits<std::uint64_t>::max(), n,
                           [&](std::uint64_t, std::uint32_t word) { words.push_back(word); }))
            return false;
        if (!target_.is_array) adapt_channels(words);
        n = words.size();
        const std::size_t want = component_count(target_.type);
        // RGB and RGBA stand for each other: nodes changed from one to the other between versions.
        const bool colors = (target_.type == ParamType::Rgb && n == 4) ||
                            (target_.type == ParamType::Rgba && n == 3);
        const std::size_t have = colors ? static_cast<std::size_t>(n) : want;
        const bool fits = target_.is_array ? n % have == 0 && n > 0 : n == have;
        if (!fits) {
            diagnostics_.error(
                Code::WrongType,
                fmt::format("{} takes {} number{} ({}), not {}", target_.label,
                            target_.is_array && want > 1 ? fmt::format("multiples of {}", want)
                                                         : std::to_string(want),
                            want == 1 ? "" : "s", type_text(target_.type), n),
                where());
            return false;
        }
        out_.n = static_cast<std::uint32_t>(n / have);
        allocate(n);
        std::copy(words.begin(), words.end(), words_of(out_.data.get()));
        if (colors) change_channels(have, want);
        return true;
    }

    /// Calls put(i, word) for each number of the text, up to `limit`.
    template <class Put>
    bool number_tokens(std::uint64_t limit, std::uint64_t& n, const Put& put) {
        const bool floats = is_float_type(target_.type);
        const std::string_view all = text();
        AssLexer lexer = tokens();
        for (n = 0; n < limit; ++n) {
            if (lexer.peek() == '\0') break;
            // Fast path: a plain number that ends at a blank.
            const char* first = all.data() + lexer.position();
            const char* last = all.data() + all.size();
            std::uint32_t word = 0;
            const char* end =
                floats ? plain_float(first, last, word) : plain_integer(first, last, word);
            if (end != nullptr) {
                lexer.seek(static_cast<std::size_t>(end - all.data()));
            } else {
                const Token token = lexer.next();
                if (!slow_number(token, floats, word)) return false;
            }
            put(n, word);
        }
        return true;
    }

    static const char* plain_float(const char* first, const char* last, std::uint32_t& word) {
        float number = 0;
        const auto [end, error] = std::from_chars(first, last, number);
        if (error != std::errc() || (end != last && !ends_token(*end))) return nullptr;
        word = std::bit_cast<std::uint32_t>(number);
        return end;
    }
    const char* plain_integer(const char* first, const char* last, std::uint32_t& word) const {
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(first, last, number);
        if (error != std::errc() || (end != last && !ends_token(*end)) || !narrow(number, word))
            return nullptr;
        return end;
    }

    /// Everything else that may stand for a number, and the errors.
    bool slow_number(const Token& token, bool floats, std::uint32_t& word) {
        const std::string raw = token_text(token);
        if (floats) {
            if (const std::optional<float> number = parse_float(raw)) {
                word = std::bit_cast<std::uint32_t>(*number);
                return true;
            }
        } else {
            const std::optional<bool> truth =
                target_.type == ParamType::Bool || value_.array.type == ParamType::Bool
                    ? parse_bool(raw)
                    : std::nullopt;
            const std::optional<std::int64_t> number =
                truth ? std::optional<std::int64_t>(*truth ? 1 : 0) : parse_integer(raw);
            if (number && narrow(*number, word)) return true;
        }
        diagnostics_.error(Code::BadValue,
                           fmt::format("\"{}\" is no {} for {}", raw.substr(0, 40),
                                       type_text(target_.type), target_.label),
                           where(token));
        return false;
    }

    /// The integer as the target's word; false if it does not fit.
    [[nodiscard]] bool narrow(std::int64_t number, std::uint32_t& word) const {
        std::int64_t low = std::numeric_limits<std::int32_t>::min(),
                     high = std::numeric_limits<std::int32_t>::max();
        switch (target_.type) {
            case ParamType::Bool: word = number != 0 ? 1 : 0; return true;
            case ParamType::Byte:
                // Ray masks of older versions have 16 bits; -1 sets all.
                number = number == -1 ? 255 : std::min<std::int64_t>(number, 255);
                low = 0;
                break;
            case ParamType::UInt: high = std::numeric_limits<std::uint32_t>::max(); break;
            default: break;
        }
        word = static_cast<std::uint32_t>(number);
        return number >= low && number <= high;
    }

    // ---- packed arrays ----

    bool packed() {
        const ParamType from = value_.array.type;
        if (target_.type == ParamType::Enum && is_float_type(from))
            return wrong_type(fmt::format("an array of {}", type_text(from)));
        const std::uint64_t n =
            std::uint64_t{value_.array.n} * value_.array.n_keys * component_count(from);
        const std::uint64_t text_bytes = value_.range.length;
        // A run takes 11 characters whatever its length, so memory has to be limited by something else than the text.
        const std::uint64_t bytes = n * sizeof(std::uint32_t);
        run_bytes_ += bytes - std::min(bytes, text_bytes * 4);
        if (run_bytes_ > kMaxRunBytes) {
            diagnostics_.error(
                Code::LimitArray,
                fmt::format("the packed array of {} expands to {} numbers", target_.label, n),
                where(),
                fmt::format("runs of all arrays together may expand to {} bytes (kMaxRunBytes)",
                            kMaxRunBytes));
            return false;
        }
        allocate(n);
        std::uint32_t* words = words_of(out_.data.get());
        (value_.array.encoding == ArrayEncoding::B85 ? decode_b85 : decode_b64)(
            text().substr(value_.array.data_offset), from, {words, n});
        out_.n = value_.array.n;
        out_.n_keys = value_.array.n_keys;
        return change_family(from, words, n);
    }

    /// Words of the file's type become words of the target's.
    bool change_family(ParamType from, std::uint32_t* words, std::uint64_t n) {
        const bool to_float = is_float_type(target_.type);
        if (is_float_type(from) && to_float) return true;
        if (!is_float_type(from) && from == target_.type && from != ParamType::Bool) return true;
        for (std::uint64_t i = 0; i < n; ++i) {
            std::int64_t number = from == ParamType::Int
                                      ? std::int64_t{static_cast<std::int32_t>(words[i])}
                                      : std::int64_t{words[i]};
            if (is_float_type(from)) {
                const float real = std::bit_cast<float>(words[i]);
                if (!(std::abs(real) < 1e15F) || real != std::floor(real))
                    return bad_element(i, fmt::format("{}", real));
                number = static_cast<std::int64_t>(real);
            }
            if (to_float)
                words[i] = std::bit_cast<std::uint32_t>(static_cast<float>(number));
            else if (!narrow(number, words[i]))
                return bad_element(i, std::to_string(number));
        }
        return true;
    }

    bool bad_element(std::uint64_t i, const std::string& shown) {
        diagnostics_.error(Code::BadValue,
                           fmt::format("element {} of {} is {}, which is no {}", i, target_.label,
                                       shown, type_text(target_.type)),
                           where());
        return false;
    }

    // ---- after reading ----

    /// RGB to RGBA with alpha 1, or back.
    void change_channels(std::size_t from, std::size_t to) {
        const std::uint64_t n = std::uint64_t{out_.n} * out_.n_keys;
        const std::unique_ptr<std::byte[]> old = std::move(out_.data);
        allocate(n * to);
        const std::uint32_t* source = words_of(old.get());
        std::uint32_t* words = words_of(out_.data.get());
        for (std::uint64_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < to; ++k)
                words[i * to + k] =
                    k < from ? source[i * from + k] : std::bit_cast<std::uint32_t>(1.0F);
    }

    /// Values outside a hard range are moved to its ends.
    bool clamp_words() {
        const std::uint64_t n =
            std::uint64_t{out_.n} * out_.n_keys * component_count(target_.type);
        const ParamInfo* info = target_.info;
        if (info == nullptr || target_.type == ParamType::Matrix) return true;
        std::uint32_t* words = words_of(out_.data.get());
        if (target_.type == ParamType::Enum && !info->enumerators.empty()) {
            const auto last = static_cast<double>(info->enumerators.size() - 1);
            return clamp_numbers(words, n, 0, last);
        }
        if (!info->hard_range || target_.type == ParamType::Bool) return true;
        return clamp_numbers(
            words, n, info->low ? double{*info->low} : -std::numeric_limits<double>::infinity(),
            info->high ? double{*info->high} : std::numeric_limits<double>::infinity());
    }

    bool clamp_numbers(std::uint32_t* words, std::uint64_t n, double low, double high) {
        const bool floats = is_float_type(target_.type),
                   is_signed = target_.type != ParamType::UInt && target_.type != ParamType::Byte;
        bool reported = false;
        for (std::uint64_t i = 0; i < n; ++i) {
            const double number =
                floats      ? double{std::bit_cast<float>(words[i])}
                : is_signed ? double{static_cast<double>(static_cast<std::int32_t>(words[i]))}
                            : double{static_cast<double>(words[i])};
            if (number >= low && number <= high) continue;
            const double moved = number > high ? high : low;  // nan goes to the lower end
            words[i] = floats ? std::bit_cast<std::uint32_t>(static_cast<float>(moved))
                              : static_cast<std::uint32_t>(static_cast<std::int64_t>(moved));
            if (!reported)
                diagnostics_.warning(
                    Code::ParamRange,
                    fmt::format("{} cannot be {}: {} is used", target_.label, number, moved),
                    where());
            reported = true;
        }
        return true;
    }

    /// BOOL and BYTE take one byte in memory.
    bool shrink() {
        if (target_.type != ParamType::Bool && target_.type != ParamType::Byte) return true;
        const std::uint64_t n = std::uint64_t{out_.n} * out_.n_keys;
        const std::uint32_t* words = words_of(out_.data.get());
        auto bytes = std::make_unique<std::byte[]>(n);
        for (std::uint64_t i = 0; i < n; ++i)
            bytes[i] = static_cast<std::byte>(words[i]);
        out_.data = std::move(bytes);
        return true;
    }

    bool fits_one() {
        if (target_.is_array || out_.n == 0) return true;
        if (out_.n > 1)
            return wrong_type(is_array_form() ? fmt::format("an array of {}", out_.n)
                                              : fmt::format("{} values", out_.n));
        if (out_.n_keys > 1)
            diagnostics_.warning(
                Code::ParamPending,
                fmt::format("motion keys of {} are not supported yet: the first is used",
                            target_.label),
                where());
        return true;
    }

    const ValueText& value_;
    const std::shared_ptr<const SourceText>& source_;
    const ReadTarget& target_;
    const FindNode& find_node_;
    std::uint64_t& run_bytes_;
    Diagnostics& diagnostics_;
    TypedValues out_;
};

}  // namespace

std::optional<bool> parse_bool(std::string_view word) {
    if (word.size() > 5) return std::nullopt;
    const std::string small = lower(word);
    if (small == "on" || small == "true") return true;
    if (small == "off" || small == "false") return false;
    return std::nullopt;
}

std::int32_t find_enumerator(const ParamInfo& info, std::string_view word) {
    for (std::size_t i = 0; i < info.enumerators.size(); ++i)
        if (info.enumerators[i] == word) return static_cast<std::int32_t>(i);
    const std::string small = lower(word);
    for (std::size_t i = 0; i < info.enumerators.size(); ++i)
        if (lower(info.enumerators[i]) == small) return static_cast<std::int32_t>(i);
    return -1;
}

std::optional<std::string> single_text(const ValueText& value, const SourceText& source) {
    const std::string_view raw =
        std::string_view(source.text).substr(value.range.offset, value.range.length);
    if (value.form == ValueForm::Word) return std::string(raw);
    if (value.form != ValueForm::Strings) return std::nullopt;
    AssLexer lexer(raw);
    const Token first = lexer.next();
    if (lexer.peek() != '\0') return std::nullopt;
    return unquote(lexer.text(first));
}

std::optional<TypedValues> ParamReader::read(const ValueText& value,
                                             const std::shared_ptr<const SourceText>& source,
                                             const ReadTarget& target) {
    return Conversion(value, source, target, find_node_, run_bytes_, diagnostics_).run();
}

}  // namespace lightsieve
