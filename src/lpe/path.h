// Light paths as people write them, for the command line, witnesses of proofs, logs and tests.
//
// A path is events separated by blanks, each as in an expression, with or without the angle
// brackets: `C RD L`, `C <RS'coat'> TS L'key'`, `C V O'fire'`. Every event must be a single one:
// `D` is not, `RD` is.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/event.h"

namespace lightsieve::lpe {

/// A light path from the camera: C, scattering events, one terminal event.
using Path = std::vector<Event>;

/// Reads a path.
///
/// base         where the text stands, as for `parse`; unknown: the text itself is quoted
/// diagnostics  gets what is wrong with it (code `lpe-path`), at the exact column
/// returns      the path, or nothing if there was an error; L without a group is in group
///              `default`
[[nodiscard]] std::optional<Path> parse_path(std::string_view text, const SourceSpan& base,
                                             Diagnostics& diagnostics);
[[nodiscard]] std::optional<Path> parse_path(std::string_view text, Diagnostics& diagnostics);

/// The path as `parse_path` reads it: `C RS'coat' L'key'`.
[[nodiscard]] std::string print_path(std::span<const Event> path);
/// One event: `RS'coat'`, `L` for a light of group `default`.
[[nodiscard]] std::string print_event(const Event& event);

/// Is this C, scattering events and exactly one terminal event (a probe only after a scattering
/// event)?
[[nodiscard]] bool is_path(std::span<const Event> path);

}  // namespace lightsieve::lpe
