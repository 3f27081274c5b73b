// What nodes that give a normal share: the normal that they start from, and tangents around it.
#pragma once

#include <cmath>

#include "nodes/shader/shader_common.h"
#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// The shading normal on the side that the surface's own normal points to, or what a parameter puts in its place.
///
/// linked  the parameter, world space; 0 0 0: nothing is linked
[[nodiscard]] inline Vec3f outward_normal(const ShadePoint& at, Vec3f linked) {
    const Vec3f own = at.entering ? at.normal : -at.normal;
    return normalize(linked, own);
}

/// Tangents across a normal, with the lengths that they have on the surface: dP/du and dP/dv where there are texture
/// coordinates, else any two.
struct Tangents {
    Vec3f u, v;
    bool by_uv = false;
};
[[nodiscard]] inline Tangents tangents_across(const ShadePoint& at, Vec3f normal) {
    const Vec3f u = at.dp_du - normal * dot(normal, at.dp_du),
                v = at.dp_dv - normal * dot(normal, at.dp_dv);
    const Vec3f across = cross(u, v);
    if (length_squared(across) > 1e-12F * length_squared(u) * length_squared(v))
        return {u, v, true};
    const Frame any = Frame::from_z(normal);
    return {any.x, any.y, false};
}

/// An orthonormal frame around a normal with x along the tangent and y on the side of dP/dv.
[[nodiscard]] inline Frame tangent_frame(const ShadePoint& at, Vec3f normal, Vec3f tangent) {
    Frame out =
        Frame::from_z_x(normal, tangent == Vec3f{} ? tangents_across(at, normal).u : tangent);
    if (dot(out.y, at.dp_dv) < 0) out.y = -out.y;
    return out;
}

/// Order in which the channels of a map hold the axes.
enum class MapOrder : std::int32_t { Xyz, Xzy, Yxz, Yzx, Zxy, Zyx };
[[nodiscard]] inline std::vector<std::string> map_order_names() {
    return {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"};
}

/// What normal_map and vector_map do to the colour of their map. Parameter structs derive from it.
struct MappedVector {
    Vec3f input, tangent, normal;
    MapOrder order = MapOrder::Xyz;
    bool invert_x = false, invert_y = false, invert_z = false;
    bool color_to_signed = true, tangent_space = true;

    void prepare(NodeContext& context) {
        if (!context.is_linked("tangent")) tangent = {};
        if (!context.is_linked("normal")) normal = {};
    }
    /// The map's vector along its axes.
    [[nodiscard]] Vec3f along_axes() const {
        const Vec3f c = color_to_signed ? input * 2 - Vec3f{1, 1, 1} : input;
        Vec3f v;
        switch (order) {
            case MapOrder::Xyz: v = c; break;
            case MapOrder::Xzy: v = {c.x, c.z, c.y}; break;
            case MapOrder::Yxz: v = {c.y, c.x, c.z}; break;
            case MapOrder::Yzx: v = {c.z, c.x, c.y}; break;
            case MapOrder::Zxy: v = {c.y, c.z, c.x}; break;
            case MapOrder::Zyx: v = {c.z, c.y, c.x}; break;
        }
        if (invert_x) v.x = -v.x;
        if (invert_y) v.y = -v.y;
        if (invert_z) v.z = -v.z;
        return v;
    }
};

template <class T>
void describe_mapped_vector(Describe<T>& d) {
    d.param("input", &T::input, "The map.");
    d.param("tangent", &T::tangent, "First axis of tangent space; acts when linked, else dP/du.");
    d.param("normal", &T::normal, "Last axis of tangent space; acts when linked.");
    d.param("order", &T::order, "Axes that the map's channels hold.").names(map_order_names());
    d.param("invert_x", &T::invert_x, "Turns the x axis.");
    d.param("invert_y", &T::invert_y, "Turns the y axis.");
    d.param("invert_z", &T::invert_z, "Turns the z axis.");
    d.param("color_to_signed", &T::color_to_signed, "0..1 of the map means -1..1.");
    d.param("tangent_space", &T::tangent_space,
            "The axes are tangents and normal of the surface.");
}

}  // namespace lightsieve
