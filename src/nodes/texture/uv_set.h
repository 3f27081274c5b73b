// Texture coordinates of a named set in place of the first one.
#pragma once

#include "scene/describe.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// The point with the texture coordinates of a set; as it is if the name is empty or the shape has no such set.
[[nodiscard]] inline ShadePoint with_uv_set(const ShadePoint& at, Name uvset) {
    ShadePoint out = at;
    UvPoint set;
    if (uvset.empty() || at.services == nullptr || !at.services->uv_set(at, uvset, set))
        return out;
    out.uv = set.uv;
    out.dp_du = set.dp_du;
    out.dp_dv = set.dp_dv;
    out.uv_width = set.width;
    return out;
}

/// The same for nodes that need the coordinates alone.
[[nodiscard]] inline UvPoint uv_of_set(const ShadePoint& at, Name uvset) {
    UvPoint set;
    if (!uvset.empty() && at.services != nullptr && at.services->uv_set(at, uvset, set))
        return set;
    return {at.uv, at.dp_du, at.dp_dv, at.uv_width};
}

}  // namespace lightsieve
