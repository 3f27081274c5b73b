// What all lights share: documentation of `LightCommon`, the emitted colour, placement, checks of numbers.
//
// Every light emits color * intensity * 2^exposure, called I below. With `normalize` a light's brightness at a distance
// does not depend on its size: I is its radiant intensity along the normal, so an area has the radiance I / area.
// Without, I is the radiance itself. Bad numbers are errors at their place in the scene; a light without area is a
// warning and black.
// The first matrix holds: for a light that moves the renderer makes several, each where it stands at a time.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "scene/describe.h"
#include "scene/light.h"
#include "scene/node_context.h"

namespace lightsieve {

/// Documents the parameters of `LightCommon`.
template <class T>
void describe_light_common(Describe<T>& d) {
    d.param("color", &LightCommon::color, "Colour of the light; a shader may drive it.");
    d.param("intensity", &LightCommon::intensity,
            "Brightness: the light emits color * intensity * 2^exposure.");
    d.param("exposure", &LightCommon::exposure, "Brightness in powers of two.").unit("f-stops");
    d.param("normalize", &LightCommon::normalize,
            "Brightness at a distance does not depend on the light's size.");
    d.param("cast_shadows", &LightCommon::cast_shadows, "Objects cast shadows in this light.");
    d.param("cast_volumetric_shadows", &LightCommon::cast_volumetric_shadows,
            "Volumes see shadows in this light.");
    d.param("shadow_density", &LightCommon::shadow_density, "Darkness of shadows: 0 none, 1 full.")
        .range(0, 1);
    d.param("shadow_color", &LightCommon::shadow_color, "Colour that shadows are filled with.");
    d.param("samples", &LightCommon::samples,
            "Shadow rays, squared, from where the camera looks; one from everywhere else. Where "
            "there "
            "are more than 16 lights some are picked.")
        .range(0, 64);
    d.param("volume_samples", &LightCommon::volume_samples, "The same for volumes.").range(0, 64);
    d.param("camera", &LightCommon::camera,
            "Factor on the light seen directly by the camera; 0 hides it.")
        .range(0, 1);
    d.param("transmission", &LightCommon::transmission,
            "Factor on the light seen through transmissive surfaces.")
        .range(0, 1);
    d.param("diffuse", &LightCommon::diffuse,
            "Factor on diffuse reflection and transmission of the light.")
        .range(0, 1);
    d.param("specular", &LightCommon::specular,
            "Factor on specular reflection and transmission of the light.")
        .range(0, 1);
    d.param("sss", &LightCommon::sss, "Factor on subsurface scattering of the light.").range(0, 1);
    d.param("indirect", &LightCommon::indirect,
            "Factor on the light after more than one scattering.")
        .range(0, 1);
    d.param("volume", &LightCommon::volume, "Factor on volume scattering of the light.")
        .range(0, 1);
    d.param("max_bounces", &LightCommon::max_bounces,
            "Most scatterings before this light is met; 0: direct light only.")
        .range(0, 999);
    d.param("aov", &LightCommon::aov,
            "Light group of the light path expressions; empty or \"default\": none.");
    d.param("filters", &LightCommon::filters,
            "Light filters (decay, barn doors, blockers, gobos), which act one after the other.");
    d.param("matrix", &LightCommon::matrix,
            "Placement in the world, row vectors; lights shine along local -Z.");
    d.param("motion_start", &LightCommon::motion_start, "Time of the first motion key.")
        .unit("frames");
    d.param("motion_end", &LightCommon::motion_end, "Time of the last motion key.").unit("frames");
}

/// What a light emits: its colour, constant or by shader, times its strength.
class Emission {
  public:
    Emission() = default;
    /// factor  on the colour: intensity, exposure, and what the kind of light divides by
    Emission(ColorInput color, float factor)
        : color_(color), factor_(factor), constant_(color.constant() * factor) {}

    /// Of a light without place; builds the shading point only for a shader.
    ///
    /// direction  unit, world space, from the shaded point
    [[nodiscard]] Color toward(Vec3f direction, Vec2f uv = {}, float uv_width = 0) const {
        if (color_.is_constant()) return constant_;
        ShadePoint point;
        point.direction = direction;
        point.uv = uv;
        point.uv_width = uv_width;
        return color_.at(point) * factor_;
    }
    /// On a surface of the light; builds the shading point only for a shader.
    [[nodiscard]] Color at(Vec3f position, Vec3f normal, Vec2f uv) const {
        if (color_.is_constant()) return constant_;
        ShadePoint point;
        point.position = position;
        point.normal = point.geometric_normal = normal;
        point.uv = uv;
        return color_.at(point) * factor_;
    }
    [[nodiscard]] bool is_constant() const { return color_.is_constant(); }
    /// The same light, `factor` times as bright.
    [[nodiscard]] Emission scaled(float factor) const { return {color_, factor_ * factor}; }
    /// Mean of the magnitudes of the channels over a uv square, for choosing among lights; lights may be negative.
    [[nodiscard]] float magnitude() const {
        if (color_.is_constant()) return magnitude(constant_);
        constexpr int kCells = 16;
        float sum = 0;
        for (int y = 0; y < kCells; ++y)
            for (int x = 0; x < kCells; ++x)
                sum += magnitude(at({}, {0, 0, 1},
                                    {(static_cast<float>(x) + 0.5F) / kCells,
                                     (static_cast<float>(y) + 0.5F) / kCells}));
        return std::max(sum / (kCells * kCells), least_magnitude());
    }
    /// What is taken at least for a shader, which may shine between the points where it was found black.
    [[nodiscard]] float least_magnitude() const { return 1e-3F * std::abs(factor_); }
    [[nodiscard]] static float magnitude(Color c) {
        return (std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) * (1.0F / 3);
    }

