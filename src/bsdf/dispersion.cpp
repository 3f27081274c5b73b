#include "bsdf/dispersion.h"

#include <array>
#include <cmath>

#include "bsdf/spectrum.h"

namespace lightsieve {
namespace {

/// The visible wave numbers [1/m], in bands of one weight each.
constexpr float kReddest = 1.43e6F, kBluest = 2.40e6F;
constexpr std::size_t kBands = 64;

struct Bands {
    std::array<Color, kBands> weight;
    std::array<float, kBands + 1> cumulative;  ///< probability of all bands before

    Bands() {
        // What each channel sees of each band. Single wavelengths lie outside of any gamut: negative parts are cut off.
        std::array<Color, kBands> seen;
        Color sum;
        for (std::size_t i = 0; i < kBands; ++i) {
            std::array<float, 3> xyz{};
            for (const Sensitivity& eye : kEye)
                xyz[static_cast<std::size_t>(eye.component)] +=
                    eye.value *
                    std::exp(-0.5F *
                             square(wave_number(static_cast<float>(i) + 0.5F) - eye.position) /
                             eye.variance);
            const Color rgb = rgb_of(xyz) * kEyeNorm;
            seen[i] = {std::max(rgb.r, 0.0F), std::max(rgb.g, 0.0F), std::max(rgb.b, 0.0F)};
            sum += seen[i];
        }
        // Each channel to sum 1; then their mean is the probability.
        cumulative[0] = 0;
        for (std::size_t i = 0; i < kBands; ++i) {
            const Color share = seen[i] / sum;
            const float p = average(share);
            weight[i] = p > 0 ? share * (1 / p) : kBlack;
            cumulative[i + 1] = cumulative[i] + p;
        }
        cumulative[kBands] = 1;
    }
    [[nodiscard]] static float wave_number(float band) {
        return lerp(kReddest, kBluest, band / static_cast<float>(kBands));
    }
};

}  // namespace

Wavelength sample_wavelength(float u) noexcept {
    static const Bands bands;
    std::size_t i = 0;
    while (i + 1 < kBands && u >= bands.cumulative[i + 1])
        ++i;
    const float width = bands.cumulative[i + 1] - bands.cumulative[i];
    const float within = width > 0 ? (u - bands.cumulative[i]) / width : 0.5F;
    return {1e9F / Bands::wave_number(static_cast<float>(i) + std::clamp(within, 0.0F, 1.0F)),
            bands.weight[i]};
}

}  // namespace lightsieve
