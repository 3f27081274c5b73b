// The absorbing bodies that a path is inside of, innermost last.
//
// A body is known by its shader, since one body may be made of several shapes. A path enters it when it is refracted at the outside of its surface and leaves it at the inside. What it is inside of decides
// how much light the way to the next surface takes away (Beer-Lambert).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/vec.h"

namespace lightsieve {

class Interiors {
  public:
    void clear() { n_ = 0; }
    /// body  the shader of the surface that the path went through to the inside
    /// More than fit are not kept: they absorb nothing.
    void enter(const void* body, Color absorption) {
        if (n_ < bodies_.size()) bodies_[n_++] = {body, absorption};
    }
    /// The path went through such a surface to the outside. Bodies may overlap, so it need not be the last.
    void leave(const void* body) {
        for (std::size_t i = n_; i-- > 0;) {
            if (bodies_[i].body != body) continue;
            for (--n_; i < n_; ++i)
                bodies_[i] = bodies_[i + 1];
            return;
        }
    }
    [[nodiscard]] bool empty() const { return n_ == 0; }
    /// Absorption coefficient of the innermost body [1/scene unit].
    [[nodiscard]] Color absorption() const {
        return n_ == 0 ? kBlack : bodies_[n_ - 1].absorption;
    }

  private:
    struct Body {
        const void* body = nullptr;
        Color absorption;
    };
    std::array<Body, 8> bodies_;
    std::size_t n_ = 0;
};

/// What is left of light after a distance in an absorbing body.
[[nodiscard]] inline Color transmittance(Color absorption, float distance) {
    return {std::exp(-absorption.r * distance), std::exp(-absorption.g * distance),
            std::exp(-absorption.b * distance)};
}

}  // namespace lightsieve
