// The footprint of a ray in texture coordinates.
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/texture/uv_set.h"

namespace lightsieve {
namespace {

/// A point on a plane, seen under an angle to its normal from the side of +x; uv along x and y.
struct Seen {
    Seen(float angle_deg, Vec3f dp_du, Vec3f dp_dv) {
        const float angle = deg_to_rad(angle_deg);
        at.wo = {std::sin(angle), 0, std::cos(angle)};
        at.width = 0.02F;
        uv = {{0.5F, 0.5F}, dp_du, dp_dv, 0.07F};
    }
    [[nodiscard]] TextureFootprint footprint() const { return texture_footprint(at, uv); }
    ShadePoint at;
    UvPoint uv;
};

/// Half the width of the footprint's ellipse along a direction.
float reach(const TextureFootprint& f, Vec2f direction) {
    const float a = f.across.x * direction.x + f.across.y * direction.y,
                b = f.along.x * direction.x + f.along.y * direction.y;
    return std::sqrt(a * a + b * b);
}

TEST(TextureFootprints, FaceOnTheyAreRoundInSpace) {
    const TextureFootprint f = Seen(0, {2, 0, 0}, {0, 0.5F, 0}).footprint();
    EXPECT_NEAR(reach(f, {1, 0}), 0.01F, 1e-6F) << "a unit of u is two units of space";
    EXPECT_NEAR(reach(f, {0, 1}), 0.04F, 1e-6F);
}

TEST(TextureFootprints, EdgeOnTheyAreLong) {
    const TextureFootprint f = Seen(60, {1, 0, 0}, {0, 1, 0}).footprint();
    EXPECT_NEAR(reach(f, {1, 0}), 0.04F, 1e-5F);
    EXPECT_NEAR(reach(f, {0, 1}), 0.02F, 1e-6F);
    // Coordinates turned by 45 degrees: the length lies between both.
    const float h = std::sqrt(0.5F);
    const TextureFootprint turned = Seen(60, {h, h, 0}, {-h, h, 0}).footprint();
    EXPECT_NEAR(reach(turned, {h, -h}), 0.04F, 1e-5F);
    EXPECT_NEAR(reach(turned, {h, h}), 0.02F, 1e-5F);
    // Not for ever.
    EXPECT_LE(reach(Seen(89.99F, {1, 0, 0}, {0, 1, 0}).footprint(), {1, 0}), 0.02F * 32.1F);
}

TEST(TextureFootprints, WithoutDirectionsTheyAreRound) {
    const TextureFootprint f = Seen(60, {}, {}).footprint();
    EXPECT_EQ(reach(f, {1, 0}), 0.07F);
    EXPECT_EQ(reach(f, {0, 1}), 0.07F);
    // Nor is there any where none is wanted.
    Seen sharp(60, {1, 0, 0}, {0, 1, 0});
    sharp.uv.width = 0;
    EXPECT_EQ(reach(sharp.footprint(), {1, 0}), 0);
}

}  // namespace
}  // namespace lightsieve
