// Collisions along a ray with all media that it passes.
//
// Each volume has collisions of its own, drawn from the bounds of its extinction; where volumes overlap, the next collision
// is the nearest of theirs (independent Poisson processes add up). So a collision belongs to one volume and makes that
// volume's event, and overlapping volumes need no rule of who wins.
// Source: Woodcock et al. 1965 (null collisions); Raab et al. 2008 and Novak et al. 2014 (ratio tracking).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bsdf/medium.h"
#include "core/sobol.h"
#include "render/majorants.h"
#include "render/ray.h"
#include "render/volume.h"

namespace lightsieve {

/// The inside of a body as media see it: a medium that is the same everywhere, and whose it is.
struct BodyMedium {
    Medium medium;
    const SceneObject* object = nullptr;
};

/// A tentative collision: with the medium, or with the nothing that makes up the rest of the bound.
struct Collision {
    float t = 0;
    float majorant = 0;                   ///< bound of the extinction there [1/scene unit]
    const SceneVolume* volume = nullptr;  ///< null: the body that the ray is in
    std::size_t part = 0;                 ///< of MediaPath::parts, if there is a volume
};

class MediaPath {
  public:
    /// Starts a ray.
    ///
    /// mask     volumes with a common bit of visibility are met
    /// body     the body that the ray is inside of, if its medium scatters
    /// stream   numbers of this ray are drawn from it, after
    /// first    the first two, which are worth well spread points
    void begin(std::span<const SceneVolume> volumes, const Ray& ray, std::uint32_t mask,
               const std::optional<BodyMedium>& body, const Sampler& sampler, std::uint32_t stream,
               Vec2f first);
    /// No ray: nothing to collide with.
    void clear() {
        intervals_.clear();
        flights_.clear();
    }
    /// Where the ray is in volumes.
    [[nodiscard]] std::span<const VolumeInterval> parts() const { return intervals_; }
    /// Whether there is anything to collide with on the ray.
    [[nodiscard]] bool active() const { return !flights_.empty(); }
    /// The next tentative collision before `to`, or nothing. Going on after one makes it a null collision.
    [[nodiscard]] std::optional<Collision> next(float to);
    /// A number for decisions at the collision.
    [[nodiscard]] float number() {
        const std::uint32_t i = count_++;
        return i == 0 ? first_.x : i == 1 ? first_.y : sampler_->random(hash_combine(stream_, i));
    }

  private:
    /// Collisions with one volume in one interval.
    struct Flight {
        const SceneVolume* volume = nullptr;
        MajorantWalk walk;
        float t = 0;         ///< of the pending collision; kInfinity: there are none left
        float majorant = 0;  ///< there
        float position = 0;  ///< how far the walk has been used up
        float end = 0;       ///< body only
    };
    void draw(Flight& flight);

    std::vector<VolumeInterval> intervals_;  ///< kept: no allocation after the first few rays
    std::vector<Flight> flights_;
    const Sampler* sampler_ = nullptr;
    Vec2f first_;
    std::uint32_t stream_ = 0, count_ = 0;
    std::size_t current_ = SIZE_MAX;  ///< flight of the last collision
};

/// What is left of light along a ray, from t_min to t_max: exact in homogeneous volumes, elsewhere an unbiased estimate by
/// ratio tracking, between 0 and 1 wherever bounds hold.
///
/// mask     volumes with a common bit of visibility count
/// scratch  for shaders
[[nodiscard]] Color estimate_transmittance(std::span<const SceneVolume> volumes, const Ray& ray,
                                           std::uint32_t mask, const Sampler& sampler,
                                           std::uint32_t stream, ClosureSet& scratch);

}  // namespace lightsieve
