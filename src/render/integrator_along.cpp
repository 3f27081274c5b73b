// Light that reaches media along a whole part of a ray: the haze of the atmosphere, and the glow around lamps in even fog.
//
// Points are drawn by the angle under which a light sees the ray, so that the bright surroundings of a lamp are found, and
// the light is asked from there. Haze is lit by that alone; in fog, collisions find light, too, and the two are weighted
// against each other by the densities with which they come upon the same point and light (any weights that add up to 1 keep
// the sum right; these keep it quiet). Source: Kulla and Fajardo 2012, "Importance Sampling Techniques for Path Tracing in
// Participating Media".
#include <cmath>

#include "render/integrator_deposit.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// An irrational step (the plastic number's inverse), so that turned points do not line up.
constexpr float kTurn = 0.7548776662F;

/// How far rays without end go through haze that shows itself.
constexpr float kHorizon = 1e7F;

/// u, shifted around in [0,1).
float turned(float u, float by) { return std::min(u + by - std::floor(u + by), kOneMinusEpsilon); }

/// Haze belongs to no shape: every light shines into it and every shape casts shadows.
const SceneObject& everywhere() {
    static const SceneObject object;
    return object;
}

/// Draws points on a part of a ray by the angle at a light.
class Equiangular {
  public:
    Equiangular(const Ray& ray, float begin, float end, const Box3f& light) {
        begin_ = begin;
        end_ = end;
        foot_ = dot(light.center() - ray.origin, ray.direction);
        // Nearer than the size of the light the angle says nothing any more.
        const float least = std::max(0.5F * length(light.size()), 1e-4F * (end - begin));
        distance_ = std::max(length(ray.origin + ray.direction * foot_ - light.center()), least);
        a_ = std::atan((begin - foot_) / distance_);
        b_ = std::atan((end - foot_) / distance_);
    }
    [[nodiscard]] float sample(float u) const {
        return std::clamp(foot_ + distance_ * std::tan(lerp(a_, b_, u)), begin_, end_);
    }
    /// Per length.
    [[nodiscard]] float pdf(float t) const {
        return b_ > a_ ? distance_ / ((b_ - a_) * (square(distance_) + square(t - foot_))) : 0;
    }

  private:
    float begin_, end_, foot_, distance_, a_, b_;
};

}  // namespace

/// How much of a light's contribution collisions bring at distance t, the rest being that of points along the ray.
///
/// asked  how many samples of the light a collision there takes, on average
template <class Tracker>
float Integrator<Tracker>::share_of_collisions(const Ray& ray, const AlongRay& part, float t,
                                               std::uint32_t light, float asked) const {
    if (part.collisions == 0) return 0;
    const float by_light = scene_.finite_lights.probability(light);
    if (!(by_light > 0)) return 1;
    const Equiangular points(ray, part.begin, part.end, scene_.lights[light].light->bounds().box);
    const float along = by_light * points.pdf(t);
    const float colliding =
        asked * part.collisions * std::exp(-part.collisions * (t - part.begin));
    return colliding + along > 0 ? colliding / (colliding + along) : 0;
}

/// Asks one light from one of n points along a part of a ray.
///
/// u         x: the point, y: the light
/// on_light  the point on the light
template <class Tracker>
void Integrator<Tracker>::add_light_along(const Ray& ray, const AlongRay& part, Vec2f u,
                                          Vec2f on_light, int n) {
    const Distribution1D::Sample picked = scene_.finite_lights.sample(u.y);
    const auto index = static_cast<std::uint32_t>(picked.index);
    const float pick = scene_.finite_lights.probability(picked.index);
    const SceneLight& light = scene_.lights[index];
    // The path's own vertex comes later and fills these anew.
    channels_[0] = {part.medium.record, true};
    n_channels_ = 1;
    if (!wanted_from(light)) return;
    const Equiangular points(ray, part.begin, part.end, light.light->bounds().box);
    const float t = points.sample(u.x);
    const float pdf = pick * points.pdf(t) * static_cast<float>(n);
    Surface vertex;
    vertex.in_medium = true;
    vertex.at.position = ray.origin + ray.direction * t;
    vertex.at.time = ray.time;
    vertex.object = part.object != nullptr ? part.object : &everywhere();
    const LightSample sample = light.light->sample(vertex.at.position, on_light);
    if (!(pdf > 0) || !(sample.pdf > 0) || is_black(sample.radiance)) return;
    const float phase = PhaseLobe(part.medium.phase).eval(-ray.direction, sample.wi).pdf;
    float weight = 1;
    if (part.collisions > 0) {
        const LightSampler& lights = *vertex.object->lights;
        const float asked =
            light_samples(light_plan(lights, true), lights, vertex.at.position, {0, 0, 0}, index);
        if (!(asked > 0)) return;  // not in the volume's light group
        weight = 1 - share_of_collisions(ray, part, t, index, asked);
        // Rays that the phase function sends find the light, too.
        const float rays = volume_rays({part.medium.record, true});
        if (!sample.delta && !light.samples_only)
            weight *= power_heuristic(asked * sample.pdf, rays * phase);
    }
    Color arriving = visibility(vertex, index, sample).straight;
    if (is_black(arriving)) return;
    if (part.collisions == 0)  // haze is no volume: shadow rays do not know of it
        arriving *= transmittance(part.medium.extinction, sample.distance + t - part.begin);
    Ray before = ray;
    before.t_min = part.start;
    before.t_max = t;
    arriving *= media_transmittance(before);
    const Color value = part.medium.scattering * sample.radiance * arriving *
                        (weight * phase / (sample.pdf * pdf));
    deposit_scattered({light.as_light, light.light_event}, [&](std::size_t g, std::size_t) {
        return path_.groups[g].key.lights_only()
                   ? kBlack
                   : value * light_factor(light.common, RayType::Volume, path_.n_scatter + 1);
    });
}

