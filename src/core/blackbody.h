// The colour of things that glow because they are hot.
#pragma once

#include "core/vec.h"

namespace lightsieve {

/// Colour of a black body in the rendering space, of luminance 1: Planck's law through the CIE 1931 observer.
///
/// kelvin  clamped to [500, 40000]: below, what is visible is too little to have a colour; not finite counts as the lower end
/// Components may be negative: deep reds lie outside of ACEScg.
/// Source: Planck 1901; colour matching functions by Wyman, Sloan and Shirley 2013, "Simple Analytic Approximations to the
/// CIE XYZ Color Matching Functions", the multi-lobe fit.
[[nodiscard]] Color blackbody_color(float kelvin);

}  // namespace lightsieve
