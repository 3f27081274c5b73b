// Where a moving object is at one time.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/matrix.h"
#include "render/scene_object.h"

namespace lightsieve {

/// Two neighbouring keys and how far the time lies between them.
struct KeyBlend {
    std::size_t first = 0, second = 0;
    float f = 0;
};

inline KeyBlend blend_at(std::size_t n_keys, float time) {
    if (n_keys <= 1) return {};
    const float x = std::clamp(time, 0.0F, 1.0F) * static_cast<float>(n_keys - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), n_keys - 2);
    return {i, i + 1, x - static_cast<float>(i)};
}

/// Placement of an object at a time: matrix and inverse.
struct Placement {
    const Mat4f &world_from_object, &object_from_world;
    bool in_place = false;  ///< both are the identity

    [[nodiscard]] Vec3f point_to_world(Vec3f p) const {
        return in_place ? p : world_from_object.point(p);
    }
    [[nodiscard]] Vec3f vector_to_world(Vec3f v) const {
        return in_place ? v : world_from_object.vector(v);
    }
    /// Not normalised.
    [[nodiscard]] Vec3f normal_to_world(Vec3f n) const {
        return in_place ? n : object_from_world.normal_by_inverse(n);
    }
    [[nodiscard]] Vec3f point_to_object(Vec3f p) const {
        return in_place ? p : object_from_world.point(p);
    }
    [[nodiscard]] Vec3f vector_to_object(Vec3f v) const {
        return in_place ? v : object_from_world.vector(v);
    }
};

/// Calls `body` with the object's placement; matrices of things at rest are not copied.
template <class Body>
auto with_placement(const SceneObject& object, float time, const Body& body) {
    if (object.world_from_object.size() == 1)
        return body(
            Placement{object.world_from_object[0], object.object_from_world[0], object.in_place});
    const KeyBlend k = blend_at(object.world_from_object.size(), time);
    const Mat4f m = lerp(object.world_from_object[k.first], object.world_from_object[k.second],
                         k.f),
                inverse = m.inverse();
    return body(Placement{m, inverse});
}

}  // namespace lightsieve
