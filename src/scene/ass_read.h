// Reads .ass files (and .ass.gz) into a Document.
//
// The reader is tolerant: every lexical habit of Arnold's writers and exporters is accepted (README.md lists them). It
// never stops at the first mistake: each is reported with its place, and reading goes on at the next parameter
// or node. Memory grows with the file only: counts in array heads are checked against the data that is there.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/diagnostics.h"
#include "scene/document.h"

namespace lightsieve {

/// Gives the text of a file, or nothing if there is none. Called for include statements.
using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;

/// Text after decompression beyond this many bytes is refused (gzip can pack 1000 to 1).
inline constexpr std::size_t kMaxSceneBytes = std::size_t{16} << 30U;
/// Include statements in all, so that files that include each other twice end somewhere.
inline constexpr std::size_t kMaxIncludes = 4096;
/// Include statements inside included files inside ...
inline constexpr std::size_t kMaxIncludeDepth = 32;

/// Reads a scene's text.
///
/// text       the file's bytes
/// name       shown in diagnostics; includes are looked for beside it
/// read_file  opens included files; without one each include is an error
[[nodiscard]] Document read_ass(std::string text, std::string name, const ReadFile& read_file,
                                Diagnostics& diagnostics);

/// Reads a file and the files that it includes; gzip is recognised by content. Errors: file-*, ass-*, array-*, include-*, limit-*.
[[nodiscard]] Document read_ass_file(const std::string& path, Diagnostics& diagnostics);

/// A file's bytes, decompressed if they are gzip, at most `max_bytes`; nothing with an error reported otherwise.
[[nodiscard]] std::optional<std::string> read_text_file(const std::string& path,
                                                        Diagnostics& diagnostics,
                                                        std::size_t max_bytes = kMaxSceneBytes);

}  // namespace lightsieve
