// Checks that plain shapes share. A shape that cannot be drawn is left out with a warning; the others are shown.
#pragma once

#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>

#include "scene/node_context.h"
#include "scene/shape.h"

namespace lightsieve {

/// Coordinates and radii beyond it are no scene but a mistake, and more than the ray library takes.
inline constexpr float kLargestCoordinate = 1e15F;

/// Reports a shape that is left out.
inline void warn_left_out(NodeContext& context, const std::string& problem, const char* param) {
    context.diagnostics().warning(Code::ShapeBad, problem + "; the shape is left out",
                                  context.where(param));
}

/// A number or vector parameter with its name.
struct CheckedValue {
    const char* param;
    Vec3f value;
    CheckedValue(const char* name, Vec3f v) : param(name), value(v) {}
    CheckedValue(const char* name, float v) : param(name), value{v, 0, 0} {}
};

/// Whether all values are finite and of a possible size; if not, says which is not.
inline bool all_possible(NodeContext& context, std::initializer_list<CheckedValue> values) {
    for (const CheckedValue& v : values)
        for (int i = 0; i < 3; ++i) {
            if (std::abs(v.value[i]) <= kLargestCoordinate) continue;
            warn_left_out(context,
                          std::string(v.param) +
                              (std::isfinite(v.value[i]) ? " is too large" : " is not finite"),
                          v.param);
            return false;
        }
    return true;
}

/// Whether a radius is not negative; if it is, says so.
inline bool not_negative(NodeContext& context, const char* param, float radius) {
    if (radius >= 0) return true;
    warn_left_out(context, std::string(param) + " is negative", param);
    return false;
}

/// A geometry of one simple shape.
inline std::unique_ptr<ShapeGeometry> geometry_from(const SimpleShape& shape) {
    auto out = std::make_unique<ShapeGeometry>();
    out->data = shape;
    return out;
}

/// The mantle from `bottom` to `top`; null, with a warning, if there is nothing to see.
inline std::unique_ptr<ShapeGeometry> mantle(NodeContext& context, Vec3f bottom, Vec3f top,
                                             float bottom_radius, float top_radius,
                                             const char* radius_param) {
    SimpleShape out;
    out.base = bottom;
    out.height = length(top - bottom);
    out.axis = normalize(top - bottom, {0, 1, 0});
    out.radius = bottom_radius;
    out.second_radius = top_radius;
    if (!(out.height > 0)) {
        warn_left_out(context, "top and bottom are the same point", "top");
        return nullptr;
    }
    if (bottom_radius == 0 && top_radius == 0) {
        warn_left_out(context, "the radius is 0", radius_param);
        return nullptr;
    }
    return geometry_from(out);
}

}  // namespace lightsieve
