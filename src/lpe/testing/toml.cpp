#include "lpe/testing/toml.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace lightsieve::lpe::testing {
namespace {

class Reader {
  public:
    Reader(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

    std::vector<TomlEntry> read() {
        std::vector<TomlEntry> entries;
        for (skip_space(); at_ < text_.size(); skip_space()) {
            if (peek() == '[') {
                const std::size_t header_line = line();
                expect('['), expect('[');
                entries.push_back({read_key(), header_line});
                expect(']'), expect(']');
            } else {
                if (entries.empty()) fail("a key before the first [[..]]");
                read_pair(entries.back().table);
            }
        }
        return entries;
    }

  private:
    [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    [[nodiscard]] std::size_t line() const {
        return 1 + static_cast<std::size_t>(std::count(
                       text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw std::runtime_error(file_ + ":" + std::to_string(line()) + ": " + message);
    }
    void expect(char c) {
        if (peek() != c) fail(std::string("expected ") + c);
        ++at_;
    }
    /// Blanks, newlines and comments.
    void skip_space() {
        while (at_ < text_.size()) {
            if (peek() == '#')
                at_ = std::min(text_.find('\n', at_), text_.size());
            else if (std::isspace(static_cast<unsigned char>(peek())) != 0)
                ++at_;
            else
                return;
        }
    }
    std::string read_key() {
        std::string key;
        while (std::isalnum(static_cast<unsigned char>(peek())) != 0 || peek() == '_')
            key += text_[at_++];
        if (key.empty()) fail("expected a key");
        return key;
    }
    void read_pair(TomlTable& table) {
        const std::string key = read_key();
        skip_space();
        expect('=');
        skip_space();
        if (!table.emplace(key, read_value()).second) fail("key twice: " + key);
    }
    TomlValue read_value() {
        switch (peek()) {
            case '"': return {read_string()};
            case '[': return {read_array()};
            case '{': return {read_table()};
            case 't': return take_word("true"), TomlValue{true};
            case 'f': return take_word("false"), TomlValue{false};
            default: return {read_integer()};
        }
    }
    void take_word(const std::string& word) {
        if (text_.compare(at_, word.size(), word) != 0) fail("expected " + word);
        at_ += word.size();
    }
    std::int64_t read_integer() {
        std::size_t used = 0;
        const std::string digits =
            text_.substr(at_, text_.find_first_not_of("-0123456789", at_) - at_);
        if (digits.empty()) fail("expected a value");
        const std::int64_t value = std::stoll(digits, &used);
        at_ += used;
        return value;
    }
    TomlArray read_array() {
        TomlArray array;
        expect('[');
        for (skip_space(); peek() != ']'; skip_space()) {
            array.push_back(read_value());
            skip_space();
            if (peek() != ']') expect(',');
        }
        expect(']');
        return array;
    }
    TomlTable read_table() {
        TomlTable table;
        expect('{');
        for (skip_space(); peek() != '}'; skip_space()) {
            read_pair(table);
            skip_space();
            if (peek() != '}') expect(',');
        }
        expect('}');
        return table;
    }
    std::string read_string() {
        std::string out;
        expect('"');
        while (peek() != '"') {
            if (at_ >= text_.size() || peek() == '\n') fail("a string that does not end");
            if (peek() == '\\')
                out += read_escape();
            else
                out += text_[at_++];
        }
        expect('"');
        return out;
    }
    std::string read_escape() {
        expect('\\');
        const char c = peek();
        ++at_;
        switch (c) {
            case 'n': return "\n";
            case 't': return "\t";
            case '"': return "\"";
            case '\\': return "\\";
            case 'u': break;
            default: fail(std::string("unknown escape ") + c);
        }
        const auto code = static_cast<unsigned>(std::stoul(text_.substr(at_, 4), nullptr, 16));
        at_ += 4;
        // UTF-8 of a code point below 0x10000.
        const auto byte = [](unsigned value) {
            return static_cast<char>(static_cast<unsigned char>(value));
        };
        if (code < 0x80) return {byte(code)};
        if (code < 0x800) return {byte(0xC0U | code >> 6U), byte(0x80U | (code & 0x3FU))};
        return {byte(0xE0U | code >> 12U), byte(0x80U | (code >> 6U & 0x3FU)),
                byte(0x80U | (code & 0x3FU))};
    }

    std::string text_, file_;
    std::size_t at_ = 0;
};

}  // namespace

std::string TomlEntry::text(const std::string& key) const {
    return has(key) ? std::get<std::string>(table.at(key).value) : "";
}

std::vector<std::string> TomlEntry::texts(const std::string& key) const {
    std::vector<std::string> out;
    if (has(key))
        for (const TomlValue& item : std::get<TomlArray>(table.at(key).value))
            out.push_back(std::get<std::string>(item.value));
    return out;
}

std::vector<TomlTable> TomlEntry::tables(const std::string& key) const {
    std::vector<TomlTable> out;
    if (has(key))
        for (const TomlValue& item : std::get<TomlArray>(table.at(key).value))
            out.push_back(std::get<TomlTable>(item.value));
    return out;
}

std::vector<TomlEntry> read_toml(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + file.string());
    return Reader({std::istreambuf_iterator<char>(in), {}}, file.filename().string()).read();
}

}  // namespace lightsieve::lpe::testing
