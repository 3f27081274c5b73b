#include "render/media_path.h"

#include <algorithm>
#include <cmath>

namespace lightsieve {
namespace {

/// Below this, estimates of transmittance go on by chance.
constexpr float kFaint = 0.05F;
/// Collisions along one ray: a guard against bounds without measure.
constexpr std::uint32_t kMaxCollisions = 1U << 20U;

}  // namespace

void MediaPath::begin(std::span<const SceneVolume> volumes, const Ray& ray, std::uint32_t mask,
                      const std::optional<BodyMedium>& body, const Sampler& sampler,
                      std::uint32_t stream, Vec2f first) {
    intervals_.clear();
    flights_.clear();
    sampler_ = &sampler;
    stream_ = stream;
    first_ = first;
    count_ = 0;
    current_ = SIZE_MAX;
    for (const SceneVolume& volume : volumes)
        if ((volume.object.visibility & mask) != 0) find_intervals(volume, ray, intervals_);
    for (const VolumeInterval& part : intervals_) {
        const ObjectRay in_object = to_object(*part.volume, ray);
        Flight flight{part.volume,
                      MajorantWalk(part.volume->majorants, in_object.origin, in_object.direction,
                                   part.begin, part.end),
                      0,
                      0,
                      part.begin,
                      part.end};
        draw(flight);
        flights_.push_back(flight);
    }
    if (!body) return;
    Flight flight;
    flight.majorant = max_component(body->medium.extinction);
    flight.position = ray.t_min;
    flight.end = ray.t_max;
    draw(flight);
    flights_.push_back(flight);
}

void MediaPath::draw(Flight& flight) {
    float thickness = count_ < kMaxCollisions ? -std::log1p(-number()) : kInfinity;
    if (flight.volume == nullptr) {
        flight.t = flight.position + thickness / flight.majorant;
        if (!(flight.t < flight.end)) flight.t = kInfinity;
        flight.position = flight.t;
        return;
    }
    // The rest of the cell where the last collision was, then cell by cell.
    do {
        const float length = flight.walk.end() - flight.position;
        const float in_cell = flight.walk.majorant() * length;
        if (length > 0 && thickness < in_cell) {
            flight.majorant = flight.walk.majorant();
            flight.position += thickness / flight.majorant;
            flight.t = flight.position;
            return;
        }
        if (length > 0) {
            thickness -= in_cell;
            flight.position = flight.walk.end();
        }
    } while (flight.walk.next());
    flight.t = kInfinity;
}

std::optional<Collision> MediaPath::next(float to) {
    if (current_ != SIZE_MAX) draw(flights_[current_]);
    current_ = SIZE_MAX;
    const auto nearest =
        std::min_element(flights_.begin(), flights_.end(),
                         [](const Flight& a, const Flight& b) { return a.t < b.t; });
    if (nearest == flights_.end() || !(nearest->t < to)) return std::nullopt;
    current_ = static_cast<std::size_t>(nearest - flights_.begin());
    return Collision{nearest->t, nearest->majorant, nearest->volume, current_};
}

Color estimate_transmittance(std::span<const SceneVolume> volumes, const Ray& ray,
                             std::uint32_t mask, const Sampler& sampler, std::uint32_t stream,
                             ClosureSet& scratch) {
    Color left = kWhite;
    thread_local std::vector<VolumeInterval> parts;
    parts.clear();
    for (const SceneVolume& volume : volumes)
        if ((volume.object.visibility & mask) != 0) find_intervals(volume, ray, parts);
    std::uint32_t count = 0;
    const auto number = [&] { return sampler.random(hash_combine(stream, count++)); };
    for (const VolumeInterval& part : parts) {
        if (part.volume->homogeneous) {
            left *= transmittance(part.volume->medium.extinction, part.end - part.begin);
            continue;
        }
        const ObjectRay in_object = to_object(*part.volume, ray);
        MajorantWalk walk(part.volume->majorants, in_object.origin, in_object.direction,
                          part.begin, part.end);
        while (walk.next()) {
            float t = walk.begin();
            while (walk.majorant() > 0 && count < kMaxCollisions) {
                t -= std::log1p(-number()) / walk.majorant();
                if (!(t < walk.end())) break;
                look_into(*part.volume, ray.origin + ray.direction * t, -ray.direction, ray.time,
                          RayType::Shadow, scratch);
                left *= kWhite - scratch.extinction() * (1 / walk.majorant());
                const float most =
                    std::max({std::abs(left.r), std::abs(left.g), std::abs(left.b)});
                if (!(most > 0)) return kBlack;
                if (most >= kFaint) continue;
                if (number() >= most) return kBlack;
                left *= 1 / most;
            }
        }
    }
    return left;
}

}  // namespace lightsieve
