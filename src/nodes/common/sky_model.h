// The clear sky and the sun by turbidity, ground albedo and the sun's elevation.
//
// The sky is the model of Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", with their
// coefficients for RGB. It has no ground and no night: below the horizon it is black, and a sun below the horizon counts as
// one on it. The sun is a black body seen through the air: its light outside of the atmosphere by the IESNA Lighting
// Handbook (127.5 klx), what the air takes by Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight",
// appendix A.1, at one wavelength for each of red, green and blue; ozone is left to the mean of that band, water vapour
// and mixed gases, which take nothing there, are left out.
// In a scene's units a white matt surface under 100 klx, about what the sun gives at noon, has radiance 1.
#pragma once

#include <array>

#include "core/color.h"
#include "core/vec.h"

namespace lightsieve {

class SkyModel {
  public:
    /// turbidity    of the air, 1 (clear) to 10 (hazy); albedo: of the ground, [0,1]; clamped to that
    /// sun          unit vector, y toward the zenith
    /// rendering    the space of `albedo` and of what is returned
    SkyModel(float turbidity, Color albedo, Vec3f sun, ColorSpace rendering = kRenderingSpace);

    /// Radiance from a direction, without the sun; rendering space. Black below the horizon.
    ///
    /// direction  unit, y toward the zenith
    [[nodiscard]] Color sky(Vec3f direction) const;
    /// Irradiance of a plane that faces the sun; rendering space. Black if the sun is below the horizon.
    [[nodiscard]] Color sun() const { return sun_irradiance_; }
    [[nodiscard]] Vec3f toward_sun() const { return toward_sun_; }

  private:
    ColorConversion rendering_from_rec709_;
    std::array<std::array<float, 9>, 3> shape_{};
    std::array<float, 3> radiance_{};
    Vec3f toward_sun_;
    Color sun_irradiance_;
};

}  // namespace lightsieve