  private:
    ColorInput color_;
    float factor_ = 1;
    Color constant_;  ///< colour times factor, if constant
};

namespace light_detail {

inline std::nullopt_t refuse(NodeContext& context, const char* param, const std::string& what,
                             const std::string& hint) {
    context.diagnostics().error(Code::InvalidValue, what, context.where(param), hint);
    return std::nullopt;
}

}  // namespace light_detail

/// Brighter lights and smaller areas are refused: radiances and densities would leave the range of floats.
inline constexpr float kMaxEmission = 1e16F, kMinLightArea = 1e-20F;

/// color * intensity * 2^exposure of a light, or nothing with an error if that is no sensible number.
inline std::optional<Emission> make_emission(const LightCommon& light, NodeContext& context) {
    const float strength = light.strength();
    if (!std::isfinite(strength)) {
        const char* param = std::isfinite(light.intensity) ? "exposure" : "intensity";
        return light_detail::refuse(context, param,
                                    "intensity * 2^exposure of \"" + context.node_name().str() +
                                        "\" is not a finite number",
                                    "write finite values for both");
    }
    const ColorInput color = context.color_input("color");
    const Color emitted = color.constant() * strength;
    if (!is_finite(emitted) || Emission::magnitude(emitted) > kMaxEmission ||
        std::abs(strength) > kMaxEmission)
        return light_detail::refuse(context, "color",
                                    "color * intensity * 2^exposure of \"" +
                                        context.node_name().str() +
                                        "\" is not finite or above 1e16",
                                    "write smaller values");
    return Emission(color, strength);
}

/// The placement of a light, or nothing with an error if it holds impossible numbers.
inline std::optional<Mat4f> world_from_light(const LightCommon& light, NodeContext& context) {
    if (light.matrix.empty()) return Mat4f{};
    const Mat4f first = light.matrix[0];
    if (!first.finite())
        return light_detail::refuse(
            context, "matrix", "the matrix of \"" + context.node_name().str() + "\" is not finite",
            "write sixteen finite numbers");
    return first;
}

/// The first value of an array parameter, or nothing with an error if it is not finite.
inline std::optional<float> finite_value(const Array<float>& values, float fallback,
                                         const char* param, NodeContext& context) {
    const float v = values.empty() ? fallback : values[0];
    if (std::isfinite(v)) return v;
    return light_detail::refuse(context, param,
                                std::string("\"") + param + "\" is not a finite number",
                                "write a finite number");
}
inline std::optional<Vec3f> finite_value(const Array<Vec3f>& values, Vec3f fallback,
                                         const char* param, NodeContext& context) {
    const Vec3f v = values.empty() ? fallback : values[0];
    if (is_finite(v)) return v;
    return light_detail::refuse(context, param, std::string("\"") + param + "\" is not finite",
                                "write three finite numbers");
}

/// Warns that a light cannot shine because of its shape.
inline void warn_no_area(NodeContext& context, const char* param) {
    context.diagnostics().warning(
        Code::InvalidValue,
        "light \"" + context.node_name().str() + "\" has no area and gives no light",
        context.where(param), "check its size and the scale of its matrix");
}

/// A light that gives nothing, for parameters that leave none over.
class DarkLight final : public Light {
  public:
    [[nodiscard]] LightSample sample(Vec3f, Vec2f) const override { return {}; }
    [[nodiscard]] LightBounds bounds() const override { return {}; }
};

/// The rotation (and mirroring) of a matrix, without its scale; nothing if it has no three directions.
inline std::optional<Frame> light_axes(const Mat4f& m) {
    const Vec3f y = m.vector({0, 1, 0}), z = m.vector({0, 0, 1});
    const float sign = m.determinant3() < 0 ? -1.0F : 1.0F;
    Frame out;
    out.y = lightsieve::normalize(y, {});
    out.z = lightsieve::normalize(z - out.y * dot(z, out.y), {});
    out.x = cross(out.y, out.z) * sign;
    if (!(length_squared(out.x) > 0.5F)) return std::nullopt;
    return out;
}

/// How much a matrix scales lengths, as the cube root of its volume.
inline float mean_scale(const Mat4f& m) { return std::cbrt(std::abs(m.determinant3())); }

}  // namespace lightsieve
