// What layered materials (standard_surface, openpbr_surface) share: frames, what a layer lets through, interiors.
#pragma once

#include <cmath>

#include "bsdf/closure.h"
#include "bsdf/dispersion.h"
#include "nodes/shader/shader_common.h"

namespace lightsieve {

/// A frame of a closure set.
struct OrientedFrame {
    std::uint8_t index = 0;
    Vec3f wo;  ///< the viewer's direction in it, at or above the horizon
};

/// The frame around a normal parameter (0 0 0: the hit's own), its x axis turned for anisotropy.
///
/// tangent   parameter; 0 0 0: the hit's own
/// rotation  in turns, from x toward -y (Autodesk Standard Surface, OSL reference)
[[nodiscard]] inline OrientedFrame oriented(const ShadePoint& at, ClosureSet& out,
                                            Vec3f linked_normal, Vec3f tangent = {},
                                            float anisotropy = 0, float rotation = 0) {
    if (linked_normal == Vec3f{} && !(anisotropy > 0)) return {0, out.local_wo(0)};
    const Vec3f n = shading_normal(at, linked_normal);
    Frame frame = Frame::from_z_x(n, tangent == Vec3f{} ? at.tangent : tangent);
    if (const float angle = 2 * kPi * rotation; angle != 0 && std::isfinite(angle))
        frame = Frame::from_z_x(n, frame.x * std::cos(angle) - frame.y * std::sin(angle));
    const std::uint8_t index = out.add_frame(frame);
    return {index, out.local_wo(index)};
}

/// Index of refraction of a clear body at one of its surfaces, for what is on the other side and for the path's wavelength.
///
/// A path that has no wavelength yet takes one when it is refracted; until then the mean index decides how much is reflected.
class BodyIndex {
  public:
    /// ior   of the body, at the wavelength of the Abbe number; outside of its range clamped
    /// abbe  0: no dispersion
    BodyIndex(float ior, float abbe, const ShadePoint& at)
        : at_(at),
          mean_(ior > kLeast ? ior : kLeast),
          disperses_(abbe > 0),
          own_(std::max(dispersed_ior(mean_, abbe, at.wavelength), kLeast)) {}
    [[nodiscard]] bool disperses() const { return disperses_; }
    /// n(far side) / n(side of wo), for reflection and refraction.
    [[nodiscard]] float reflecting() const { return relative(at_.monochromatic ? own_ : mean_); }
    [[nodiscard]] float refracting() const { return relative(own_); }
    /// Of the body, for paths that are inside.
    [[nodiscard]] float inside() const { return own_; }

  private:
    static constexpr float kLeast = 1e-3F;
    [[nodiscard]] float relative(float own) const {
        return at_.entering ? own / at_.outer_ior : at_.outer_ior / own;
    }
    const ShadePoint& at_;
    float mean_;
    bool disperses_;
    float own_;
};

/// Fresnel reflection. Tables of dielectrics end at kMaxEta; mirrors are made with larger indices, and those are metals
/// without extinction.
[[nodiscard]] inline LobeModel dielectric_reflection(GgxAlpha alpha, float eta) {
    if (eta > kMaxEta && std::isfinite(eta))
        return ConductorReflect(alpha, Color::grey(eta), kBlack);
    return DielectricReflect(alpha, eta);
}

/// Subsurface scattering; without a depth to walk in it is as good as diffuse reflection.
inline void add_below_surface(ClosureSet& out, int lobe, Color color, Color radius,
                              float anisotropy, Color weight, std::uint8_t frame,
                              float roughness = 0) {
    if (SubsurfaceMedium::has_depth(radius))
        out.add_subsurface(lobe, SubsurfaceMedium(color, radius, anisotropy), weight);
    else
        out.add(lobe, DiffuseReflect(color, roughness), weight, frame, true);
}

/// A lobe that dims the layers below by what it reflects. Its albedo is worked out once, for them and for the renderer.
class LayerLobe {
  public:
    LayerLobe(const LobeModel& model, const OrientedFrame& frame)
        : model_(model),
          frame_(frame.index),
          albedo_(visit_lobe([&](const auto& lobe) { return lobe.albedo(frame.wo); }, model)) {}
    /// As ClosureSet::add.
    void add_to(ClosureSet& out, int lobe, Color weight, bool caustics) const {
        out.add(lobe, model_, weight, frame_, caustics, albedo_);
    }
    /// 1 - weight * E, what the layer leaves to those below.
    [[nodiscard]] Color leaves(Color weight = kWhite) const {
        return unit(kWhite - weight * albedo_);
    }

  private:
    LobeModel model_;
    std::uint8_t frame_;
    Color albedo_;
};

/// An interior that leaves `color` of straight light after `depth`, and scatters with the coefficient `scattering`. Where more
/// would scatter than is lost in all, absorption grows by the same amount in every channel until none is negative.
/// Source: Autodesk Standard Surface 1.0.1, section 4.3; the shift as in OpenPBR 1.1, section "Translucent base".
///
/// lobe  of the scattering event, or -1: it only absorbs
[[nodiscard]] inline Medium interior_medium(const ClosureSet& out, int lobe, Color color,
                                            float depth, Color scattering,
                                            const Phase& phase = {}) {
    constexpr float kDarkest = 1e-6F;
    const Color scatters = positive(scattering);
    Color absorption;
    float least = 0;
    for (int c = 0; c < 3; ++c) {
        const float left = std::clamp(color[c], kDarkest, 1.0F);
        absorption[c] = -std::log(left) / depth - scatters[c];
        least = std::min(least, absorption[c]);
    }
    absorption = positive(absorption - Color::grey(least));
    return out.medium(lobe, absorption + scatters, scatters, phase);
}

}  // namespace lightsieve
