// What the ray switches share: which of their inputs a ray takes.
#pragma once

#include "scene/shade_point.h"

namespace lightsieve {

/// The input of `node` for a type of ray; rays from below a surface count as diffusely transmitted.
template <class Node>
[[nodiscard]] const auto& input_for_ray(const Node& node, RayType type) {
    switch (type) {
        case RayType::Camera: return node.camera;
        case RayType::Shadow: return node.shadow;
        case RayType::DiffuseReflect: return node.diffuse_reflection;
        case RayType::DiffuseTransmit:
        case RayType::Subsurface: return node.diffuse_transmission;
        case RayType::SpecularReflect: return node.specular_reflection;
        case RayType::SpecularTransmit: return node.specular_transmission;
        case RayType::Volume: break;
    }
    return node.volume;
}

}  // namespace lightsieve
