// The space in which a solid texture lies.
#pragma once

#include "nodes/shader/shader_common.h"
#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_services.h"

namespace lightsieve {

enum class CoordSpace : std::int32_t { World, Object, Pref, Uv };

/// Parameters of nodes with a place in space. Parameter structs derive from it.
struct SolidPlace {
    CoordSpace coord_space = CoordSpace::Object;
    Name pref_name = "Pref";
    Vec3f P;
    bool p_linked = false;  ///< found by prepare()

    void prepare(NodeContext& context) { p_linked = context.is_linked("P"); }
    /// Where the point lies in the space that the node asks for. Shapes without Pref have their object space.
    [[nodiscard]] Vec3f place(const ShadePoint& at) const {
        if (p_linked) return P;
        ShaderValue pref;
        switch (coord_space) {
            case CoordSpace::World: return at.position;
            case CoordSpace::Uv: return {at.uv.x, at.uv.y, 0};
            case CoordSpace::Pref:
                if (at.services != nullptr && at.services->user_value(at, pref_name, pref))
                    return {pref.rgb.r, pref.rgb.g, pref.rgb.b};
                break;
            case CoordSpace::Object: break;
        }
        return at.services != nullptr ? at.services->object_from_world(at).point(at.position)
                                      : at.position;
    }
};

template <class T>
void describe_solid_place(Describe<T>& d) {
    d.param(
         "coord_space", &T::coord_space,
         "Space of the pattern: the world, the object, the object at rest, texture coordinates.")
        .names({"world", "object", "Pref", "uv"});
    d.param("pref_name", &T::pref_name, "User data with the points at rest, for Pref.");
    d.param("P", &T::P, "The point in place of the hit's own; acts when linked.");
}

}  // namespace lightsieve
