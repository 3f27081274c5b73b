// Directions toward a rectangle, uniform over the solid angle that it covers.
//
// So the estimate of an unshadowed rectangle with even radiance has no variance but that of the cosine and the
// surface. Very small solid angles are sampled by area instead, which is as good there and keeps its precision.
// Solid angles are differences of angles near pi: what they come from is done in double.
#pragma once

#include <cmath>

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
        z0_ = static_cast<double>(dot(d, rectangle.normal()));
        visible_ = z0_ < 0;
        if (!visible_) return;
        x0_ = static_cast<double>(dot(d, rectangle.axis_x()));
        y0_ = static_cast<double>(dot(d, rectangle.axis_y()));
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
        // Rounding of a vanishing angle must not make it a whole turn.
        solid_angle_ = angle < -kMinSolidAngle ? angle + 2 * kPi : std::max(angle, 0.0F);
    }

    /// Whether the viewer is on the lit side.
    [[nodiscard]] bool visible() const { return visible_; }
    [[nodiscard]] float solid_angle() const { return solid_angle_; }

    struct Sample {
        Vec3f position;  ///< on the rectangle
        Vec2f uv;        ///< along its edges
    };
    [[nodiscard]] Sample sample(Vec2f u) const { return by_area() ? at(u) : at(spherical(u)); }
    /// Density of the direction to a point of the rectangle, per solid angle.
    [[nodiscard]] float pdf(Vec3f position) const {
        if (!by_area()) return 1 / solid_angle_;
        const float r2 = length_squared(position - from_);
        const float pdf = r2 * std::sqrt(r2) / (static_cast<float>(-z0_) * rectangle_.area());
        return std::isfinite(pdf) ? pdf : 0;
    }

  private:
    /// Below this solid angle area and solid angle agree, and the products of turns lose their digits [sr].
    static constexpr float kMinSolidAngle = 1e-6F;

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

    [[nodiscard]] bool by_area() const { return !(solid_angle_ >= kMinSolidAngle); }

    [[nodiscard]] Sample at(Vec2f uv) const {
        return {rectangle_.corner() + rectangle_.axis_x() * (uv.x * rectangle_.width()) +
                    rectangle_.axis_y() * (uv.y * rectangle_.height()),
                uv};
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
    bool visible_ = false;
};

}  // namespace lightsieve
