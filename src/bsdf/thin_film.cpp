#include "bsdf/thin_film.h"

#include <array>
#include <complex>

#include "bsdf/ggx_compensation.h"

namespace lightsieve {
namespace {

/// Orders of interference that are added up; higher ones are below 1e-3 but for metals under films of high index.
constexpr int kOrders = 3;
/// Least share of the light that leaves a film at each turn.
constexpr float kLeastEscape = 1e-6F;

/// A Gaussian of the eye's sensitivity over the wave number. Belcour and Barla 2017, supplemental code.
struct Sensitivity {
    float value, position, variance;
    int component;  ///< of XYZ
};
constexpr std::array<Sensitivity, 4> kEye{{{5.4856e-13F, 1.6810e+06F, 4.3278e+09F, 0},
                                           {9.7470e-14F, 2.2399e+06F, 4.5282e+09F, 0},
                                           {4.4201e-13F, 1.7953e+06F, 9.3046e+09F, 1},
                                           {5.2481e-13F, 2.2084e+06F, 6.6121e+09F, 2}}};
constexpr float kEyeNorm = 1 / 1.0685e-7F;

/// XYZ, white where all wavelengths are equal, to ACEScg (CIE xy of AP1's primaries, Bradford adaptation from E to D60).
Color rgb_of(const std::array<float, 3>& xyz) {
    return {1.594218093F * xyz[0] - 0.367845807F * xyz[1] - 0.226372286F * xyz[2],
            -0.690518968F * xyz[0] + 1.672303585F * xyz[1] + 0.018215383F * xyz[2],
            0.011106827F * xyz[0] - 0.006693548F * xyz[1] + 0.995586721F * xyz[2]};
}

/// What does not depend on the polarisation nor on the base: the light's way through the film.
struct Way {
    struct Order {
        std::array<float, kEye.size()> phase, strength;
    };
    std::array<Order, kOrders> orders;

    /// difference  of the optical paths of neighbouring orders [nm]
    explicit Way(float difference) {
        for (int m = 1; m <= kOrders; ++m)
            for (std::size_t i = 0; i < kEye.size(); ++i) {
                const Sensitivity& eye = kEye[i];
                const float phase = 2 * kPi * static_cast<float>(m) * difference * 1e-9F;
                Order& order = orders[static_cast<std::size_t>(m - 1)];
                order.phase[i] = eye.position * phase;
                order.strength[i] = kEyeNorm * eye.value * std::sqrt(2 * kPi * eye.variance) *
                                    std::exp(-eye.variance * phase * phase);
            }
    }
    /// Mean of cos(order * (2 pi difference / wavelength + shift)) over each channel's wavelengths.
    [[nodiscard]] Color cosine(std::size_t order, float shift) const {
        std::array<float, 3> xyz{};
        for (std::size_t i = 0; i < kEye.size(); ++i)
            xyz[static_cast<std::size_t>(kEye[i].component)] +=
                orders[order].strength[i] * std::cos(orders[order].phase[i] + shift);
        return rgb_of(xyz);
    }
};

/// Amplitudes of both polarisations, s and p.
using Amplitudes = std::array<std::complex<float>, 2>;

/// Fresnel's equations. index  of the far side over that of the near one
Amplitudes fresnel(float cosine, std::complex<float> index) {
    const std::complex<float> squared = index * index;
    const std::complex<float> far = std::sqrt(squared - (1 - cosine * cosine));
    return {(cosine - far) / (cosine + far), (squared * cosine - far) / (squared * cosine + far)};
}

/// Reflectance with a base of one index for all wavelengths; eq. 10 of the paper, mean of both polarisations.
Color reflectance_over(float cosine, float ior, float n, float k, const Way& way) {
    const float cos_film = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const Amplitudes above = fresnel(cosine, ior),
                     below = fresnel(cos_film, std::complex<float>(n, k) / ior);
    Color sum;
    for (std::size_t polarisation = 0; polarisation < 2; ++polarisation) {
        const float r12 = above[polarisation].real(), big_r12 = r12 * r12;
        const float big_r23 = std::norm(below[polarisation]), through = 1 - big_r12;
        // From within the film the upper side reflects with the opposite sign.
        const float shift = std::arg(below[polarisation]) + (r12 < 0 ? 0 : kPi);
        // Total reflection on both sides leaves nothing in the film: 0 / 0.
        const float all =
            through * through * big_r23 / std::max(1 - big_r12 * big_r23, kLeastEscape);
        sum += Color::grey(0.5F * (big_r12 + all));
        float c = all - through;
        for (std::size_t m = 0; m < kOrders; ++m) {
            c *= std::sqrt(big_r12 * big_r23);
            sum += c * way.cosine(m, static_cast<float>(m + 1) * shift);
        }
    }
    return sum;
}

float limited(float v, float low, float high) {
    return v > low ? std::min(v, high) : low;  // NaN: low
}

}  // namespace

Color ThinFilm::reflectance(float cos_theta) const noexcept {
    // Nearer to the horizon 1 - cos^2 rounds to 1.
    const float cosine = std::clamp(cos_theta, 1e-3F, 1.0F);
    const float cos_film = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const Way way(2 * ior * thickness * cos_film);
    Color out = reflectance_over(cosine, ior, n.r, k.r, way);
    if (n.g != n.r || k.g != k.r) out.g = reflectance_over(cosine, ior, n.g, k.g, way).g;
    if (n.b != n.r || k.b != k.r) out.b = reflectance_over(cosine, ior, n.b, k.b, way).b;
    return clamp(out, 0, 1);
}

FilmReflect::FilmReflect(GgxAlpha roughness, float thickness, float film_ior, Color n,
                         Color k) noexcept
    : alpha(roughness) {
    constexpr float kMaxIndex = 1e3F, kMinIndex = 1e-3F;
    film.thickness = limited(thickness, 0, 1e5F);
    film.ior = limited(film_ior, 1, 4);
    for (int c = 0; c < 3; ++c) {
        film.n[c] = limited(n[c], kMinIndex, kMaxIndex);
        film.k[c] = limited(k[c], 0, kMaxIndex);
    }
}

namespace {

/// Facet reflectance times the compensation for wo.
struct Facet {
    ThinFilm film;
    Color compensation;
    Color operator()(float cos_theta) const noexcept {
        return film.reflectance(cos_theta) * compensation;
    }
};

Facet facet(const FilmReflect& f, Vec3f wo) {
    if (f.alpha.smooth()) return {f.film, kWhite};
    return {f.film, kWhite + f.film.reflectance(1) * ggx_white(wo, f.alpha).lost};
}

}  // namespace

LobeEval FilmReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0) || alpha.smooth()) return {};
    return ggx_eval_reflection(wo, wi, alpha, facet(*this, wo));
}

LobeSample FilmReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    return ggx_sample_reflection(wo, u, alpha, facet(*this, wo));
}

Color FilmReflect::albedo(Vec3f wo) const noexcept {
    return ggx_compensated_albedo(wo, alpha, film.reflectance(1),
                                  [&](float cosine) { return film.reflectance(cosine); });
}

}  // namespace lightsieve
