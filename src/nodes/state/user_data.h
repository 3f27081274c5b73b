// What the user_data_* nodes share: the name of the data, and finding it at the point.
#pragma once

#include <cmath>

#include "scene/describe.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// One of the nodes: user data named `attribute` as a T, or `fallback`.
template <class T>
struct UserDataNode {
    Name attribute;
    T fallback{};
};

template <class T>
void describe_user_data(Describe<T>& d) {
    d.param("attribute", &T::attribute, "Name of the user data.");
    d.param("default", &T::fallback, "What shapes have that do not carry it.");
}

/// The numbers of the user data at the point; false if the shape has none of that name.
[[nodiscard]] inline bool find_user_value(const ShadePoint& at, Name attribute, ShaderValue& out) {
    return at.services != nullptr && at.services->user_value(at, attribute, out);
}

/// The nearest whole number.
[[nodiscard]] inline std::int32_t int_from(float v) {
    constexpr float kLargest = 2147483520.0F;  // largest float below 2^31
    return static_cast<std::int32_t>(std::lround(std::fmin(std::fmax(v, -kLargest), kLargest)));
}

}  // namespace lightsieve
