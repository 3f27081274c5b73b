#include "core/blackbody.h"

#include <array>
#include <cmath>

#include "core/color.h"

namespace lightsieve {
namespace {

constexpr float kColdest = 500, kHottest = 40000;
/// Colours are tabulated evenly in 1 / temperature, in which they change most evenly.
constexpr int kSteps = 512;

/// A Gaussian with two widths.
double lobe(double wavelength, double peak, double below, double above) {
    const double t = (wavelength - peak) * (wavelength < peak ? below : above);
    return std::exp(-0.5 * t * t);
}

/// CIE 1931 colour matching functions at a wavelength [nm].
std::array<double, 3> matching(double w) {
    return {1.056 * lobe(w, 599.8, 0.0264, 0.0323) + 0.362 * lobe(w, 442.0, 0.0624, 0.0374) -
                0.065 * lobe(w, 501.1, 0.0490, 0.0382),
            0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
            1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725)};
}

/// Planck's law up to a constant. wavelength [nm]
double planck(double wavelength, double kelvin) {
    constexpr double kSecondRadiation = 1.438776877e7;  // h c / k [nm K]
    return 1 / (std::pow(wavelength, 5) * std::expm1(kSecondRadiation / (wavelength * kelvin)));
}

Color integrate(double kelvin) {
    std::array<double, 3> xyz{};
    for (int w = 360; w <= 830; w += 2) {
        const double power = planck(w, kelvin);
        const std::array<double, 3> cmf = matching(w);
        for (std::size_t i = 0; i < 3; ++i)
            xyz[i] += power * cmf[i];
    }
    static const ColorMatrix kMatrix = rgb_from_xyz(kRenderingSpace.primaries);
    Color out;
    for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += kMatrix[row][i] * xyz[i] / xyz[1];
        out[static_cast<int>(row)] = static_cast<float>(sum);
    }
    return out * (1 / luminance(out));
}

}  // namespace

Color blackbody_color(float kelvin) {
    static const std::array<Color, kSteps + 1> kTable = [] {
        std::array<Color, kSteps + 1> table;
        for (int i = 0; i <= kSteps; ++i)
            table[static_cast<std::size_t>(i)] =
                integrate(1 / lerp(1 / kColdest, 1 / kHottest, static_cast<float>(i) / kSteps));
        return table;
    }();
    const float t = kelvin > kColdest ? std::min(kelvin, kHottest) : kColdest;
    const float x = (1 / kColdest - 1 / t) / (1 / kColdest - 1 / kHottest) * kSteps;
    const auto i = static_cast<std::size_t>(std::min(x, kSteps - 1.0F));
    return lerp(kTable[i], kTable[i + 1], x - static_cast<float>(i));
}

}  // namespace lightsieve
