// Node types of Arnold that do not exist here, and what a picture lacks without them.
//
// For the warning where a scene has one: "not known" alone would not say whether the picture can be trusted.
#pragma once

#include <string_view>

namespace lightsieve {

/// What is lost, and what to do about it; empty for types that Arnold does not have either, or nobody has looked at.
[[nodiscard]] std::string_view lost_without(std::string_view node_type);

}  // namespace lightsieve
