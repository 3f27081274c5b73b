#include "bsdf/phase.h"

#include "bsdf/subsurface.h"

namespace lightsieve {
namespace {

constexpr float kMostAnisotropy = 0.98F;

float mean_cosine(float g) {
    return std::isfinite(g) ? std::clamp(g, -kMostAnisotropy, kMostAnisotropy) : 0.0F;
}

/// Density of the cosine between the direction of travel before and after [1/sr].
float henyey_greenstein(float cosine, float g) {
    const float d = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * kPi * d * std::sqrt(d));
}

float density(const Phase& p, float cosine) {
    const float first = henyey_greenstein(cosine, p.anisotropy);
    return p.mix > 0 ? lerp(first, henyey_greenstein(cosine, p.secondary_anisotropy), p.mix)
                     : first;
}

}  // namespace

Phase::Phase(float first, float second, float share) noexcept
    : anisotropy(mean_cosine(first)),
      secondary_anisotropy(mean_cosine(second)),
      mix(share > 0 ? std::min(share, 1.0F) : 0.0F) {}

LobeEval PhaseLobe::eval(Vec3f wo, Vec3f wi) const noexcept {
    const float p = density(phase, -dot(wo, wi));
    return {Color::grey(p), p};
}

LobeSample PhaseLobe::sample(Vec3f wo, Vec2f u, float u_choice) const noexcept {
    const float g = u_choice < phase.mix ? phase.secondary_anisotropy : phase.anisotropy;
    LobeSample out;
    out.wi = sample_henyey_greenstein(-wo, g, u);
    const LobeEval value = eval(wo, out.wi);
    out.f = value.f;
    out.pdf = value.pdf;
    return out;
}

}  // namespace lightsieve
