#include "bsdf/hair.h"

#include <algorithm>
#include <cmath>

#include "bsdf/fresnel.h"

namespace lightsieve {
namespace {

/// Narrower lobes are smooth to the eye, and their densities leave the range of floats.
constexpr float kMinVariance = 2e-5F, kMinScale = 2e-3F;
/// Wider along than this M_p is uniform, wider around so is N_p.
constexpr float kMaxVariance = 100, kMaxScale = 100;
constexpr float kMaxIor = 4;
/// Far tails are left out: products with them leave the range of floats.
constexpr float kLeastDensity = 1e-20F;
/// Thicker than black.
constexpr float kMaxAbsorption = 1e4F;
constexpr float kLeastMelaninLeft = 1e-4F;
constexpr float kLeastColor = 1e-3F;

float within(float v, float low, float high) {
    return v >= low ? std::min(v, high) : low;  // nan becomes low
}

/// exp(-x) I0(x), x >= 0. Source: Abramowitz and Stegun, 9.8.1 and 9.8.2 (error below 2e-7).
float scaled_bessel_i0(float x) {
    if (x < 3.75F) {
        const float t = square(x / 3.75F);
        const float i0 =
            1 +
            t * (3.5156229F +
                 t * (3.0899424F +
                      t * (1.2067492F + t * (0.2659732F + t * (0.0360768F + t * 0.0045813F)))));
        return std::exp(-x) * i0;
    }
    const float t = 3.75F / x;
    const float series =
        0.39894228F +
        t * (0.01328592F +
             t * (0.00225319F +
                  t * (-0.00157565F +
                       t * (0.00916281F +
                            t * (-0.02057706F +
                                 t * (0.02635537F + t * (-0.01647633F + t * 0.00392377F)))))));
    return series / std::sqrt(x);
}

/// Logistic distribution of scale s, cut to [-pi, pi]; chances below `x`.
float logistic_below(float x, float s) { return 1 / (1 + std::exp(-x / s)); }

/// Its density. The tails are what 2 x / s leaves of 1: 1 - 2 logistic_below(-pi).
float trimmed_logistic(float x, float s) {
    const float e = std::exp(-std::abs(x) / s);
    const float kept = 1 - 2 * logistic_below(-kPi, s);
    return e / (s * square(1 + e) * kept);
}

float sample_trimmed_logistic(float u, float s) {
    const float low = logistic_below(-kPi, s);
    const float below = lerp(low, 1 - low, u);
    return std::clamp(-s * std::log(1 / below - 1), -kPi, kPi);
}

/// Into [-pi, pi].
float wrapped(float angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

HairWidth HairWidth::from_roughness(float longitudinal, float azimuthal) noexcept {
    const float l = within(longitudinal, 0, 1), a = within(azimuthal, 0, 1);
    const float sqrt_pi_8 = std::sqrt(kPi / 8);
    HairWidth out;
    out.variance = square(0.726F * l + 0.812F * l * l + 3.7F * std::pow(l, 20.0F));
    out.scale = sqrt_pi_8 * (0.265F * a + 1.194F * a * a + 5.372F * std::pow(a, 22.0F));
    return out;
}

HairWidth HairWidth::of(HairPath path) const noexcept {
    const float factor = path == HairPath::R ? 1.0F : path == HairPath::TT ? 0.25F : 4.0F;
    return {variance * factor, scale};
}

HairLobe::HairLobe(HairPath lobe_path, HairWidth lobe_width, float index, Color lobe_absorption,
                   float shift, float across) noexcept
    : ior(within(index, 1, kMaxIor)),
      width{within(lobe_width.variance, kMinVariance, kMaxVariance),
            within(lobe_width.scale, kMinScale, kMaxScale)},
      path(lobe_path) {
    for (int c = 0; c < 3; ++c)
        absorption[c] = within(lobe_absorption[c], 0, kMaxAbsorption);
    offset = std::isfinite(across) ? std::clamp(across, -1.0F, 1.0F) : 0.0F;
    // The scales point to the tip, so that normals lean to the root: R goes there by twice their angle, TT by once and TRT
    // by four times it the other way. Source: Marschner et al. 2003, table 1, for the sign (Chiang et al. leave it open).
    static constexpr float kTilt[] = {-2, 1, 4, 0};
    const float tilt = std::isfinite(shift) ? shift * kTilt[static_cast<int>(path)] : 0.0F;
    sin_shift = std::sin(tilt);
    cos_shift = std::cos(tilt);
}

/// Where the lobe of a given wo lies.
struct HairLobe::Peak {
    float sin_theta, cos_theta;  ///< of wo along the fibre, tilted; the peak is at minus that
    float phi;                   ///< around, counted from z toward y
    Color attenuation;           ///< A_p
};

HairLobe::Peak HairLobe::peak(Vec3f wo) const noexcept {
    const float sin_o = std::clamp(wo.x, -1.0F, 1.0F), cos_o = safe_sqrt(1 - sin_o * sin_o);
    Peak out{};
    out.sin_theta = sin_o * cos_shift - cos_o * sin_shift;
    out.cos_theta = std::abs(cos_o * cos_shift + sin_o * sin_shift);

    // Around: the normal where the ray enters is turned by gamma_o from wo, inside it goes on at gamma_t.
    const float gamma_o = std::asin(offset), cos_gamma_o = safe_sqrt(1 - offset * offset);
    // Index as the cross-section sees it. Source: Bravais, as in Marschner et al. 2003, eq. 9.
    const float ior_across = std::sqrt(std::max(ior * ior - sin_o * sin_o, 1e-12F));
    const float sin_gamma_t = std::clamp(offset * cos_o / ior_across, -1.0F, 1.0F);
    const float gamma_t = std::asin(sin_gamma_t);
    const int p = static_cast<int>(path);
    // The normal lies toward +y where the offset does, so that all angles count the other way round than in the paper.
    const float turn =
        -(2 * static_cast<float>(p) * gamma_t - 2 * gamma_o + static_cast<float>(p) * kPi);
    out.phi = wrapped(std::atan2(wo.y, wo.z) + turn);

    // Attenuation. Source: Chiang et al. 2016, eq. 6 to 8 and the closed sum of the rest.
    const float fresnel = fresnel_dielectric(cos_o * cos_gamma_o, ior).reflectance;
    if (path == HairPath::R) {
        out.attenuation = Color::grey(fresnel);
        return out;
    }
    const float cos_t = safe_sqrt(1 - square(sin_o / ior));
    const float way = 2 * safe_sqrt(1 - sin_gamma_t * sin_gamma_t) / std::max(cos_t, 1e-4F);
    for (int c = 0; c < 3; ++c) {
        const float through = std::exp(-absorption[c] * way);
        float left = square(1 - fresnel) * through;
        if (path != HairPath::TT) left *= fresnel * through;
        if (path == HairPath::Rest) left *= fresnel * through / (1 - fresnel * through + 1e-12F);
        out.attenuation[c] = left;
    }
    return out;
}

/// M_p N_p: the density of directions per solid angle.
float HairLobe::density(const Peak& at, Vec3f wi) const noexcept {
    // Along. Source: d'Eon et al. 2011, eq. 7. Written with the squared distance of both directions' angles, because
    // its exponents are large and nearly cancel.
    const float sin_i = std::clamp(wi.x, -1.0F, 1.0F), cos_i = safe_sqrt(1 - sin_i * sin_i);
    const float v = width.variance;
    const float distance = square(sin_i + at.sin_theta) + square(cos_i - at.cos_theta);
    const float along = std::exp(-distance / (2 * v)) *
                        scaled_bessel_i0(cos_i * at.cos_theta / v) / (v * -std::expm1(-2 / v));
    // Around. Source: Chiang et al. 2016, eq. 11; what is left after TRT has no direction.
    const float around =
        path == HairPath::Rest
            ? 0.5F * kInvPi
            : trimmed_logistic(wrapped(std::atan2(wi.y, wi.z) - at.phi), width.scale);
    const float out = along * around;
    return out > kLeastDensity ? out : 0.0F;
}

LobeEval HairLobe::eval(Vec3f wo, Vec3f wi) const noexcept {
    const Peak at = peak(wo);
    const float pdf = density(at, wi);
    return {at.attenuation * pdf, pdf};
}

LobeSample HairLobe::sample(Vec3f wo, Vec2f u, float u_choice) const noexcept {
    const Peak at = peak(wo);
    // Along. Source: d'Eon et al. 2013, "Importance sampling for physically-based hair fiber models", section 4.
    const float v = width.variance;
    const float x = std::max(u.x, 1e-6F);
    const float cos_off = std::max(-1.0F, 1 + v * std::log(x + (1 - x) * std::exp(-2 / v)));
    const float sin_off = safe_sqrt((1 - cos_off) * (1 + cos_off));
    const float sin_i = std::clamp(
        -cos_off * at.sin_theta + sin_off * std::cos(2 * kPi * u.y) * at.cos_theta, -1.0F, 1.0F);
    const float cos_i = safe_sqrt(1 - sin_i * sin_i);
    // Around.
    const float turn = path == HairPath::Rest ? 2 * kPi * u_choice
                                              : sample_trimmed_logistic(u_choice, width.scale);
    const float phi = at.phi + turn;
    LobeSample out;
    out.wi = {sin_i, cos_i * std::sin(phi), cos_i * std::cos(phi)};
    out.pdf = density(at, out.wi);
    out.f = at.attenuation * out.pdf;
    return out;
}

Color HairLobe::albedo(Vec3f wo) const noexcept { return peak(wo).attenuation; }

Color hair_absorption_from_color(Color color, float azimuthal) noexcept {
    const float a = within(azimuthal, 0, 1);
    const float fit =
        5.969F + a * (-0.215F + a * (2.532F + a * (-10.73F + a * (5.574F + a * 0.245F))));
    Color out;
    for (int c = 0; c < 3; ++c)
        out[c] = square(std::log(within(color[c], kLeastColor, 1)) / fit);
    return out;
}

Color hair_absorption_from_melanin(float melanin, float redness) noexcept {
    const float amount = -std::log(std::max(1 - within(melanin, 0, 1), kLeastMelaninLeft));
    const float red = within(redness, 0, 1);
    constexpr Color kEumelanin{0.419F, 0.697F, 1.37F}, kPheomelanin{0.187F, 0.4F, 1.05F};
    return lerp(kEumelanin, kPheomelanin, red) * amount;
}

}  // namespace lightsieve
