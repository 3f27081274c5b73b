#include "nodes/camera/camera_common.h"

#include <fmt/format.h>

#include "core/sampling.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

/// The camera's matrices, from `matrix` or from position, look_at and up; identity after an error.
std::vector<Mat4f> placement(const CameraCommon& p, NodeContext& context) {
    std::vector<Mat4f> keys;
    if (!p.matrix.empty()) {
        keys = key_values(p.matrix, Mat4f{});
    } else {
        const auto eyes = key_values(p.position, camera_defaults::kPosition);
        const auto targets = key_values(p.look_at, camera_defaults::kLookAt);
        const auto ups = key_values(p.up, camera_defaults::kUp);
        const std::size_t n = std::max({eyes.size(), targets.size(), ups.size()});
        // A parameter with fewer keys than the others keeps its last one.
        const auto key = [](const std::vector<Vec3f>& v, std::size_t i) {
            return v[std::min(i, v.size() - 1)];
        };
        for (std::size_t i = 0; i < n; ++i)
            keys.push_back(Mat4f::look_at(key(eyes, i), key(targets, i), key(ups, i)));
    }
    for (Mat4f& m : keys) {
        bool ok = m.finite();
        if (ok) static_cast<void>(m.inverse(&ok));
        if (ok) continue;
        context.diagnostics().error(
            Code::InvalidValue,
            fmt::format("the placement of camera \"{}\" cannot be inverted",
                        context.node_name().view()),
            context.where("matrix"),
            "the matrix must hold finite numbers and three independent axes");
        return {Mat4f{}};
    }
    return keys;
}

/// Keeps the parts of a shutter curve that make sense; a box after a warning if nothing is left.
Shutter make_shutter(const CameraCommon& p, NodeContext& context) {
    if (p.shutter_type == ShutterType::Triangle) return Shutter({{0, 0}, {0.5F, 1}, {1, 0}});
    if (p.shutter_type != ShutterType::Curve) return {};
    std::vector<Vec2f> points;
    float area = 0;
    bool good = p.shutter_curve.n >= 2;
    for (const Vec2f point : p.shutter_curve.first_key()) {
        const float previous = points.empty() ? 0 : points.back().x;
        good =
            good && point.x >= previous && point.x <= 1 && point.y >= 0 && std::isfinite(point.y);
        if (!good) break;
        if (!points.empty()) area += (point.x - previous) * (point.y + points.back().y) * 0.5F;
        points.push_back(point);
    }
    if (good && area > 0 && std::isfinite(area)) return Shutter(std::move(points));
    context.diagnostics().warning(
        Code::InvalidValue, "shutter_curve is no curve; the shutter is taken as a box",
        context.where("shutter_curve"),
        "give at least two points with rising times in 0..1 and openness above 0");
    return {};
}

/// What a shader says at a place of the film.
Color film_color(const ColorInput& shader, Vec2f film) {
    ShadePoint point;
    point.uv = {film.x, 1 - film.y};
    return shader.at(point);
}

}  // namespace

Shutter::Shutter(std::vector<Vec2f> points)
    : points_(std::move(points)), area_(points_.size(), 0.0F) {
    for (std::size_t i = 1; i < points_.size(); ++i)
        area_[i] = area_[i - 1] +
                   (points_[i].x - points_[i - 1].x) * (points_[i].y + points_[i - 1].y) * 0.5F;
    const float total = area_.back();
    for (float& a : area_)
        a /= total;
    for (Vec2f& p : points_)
        p.y /= total;
}

float Shutter::sample(float u) const {
    if (points_.empty()) return u;
    // Find the segment, then invert the quadratic below it: h0 x + (h1 - h0) x^2 / (2 w) = rest.
    const auto above = std::upper_bound(area_.begin() + 1, area_.end() - 1, u);
    const std::size_t i = static_cast<std::size_t>(above - area_.begin());
    const Vec2f a = points_[i - 1], b = points_[i];
    const float rest = std::max(0.0F, u - area_[i - 1]), width = b.x - a.x;
    // The stable form of the root, which also serves h1 = h0.
    const float slope = width > 0 ? (b.y - a.y) / width : 0;
    const float denominator = a.y + safe_sqrt(a.y * a.y + 2 * slope * rest);
    const float x = denominator > 0 ? 2 * rest / denominator : 0;
    constexpr float kBelowOne = 0x1.fffffep-1F;
    return std::min(a.x + std::min(x, width), kBelowOne);
}

