// How bright luminaires are by direction, from IES files.
//
// Reads the text format IESNA LM-63 (1986 to 2002; the standard's section 5): photometry of types C, B and A, with the
// symmetries that leave parts of the sphere out. Text before the line `TILT=` is skipped, whatever it says, for makers put
// much there. What the lamp's tilt does to its light is left out: a luminaire in a scene hangs as it was measured.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

/// Luminous intensity of a luminaire by direction.
class Photometry {
  public:
    /// How angles are meant: C around the vertical axis, 0 straight down; B around the axis across; A around the vertical
    /// axis, both with 0, 0 along the beam.
    enum class Type { C = 1, B = 2, A = 3 };

    /// Angles in degrees, not falling, at least one of each; `candela` has all vertical angles of the first horizontal one,
    /// then of the next. Values >= 0.
    Photometry(Type type, std::vector<float> vertical, std::vector<float> horizontal,
               std::vector<float> candela);

    /// Intensity [cd] toward a unit direction. Type C: z points down to vertical angle 0, x to horizontal angle 0, y to 90.
    /// Types B and A: z is the beam, x is across, y up. Bilinear in the angles; 0 beyond the measured vertical angles.
    [[nodiscard]] float candela(Vec3f direction) const noexcept;
    /// The largest value.
    [[nodiscard]] float peak() const { return peak_; }

  private:
    [[nodiscard]] float at(float vertical, float horizontal) const noexcept;
    [[nodiscard]] float folded(float horizontal) const noexcept;

    Type type_;
    std::vector<float> vertical_, horizontal_, candela_;
    float peak_ = 0;
};

/// Largest file that is read [bytes].
inline constexpr std::size_t kMaxPhotometryBytes = std::size_t{1} << 24;

/// The luminaire of an IES file.
///
/// throws  InputError: missing, unreadable, too large, damaged
[[nodiscard]] Photometry read_photometry(const std::string& path);
/// The same for the text of a file; `name` is for messages.
[[nodiscard]] Photometry parse_photometry(std::string_view text, const std::string& name);

}  // namespace lightsieve
