#include "render/camera_sample.h"

namespace lightsieve {
namespace {
/// Pairs of dimensions before the path's own (Integrator::kFirstPair).
enum CameraPair : std::uint32_t { kFilterPair = 0, kLensPair = 1, kTimePair = 2 };
}  // namespace

CameraSample CameraSampler::sample(int x, int y, std::uint32_t index) const {
    CameraSample out{.sampler = Sampler(static_cast<std::uint32_t>(x),
                                        static_cast<std::uint32_t>(y), index, seed_)};
    const PixelFilter& filter = *scene_.plan.views[pass_.sampling_view].filter;
    const std::array<Vec2f, 4> points = out.sampler.at2x4(0);
    out.offset = filter.sample(points[kFilterPair]).offset;
    const Vec2f film{
        (static_cast<float>(x) + 0.5F + out.offset.x) / static_cast<float>(scene_.settings.width),
        (static_cast<float>(y) + 0.5F + out.offset.y) /
            static_cast<float>(scene_.settings.height)};
    out.film = film;
    out.time = scene_.settings.instant ? *scene_.settings.instant
                                       : pass_.camera->sample_time(film, points[kTimePair].x);
    out.lens = points[kLensPair];
    out.ray = pass_.camera->ray(film, out.lens, out.time);
    out.state.x = x;
    out.state.y = y;
    out.state.sample = index;
    out.state.screen = {2 * film.x - 1, 1 - 2 * film.y};
    out.state.subpixel = {out.offset.x + 0.5F, out.offset.y + 0.5F};
    out.camera_from_world = pass_.camera->camera_from_world(out.time);
    return out;
}

void CameraSampler::weights(const CameraSample& sample, std::vector<float>& out) const {
    out.resize(pass_.views.size());
    const FilterView& main = scene_.plan.views[pass_.sampling_view];
    const float density = main.filter->pdf(sample.offset);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const FilterView& view = scene_.plan.views[pass_.views[i]];
        if (keeps_one_sample(view.filter->reduction())) {
            out[i] = 1;
        } else if (!view.is_signed && pass_.views[i] == pass_.sampling_view) {
            out[i] = 1;  // by construction, without the rounding of the quotient
        } else {
            out[i] =
                density > 0 ? view.filter->eval(sample.offset) / (view.integral * density) : 0;
        }
    }
}

void remove_exposure(const CameraSample& sample, std::vector<SampleBuffer::Contribution>& probes) {
    if (sample.ray.weight == 1 || !(sample.ray.weight > 0)) return;
    for (SampleBuffer::Contribution& probe : probes)
        probe.value *= 1 / sample.ray.weight;
}

float sample_clamp_factor(const Scene& scene, Color beauty) {
    const float largest = max_component(beauty);
    return largest > scene.settings.sample_clamp ? scene.settings.sample_clamp / largest : 1;
}

}  // namespace lightsieve
