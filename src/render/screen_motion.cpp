#include "render/screen_motion.h"

#include <algorithm>
#include <cmath>

namespace lightsieve {
namespace {

/// How far the ray of a film place passes beside the point, across it and as a share of the distance; nothing if there is no
/// ray or the point lies behind it.
std::optional<Vec2f> miss(const Camera& camera, Vec3f point, Vec2f film, Vec2f lens, float time,
                          const Frame& across) {
    const CameraRay ray = camera.ray(film, lens, time);
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
        const Vec3f direction = camera.ray(film, lens, time).direction;
        if (!is_finite(direction) || !(length_squared(direction) > 0)) return std::nullopt;
        const Frame across = Frame::from_z(direction);
        const auto at = [&](Vec2f place) {
            return miss(camera, point, place, lens, time, across);
        };
        const std::optional<Vec2f> here = at(film), right = at(film + Vec2f{kDifference, 0}),
                                   down = at(film + Vec2f{0, kDifference});
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
