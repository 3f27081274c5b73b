#include "render/turning.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightsieve {
namespace {

/// Between neighbouring keys a point leaves its circle by at most 1 - cos(2.5 degrees), a thousandth of its radius.
constexpr float kMostTurn = deg_to_rad(5);
/// Embree takes 129.
constexpr std::size_t kMostKeys = 128;

struct Quaternion {
    float w = 1, x = 0, y = 0, z = 0;
};
float dot(Quaternion a, Quaternion b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }

Mat4f linear_part(const Mat4f& m) {
    Mat4f out = m;
    for (std::size_t i = 0; i < 3; ++i)
        out.m[3][i] = out.m[i][3] = 0;
    out.m[3][3] = 1;
    return out;
}

Mat4f scaled(Mat4f m, float s) {
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            m.m[r][c] *= s;
    return m;
}

/// The rotation nearest to a matrix. Source: Higham 1986, "Computing the Polar Decomposition", algorithm 1.
Mat4f nearest_rotation(const Mat4f& linear) {
    constexpr int kMostSteps = 40;
    Mat4f r = linear.determinant3() < 0 ? scaled(linear, -1) : linear;
    for (int step = 0; step < kMostSteps; ++step) {
        const Mat4f next = lerp(r, r.inverse().transposed(), 0.5F);
        float change = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                change = std::max(change, std::abs(next.m[i][k] - r.m[i][k]));
        r = next;
        constexpr float kSettled = 1e-6F;
        if (change < kSettled) break;
    }
    return r;
}

/// Of a rotation of row vectors. Source: Shepperd 1978, "Quaternion from Rotation Matrix".
Quaternion quaternion_of(const Mat4f& r) {
    const auto& m = r.m;
    const std::array<float, 4> squares{m[0][0] + m[1][1] + m[2][2], m[0][0], m[1][1], m[2][2]};
    const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
    Quaternion q;
    switch (largest) {
        case 0:
            q = {1 + squares[0], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]};
            break;
        case 1:
            q = {m[1][2] - m[2][1], 1 + m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0],
                 m[0][2] + m[2][0]};
            break;
        case 2:
            q = {m[2][0] - m[0][2], m[0][1] + m[1][0], 1 - m[0][0] + m[1][1] - m[2][2],
                 m[1][2] + m[2][1]};
            break;
        default:
            q = {m[0][1] - m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1],
                 1 - m[0][0] - m[1][1] + m[2][2]};
    }
    const float scale = 1 / std::sqrt(dot(q, q));
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

Mat4f rotation_of(Quaternion q) {
    Mat4f out;
    out.m[0] = {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z),
                2 * (q.x * q.z - q.w * q.y), 0};
    out.m[1] = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z),
                2 * (q.y * q.z + q.w * q.x), 0};
    out.m[2] = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
                1 - 2 * (q.x * q.x + q.y * q.y), 0};
    return out;
}

/// A key as stretch, then rotation, then the place of the center.
struct Parts {
    Mat4f stretch;
    Quaternion rotation;
    Vec3f place;

    Parts(const Mat4f& key, Vec3f center) : place(key.point(center)) {
        const Mat4f linear = linear_part(key), r = nearest_rotation(linear);
        rotation = quaternion_of(r);
        stretch = linear * r.transposed();
    }
};

float angle_between(const Parts& a, const Parts& b) {
    return 2 * std::acos(std::min(1.0F, std::abs(dot(a.rotation, b.rotation))));
}

Quaternion slerp(Quaternion a, Quaternion b, float t) {
    float cosine = dot(a, b);
    const float side = cosine < 0 ? -1.0F : 1.0F;
    cosine = std::min(1.0F, cosine * side);
    const float angle = std::acos(cosine), sine = std::sin(angle);
    constexpr float kStraight = 1e-4F;
    const float wa = sine < kStraight ? 1 - t : std::sin((1 - t) * angle) / sine;
    const float wb = (sine < kStraight ? t : std::sin(t * angle) / sine) * side;
    return {a.w * wa + b.w * wb, a.x * wa + b.x * wb, a.y * wa + b.y * wb, a.z * wa + b.z * wb};
}

Mat4f between(const Parts& a, const Parts& b, float t, Vec3f center) {
    Mat4f out = lerp(a.stretch, b.stretch, t) * rotation_of(slerp(a.rotation, b.rotation, t));
    const Vec3f shift = a.place * (1 - t) + b.place * t - out.point(center);
    out.m[3] = {shift.x, shift.y, shift.z, 1};
    return out;
}

}  // namespace

std::vector<Mat4f> turning_keys(std::span<const Mat4f> keys, TransformType type, Vec3f center) {
    std::vector<Mat4f> same(keys.begin(), keys.end());
    if (type == TransformType::Linear || keys.size() < 2) return same;
    if (type == TransformType::RotateAboutOrigin) center = {};
    std::vector<Parts> parts;
    for (const Mat4f& key : keys) {
        bool invertible = false;
        (void)key.inverse(&invertible);
        if (!invertible || !key.finite()) return same;
        parts.emplace_back(key, center);
    }
    // A mirror image is nowhere near: nothing turns into it.
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].determinant3() * keys[0].determinant3() < 0) return same;
    float most = 0;
    for (std::size_t i = 1; i < parts.size(); ++i)
        most = std::max(most, angle_between(parts[i - 1], parts[i]));
    const std::size_t room = std::max<std::size_t>(1, (kMostKeys - 1) / (keys.size() - 1));
    const std::size_t steps =
        std::min(room, static_cast<std::size_t>(std::ceil(most / kMostTurn)));
    if (steps <= 1) return same;
    std::vector<Mat4f> out{keys[0]};
    for (std::size_t i = 1; i < parts.size(); ++i) {
        for (std::size_t k = 1; k < steps; ++k)
            out.push_back(between(parts[i - 1], parts[i],
                                  static_cast<float>(k) / static_cast<float>(steps), center));
        out.push_back(keys[i]);
    }
    return out;
}

}  // namespace lightsieve
