// The closed form against the Airy sum of waves, integrated over the wavelengths.
#include "bsdf/thin_film.h"

#include <gtest/gtest.h>

#include <complex>

#include "bsdf/fresnel.h"

namespace lightsieve {
namespace {

using Complex = std::complex<double>;

/// Reflectance of a film for one wavelength [nm]: amplitudes of all orders as a geometric series.
double airy(double cosine, double thickness, double ior, Complex base, double wavelength) {
    const double sine2 = 1 - cosine * cosine, cos_film = std::sqrt(1 - sine2 / (ior * ior));
    const Complex phase = std::exp(Complex(0, 4 * M_PI * ior * thickness * cos_film / wavelength));
    double sum = 0;
    for (const bool p : {false, true}) {
        const auto amplitude = [&](Complex index, double c) {
            const Complex far = std::sqrt(index * index - (1 - c * c));
            return p ? (index * index * c - far) / (index * index * c + far)
                     : (c - far) / (c + far);
        };
        const Complex r12 = amplitude(ior, cosine), r23 = amplitude(base / ior, cos_film);
        sum += std::norm((r12 + r23 * phase) / (1.0 + r12 * r23 * phase));
    }
    return sum / 2;
}

/// Mean over wavelengths with weight V of the eye's middle channel, as a Gaussian over wave numbers.
double mean_airy(double cosine, double thickness, double ior, Complex base) {
    double sum = 0, weights = 0;
    for (double wave_number = 1.0e6; wave_number < 2.8e6; wave_number += 2e3) {
        // The sensitivities' transform: exp(-variance (2 pi d)^2) belongs to a Gaussian of this width.
        const double x = (wave_number - 1.7953e6) / std::sqrt(2 * 9.3046e9);
        const double w = std::exp(-x * x);
        sum += w * airy(cosine, thickness, ior, base, 1e9 / wave_number);
        weights += w;
    }
    return sum / weights;
}

float luminance_of(const ThinFilm& film, float cosine) {
    // The film's Y: ACEScg's luminance row, adapted as the conversion from XYZ is (white stays white).
    const Color c = film.reflectance(cosine);
    return 0.2722287F * c.r + 0.6740818F * c.g + 0.0536895F * c.b;
}

TEST(ThinFilm, IsTheSumOfAllWaves) {
    for (const float thickness : {80.0F, 250.0F, 400.0F, 700.0F})
        for (const float cosine : {1.0F, 0.7F, 0.3F})
            for (const Complex base : {Complex(1.5, 0), Complex(2.5, 0), Complex(0.9, 3.0)}) {
                ThinFilm film;
                film.thickness = thickness;
                film.ior = 1.33F;
                film.n = Color::grey(static_cast<float>(base.real()));
                film.k = Color::grey(static_cast<float>(base.imag()));
                const double truth = mean_airy(static_cast<double>(cosine),
                                               static_cast<double>(thickness), 1.33, base);
                // Chromatic adaptation mixes a little of X and Z into luminance: hence the slack.
                EXPECT_NEAR(luminance_of(film, cosine), truth, 0.02)
                    << thickness << " " << cosine << " " << base;
            }
}

TEST(ThinFilm, WithoutThicknessIsTheBase) {
    for (const float cosine : {1.0F, 0.6F, 0.2F}) {
        ThinFilm film;
        EXPECT_NEAR(film.reflectance(cosine).g, fresnel_dielectric(cosine, 1.5F).reflectance,
                    2e-3);
        film.n = Color::grey(0.2F), film.k = Color::grey(3.5F);
        EXPECT_NEAR(film.reflectance(cosine).g, fresnel_conductor(cosine, 0.2F, 3.5F), 1e-2);
    }
}

TEST(ThinFilm, TooThickToInterfereIsGrey) {
    ThinFilm film;
    film.thickness = 50000;
    film.ior = 1.33F;
    const Color c = film.reflectance(0.8F);
    EXPECT_NEAR(c.r, c.g, 1e-4);
    EXPECT_NEAR(c.b, c.g, 1e-4);
}

TEST(ThinFilm, ColoursChangeWithTheAngle) {
    ThinFilm film;
    film.thickness = 400;
    film.ior = 1.4F;
    film.n = Color::grey(2.5F);
    const Color facing = film.reflectance(1), tilted = film.reflectance(0.4F);
    const float hue_facing = facing.r / facing.b, hue_tilted = tilted.r / tilted.b;
    EXPECT_GT(std::abs(std::log(hue_facing / hue_tilted)), 0.3F);
}

TEST(FilmOnSchlick, FaceOnIsThatOfTheDielectric) {
    for (const float n : {1.2F, 1.8F, 3.0F, 9.0F})
        for (const float thickness : {0.0F, 150.0F, 420.0F, 900.0F}) {
            ThinFilm dielectric;
            FilmOnSchlick schlick;
            dielectric.thickness = schlick.thickness = thickness;
            dielectric.ior = schlick.ior = 1.4F;
            dielectric.n = Color::grey(n);
            schlick.base = {Color::grey(square((n - 1) / (n + 1))), kWhite, kBlack};
            const Color a = dielectric.reflectance(1), b = schlick.reflectance(1);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(a[c], b[c], 1e-4F) << n << " " << thickness;
        }
}

TEST(FilmOnSchlick, AFilmOfAirIsNone) {
    FilmOnSchlick film;
    film.ior = 1;
    film.thickness = 500;
    film.base = SchlickCurve::through({0.9F, 0.6F, 0.2F}, {0.7F, 0.6F, 0.3F});
    for (const float cosine : {1.0F, 0.5F, 1.0F / 7})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(film.reflectance(cosine)[c], film.base.value(cosine)[c], 2e-3F);
}

TEST(FilmOnSchlick, ColoursMetal) {
    FilmOnSchlick film;
    film.thickness = 300;
    film.base = {Color::grey(0.5F), kWhite, kBlack};
    const Color c = film.reflectance(1);
    EXPECT_GT(max_component(c) - std::min({c.r, c.g, c.b}), 0.1F);
}

}  // namespace
}  // namespace lightsieve
