#include "core/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace lightsieve {
namespace {

struct CodeRow {
    std::string_view text, meaning;
};
constexpr CodeRow kCodes[] = {
#define X(enumerator, text, meaning) {text, meaning},
#include "core/error_codes.def"
#undef X
};

/// Longest part of a quoted line; longer lines (arrays of a mesh) are cut around the place.
constexpr std::size_t kMaxQuoted = 120;

std::size_t count_characters(std::string_view bytes) {
    return static_cast<std::size_t>(std::count_if(bytes.begin(), bytes.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

/// `   14 | text` and a line of carets under the span.
std::string quote(const SourceSpan& where) {
    std::string_view line = where.line();
    const char* first =
        where.source->text.data() + std::min(where.offset, where.source->text.size());
    std::size_t start = static_cast<std::size_t>(first - line.data());
    // Cut a very long line so that the place stays in view.
    std::size_t cut = 0;
    if (line.size() > kMaxQuoted && start > kMaxQuoted / 2) cut = start - kMaxQuoted / 2;
    const bool cut_front = cut > 0;
    line = line.substr(cut, kMaxQuoted);
    start -= cut;
    const std::string number = std::to_string(where.line_column().line);
    const std::string gutter =
        std::string(number.size() < 5 ? 5 - number.size() : 0, ' ') + number + " | ";
    std::string shown;
    for (char c : line)
        shown += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    const std::size_t before = count_characters(line.substr(0, std::min(start, line.size())));
    const std::size_t inside =
        start < line.size() ? count_characters(line.substr(start, where.length)) : 0;
    std::string marks =
        std::string(before, ' ') + "^" + std::string(inside > 1 ? inside - 1 : 0, '~');
    return gutter + (cut_front ? "..." : "") + shown + "\n" + std::string(gutter.size() - 2, ' ') +
           "| " + (cut_front ? "   " : "") + marks + "\n";
}

std::string place(const SourceSpan& where) {
    if (!where.known()) return "";
    const LineColumn at = where.line_column();
    return where.source->name + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) +
           ": ";
}

std::string joined(const std::vector<Error>& errors) {
    std::string out;
    for (const Error& e : errors)
        out += e.render() + "\n";
    if (!out.empty()) out.pop_back();
    return out;
}

}  // namespace

LineColumn SourceSpan::line_column() const {
    if (!source) return {};
    const std::string_view before =
        std::string_view(source->text).substr(0, std::min(offset, source->text.size()));
    const std::size_t newline = before.rfind('\n');
    const std::string_view last =
        newline == std::string_view::npos ? before : before.substr(newline + 1);
    return {1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
            1 + count_characters(last)};
}

std::string_view SourceSpan::line() const {
    if (!source) return {};
    const std::string_view all = source->text;
    const std::size_t at = std::min(offset, all.size());
    const std::size_t newline = at == 0 ? std::string_view::npos : all.rfind('\n', at - 1);
    const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    std::string_view line = all.substr(begin, all.find('\n', at) - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

std::string_view SourceSpan::text() const {
    return source ? std::string_view(source->text)
                        .substr(std::min(offset, source->text.size()), length)
                  : std::string_view{};
}

std::string_view code_text(Code code) { return kCodes[static_cast<std::size_t>(code)].text; }
std::string_view code_meaning(Code code) { return kCodes[static_cast<std::size_t>(code)].meaning; }

std::vector<Code> all_codes() {
    std::vector<Code> out;
    for (std::size_t i = 0; i < std::size(kCodes); ++i)
        out.push_back(static_cast<Code>(i));
    return out;
}

std::string Error::render() const {
    const char* kind = severity == Severity::Error     ? "error"
                       : severity == Severity::Warning ? "warning"
                                                       : "lint";
    std::string out =
        place(where) + kind + "[" + std::string(code_text(code)) + "]: " + message + "\n";
    if (where.known()) out += quote(where);
    if (!hint.empty()) out += "  hint: " + hint + "\n";
    for (const Note& note : notes) {
        out += "  note: " + note.message;
        if (note.where.known()) {
            std::string at = place(note.where);
            out += " at " + at.substr(0, at.size() - 2);
        }
        out += "\n";
    }
    out.pop_back();
    return out;
}

InputError::InputError(Error error) : InputError(std::vector<Error>{std::move(error)}) {}
InputError::InputError(std::vector<Error> errors)
    : errors_(std::move(errors)), text_(joined(errors_)) {}

void report_bug(const char* condition, const char* file, int line, const std::string& values) {
    std::fprintf(stderr,
                 "lightsieve: bug: %s failed at %s:%d (%s)\nplease report this with the scene or "
                 "the expression that caused it\n",
                 condition, file, line, values.c_str());
    std::abort();
}

}  // namespace lightsieve
