// How a path goes through media: collisions, emission on the way, what shadow rays lose.
//
// At a tentative collision the path scatters or goes on. Both choices are weighted, so that each channel stays unbiased
// however unlike the channels are; their odds follow what the path still carries, which keeps the weights near 1.
// Absorption never ends a path by itself. Source: Kutz, Habel, Li and Novak 2017, "Spectral and Decomposition Tracking for
// Rendering Heterogeneous Volumes"; negative weights where a bound is exceeded: Galtier et al. 2013.
#include <cmath>

#include "render/integrator.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Streams of random numbers of media, apart from those of the path.
constexpr std::uint32_t kMediaStream = 0x3c6ef372U, kShadowStream = 0xa54ff53aU,
                        kOpacityStream = 0x510e527fU, kDepthStream = 0x9b05688cU;
/// The sampler's pairs of dimensions for media, four a segment, past those of any path.
constexpr std::uint32_t kMediaPairs = 1U << 16U;
/// A path that carries less than this share of what it began with goes on by chance.
constexpr float kFaint = 0.02F;

Color absolute(Color c) { return {std::abs(c.r), std::abs(c.g), std::abs(c.b)}; }
float weighted(Color odds, Color c) { return odds.r * c.r + odds.g * c.g + odds.b * c.b; }

}  // namespace

template <class Tracker>
void Integrator<Tracker>::begin_media(const Ray& ray, float t_end) {
    const std::optional<BodyMedium> body = path_.interiors.scattering();
    media_t_ = ray.t_min;
    haze_.left = kWhite;
    if (scene_.volumes.empty() && scene_.atmosphere == nullptr && !body) return media_.clear();
    media_points_ = path_.sampler.at2x4(kMediaPairs + path_.segment * 4);
    Ray part = ray;
    part.t_max = t_end;
    media_.begin(scene_.volumes, part, ray_mask(), body, path_.sampler,
                 hash_combine(path_.segment, kMediaStream), media_points_[0]);
}

template <class Tracker>
auto Integrator<Tracker>::travel_through_media(const Ray& ray, float to) -> Passage {
    if (!(to > media_t_)) return Passage::Free;
    const bool hazy = scene_.atmosphere != nullptr;
    if (hazy) add_haze(ray, to);
    if (media_.active()) {
        if (seen()) add_media_opacity(ray, to);
        add_fog(ray, to);
        while (const std::optional<Collision> collision = media_.next(to)) {
            const Passage end = collide(ray, *collision);
            if (end == Passage::Scattered) {
                if (hazy) fade_in_haze(media_t_, collision->t);
                vertex_part_.reset();
                vertex_ray_ = ray;
                if (collision->volume != nullptr && collision->volume->homogeneous)
                    vertex_part_ = along(media_.parts()[collision->part], to);
            }
            if (end != Passage::Free) return end;
        }
    }
    if (hazy) fade_in_haze(media_t_, to);
    media_t_ = to;
    return Passage::Free;
}

/// One tentative collision.
template <class Tracker>
auto Integrator<Tracker>::collide(const Ray& ray, const Collision& collision) -> Passage {
    const Vec3f position = ray.origin + ray.direction * collision.t;
    if (collision.volume != nullptr) {
        look_into(*collision.volume, position, -ray.direction, ray.time,
                  path_.groups[0].key.ray_type(), closures_);
        open_slot(position);
        // Emission on a way of mean length 1 / bound.
        add_emission(1 / collision.majorant);
    } else {
        open_slot(position);
        closures_.begin_volume(-ray.direction);
        closures_.add_medium(path_.interiors.scattering()->medium);
    }
    const Color extinction = closures_.extinction();
    Color scattering;
    for (const Medium& m : closures_.media())
        scattering += m.scattering;
    if (lights_only_) scattering = kBlack;

    const float per_bound = 1 / collision.majorant;
    const Color carried = absolute(path_.groups.total());
    const Color odds = carried * (1 / std::max(carried.r + carried.g + carried.b, 1e-30F));
    const Color real = scattering * per_bound, null = kWhite - extinction * per_bound;
    const float to_real = weighted(odds, real), to_null = weighted(odds, absolute(null));
    if (!(to_real + to_null > 0)) return Passage::Ended;
    const float p = to_real / (to_real + to_null);
    if (media_.number() < p) {
        closures_.scatter_in_media(per_bound / p);
        make_vertex(ray, collision);
        return Passage::Scattered;
    }
    const Color factor = null * (1 / (1 - p));
    path_.groups.scale(factor);
    tracker_.scale(factor);
    path_.passed *= factor;
    const float left = max_component(absolute(path_.groups.total())) * path_.siblings /
                       max_component(path_.start);
    if (left >= kFaint) return Passage::Free;
    const float survival = left / kFaint;
    if (!(media_.number() < survival)) return Passage::Ended;
    path_.groups.scale(Color::grey(1 / survival));
    tracker_.scale(Color::grey(1 / survival));
    path_.passed *= 1 / survival;
    return Passage::Free;
}

