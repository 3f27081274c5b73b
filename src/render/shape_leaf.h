// A shape on its way into the world, while instances, instancers and procedurals around it are followed.
//
// The compiler walks from the outside in and comes back with leaves: shapes with geometry, in the space of the node that
// was asked. Each node that they pass adds its matrix, its own values and a step of their lineage. Leaves are small and
// know only nodes: programs and light samplers are found once they have arrived (compile_shapes.cpp).
#pragma once

#include <functional>
#include <vector>

#include "render/scene_object.h"
#include "scene/graph.h"

namespace lightsieve {

struct ShapeLeaf {
    const NodeInstance* shape = nullptr;  ///< the node that has the geometry
    const ShapeGeometry* geometry = nullptr;
    std::vector<Mat4f>
        placement;  ///< keys over the shutter, into the space of the node that was asked
    const Lineage* lineage = nullptr;
    std::uint64_t instance = 0;                ///< as SceneObject::instance
    Array<NodeRef> shaders;                    ///< one, or by shidxs
    Name label;                                ///< lpe_label
    const NodeInstance* outermost = nullptr;   ///< whose place messages name
    Array<NodeRef> light_group, shadow_group;  ///< for those that are in use
    bool use_light_group = false, use_shadow_group = false;
    Name name;
    std::uint32_t id = 0;  ///< 0: a hash of the name
    float step_size = 0;
    std::uint8_t visibility = 255, sidedness = 255;
    bool matte = false, invert_normals = false, receive_shadows = true, self_shadows = true;
};

/// Where leaves go.
using LeafSink = std::function<void(ShapeLeaf&&)>;

/// How a node is asked for its leaves.
struct LeafUse {
    bool as_source = false;   ///< an instance places it: its own visibility says nothing
    bool with_matrix = true;  ///< its own matrix counts
    int depth = 0;            ///< instances of instances of ...
};

}  // namespace lightsieve
