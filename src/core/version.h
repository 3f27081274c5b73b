// The version that the build system knows, for headers of files and `--version`.
#pragma once

#include <string_view>

namespace lightsieve {

inline constexpr std::string_view kVersion = LIGHTSIEVE_VERSION;

}  // namespace lightsieve
