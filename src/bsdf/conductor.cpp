#include "bsdf/conductor.h"

#include "bsdf/fresnel.h"
#include "bsdf/ggx_compensation.h"

namespace lightsieve {
namespace {

/// Reflectance 1 needs an infinite index; this near to it, white metals lose 1e-4.
constexpr float kMaxReflectivity = 0.9999F;

/// The formulas are 0 / 0 for an index of 0 without extinction.
constexpr float kMinIndex = 1e-4F;
/// Reflectance is 1 well below it, and squares stay finite.
constexpr float kMaxIndex = 1e6F;

float non_negative(float v) { return v > 0 ? std::min(v, kMaxIndex) : 0.0F; }
Color non_negative(Color c) { return {non_negative(c.r), non_negative(c.g), non_negative(c.b)}; }
float unit(float v) { return std::min(non_negative(v), 1.0F); }

/// Gulbrandsen 2014, eq. 11 to 16; k^2 rewritten as 2 n (1 + r) / (1 - r) - n^2 - 1 against cancellation.
void artistic_index(float reflectivity, float edge_tint, float& n, float& k) {
    const float r = std::min(unit(reflectivity), kMaxReflectivity), root = std::sqrt(r);
    const float tint = unit(edge_tint);
    n = (1 - tint) * (1 + root) / (1 - root) + tint * (1 - r) / (1 + r);
    k = safe_sqrt(2 * n * (1 + r) / (1 - r) - n * n - 1);
}

Color facing(Color n, Color k) {
    const Color k2 = k * k, below = n - kWhite, above = n + kWhite;
    return (below * below + k2) / (above * above + k2);
}

/// Facet reflectance times the compensation for wo.
struct Metal {
    Color n, k, compensation;
    Color operator()(float cos_theta) const noexcept {
        return fresnel_conductor(cos_theta, n, k) * compensation;
    }
};

Metal metal(const ConductorReflect& c, Vec3f wo) {
    if (c.alpha.smooth()) return {c.n, c.k, kWhite};
    return {c.n, c.k, kWhite + facing(c.n, c.k) * ggx_white(wo, c.alpha).lost};
}

}  // namespace

ConductorReflect::ConductorReflect(GgxAlpha roughness, Color index, Color extinction) noexcept
    : alpha(roughness),
      n(clamp(non_negative(index), kMinIndex, kMaxIndex)),
      k(non_negative(extinction)) {}

ConductorReflect ConductorReflect::from_artistic(GgxAlpha roughness, Color reflectivity,
                                                 Color edge_tint) noexcept {
    ConductorReflect c(roughness, kBlack, kBlack);
    artistic_index(reflectivity.r, edge_tint.r, c.n.r, c.k.r);
    artistic_index(reflectivity.g, edge_tint.g, c.n.g, c.k.g);
    artistic_index(reflectivity.b, edge_tint.b, c.n.b, c.k.b);
    return c;
}

LobeEval ConductorReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0) || alpha.smooth()) return {};
    return ggx_eval_reflection(wo, wi, alpha, metal(*this, wo));
}

LobeSample ConductorReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    return ggx_sample_reflection(wo, u, alpha, metal(*this, wo));
}

Color ConductorReflect::albedo(Vec3f wo) const noexcept {
    return ggx_compensated_albedo(wo, alpha, facing(n, k), [&](float cos_theta) {
        return fresnel_conductor(cos_theta, n, k);
    });
}

}  // namespace lightsieve
