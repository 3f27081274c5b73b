#include "bsdf/thin_transmit.h"

#include "bsdf/ggx_compensation.h"

namespace lightsieve {

ThinTransmit ThinTransmit::through_sheet(GgxAlpha interfaces, float ior) noexcept {
    constexpr float kSqrt3 = 1.7320508F;
    const float scale = 0.5F * kSqrt3 * std::abs(ior - 1);
    return ThinTransmit({interfaces.x * scale, interfaces.y * scale});
}

LobeEval ThinTransmit::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z < 0) || alpha.smooth()) return {};
    return ggx_eval_reflection(wo, {wi.x, wi.y, -wi.z}, alpha,
                               [&](float) { return Color::grey(1 + ggx_white(wo, alpha).lost); });
}

LobeSample ThinTransmit::sample(Vec3f wo, Vec2f u, float) const noexcept {
    LobeSample s = ggx_sample_reflection(
        wo, u, alpha, [&](float) { return Color::grey(1 + ggx_white(wo, alpha).lost); });
    s.wi.z = -s.wi.z;
    return s;
}

Color ThinTransmit::albedo(Vec3f) const noexcept { return kWhite; }

}  // namespace lightsieve
