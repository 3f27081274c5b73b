#include "scene/simple_shape.h"

#include <gtest/gtest.h>

namespace lightsieve {
namespace {

SimpleShape mantle(float radius, float second_radius) {
    SimpleShape out;
    out.base = {1, 2, 3};
    out.height = 2;
    out.radius = radius;
    out.second_radius = second_radius;
    return out;
}

SimpleShape disk(float radius, float hole) {
    SimpleShape out;
    out.kind = SimpleShape::Kind::Disk;
    out.base = {0, 1, 0};
    out.axis = {0, 0, 1};
    out.radius = radius;
    out.second_radius = hole;
    return out;
}

std::optional<float> hit(const SimpleShape& shape, Vec3f origin, Vec3f direction,
                         float t_min = 0) {
    return hit_simple_shape(shape, origin, direction, t_min, kInfinity);
}

void expect_near(Vec3f a, Vec3f b, float tolerance) {
    EXPECT_LT(length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(SimpleShapes, CylindersAreHitOutsideAndInside) {
    const SimpleShape side = mantle(0.5F, 0.5F);
    EXPECT_NEAR(hit(side, {-3, 3, 3}, {1, 0, 0}).value_or(-1), 3.5F, 1e-6F);
    // Past the near side: the far one. Off the axis: the chord.
    EXPECT_NEAR(hit(side, {-3, 3, 3}, {1, 0, 0}, 3.6F).value_or(-1), 4.5F, 1e-6F);
    EXPECT_NEAR(hit(side, {1, 3, 3.3F}, {2, 0, 0}).value_or(-1), 0.2F, 1e-6F);
    // Above the top, along the axis, beside it: nothing. The ends are open.
    EXPECT_FALSE(hit(side, {-3, 4.01F, 3}, {1, 0, 0}));
    EXPECT_FALSE(hit(side, {1.2F, 9, 3}, {0, -1, 0}));
    EXPECT_FALSE(hit(side, {-3, 3, 3.51F}, {1, 0, 0}));
    EXPECT_FALSE(hit(side, {-3, 3, 3}, {-1, 0, 0}));
    EXPECT_FALSE(hit_simple_shape(side, {-3, 3, 3}, {1, 0, 0}, 0, 3.4F));
}

TEST(SimpleShapes, ConesHaveOneNappe) {
    // Radius 1 at y = 2, 0 at y = 4: at height 3 the radius is 0.5.
    const SimpleShape cone = mantle(1, 0);
    EXPECT_NEAR(hit(cone, {-3, 3, 3}, {1, 0, 0}).value_or(-1), 3.5F, 1e-6F);
    EXPECT_FALSE(hit(cone, {-3, 5, 3}, {1, 0, 0}));
    // Straight down at 0.25 from the axis: where the radius is 0.25. A generator's direction: met once.
    EXPECT_NEAR(hit(cone, {1.25F, 9, 3}, {0, -1, 0}).value_or(-1), 5.5F, 1e-5F);
    EXPECT_NEAR(hit(cone, {0, 3, 3}, {0.5F, -1, 0}).value_or(-1), 0.5F, 1e-5F);
}

TEST(SimpleShapes, FlatShapes) {
    EXPECT_NEAR(hit(disk(1, 0.5F), {0.7F, 1, 4}, {0, 0, -1}).value_or(-1), 4, 1e-6F);
    EXPECT_FALSE(hit(disk(1, 0.5F), {0.3F, 1, 4}, {0, 0, -1}));
    EXPECT_FALSE(hit(disk(1, 0.5F), {1.01F, 1, 4}, {0, 0, -1}));
    EXPECT_FALSE(hit(disk(1, 0.5F), {0.7F, 1, 4}, {1, 0, 0}));
    SimpleShape plane;
    plane.kind = SimpleShape::Kind::Plane;
    EXPECT_NEAR(hit(plane, {0, 1, 0}, {1, -1e-6F, 0}).value_or(-1), 1e6F, 1);
    EXPECT_TRUE(bounds_of(plane).empty());
}

/// Points of a shape near those that a grid of directions meets.
template <class Check>
void on_grid(const SimpleShape& shape, const Check& check) {
    const Vec3f middle = shape.base + shape.axis * (0.5F * shape.height);
    for (int i = 0; i < 24; ++i)
        for (int k = 1; k < 8; ++k) {
            const float angle = static_cast<float>(i) * kPi / 12 + 0.01F;
            const float along = (static_cast<float>(k) / 8 - 0.5F) * shape.height;
            const Vec3f p = middle + Vec3f{std::cos(angle), along, std::sin(angle)};
            check(simple_point(shape, p));
        }
}

TEST(SimpleShapes, DerivativesSpanTheArea) {
    // The parallelogram of the derivatives over the unit square of uv is the surface's area: 2 pi r h of a cylinder; of a
    // cone 2 pi r times the slanted height, where r is the radius at the point, whose mean is that of the ends.
    for (const float top : {0.5F, 1.5F}) {
        const SimpleShape shape = mantle(0.5F, top);
        const float slant = std::hypot(shape.height, top - 0.5F);
        on_grid(shape, [&](const SimplePoint& at) {
            const float r = lerp(0.5F, top, at.uv.y);
            const Vec3f area = cross(at.dp_du, at.dp_dv);
            EXPECT_NEAR(length(area), 2 * kPi * r * slant, 1e-4F);
            expect_near(normalize(area), at.normal, 1e-5F);
            const Vec3f out = at.position - shape.base;
            EXPECT_NEAR(std::hypot(out.x, out.z), r, 1e-6F);
            EXPECT_GT(dot(at.normal, {out.x, 0, out.z}), 0);
        });
    }
}

TEST(SimpleShapes, DerivativesAreThoseOfThePoint) {
    for (const SimpleShape& shape : {mantle(0.5F, 0.5F), mantle(1, 0.2F), disk(2, 0.3F)}) {
        constexpr float kStep = 1e-3F;
        on_grid(shape, [&](const SimplePoint& at) {
            if (at.uv.y < 0.01F || at.uv.y > 0.99F) return;  // beyond the edges v stays what it is
            const auto moved = [&](Vec3f by) {
                return simple_point(shape, at.position + by * kStep);
            };
            const SimplePoint u = moved(at.dp_du), v = moved(at.dp_dv);
            if (std::abs(u.uv.x - at.uv.x) < 0.5F) {
                EXPECT_NEAR((u.uv.x - at.uv.x) / kStep, 1, 2e-2F);
            }
            EXPECT_NEAR(u.uv.y, at.uv.y, 1e-3F);
            EXPECT_NEAR((v.uv.y - at.uv.y) / kStep, 1, 2e-2F);
        });
    }
}

TEST(SimpleShapes, BoundsAreTight) {
    SimpleShape tilted = mantle(1, 0);
    tilted.axis = normalize(Vec3f{1, 1, 0});
    const Box3f box = bounds_of(tilted);
    const float half = std::sqrt(0.5F);
    expect_near(box.lower, Vec3f{1 - half, 2 - half, 2}, 1e-6F);
    expect_near(box.upper, Vec3f{1 + 2 * half, 2 + 2 * half, 4}, 1e-6F);
}

TEST(SimpleShapes, QuadsFaceTheRay) {
    const FacingQuad upright{{0, 0, 0}, 0.2F, 0.1F, 0, {0, 1, 0}};
    const auto meets = [](const FacingQuad& quad, Vec3f origin, Vec3f direction) {
        return hit_facing_quad(quad, origin, direction, 0, kInfinity);
    };
    // Seen from +z and from +x: as wide either way.
    EXPECT_NEAR(meets(upright, {0.19F, 0.09F, 5}, {0, 0, -1}).value_or(-1), 5, 1e-6F);
    EXPECT_NEAR(meets(upright, {5, 0.09F, 0.19F}, {-1, 0, 0}).value_or(-1), 5, 1e-6F);
    EXPECT_FALSE(meets(upright, {0.19F, 0.11F, 5}, {0, 0, -1}));
    EXPECT_FALSE(meets(upright, {0.21F, 0.09F, 5}, {0, 0, -1}));
    // A quarter turn stands it up; an eighth turns counter-clockwise.
    FacingQuad turned = upright;
    turned.rotation_rad = kPi / 2;
    EXPECT_TRUE(meets(turned, {0.09F, 0.19F, 5}, {0, 0, -1}));
    EXPECT_FALSE(meets(turned, {0.19F, 0.09F, 5}, {0, 0, -1}));
    turned.rotation_rad = kPi / 4;
    EXPECT_TRUE(meets(turned, {0.13F, 0.13F, 5}, {0, 0, -1}));
    EXPECT_FALSE(meets(turned, {0.13F, -0.13F, 5}, {0, 0, -1}));
    // Rays that leave the quad do not meet it, whichever way it is turned then.
    EXPECT_FALSE(meets(upright, {-0.15F, 0, 0}, normalize(Vec3f{1, 0, 1})));
}

}  // namespace
}  // namespace lightsieve
