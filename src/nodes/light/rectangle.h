// Directions toward a rectangle, uniform over the solid angle that it covers.
//
// So the estimate of an unshadowed rectangle with even radiance has no variance but that of the cosine and the
// surface. From near by that takes spherical geometry: solid angles are differences of angles near pi, so what they come
// from is done in double. From further away the density over the area is bilinear to a few per cent: points drawn from
// the bilinear function through the corners' densities are as good, keep their precision at any distance and cost a
// quarter.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/sampling.h"
#include "core/vec.h"

namespace lightsieve {

/// A rectangle in space, with its derived sizes.
class Rectangle {
  public:
    /// edge_x, edge_y  from `corner`, orthogonal; the normal is along their cross product
    Rectangle(Vec3f corner, Vec3f edge_x, Vec3f edge_y)
        : corner_(corner),
          width_(length(edge_x)),
          height_(length(edge_y)),
          axis_x_(edge_x / width_),
          axis_y_(edge_y / height_),
          normal_(normalize(cross(edge_x, edge_y))) {}
    [[nodiscard]] Vec3f corner() const { return corner_; }
    [[nodiscard]] float width() const { return width_; }
    [[nodiscard]] float height() const { return height_; }
    [[nodiscard]] Vec3f axis_x() const { return axis_x_; }
    [[nodiscard]] Vec3f axis_y() const { return axis_y_; }
    [[nodiscard]] Vec3f normal() const { return normal_; }
    [[nodiscard]] float area() const { return width_ * height_; }
    /// Where a point lies along the edges, [0,1]^2 on the rectangle.
    [[nodiscard]] Vec2f uv_of(Vec3f point) const {
        const Vec3f d = point - corner_;
        return {dot(d, axis_x_) / width_, dot(d, axis_y_) / height_};
    }
    /// The part between two places along the edges.
    [[nodiscard]] Rectangle part(Vec2f low, Vec2f high) const {
        Rectangle out = *this;
        out.corner_ += axis_x_ * (low.x * width_) + axis_y_ * (low.y * height_);
        out.width_ *= high.x - low.x;
        out.height_ *= high.y - low.y;
        return out;
    }

  private:
    Vec3f corner_;
    float width_, height_;
    Vec3f axis_x_, axis_y_, normal_;
};

/// A rectangle as seen from a point.
///
/// Source: Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles"; the names
/// are theirs, with the viewing point at the origin and the rectangle at z = z0 < 0. Their sums of arc cosines are taken
/// as products of complex numbers of modulus 1, whose arguments they are: one arc tangent instead of four arc cosines.
class RectangleView {
  public:
    RectangleView(const Rectangle& rectangle, Vec3f from) : rectangle_(rectangle), from_(from) {
        const Vec3f d = rectangle.corner() - from;
        // Seen from the lit side the normal points back to the viewer.
        const float height = dot(d, rectangle.normal());
        visible_ = height < 0;
        if (!visible_) return;
        z0_ = static_cast<double>(height);
        const float x = dot(d, rectangle.axis_x()), y = dot(d, rectangle.axis_y());
        far_ = look_from_afar(x, y, height);
        if (!far_) look_from_near(static_cast<double>(x), static_cast<double>(y));
    }

    /// Whether the viewer is on the lit side.
    [[nodiscard]] bool visible() const { return visible_; }

    struct Sample {
        Vec3f position;  ///< on the rectangle
        Vec2f uv;        ///< along its edges
    };
    [[nodiscard]] Sample sample(Vec2f u) const { return at(far_ ? bilinear(u) : spherical(u)); }
    /// Density of the direction to a point of the rectangle, per solid angle.
    [[nodiscard]] float pdf(const Sample& at) const {
        if (!far_) return 1 / solid_angle_;
        const float r2 = length_squared(at.position - from_);
        const float pdf = bilinear_density(at.uv) * r2 * std::sqrt(r2) /
                          (static_cast<float>(-z0_) * rectangle_.area());
        return std::isfinite(pdf) ? pdf : 0;
    }

  private:
    /// Half the diagonal over the distance up to which a rectangle counts as far away.
    static constexpr float kFar = 0.5F;
    /// Below this solid angle the products of turns lose their digits [sr]; smaller ones are far away.
    static constexpr float kMinSolidAngle = 1e-6F;

    /// Densities over the area, 1 / r^3 for a plane at a fixed height, at the corners; true if that is good enough.
    bool look_from_afar(float x0, float y0, float z0) {
        const float w = rectangle_.width(), h = rectangle_.height();
        const float distance_squared = square(x0 + 0.5F * w) + square(y0 + 0.5F * h) + square(z0);
        if (!(0.25F * (w * w + h * h) < kFar * kFar * distance_squared)) return false;
        for (std::size_t i = 0; i < 4; ++i) {
            const float x = i % 2 == 0 ? x0 : x0 + w, y = i < 2 ? y0 : y0 + h;
            // Relative to the centre: numbers near 1 whatever the scale.
            const float q = distance_squared / (x * x + y * y + z0 * z0);
            corner_density_[i] = q * std::sqrt(q);
        }
        return true;
    }