PlacedCamera::PlacedCamera(const CameraCommon& p, NodeContext& context)
    : motion_{p.motion_start, p.motion_end},
      clock_{p.shutter_start, p.shutter_end},
      world_from_camera_(placement(p, context), motion_, clock_),
      camera_from_world_(world_from_camera_.at(0).inverse()),
      window_min_(keyed(p.screen_window_min, camera_defaults::kWindowMin)),
      window_max_(keyed(p.screen_window_max, camera_defaults::kWindowMax)),
      shutter_(make_shutter(p, context)),
      rolling_(p.rolling_shutter),
      rolling_duration_(std::clamp(p.rolling_shutter_duration, 0.0F, 1.0F)),
      mirror_(p.handedness == Handedness::Left ? -1.0F : 1.0F),
      near_clip_(std::max(0.0F, p.near_clip)),
      far_clip_(p.far_clip),
      weight_(std::exp2(p.exposure)) {
    const NodeContext::Frame frame = context.frame();
    frame_width_ = std::max(1, frame.width);
    const float aspect = frame.pixel_aspect_ratio > 0 ? frame.pixel_aspect_ratio : 1;
    frame_ratio_ =
        static_cast<float>(std::max(1, frame.height)) / static_cast<float>(frame_width_) / aspect;
    if (context.is_linked("uv_remap")) uv_remap_ = context.color_input("uv_remap");
    if (p.filtermap) filtermap_ = context.color_input("filtermap");
    if (!(rolling_duration_ >= 0)) rolling_duration_ = 0;
}

float PlacedCamera::sample_time(Vec2f film, float u) const {
    const float time = shutter_.sample(u);
    if (rolling_ == RollingShutter::Off) return time;
    const float down = std::clamp(film.y, 0.0F, kOneMinusEpsilon),
                right = std::clamp(film.x, 0.0F, kOneMinusEpsilon);
    float line = 0;  // how much of the frame was exposed before
    switch (rolling_) {
        case RollingShutter::Off: break;
        case RollingShutter::Top: line = down; break;
        case RollingShutter::Bottom: line = 1 - down; break;
        case RollingShutter::Left: line = right; break;
        case RollingShutter::Right: line = 1 - right; break;
    }
    return std::clamp(std::lerp(line, time, rolling_duration_), 0.0F, kOneMinusEpsilon);
}

CameraRay PlacedCamera::ray(Vec2f film, Vec2f lens, float time) const {
    CameraRay out;
    out.weight =
        filtermap_ ? weight_ * std::max(0.0F, average(film_color(*filtermap_, film))) : weight_;
    Vec2f seen = film;
    if (uv_remap_) {
        const Color uv = film_color(*uv_remap_, film);
        seen = {uv.r, 1 - uv.g};
    }
    const Mat4f world_from_camera = world_from_camera_.at(time);
    LocalRay local;
    if (out.weight > 0) local = local_ray(seen, lens, time);
    if (!(length_squared(local.direction) > 0)) {
        out.weight = 0;
        local.direction = {0, 0, -1};
    }
    const Vec3f d = world_from_camera.vector(local.direction);
    const float distance_per_depth = length(d);
    out.origin = world_from_camera.point(local.origin);
    out.direction = normalize(d);
    out.t_min = near_clip_ * distance_per_depth;
    out.t_max = far_clip_ * distance_per_depth;
    out.spread = local.spread;
    out.width = local.width;
    return out;
}

Vec2f PlacedCamera::window_point(Vec2f film, float time) const {
    const Vec2f low = window_min_.at(time), high = window_max_.at(time);
    return {mirror_ * std::lerp(low.x, high.x, film.x), std::lerp(high.y, low.y, film.y)};
}

Vec2f PlacedCamera::screen_point(Vec2f film, float time) const {
    const Vec2f p = window_point(film, time);
    return {p.x, p.y * frame_ratio_};
}

float PlacedCamera::pixel_width() const {
    return std::abs(window_max_.at(0).x - window_min_.at(0).x) / static_cast<float>(frame_width_);
}

}  // namespace lightsieve
