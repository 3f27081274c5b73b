// Typed values as .ass text.
#pragma once

#include <string>
#include <string_view>

#include "scene/graph.h"

namespace lightsieve {

/// The fewest digits that read back to the same bits; inf, -inf, nan.
[[nodiscard]] std::string float_text(float value);

/// One value of a parameter: `0.8 0.8 0.8`, `on`, `"left"`, a node's name in quotes or NULL.
///
/// data         as it lies in a block or an array
/// info         for the names of an enumeration; null: numbers
[[nodiscard]] std::string value_text(ParamType type, const std::byte* data, const ParamInfo* info);

/// `N KEYS TYPE` and the values, a few on each line, each line after the first indented by `indent`.
[[nodiscard]] std::string array_text(ParamType type, const std::byte* data, std::size_t n,
                                     std::size_t n_keys, const ParamInfo* info,
                                     std::string_view indent);

}  // namespace lightsieve