    void look_from_near(double x0, double y0) {
        x0_ = x0;
        y0_ = y0;
        const Rectangle& rectangle = rectangle_;
        x1_ = x0_ + static_cast<double>(rectangle.width());
        y1_ = y0_ + static_cast<double>(rectangle.height());
        // z components of the normals of the four planes through the viewer and an edge.
        const double z0_squared = z0_ * z0_;
        b0_ = -y0_ / std::sqrt(z0_squared + y0_ * y0_);
        const double n1 = x1_ / std::sqrt(z0_squared + x1_ * x1_);
        b1_ = y1_ / std::sqrt(z0_squared + y1_ * y1_);
        const double n3 = -x0_ / std::sqrt(z0_squared + x0_ * x0_);
        // Angles between neighbouring planes; the excess of their sum over 2 pi is the solid angle.
        const Turn g2 = Turn::of_cosine(-b1_ * n3), g3 = Turn::of_cosine(-n3 * b0_);
        k_ = (g2 * g3).conjugate();
        const Turn excess = Turn::of_cosine(-b0_ * n1) * Turn::of_cosine(-n1 * b1_) * (g2 * g3);
        const float angle =
            std::atan2(static_cast<float>(excess.sine), static_cast<float>(excess.cosine));
        // Rounding of a vanishing angle must not make it a whole turn. Seen from near by, only the edge-on rectangle is that
        // thin: even sampling of its area will do.
        solid_angle_ = angle < -kMinSolidAngle ? angle + 2 * kPi : std::max(angle, 0.0F);
        far_ = !(solid_angle_ >= kMinSolidAngle);
        if (far_) corner_density_.fill(1);
    }

    /// An angle as a complex number of modulus 1.
    struct Turn {
        double cosine, sine;
        /// The angle in [0, pi] of that cosine.
        static Turn of_cosine(double c) {
            return {c, std::sqrt(std::max(0.0, (1 - c) * (1 + c)))};
        }
        [[nodiscard]] Turn conjugate() const { return {cosine, -sine}; }
        friend Turn operator*(Turn a, Turn b) {
            return {a.cosine * b.cosine - a.sine * b.sine, a.cosine * b.sine + a.sine * b.cosine};
        }
    };

    [[nodiscard]] Sample at(Vec2f uv) const {
        return {rectangle_.corner() + rectangle_.axis_x() * (uv.x * rectangle_.width()) +
                    rectangle_.axis_y() * (uv.y * rectangle_.height()),
                uv};
    }

    /// A number in [0,1] with a density that goes linearly from a to b; both > 0.
    static float linear(float u, float a, float b) {
        return std::min(u * (a + b) / (a + std::sqrt(lerp(a * a, b * b, u))), 1.0F);
    }
    /// Position along the edges with bilinear density. Source: Pharr, Jakob and Humphreys, "Physically Based Rendering",
    /// 4th ed., sections 2.4.1 and A.5.2 (inversion of linear and bilinear densities).
    [[nodiscard]] Vec2f bilinear(Vec2f u) const {
        const auto& w = corner_density_;
        const float y = linear(u.y, w[0] + w[1], w[2] + w[3]);
        return {linear(u.x, lerp(w[0], w[2], y), lerp(w[1], w[3], y)), y};
    }
    [[nodiscard]] float bilinear_density(Vec2f uv) const {
        const auto& w = corner_density_;
        return 4 * lerp(lerp(w[0], w[1], uv.x), lerp(w[2], w[3], uv.x), uv.y) /
               ((w[0] + w[1]) + (w[2] + w[3]));
    }

    /// Position along the edges for a uniform point on the spherical rectangle.
    [[nodiscard]] Vec2f spherical(Vec2f u) const {
        // The plane through the y axis that cuts off the part u of the solid angle. By its half, because a cosine near 1
        // keeps its digits only in the square of the half's sine.
        const float half = 0.5F * u.x * solid_angle_;
        const double s = std::sin(half), c = std::cos(half);
        const Turn au = Turn{1 - 2 * s * s, 2 * s * c} * k_;
        const double fu = (au.cosine * b0_ - b1_) / (au.sine == 0 ? kTiny : au.sine);
        const double xu = std::clamp(
            std::copysign(-z0_, fu) / std::sqrt(std::max(kTiny, fu * fu + b0_ * b0_ - 1)), x0_,
            x1_);
        // The point on that plane's arc, uniform in its height.
        const double d2 = xu * xu + z0_ * z0_;
        const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
        const double hv = h0 + static_cast<double>(u.y) * (h1 - h0);
        const double yv =
            hv * hv < 1 - 1e-12 ? std::clamp(hv * std::sqrt(d2 / (1 - hv * hv)), y0_, y1_) : y1_;
        return {static_cast<float>((xu - x0_) / (x1_ - x0_)),
                static_cast<float>((yv - y0_) / (y1_ - y0_))};
    }

    static constexpr double kTiny = 1e-300;

    const Rectangle& rectangle_;
    Vec3f from_;
    double x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0;  ///< the rectangle around the viewer
    double b0_ = 0, b1_ = 0;
    Turn k_{1, 0};
    float solid_angle_ = 0;
    std::array<float, 4> corner_density_;  ///< relative, seen from afar; lower edge first
    bool visible_ = false, far_ = false;
};

}  // namespace lightsieve
