// Where in the picture, on the lens and in time a camera sample lies, and what filters make of it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/sobol.h"
#include "render/film.h"
#include "render/scene.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// Everything about one camera sample but its light.
struct CameraSample {
    Sampler sampler;
    CameraRay ray{};
    float time = 0;
    Mat4f camera_from_world{};
    Vec2f offset{};        ///< from the pixel's centre [pixels]
    Vec2f film{}, lens{};  ///< as Camera::ray takes them
    RayState state{};      ///< what shaders see of it: pixel, place in it
};

/// Makes the camera samples of one pass.
///
/// The pass's first filter places the samples (a sample belongs to one pixel: no pixel sees its neighbours' samples);
/// the other filters weigh them by their value over the density.
class CameraSampler {
  public:
    CameraSampler(const Scene& scene, const Pass& pass)
        : CameraSampler(scene, pass, scene.settings.seed) {}
    /// The same with another seed than the scene's.
    CameraSampler(const Scene& scene, const Pass& pass, std::uint32_t seed)
        : scene_(scene), pass_(pass), seed_(seed) {}

    [[nodiscard]] CameraSample sample(int x, int y, std::uint32_t index) const;
    /// One weight for each of the pass's views.
    void weights(const CameraSample& sample, std::vector<float>& out) const;

    [[nodiscard]] const Camera& camera() const { return *pass_.camera; }

  private:
    const Scene& scene_;
    const Pass& pass_;
    std::uint32_t seed_;
};

/// Takes the camera's exposure out of a sample's albedos: it brightens light, and they are a property of surfaces.
void remove_exposure(const CameraSample& sample, std::vector<SampleBuffer::Contribution>& probes);

/// AA_sample_clamp: one factor for everything a sample brings.
[[nodiscard]] float sample_clamp_factor(const Scene& scene, Color beauty);

}  // namespace lightsieve
