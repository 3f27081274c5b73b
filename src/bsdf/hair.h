// A fibre of hair or fur: light that it reflects (R), lets through (TT), reflects inside (TRT) and all that goes on longer.
//
// The fibre is a dielectric cylinder with a rough, tilted surface and an absorbing inside. Each path through it is a lobe of
// its own, because each makes its own event: R, TRT and the rest <RS'hair'>, TT <TS'hair'>. The side on which light leaves
// says nothing: every lobe spreads over the whole sphere.
// A lobe is A_p (what is left of the light) times a density of directions, M_p (along) N_p (around), and is sampled exactly
// by that density. So its directional albedo is A_p, and without absorption the four add up to 1.
//
// Frame: x along the fibre, z toward the viewer's side (wo.z > 0), y across. `offset` is where the ray met the fibre, -1 to 1
// along y. Values are not f * |cos| to a normal, which a fibre has not: they are f times the cosine to the fibre's
// cross-section, which is what M_p contains.
// Sources: Marschner et al. 2003 (paths); d'Eon et al. 2011 (M_p); Chiang, Bitterli, Tappan and Burley 2016, "A Practical
// and Controllable Hair and Fur Model for Production Path Tracing" (attenuation, N_p, roughness); absorption as MaterialX.
#pragma once

#include <cstdint>

#include "bsdf/lobe.h"

namespace lightsieve {

/// The paths of light through a fibre that are told apart.
enum class HairPath : std::uint8_t { R, TT, TRT, Rest };

/// Widths of a hair lobe. From an artist's roughness by `from_roughness`.
struct HairWidth {
    float variance = 0.03F;  ///< v of M_p: along the fibre [rad^2]
    float scale = 0.2F;      ///< s of the logistic N_p: around it [rad]

    /// The widths for the path R. Source: Chiang et al. 2016, section 4.1.
    /// longitudinal, azimuthal  [0,1]; outside is clamped, not finite becomes 0
    [[nodiscard]] static HairWidth from_roughness(float longitudinal, float azimuthal) noexcept;
    /// Along the fibre TT is half as wide as R, TRT and the rest twice. Source: Marschner et al. 2003, table 1.
    [[nodiscard]] HairWidth of(HairPath path) const noexcept;
};

/// One path through a fibre.
struct HairLobe {
    Color absorption{0, 0, 0};  ///< per radius of the fibre
    float offset = 0;           ///< where the ray met the fibre across, [-1,1]
    float ior = 1.55F;
    HairWidth width;
    float sin_shift = 0, cos_shift = 1;  ///< of how far the lobe is tilted by the cuticle
    HairPath path = HairPath::R;

    HairLobe() = default;
    /// width   of this path
    /// ior     clamped to [1, 4]
    /// shift   tilt of the cuticle's scales toward the root [rad]
    HairLobe(HairPath path, HairWidth width, float ior, Color absorption, float shift,
             float offset) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    /// A_p.
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return false; }

  private:
    struct Peak;
    [[nodiscard]] Peak peak(Vec3f wo) const noexcept;
    [[nodiscard]] float density(const Peak& peak, Vec3f wi) const noexcept;
};

/// Absorption of a fibre that shows `color` in bulk. Source: Chiang et al. 2016, eq. 9.
/// color      (0,1]; darker is taken as nearly black
/// azimuthal  roughness around the fibre, [0,1]
[[nodiscard]] Color hair_absorption_from_color(Color color, float azimuthal) noexcept;

/// Absorption by pigment. Source: d'Eon et al. 2011, with the colours of MaterialX's deon_hair_absorption_from_melanin.
/// melanin  0 white, 1 black; redness  share of the red pigment
[[nodiscard]] Color hair_absorption_from_melanin(float melanin, float redness) noexcept;

}  // namespace lightsieve
