// How a Guide is learned: rounds of paths before the picture's own, each guided by what the one before found.
//
// A path notes each place from which it went on by a guided lobe. All light that it brings later on is noted for all of these
// places, in proportion to what the path carried there: so much light came to the lobe from that direction. Rounds double in
// size; the last one is what the picture is rendered with. Records are added up in the order of the picture's tiles, so the
// guide has the same bits on any number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "render/guide.h"
#include "render/statistics.h"

namespace lightsieve {

class Scene;

/// Densities of a direction, per solid angle, summed over the lobes that could have chosen it.
struct GuideDensities {
    float used = 0;      ///< that the direction was drawn with
    float unguided = 0;  ///< if no ray were guided
    float guided = 0;    ///< if all rays of broad lobes were
    /// If `share` of them were.
    [[nodiscard]] float of_share(float share) const { return lerp(unguided, guided, share); }
};

/// Light that came to a lobe from a direction.
struct GuideRecord {
    std::uint32_t cell = 0;
    Vec2f at;         ///< square_from_direction
    float light = 0;  ///< cosine and lobe included, over the density of the direction
    GuideDensities pdf;
};

/// The places from which the paths of one camera sample went on.
class GuideRecorder {
  public:
    static constexpr std::uint32_t kNone = UINT32_MAX;

    /// A path goes on. Returns the place's number.
    ///
    /// before  the place that the path was at before, or kNone
    /// scale   what light that the path brings from now on is multiplied by
    /// pdf     of the direction
    std::uint32_t add(std::uint32_t before, std::uint32_t cell, Vec3f direction, float scale,
                      const GuideDensities& pdf) {
        places_.push_back({before, cell, square_from_direction(direction), scale, 0, pdf});
        return static_cast<std::uint32_t>(places_.size() - 1);
    }
    /// A path whose last place is `last` brings light [luminance].
    void bring(std::uint32_t last, float light) {
        for (std::uint32_t i = last; i != kNone; i = places_[i].before)
            places_[i].brought += light;
    }
    /// The sample is done: its places become records, those that got nothing too.
    void finish(std::vector<GuideRecord>& out);

  private:
    struct Place {
        std::uint32_t before, cell;
        Vec2f at;
        float scale, brought;
        GuideDensities pdf;
    };
    std::vector<Place> places_;
};

/// What training took.
struct GuideTraining {
    std::unique_ptr<Guide> guide;  ///< null: there is nothing to learn from, or it was stopped
    std::uint64_t n_samples = 0;   ///< of the camera
    RaysByKind rays{};
};

/// Camera samples that training will take, about: an eighth of the picture's, and no more than 16 million a camera. They do not get
/// into the picture. 0: no light is asked for.
[[nodiscard]] std::uint64_t training_samples(const Scene& scene);
/// Bytes that training will take at most, about, and the guide after it.
[[nodiscard]] std::size_t training_memory(const Scene& scene);

/// Learns a guide.
///
/// taken  told now and then of so many more camera samples, by one thread
/// stop   set it to end early, or null
[[nodiscard]] GuideTraining train_guide(const Scene& scene,
                                        const std::function<void(std::uint64_t)>& taken,
                                        const std::atomic<bool>* stop);

}  // namespace lightsieve