/// Makes a collision the path's next vertex.
template <class Tracker>
void Integrator<Tracker>::make_vertex(const Ray& ray, const Collision& collision) {
    Surface& at = medium_vertex_;
    at = {};
    at.in_medium = true;
    at.object = collision.volume != nullptr ? &collision.volume->object
                                            : path_.interiors.scattering()->object;
    at.shader = at.object->shaders[0];
    at.t = collision.t;
    at.at.position = ray.origin + ray.direction * collision.t;
    at.at.wo = at.at.normal = at.at.geometric_normal = at.outward = -ray.direction;
    at.at.ray_type = path_.groups[0].key.ray_type();
    at.at.time = ray.time;
    at.frame = Frame::from_z(-ray.direction);
}

/// What media hide from the camera, on average over all collisions and so with little noise.
template <class Tracker>
void Integrator<Tracker>::add_media_opacity(const Ray& ray, float to) {
    Ray part = ray;
    part.t_min = media_t_;
    part.t_max = to;
    const Color left = estimate_transmittance(
        scene_.volumes, part, ray_bit(RayType::Camera), path_.sampler,
        hash_combine(hash_combine(path_.segment, kOpacityStream), n_shadow_rays_++),
        shadow_closures_);
    const Color opacity = path_.passed * (kWhite - left);
    out_->first.volume_opacity += opacity;
    if (out_->deep && path_.n_scatter == 0) open_slot(somewhere_in_media(ray, to));
    out_->add_alpha(average(opacity), opacity);
}

/// A point of the ray in media before `to`: over many samples their opacity is spread evenly along the ray.
template <class Tracker>
Vec3f Integrator<Tracker>::somewhere_in_media(const Ray& ray, float to) {
    float all = 0;
    const auto length_of = [&](const VolumeInterval& part) {
        return std::max(0.0F, std::min(part.end, to) - std::max(part.begin, media_t_));
    };
    for (const VolumeInterval& part : media_.parts())
        all += length_of(part);
    float left = random(kDepthStream) * all;
    for (const VolumeInterval& part : media_.parts()) {
        const float length = length_of(part);
        if (left <= length)
            return ray.origin + ray.direction * (std::max(part.begin, media_t_) + left);
        left -= length;
    }
    return ray.origin + ray.direction * to;
}

template <class Tracker>
Color Integrator<Tracker>::media_transmittance(const Ray& ray) {
    if (scene_.volumes.empty()) return kWhite;
    return estimate_transmittance(
        scene_.volumes, ray, ray_bit(RayType::Shadow), path_.sampler,
        hash_combine(hash_combine(path_.segment, kShadowStream), n_shadow_rays_++),
        shadow_closures_);
}

// Explicitly, member by member: the class as a whole is instantiated in integrator.cpp.
#define LIGHTSIEVE_MEDIA(Tracker)                                                          \
    template void Integrator<Tracker>::begin_media(const Ray&, float);                     \
    template auto Integrator<Tracker>::travel_through_media(const Ray&, float) -> Passage; \
    template auto Integrator<Tracker>::collide(const Ray&, const Collision&) -> Passage;   \
    template void Integrator<Tracker>::make_vertex(const Ray&, const Collision&);          \
    template void Integrator<Tracker>::add_media_opacity(const Ray&, float);               \
    template Vec3f Integrator<Tracker>::somewhere_in_media(const Ray&, float);             \
    template Color Integrator<Tracker>::media_transmittance(const Ray&);
LIGHTSIEVE_MEDIA(AovTracker)
LIGHTSIEVE_MEDIA(LogTracker)
#undef LIGHTSIEVE_MEDIA

}  // namespace lightsieve