/// Light on even fog between media_t_ and `to`.
template <class Tracker>
void Integrator<Tracker>::add_fog(const Ray& ray, float to) {
    if (lights_only_ || scene_.finite_lights.size() == 0) return;
    for (const VolumeInterval& interval : media_.parts()) {
        const AlongRay part = along(interval, to);
        if (part.begin < part.end && part.collisions > 0 && part.medium.scatters())
            add_light_along(ray, part, media_points_[1], media_points_[2], 1);
    }
}

template <class Tracker>
auto Integrator<Tracker>::along(const VolumeInterval& interval, float to) -> AlongRay {
    AlongRay part;
    const SceneVolume& volume = *interval.volume;
    part.start = media_t_;
    part.begin = std::max(interval.begin, media_t_);
    part.end = std::min(interval.end, to);
    part.object = &volume.object;
    if (!volume.homogeneous) return part;
    part.medium = volume.medium;
    part.collisions = max_component(volume.medium.extinction);
    return part;
}

/// The atmosphere between media_t_ and `to`. Rays without end are followed to the far side of the scene.
template <class Tracker>
void Integrator<Tracker>::add_haze(const Ray& ray, float to) {
    const Box3f& bounds = scene_.haze.bounds;
    haze_.medium = {};
    haze_.far = std::min(to, length(bounds.center() - ray.origin) + length(bounds.size()));
    if (!(haze_.far > media_t_)) return;
    ShadePoint at;
    at.position = ray.origin;
    at.wo = at.normal = at.geometric_normal = -ray.direction;
    at.direction = ray.direction;
    at.time = ray.time;
    at.ray_type = path_.groups[0].key.ray_type();
    at.ray_length = std::min(to, kHorizon);
    closures_.begin_volume(at.wo);
    scene_.atmosphere->closures(at, closures_);
    haze_.medium = mixed(closures_.media());
    if (!closures_.emissions().empty()) add_glow(at.ray_length);
    if (lights_only_ || !haze_.medium.scatters() || scene_.finite_lights.size() == 0) return;
    AlongRay part;
    part.medium = haze_.medium;
    part.start = part.begin = media_t_;
    part.end = haze_.far;
    const int n = path_.n_scatter == 0 ? scene_.haze.samples : 1;
    // One well spread point for each of n parts of the ray; their other numbers are turned against each other.
    for (int i = 0; i < n; ++i) {
        const auto share = static_cast<float>(i) / static_cast<float>(n);
        const Vec2f u = media_points_[1], on = media_points_[2];
        add_light_along(ray, part, {share + u.x / static_cast<float>(n), turned(u.y, share)},
                        {turned(on.x, share), turned(on.y, share * kTurn)}, n);
    }
}

/// What haze shows of itself: it has no end but what the ray meets.
template <class Tracker>
void Integrator<Tracker>::add_glow(float to) {
    haze_.far = to;
    const float length = to - media_t_;
    const Color left = transmittance(haze_.medium.extinction, length);
    Color seen;  // [scene units]
    for (int c = 0; c < 3; ++c) {
        const float extinction = haze_.medium.extinction[c];
        seen[c] = extinction > 0 ? (1 - left[c]) / extinction : length;
    }
    for (const Emission& e : closures_.emissions())
        deposit({e.record->terminal, e.record->event}, [&](std::size_t g) {
            return path_.groups[g].key.lights_only()
                       ? kBlack
                       : e.radiance * seen * path_.groups.indirect(g);
        });
}

/// What the haze takes away between two points of the ray.
template <class Tracker>
void Integrator<Tracker>::fade_in_haze(float from, float to) {
    if (is_black(haze_.medium.extinction)) return;
    const Color left =
        transmittance(haze_.medium.extinction, std::max(std::min(to, haze_.far) - from, 0.0F));
    path_.groups.scale(left);
    tracker_.scale(left);
    path_.passed *= left;
    haze_.left *= left;
}

// Explicitly, member by member: the class as a whole is instantiated in integrator.cpp.
#define LIGHTSIEVE_ALONG(Tracker)                                                                 \
    template float Integrator<Tracker>::share_of_collisions(const Ray&, const AlongRay&, float,   \
                                                            std::uint32_t, float) const;          \
    template void Integrator<Tracker>::add_light_along(const Ray&, const AlongRay&, Vec2f, Vec2f, \
                                                       int);                                      \
    template void Integrator<Tracker>::add_fog(const Ray&, float);                                \
    template auto Integrator<Tracker>::along(const VolumeInterval&, float) -> AlongRay;           \
    template void Integrator<Tracker>::add_haze(const Ray&, float);                               \
    template void Integrator<Tracker>::add_glow(float);                                           \
    template void Integrator<Tracker>::fade_in_haze(float, float);
LIGHTSIEVE_ALONG(AovTracker)
LIGHTSIEVE_ALONG(LogTracker)
#undef LIGHTSIEVE_ALONG

}  // namespace lightsieve
