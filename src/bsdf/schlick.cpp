#include "bsdf/schlick.h"

#include "bsdf/ggx_compensation.h"

namespace lightsieve {
namespace {

float unit(float v) { return v > 0 ? std::min(v, 1.0F) : 0.0F; }
Color unit(Color c) { return {unit(c.r), unit(c.g), unit(c.b)}; }

/// Facet reflectance times the compensation for wo.
struct Facet {
    SchlickCurve curve;
    Color compensation;
    Color operator()(float cos_theta) const noexcept {
        return curve.value(cos_theta) * compensation;
    }
};

Facet facet(const SchlickReflect& s, Vec3f wo) {
    return {s.curve, kWhite + s.curve.f0 * ggx_white(wo, s.alpha).lost};
}

}  // namespace

SchlickReflect::SchlickReflect(GgxAlpha roughness, Color facing, Color grazing, Color f82) noexcept
    : alpha(roughness) {
    const SchlickCurve plain{unit(facing), unit(grazing), kBlack};
    curve =
        SchlickCurve::through(plain.f0, plain.value(SchlickCurve::kDipCos) * unit(f82), plain.f90);
}

LobeEval SchlickReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0) || alpha.smooth()) return {};
    return ggx_eval_reflection(wo, wi, alpha, facet(*this, wo));
}

LobeSample SchlickReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    return ggx_sample_reflection(wo, u, alpha, facet(*this, wo));
}

Color SchlickReflect::albedo(Vec3f wo) const noexcept {
    return ggx_compensated_albedo(wo, alpha, curve.f0,
                                  [&](float cos_theta) { return curve.value(cos_theta); });
}

}  // namespace lightsieve
