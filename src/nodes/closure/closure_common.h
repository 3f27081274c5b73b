// What the closures of this folder share: weight, label and the frame around a normal of their own.
//
// Each file is one closure of MaterialX by its name and inputs; `label` is added, which MaterialX lacks: it joins the event
// that the closure's light makes, so that light path expressions can ask for it. A closure is a shader: a shape may use it
// as it is, or layer, mix, add and multiply combine several.
// Source: MaterialX Specification 1.39, physically based shading nodes.
#pragma once

#include "bsdf/closure.h"
#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {

/// What a scattering closure of any kind has. Parameter structs derive from it.
struct ScatterCommon {
    float weight = 1;
    Vec3f normal{0, 0, 0};  ///< world space; acts only when linked
    Name label;

    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }
    [[nodiscard]] static bool reads_coordinates() { return false; }
    /// The closure's frame in the set; its x axis is along `tangent` (0 0 0: the hit's own).
    [[nodiscard]] std::uint8_t frame(const ShadePoint& at, ClosureSet& out,
                                     Vec3f tangent = {}) const {
        if (normal == Vec3f{} && tangent == Vec3f{}) return 0;
        return out.add_frame(Frame::from_z_x(shading_normal(at, normal),
                                             tangent == Vec3f{} ? at.tangent : tangent));
    }
};

/// normal_acts  false for closures that go by other directions than the surface's
template <class T>
void describe_scatter(Describe<T>& d, bool normal_acts = true) {
    d.param("weight", &T::weight, "Factor on all that the closure does.").range(0, 1);
    if (normal_acts)
        d.param("normal", &T::normal, "Normal, world space; acts when linked.");
    else
        d.param("normal", &T::normal, "Has no effect: this closure does not go by the normal.")
            .ignored();
    d.param("label", &T::label, "Joins the closure's events, for light path expressions.");
}

/// Microfacets of a closure with `roughness`: the widths along both axes, already squared.
struct MicrofacetCommon : ScatterCommon {
    Vec2f roughness{0.05F, 0.05F};
    Vec3f tangent{0, 0, 0};  ///< world space; acts only when linked
    float thinfilm_thickness = 0, thinfilm_ior = 1.5F;
    bool caustics = true;

    void prepare(NodeContext& context) {
        ScatterCommon::prepare(context);
        if (!context.is_linked("tangent")) tangent = {};
    }
    [[nodiscard]] bool reads_coordinates() const { return roughness.x != roughness.y; }
    [[nodiscard]] GgxAlpha alpha() const { return {roughness.x, roughness.y}; }
    /// Reflection by a base of these indices under the film.
    [[nodiscard]] FilmReflect filmed(Color n, Color k) const {
        return FilmReflect(alpha(), thinfilm_thickness, thinfilm_ior, n, k);
    }
};

template <class T>
void describe_microfacets(Describe<T>& d) {
    describe_scatter(d);
    d.param("roughness", &T::roughness,
            "Width of the microfacets along both axes: the square of an artist's roughness.")
        .range(0, 1);
    d.param("tangent", &T::tangent, "Direction of the first axis, world space; acts when linked.");
    d.param("thinfilm_thickness", &T::thinfilm_thickness,
            "Thickness of an iridescent film; 0: none.")
        .unit("nm")
        .range(0, 2000);
    d.param("thinfilm_ior", &T::thinfilm_ior, "Index of refraction of the film.").range(1, 3);
    d.param("caustics", &T::caustics, "Also seen by rays that were scattered diffusely.");
}

/// Adds the closures of `part` with a factor.
inline void add_scaled(const ShaderRef& part, Color factor, const ShadePoint& at,
                       ClosureSet& out) {
    const Color scale = out.scale();
    out.set_scale(scale * factor);
    part.closures(at, out);
    out.set_scale(scale);
}

/// What part of a closure is used.
enum class ScatterMode : std::int32_t { Reflect, Transmit, Both };
[[nodiscard]] inline bool reflects(ScatterMode m) { return m != ScatterMode::Transmit; }
[[nodiscard]] inline bool transmits(ScatterMode m) { return m != ScatterMode::Reflect; }

}  // namespace lightsieve
