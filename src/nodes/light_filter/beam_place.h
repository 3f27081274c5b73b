// Where a point lies in the picture that a spot light throws: for barn doors and slides, which hang in its beam.
#pragma once

#include <optional>
#include <string>

#include "core/vec.h"
#include "scene/light_filter.h"
#include "scene/node_context.h"

namespace lightsieve {

/// Of a world space point in the square around the cone: x to the right, y down as seen from the light, both 0..1 inside;
/// nothing behind the light.
[[nodiscard]] inline std::optional<Vec2f> beam_place(const LightPlace& place, Vec3f point) {
    const Vec3f p = place.light_from_world.point(point);
    if (!(p.z < 0) || !(place.cone_tangent > 0)) return std::nullopt;
    const float scale = 0.5F / (-p.z * place.cone_tangent);
    return Vec2f{0.5F + p.x * scale, 0.5F - p.y * scale};
}

/// False with a warning if the light has no cone to hang something into.
[[nodiscard]] inline bool has_beam(const LightPlace& place, NodeContext& context,
                                   const char* what) {
    if (place.cone_tangent > 0) return true;
    context.diagnostics().warning(Code::InvalidValue,
                                  std::string(what) + " \"" + context.node_name().str() +
                                      "\" needs a spot light: it is left out",
                                  context.where("name"));
    return false;
}

}  // namespace lightsieve
