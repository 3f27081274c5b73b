#include "bsdf/thin_film.h"

#include <array>
#include <complex>

#include "bsdf/ggx_compensation.h"
#include "bsdf/spectrum.h"

namespace lightsieve {
namespace {

/// Orders of interference that are added up; higher ones are below 1e-3 but for metals under films of high index.
constexpr int kOrders = 3;
/// Least share of the light that leaves a film at each turn.
constexpr float kLeastEscape = 1e-6F;

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

/// Cosine within the film.
float cosine_in_film(float cosine, float ior) {
    return std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
}

/// Nearer to the horizon 1 - cos^2 rounds to 1.
float off_horizon(float cosine) { return std::clamp(cosine, 1e-3F, 1.0F); }

/// Reflectance with a base of one index for all wavelengths; eq. 10 of the paper, mean of both polarisations.
///
/// below  amplitudes at the base
Color reflectance_over(float cosine, float ior, const Amplitudes& below, const Way& way) {
    const Amplitudes above = fresnel(cosine, ior);
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
    const float cosine = off_horizon(cos_theta), cos_film = cosine_in_film(cosine, ior);
    const Way way(2 * ior * thickness * cos_film);
    const auto over = [&](float index, float extinction) {
        return reflectance_over(
            cosine, ior, fresnel(cos_film, std::complex<float>(index, extinction) / ior), way);
    };
    Color out = over(n.r, k.r);
    if (n.g != n.r || k.g != k.r) out.g = over(n.g, k.g).g;
    if (n.b != n.r || k.b != k.r) out.b = over(n.b, k.b).b;
    return clamp(out, 0, 1);
}

Color FilmOnSchlick::reflectance(float cos_theta) const noexcept {
    const float cosine = off_horizon(cos_theta), cos_film = cosine_in_film(cosine, ior);
    const Way way(2 * ior * thickness * cos_film);
    const Color seen = base.value(cos_film);
    const float m = 1 - cos_film, m5 = square(square(m)) * m;
    Color out;
    for (int c = 0; c < 3; ++c) {
        // The dielectric of that reflectance face on, seen from within the film; the rest of the curve keeps its proportions.
        const float f0 = std::min(base.f0[c], 0.9999F), root = std::sqrt(f0);
        const float index = (1 + root) / (1 - root);
        const float facing = square((index - ior) / (index + ior));
        const float plain = std::max(lerp(f0, base.f90[c], m5), 1e-6F);
        const float reflected = std::min(seen[c] / plain * lerp(facing, base.f90[c], m5), 1.0F);
        // A denser base turns the wave over.
        const float amplitude = (index > ior ? 1.0F : -1.0F) * std::sqrt(reflected);
        out[c] = reflectance_over(cosine, ior, {-amplitude, amplitude}, way)[c];
    }
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

FilmedSchlickReflect::FilmedSchlickReflect(float thickness, float film_ior,
                                           const SchlickReflect& base) noexcept
    : alpha(base.alpha), film{limited(thickness, 0, 1e5F), limited(film_ior, 1, 4), base.curve} {}

namespace {

/// Facet reflectance times the compensation for wo.
template <class Film>
struct Facet {
    Film film;
    Color compensation;
    Color operator()(float cos_theta) const noexcept {
        return film.reflectance(cos_theta) * compensation;
    }
};

template <class Film>
Facet<Film> facet(GgxAlpha alpha, const Film& film, Vec3f wo) {
    if (alpha.smooth()) return {film, kWhite};
    return {film, kWhite + film.reflectance(1) * ggx_white(wo, alpha).lost};
}

template <class Film>
LobeEval eval_film(GgxAlpha alpha, const Film& film, Vec3f wo, Vec3f wi) {
    if (!(wi.z > 0) || alpha.smooth()) return {};
    return ggx_eval_reflection(wo, wi, alpha, facet(alpha, film, wo));
}

template <class Film>
Color albedo_of_film(GgxAlpha alpha, const Film& film, Vec3f wo) {
    return ggx_compensated_albedo(wo, alpha, film.reflectance(1),
                                  [&](float cosine) { return film.reflectance(cosine); });
}

}  // namespace

LobeEval FilmReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    return eval_film(alpha, film, wo, wi);
}
LobeSample FilmReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    return ggx_sample_reflection(wo, u, alpha, facet(alpha, film, wo));
}
Color FilmReflect::albedo(Vec3f wo) const noexcept { return albedo_of_film(alpha, film, wo); }

LobeEval FilmedSchlickReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    return eval_film(alpha, film, wo, wi);
}
LobeSample FilmedSchlickReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    return ggx_sample_reflection(wo, u, alpha, facet(alpha, film, wo));
}
Color FilmedSchlickReflect::albedo(Vec3f wo) const noexcept {
    return albedo_of_film(alpha, film, wo);
}

}  // namespace lightsieve
