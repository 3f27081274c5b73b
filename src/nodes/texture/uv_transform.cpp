// uv_transform: a texture seen through moved, turned and repeated coordinates.
//
// The semantics are those of Maya's place2dTexture, in this order (found on reference picture test_0114: every other order of
// the last five steps is off on one of its five planes): the frame is turned about its pivot, moved, scaled and wrapped
// within its coverage; then coordinates are repeated, offset, staggered, mirrored and turned. The input is evaluated
// anew at the coordinates found, with the footprint that belongs to them.
#include <array>
#include <utility>

#include "nodes/texture/perlin.h"
#include "nodes/texture/uv_set.h"

namespace lightsieve {
namespace {

enum class RotationUnit : std::int32_t { Degrees, Radians, Normalized };
enum class FrameWrap : std::int32_t { Periodic, Clamp, Mirror, Color, None };
std::vector<std::string> wrap_names() { return {"periodic", "clamp", "mirror", "color", "none"}; }

/// Coordinates with their derivatives by the original ones.
struct Place {
    Vec2f p, by_u{1, 0}, by_v{0, 1};

    void scale(Vec2f s) { p = p * s, by_u = by_u * s, by_v = by_v * s; }
    void turn(float angle, Vec2f pivot) {
        const float c = std::cos(angle), s = std::sin(angle);
        const auto turned = [&](Vec2f v) { return Vec2f{c * v.x - s * v.y, s * v.x + c * v.y}; };
        p = turned(p - pivot) + pivot;
        by_u = turned(by_u);
        by_v = turned(by_v);
    }
    /// 1 in repetition 0, 2, ...; mirrors the others.
    void mirror(bool u, bool v) {
        const auto flip = [](float& x, float& dx, float& dy) {
            const float cell = std::floor(x);
            if (std::fmod(cell, 2.0F) == 0) return;
            x = 2 * cell + 1 - x;
            dx = -dx;
            dy = -dy;
        };
        if (u) flip(p.x, by_u.x, by_v.x);
        if (v) flip(p.y, by_u.y, by_v.y);
    }
    void swap() {
        std::swap(p.x, p.y);
        std::swap(by_u.x, by_u.y);
        std::swap(by_v.x, by_v.y);
    }
};

struct UvTransform {
    Lazy<Rgba> passthrough{{{1, 1, 1}, 1}, {}};
    RotationUnit unit = RotationUnit::Degrees;
    Name uvset;
    Vec2f coverage{1, 1}, scale_frame{1, 1}, translate_frame;
    float rotate_frame = 0;
    Vec2f pivot_frame{0.5F, 0.5F};
    FrameWrap wrap_frame_u = FrameWrap::Periodic, wrap_frame_v = FrameWrap::Periodic;
    Rgba wrap_frame_color{{0, 0, 0}, 0};
    Vec2f repeat{1, 1}, offset;
    float rotate = 0;
    Vec2f pivot{0.5F, 0.5F}, noise;
    bool mirror_u = false, mirror_v = false, flip_u = false, flip_v = false, swap_uv = false,
         stagger = false;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] float radians(float angle) const;
    /// Moves coordinates into the frame; false where it has no texture.
    [[nodiscard]] bool into_frame(Place& place) const;
    void repeat_inside(Place& place) const;
};

void describe_frame(Describe<UvTransform>& d) {
    d.param("passthrough", &UvTransform::passthrough,
            "The texture that is seen through the new coordinates.");
    d.param("unit", &UvTransform::unit, "Of both rotations; normalized: 1 is a full turn.")
        .names({"degrees", "radians", "normalized"});
    d.param("uvset", &UvTransform::uvset, "Set of texture coordinates; empty: the first.");
    d.param("coverage", &UvTransform::coverage,
            "Part of the frame that the texture fills; the rest has wrap_frame_color.");
    d.param("scale_frame", &UvTransform::scale_frame, "Size of the frame.");
    d.param("translate_frame", &UvTransform::translate_frame, "Where the frame is moved.");
    d.param("rotate_frame", &UvTransform::rotate_frame, "By how much the frame is turned.");
    d.param("pivot_frame", &UvTransform::pivot_frame,
            "What rotate_frame and scale_frame leave in its place.");
    d.param("wrap_frame_u", &UvTransform::wrap_frame_u, "What lies beside the frame in u.")
        .names(wrap_names());
    d.param("wrap_frame_v", &UvTransform::wrap_frame_v, "What lies beside the frame in v.")
        .names(wrap_names());
    d.param("wrap_frame_color", &UvTransform::wrap_frame_color,
            "Colour where the frame has no texture.");
}

NodeType UvTransform::describe() {
    Describe<UvTransform> d("uv_transform", NodeKind::Shader,
                            "A texture seen through moved, turned and repeated coordinates.");
    describe_frame(d);
    d.param("repeat", &UvTransform::repeat, "Copies of the texture within the frame.");
    d.param("offset", &UvTransform::offset, "Where the copies are moved.");
    d.param("rotate", &UvTransform::rotate, "By how much they are turned.");
    d.param("pivot", &UvTransform::pivot, "What rotate leaves in its place.");
    d.param("noise", &UvTransform::noise, "How far noise moves coordinates.");
    d.param("mirror_u", &UvTransform::mirror_u, "Every other copy is mirrored left to right.");
    d.param("mirror_v", &UvTransform::mirror_v, "Every other copy is turned upside down.");
    d.param("flip_u", &UvTransform::flip_u, "All are mirrored left to right.");
    d.param("flip_v", &UvTransform::flip_v, "All are turned upside down.");
    d.param("swap_uv", &UvTransform::swap_uv, "Exchanges u and v.");
    d.param("stagger", &UvTransform::stagger, "Every other row is moved by half a copy.");
    return d.done();
}

float UvTransform::radians(float angle) const {
    switch (unit) {
        case RotationUnit::Degrees: return deg_to_rad(angle);
        case RotationUnit::Radians: return angle;
        case RotationUnit::Normalized: break;
    }
    return 2 * kPi * angle;
}

/// One coordinate of the frame, wrapped; false if it lies outside of the texture.
bool wrapped(float& x, float coverage, FrameWrap wrap) {
    switch (wrap) {
        case FrameWrap::Periodic:
            // A texture that fills the frame goes on beyond it; a smaller one leaves a gap in every copy.
            if (coverage < 1)
                x -= std::floor(x);
            else
                return true;
            return x <= coverage;
        case FrameWrap::Clamp: x = std::clamp(x, 0.0F, coverage); return true;
        case FrameWrap::Mirror: x = std::abs(x - 2 * std::round(x * 0.5F)); return x <= coverage;
        case FrameWrap::Color: return x >= 0 && x <= coverage;
        case FrameWrap::None: return true;
    }
    return true;
}

bool UvTransform::into_frame(Place& place) const {
    place.turn(radians(rotate_frame), pivot_frame);
    place.p = place.p - translate_frame;
    const Vec2f size{scale_frame.x != 0 ? scale_frame.x : 1,
                     scale_frame.y != 0 ? scale_frame.y : 1};
    place.p = place.p - pivot_frame;
    place.scale({1 / size.x, 1 / size.y});
    place.p = place.p + pivot_frame;
    const Vec2f cover{positive(coverage.x), positive(coverage.y)};
    if (!(cover.x > 0) || !(cover.y > 0)) return false;
    const bool inside_u = wrapped(place.p.x, cover.x, wrap_frame_u),
               inside_v = wrapped(place.p.y, cover.y, wrap_frame_v);
    place.scale({1 / cover.x, 1 / cover.y});
    return inside_u && inside_v;
}

void UvTransform::repeat_inside(Place& place) const {
    if (noise.x != 0 || noise.y != 0) {
        constexpr float kFrequency = 8;  // bumps a frame
        const Vec3f p{place.p.x * kFrequency, place.p.y * kFrequency, 0};
        place.p = place.p + noise * Vec2f{perlin_noise(p), perlin_noise(p + Vec3f{0, 0, 31.4F})};
    }
    place.scale(repeat);
    place.p = place.p + offset;
    if (stagger && std::fmod(std::floor(place.p.y), 2.0F) != 0) place.p.x += 0.5F;
    place.mirror(mirror_u, mirror_v);
    place.turn(radians(rotate), pivot);
    if (flip_u)
        place.p.x = 1 - place.p.x, place.by_u.x = -place.by_u.x, place.by_v.x = -place.by_v.x;
    if (flip_v)
        place.p.y = 1 - place.p.y, place.by_u.y = -place.by_u.y, place.by_v.y = -place.by_v.y;
    if (swap_uv) place.swap();
}

Rgba UvTransform::eval(const ShadePoint& at) const {
    ShadePoint point = with_uv_set(at, uvset);
    Place place;
    place.p = point.uv;
    if (!std::isfinite(place.p.x) || !std::isfinite(place.p.y)) return wrap_frame_color;
    if (!into_frame(place)) return wrap_frame_color;
    repeat_inside(place);
    // The footprint and the derivatives of the position by the new coordinates.
    const float det = place.by_u.x * place.by_v.y - place.by_u.y * place.by_v.x;
    point.uv = place.p;
    point.uv_width *= std::sqrt(std::abs(det));
    if (det != 0) {
        const Vec3f du = point.dp_du, dv = point.dp_dv;
        point.dp_du = (du * place.by_v.y - dv * place.by_u.y) / det;
        point.dp_dv = (dv * place.by_u.x - du * place.by_v.x) / det;
    }
    return passthrough.at(point);
}

}  // namespace

NodeType node_uv_transform() { return UvTransform::describe(); }

}  // namespace lightsieve
