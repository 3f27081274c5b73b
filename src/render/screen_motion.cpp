#include "render/screen_motion.h"

#include <algorithm>
#include <cmath>

namespace lightsieve {
namespace {

/// How far a ray passes beside the point, across it and as a share of the distance; nothing if the point lies behind it.
std::optional<Vec2f> miss(const CameraRay& ray, Vec3f point, const Frame& across) {
    const Vec3f to_point = point - ray.origin;
    const float along = dot(to_point, ray.direction);
    if (!(along > 0)) return std::nullopt;
    const Vec3f beside = (to_point - ray.direction * along) / along;
    return Vec2f{dot(beside, across.x), dot(beside, across.y)};
}

}  // namespace

std::optional<Vec2f> film_of(const Camera& camera, Vec3f point, Vec2f lens, float time,
                             Vec2f guess) {
    constexpr int kMostSteps = 20;
    constexpr float kDifference = 1e-3F;  // of the film, for slopes
    constexpr float kLongest = 0.25F;     // step: beyond, the slopes tell little
    constexpr float kClose = 1e-6F;       // a hundredth of a pixel of 8K
    constexpr float kUsable = 1e-4F;      // as near as long lenses let a float come
    Vec2f film = guess;
    float size = kInfinity;
    for (int i = 0; i < kMostSteps; ++i) {
        const auto ray_at = [&](float dx, float dy) {
            return camera.ray(film + Vec2f{dx, dy}, lens, time);
        };
        const CameraRay ray = ray_at(0, 0);
        if (!is_finite(ray.direction) || !(length_squared(ray.direction) > 0)) return std::nullopt;
        const Frame across = Frame::from_z(ray.direction);
        const std::optional<Vec2f> here = miss(ray, point, across),
                                   right = miss(ray_at(kDifference, 0), point, across),
                                   down = miss(ray_at(0, kDifference), point, across);
        if (!here || !right || !down) return std::nullopt;
        const Vec2f dx = (*right - *here) * (1 / kDifference),
                    dy = (*down - *here) * (1 / kDifference);
        const float determinant = dx.x * dy.y - dx.y * dy.x;
        Vec2f step{(dy.x * here->y - dy.y * here->x) / determinant,
                   (dx.y * here->x - dx.x * here->y) / determinant};
        size = std::hypot(step.x, step.y);
        if (!std::isfinite(size)) return std::nullopt;
        if (size > kLongest) step = step * (kLongest / size);
        film = film + step;
        if (size < kClose) return film;
    }
    return size < kUsable ? std::optional(film) : std::nullopt;
}

Vec2f screen_motion(const Camera& camera, const CameraSample& sample,
                    const std::array<Vec3f, 2>& at_shutter, const RenderSettings& settings) {
    const auto seen = [&](std::size_t end) {
        return film_of(camera, at_shutter[end], sample.lens, static_cast<float>(end), sample.film);
    };
    const std::optional<Vec2f> open = seen(0), closed = seen(1);
    if (!open || !closed) return {};
    return {(closed->x - open->x) * static_cast<float>(settings.width),
            (open->y - closed->y) * static_cast<float>(settings.height)};
}

}  // namespace lightsieve
