#include "bsdf/sheen.h"

#include "bsdf/albedo_table.h"
#include "core/sampling.h"

namespace lightsieve {
namespace {

constexpr float kUniformPdf = 1 / (2 * kPi);

/// Smith's Lambda of the sheen distribution: the fit of Estevez and Kulla 2017, table 1 and eq. 3.
class SheenMasking {
  public:
    explicit SheenMasking(float roughness) {
        const float t = square(1 - roughness);
        a_ = lerp(21.5473F, 25.3245F, t);
        b_ = lerp(3.82987F, 3.32435F, t);
        c_ = lerp(0.19823F, 0.16801F, t);
        d_ = lerp(-1.97760F, -1.27393F, t);
        e_ = lerp(-4.32054F, -4.85967F, t);
    }
    [[nodiscard]] float lambda(float cos_theta) const {
        // Rounding may leave a cosine a little above 1.
        const float below = std::max(0.0F, 1 - cos_theta);
        return std::exp(cos_theta < 0.5F ? fit(cos_theta) : 2 * fit(0.5F) - fit(below));
    }

  private:
    [[nodiscard]] float fit(float x) const {
        return a_ / (1 + b_ * std::pow(x, c_)) + d_ * x + e_;
    }
    float a_, b_, c_, d_, e_;
};

}  // namespace

SheenReflect::SheenReflect(float sheen_roughness) noexcept
    : roughness(sheen_roughness > kMinSheenRoughness ? std::min(sheen_roughness, 1.0F)
                                                     : kMinSheenRoughness) {}

LobeEval SheenReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0)) return {};
    // Inverted Gaussian-like distribution of fibres, eq. 2; sin theta from the horizontal part, exact near the pole.
    const Vec3f h = wo + wi;
    const float sin2 = (h.x * h.x + h.y * h.y) / length_squared(h);
    const float inverse = 1 / roughness;
    const float d = (2 + inverse) * std::pow(sin2, 0.5F * inverse) * (0.5F * kInvPi);
    const SheenMasking masking(roughness);
    const float g = 1 / (1 + masking.lambda(wo.z) + masking.lambda(wi.z));
    return {Color::grey(d * g / (4 * wo.z)), kUniformPdf};
}

LobeSample SheenReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    const Vec3f wi = sample_uniform_cone(u, 1);
    if (!(wi.z > 0)) return {};
    const LobeEval e = eval(wo, wi);
    return {wi, e.f, e.pdf};
}

Color SheenReflect::albedo(Vec3f wo) const noexcept {
    return Color::grey(sheen_albedo(wo.z, roughness));
}

}  // namespace lightsieve
