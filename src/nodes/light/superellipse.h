// The outlines between a square and a disc that `roundness` means: superellipses with exponent 2 / roundness.
//
// One measure for every light that has the parameter: the beam of a spot light, where it was fitted to one of Arnold's
// pictures (spot_light.cpp), and the outline of a quad light, for which the same family is a guess.
// Source: Barzel 1997, "Lighting Controls for Computer Cinematography".
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vec.h"

namespace lightsieve {

class Superellipse {
  public:
    Superellipse() = default;
    /// roundness  1: a disc, 0: a square
    explicit Superellipse(float roundness) {
        // Superellipses with less roundness than this are squares to float precision.
        constexpr float kMinRoundness = 0.01F;
        if (roundness >= 1)
            exponent_ = 2;
        else
            exponent_ = roundness < kMinRoundness ? kInfinity : 2 / roundness;
    }

    /// 1 on the outline through (1, 0) and (0, 1), less inside.
    ///
    /// x, y  not negative
    [[nodiscard]] float norm(float x, float y) const {
        if (exponent_ == 2) return std::sqrt(x * x + y * y);
        const float most = std::max(x, y);
        if (exponent_ == kInfinity || !(most > 0)) return most;
        // Relative to the larger one, so that high powers stay in range.
        return most * std::pow(1 + std::pow(std::min(x, y) / most, exponent_), 1 / exponent_);
    }
    [[nodiscard]] bool is_disc() const { return exponent_ == 2; }
    [[nodiscard]] bool is_square() const { return exponent_ == kInfinity; }

  private:
    float exponent_ = 2;
};

}  // namespace lightsieve
