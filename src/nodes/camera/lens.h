// The lens of cameras with depth of field: parameters, and points of the aperture.
//
// An aperture of n blades is a polygon whose edges bend outward (curvature 1: a disc) or inward (a star). Points are
// even over its area whatever the curvature, so that a highlight out of focus is an even spot.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/sampling.h"
#include "nodes/camera/camera_common.h"

namespace lightsieve {

/// Parameters of cameras with a lens.
struct LensParams {
    Array<float> focus_distance{&camera_defaults::kFocusDistance, 1, 1};  ///< from the eye
    Array<float> aperture_size{&camera_defaults::kApertureSize, 1, 1};    ///< radius of the lens
    std::int32_t aperture_blades = 0;                                     ///< fewer than 3: a disc
    float aperture_blade_curvature = 0;  ///< 1: a disc, below 0: a star
    float aperture_rotation = 0;
    float aperture_aspect_ratio = 1;
    bool flat_field_focus = true;  ///< focus on a plane, not on a sphere
};

/// Documents `LensParams`.
template <class T>
void describe_lens(Describe<T>& d) {
    d.param("focus_distance", &LensParams::focus_distance, "Depth at which the picture is sharp.")
        .unit("scene units")
        .range(0, kInfinity);
    d.param("aperture_size", &LensParams::aperture_size, "Radius of the lens; 0 is a pinhole.")
        .unit("scene units")
        .range(0, kInfinity);
    d.param("aperture_blades", &LensParams::aperture_blades,
            "Edges of the aperture; fewer than 3 is a disc.");
    d.param("aperture_blade_curvature", &LensParams::aperture_blade_curvature,
            "0: straight edges, 1: a disc, below 0: edges bent inward.")
        .range(-1, 1);
    d.param("aperture_rotation", &LensParams::aperture_rotation, "Turns the aperture's polygon.")
        .unit("deg");
    d.param("aperture_aspect_ratio", &LensParams::aperture_aspect_ratio,
            "Height of the aperture over its width, which has the radius.")
        .range(0.1F, 10);
}

/// Points of an aperture of radius 1.
class Aperture {
  public:
    Aperture() = default;
    explicit Aperture(const LensParams& p)
        : n_blades_(p.aperture_blades >= 3 ? std::min(p.aperture_blades, kMaxBlades) : 0),
          curvature_(std::clamp(p.aperture_blade_curvature, -1.0F, 1.0F)),
          rotation_(std::isfinite(p.aperture_rotation) ? deg_to_rad(p.aperture_rotation) : 0) {
        if (!(curvature_ == curvature_)) curvature_ = 0;
        if (curvature_ >= 1) n_blades_ = 0;
        if (n_blades_ > 0) make_table();
    }

    /// u  in [0,1)^2
    [[nodiscard]] Vec2f point(Vec2f u) const {
        if (n_blades_ == 0) return sample_concentric_disk(u);
        const float n = static_cast<float>(n_blades_);
        const float blade = std::min(std::floor(u.x * n), n - 1);
        const float at = (u.x * n - blade) * kCells;
        const std::size_t cell = std::min(static_cast<std::size_t>(at), kCells - 1);
        const float angle =
            std::lerp(angles_[cell], angles_[cell + 1], at - static_cast<float>(cell));
        const float half = kPi / n, radius = edge(angle, half) * std::sqrt(u.y);
        const float turned = rotation_ + half * (2 * blade + 1) + angle;
        return {radius * std::cos(turned), radius * std::sin(turned)};
    }

  private:
    static constexpr std::int32_t kMaxBlades = 1000;
    static constexpr std::size_t kCells = 256;

    /// Distance of the edge at an angle to the middle of a blade.
    [[nodiscard]] float edge(float angle, float half) const {
        return std::lerp(std::cos(half) / std::cos(angle), 1.0F, curvature_);
    }
    /// Angles that cut a blade's sector into parts of equal area.
    void make_table() {
        const double half = static_cast<double>(kPi) / n_blades_;
        constexpr std::size_t kFine = 16;
        // Areas by the midpoint rule, then their inversion.
        std::array<double, kCells * kFine + 1> area{};
        const double step = 2 * half / (kCells * kFine);
        for (std::size_t i = 0; i < kCells * kFine; ++i) {
            const double r = static_cast<double>(
                edge(static_cast<float>(-half + step * (static_cast<double>(i) + 0.5)),
                     static_cast<float>(half)));
            area[i + 1] = area[i] + r * r;
        }
        std::size_t i = 0;
        for (std::size_t cell = 0; cell <= kCells; ++cell) {
            const double wanted = area.back() * static_cast<double>(cell) / kCells;
            while (i + 1 < area.size() - 1 && area[i + 1] < wanted)
                ++i;
            const double width = area[i + 1] - area[i];
            const double inside = width > 0 ? std::min((wanted - area[i]) / width, 1.0) : 0;
            angles_[cell] = static_cast<float>(-half + step * (static_cast<double>(i) + inside));
        }
    }

    std::int32_t n_blades_ = 0;
    float curvature_ = 0, rotation_ = 0;
    std::array<float, kCells + 1> angles_{};
};

/// A thin lens in front of an eye at the origin.
class Lens {
  public:
    Lens(const LensParams& p, Keyed<float> focus_distance, Keyed<float> aperture_size)
        : focus_distance_(std::move(focus_distance)),
          aperture_size_(std::move(aperture_size)),
          aperture_(p),
          open_(std::any_of(aperture_size_.keys().begin(), aperture_size_.keys().end(),
                            [](float r) { return r > 0; })),
          aspect_(p.aperture_aspect_ratio > 0 && std::isfinite(p.aperture_aspect_ratio)
                      ? p.aperture_aspect_ratio
                      : 1),
          flat_focus_(p.flat_field_focus) {}

    /// Moves a ray from the eye to a point of the lens, which faces -Z, so that what is in focus stays where it is.
    ///
    /// direction  with z = -1, before and after
    void bend(Vec3f& origin, Vec3f& direction, Vec2f u, float time) const {
        const std::optional<Open> lens = open(u, time);
        if (!lens) return;
        origin = {lens->point.x, lens->point.y, 0};
        const Vec3f in_focus =
            direction * (flat_focus_ ? lens->focus : lens->focus / length(direction));
        const Vec3f d = in_focus - origin;
        direction = d * (1 / -d.z);
    }
    /// The same for cameras that look to all sides: the lens faces each ray.
    ///
    /// direction  unit, before and after
    void bend_facing(Vec3f& origin, Vec3f& direction, Vec2f u, float time) const {
        const std::optional<Open> lens = open(u, time);
        if (!lens) return;
        // The frame that turns least from the viewing axis.
        const Frame frame = Frame::from_z(-direction);
        origin = frame.x * lens->point.x + frame.y * lens->point.y;
        direction = normalize(direction * lens->focus - origin);
    }

  private:
    struct Open {
        Vec2f point;
        float focus;
    };
    /// Where the ray passes the lens; nothing for a pinhole.
    [[nodiscard]] std::optional<Open> open(Vec2f u, float time) const {
        if (!open_) return std::nullopt;
        const float radius = aperture_size_.at(time), focus = focus_distance_.at(time);
        if (!(radius > 0 && focus > 0)) return std::nullopt;
        const Vec2f p = aperture_.point(u);
        return Open{{p.x * radius, p.y * radius * aspect_}, focus};
    }

    Keyed<float> focus_distance_, aperture_size_;
    Aperture aperture_;
    bool open_;
    float aspect_;
    bool flat_focus_;
};

}  // namespace lightsieve
