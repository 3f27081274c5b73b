// Texts that errors point into (a scene file, an expression) and places in them.
//
// A place is a byte offset and a length; line and column are computed only when an error is shown,
// so that a parser can keep a place for every value at the cost of two integers.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace lightsieve {

/// A named text that diagnostics quote. Immutable once shared.
struct SourceText {
    std::string name;  ///< shown before the line number: a path, or "<expression>"
    std::string text;  ///< the whole text, as read
};

/// One line and column, both counted from 1; the column counts characters (UTF-8), not bytes.
struct LineColumn {
    std::size_t line = 1;
    std::size_t column = 1;
};

/// A run of bytes of a text. Default constructed: no place is known.
struct SourceSpan {
    /// Shared because errors outlive the parser and the document that they came from.
    std::shared_ptr<const SourceText> source;
    std::size_t offset = 0;  ///< first byte
    std::size_t length = 0;  ///< bytes; 0 is a place between two characters

    [[nodiscard]] bool known() const { return source != nullptr; }
    /// Line and column of the first byte. Cost: one pass over the text before it.
    [[nodiscard]] LineColumn line_column() const;
    /// The whole line that the first byte lies in, without its end.
    [[nodiscard]] std::string_view line() const;
    /// The bytes that the span covers.
    [[nodiscard]] std::string_view text() const;
};

}  // namespace lightsieve
