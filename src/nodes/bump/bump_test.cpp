// Nodes that give normals.
#include <gtest/gtest.h>

#include <functional>

#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {
namespace {

TestNode node_of(const char* type) { return TestNode(*builtin_registry().find(type)); }

/// Links a height to a bump node.
struct Height {
    std::function<float(const ShadePoint&)> of;
    void link(TestNode& node) const {
        LazyLink link;
        link.links = this;
        link.apply = [](const void* self, void* value, const ShadePoint& at) {
            const float v = static_cast<const Height*>(self)->of(at);
            std::memcpy(value, &v, sizeof(v));
        };
        std::memcpy(
            static_cast<std::byte*>(node.block()) + node.type().find("bump_map")->lazy_offset,
            &link, sizeof(link));
    }
};

Vec3f normal_of(const TestNode& node, const ShadePoint& at) {
    const Color c = node.type().eval_value(node.block(), at).rgb;
    return {c.r, c.g, c.b};
}

/// On the plane z = 0; uv as wide as `u` and `v` say.
ShadePoint on_plane(float u = 1, float v = 1) {
    ShadePoint at;
    at.dp_du = {u, 0, 0};
    at.dp_dv = {0, v, 0};
    at.wo = {0, 0, 1};
    return at;
}

TEST(Bump2d, LeansAgainstTheSlope) {
    TestNode node = node_of("bump2d");
    EXPECT_EQ(normal_of(node, on_plane()), (Vec3f{0, 0, 1})) << "nothing linked";
    const Height ramp{[](const ShadePoint& at) { return at.uv.x; }};
    ramp.link(node);
    // Height u over a surface that is 2 wide a unit of u: a slope of 1/2.
    const Vec3f n = normal_of(node, on_plane(2));
    EXPECT_NEAR(n.x / n.z, -0.5, 1e-3);
    EXPECT_NEAR(n.y, 0, 1e-4);
    node.set("bump_height", -1.0F);
    EXPECT_NEAR(normal_of(node, on_plane(2)).x / n.x, -1, 1e-3);
}

TEST(Bump2d, DoesNotDependOnTheViewersSide) {
    TestNode node = node_of("bump2d");
    const Height ramp{[](const ShadePoint& at) { return at.uv.y; }};
    ramp.link(node);
    ShadePoint front = on_plane(), back = on_plane();
    back.wo = {0, 0, -1};
    back.entering = false;
    back.normal = {0, 0, -1};
    EXPECT_NEAR(length(normal_of(node, front) - normal_of(node, back)), 0, 1e-5);
}

TEST(Bump3d, LeansAgainstTheSlopeInSpace) {
    TestNode node = node_of("bump3d");
    node.set("bump_height", 0.5F);
    const Height ramp{[](const ShadePoint& at) { return at.position.x + 3 * at.position.z; }};
    ramp.link(node);
    const Vec3f n = normal_of(node, on_plane());
    EXPECT_NEAR(n.x / n.z, -0.5, 1e-3) << "the slope along the normal does not count";
    EXPECT_NEAR(n.y, 0, 1e-4);
}

TEST(NormalMap, HasItsAxesInTangentSpace) {
    TestNode node = node_of("normal_map");
    ShadePoint at = on_plane();
    EXPECT_NEAR(length(normal_of(node.set("input", Vec3f{0.5F, 0.5F, 1}), at) - Vec3f{0, 0, 1}), 0,
                1e-6);
    node.set("input", Vec3f{1, 0.5F, 0.5F});
    EXPECT_NEAR(length(normal_of(node, at) - Vec3f{1, 0, 0}), 0, 1e-6);
    at.dp_du = {0, 3, 0};
    at.dp_dv = {2, 0, 0};  // mirrored uv
    EXPECT_NEAR(length(normal_of(node, at) - Vec3f{0, 1, 0}), 0, 1e-6);
    node.set("input", Vec3f{0.5F, 1, 0.5F});
    EXPECT_NEAR(length(normal_of(node, at) - Vec3f{1, 0, 0}), 0, 1e-6) << "y goes with dP/dv";
    node.set("invert_y", true);
    EXPECT_NEAR(length(normal_of(node, at) - Vec3f{-1, 0, 0}), 0, 1e-6);
    node.set("invert_y", false).set_enum("order", 1);
    EXPECT_NEAR(length(normal_of(node, at) - Vec3f{0, 0, 1}), 0, 1e-6) << "XZY";
}

TEST(NormalMap, StrengthAndSpaces) {
    TestNode node = node_of("normal_map");
    node.set("input", Vec3f{0.3F, 0, 1}).set("color_to_signed", false).set("strength", 2.0F);
    const Vec3f n = normal_of(node, on_plane());
    EXPECT_NEAR(n.x / n.z, 0.6, 1e-5);
    node.set("strength", 1.0F).set("tangent_space", false).set("input", Vec3f{0, 1, 0});
    EXPECT_NEAR(length(normal_of(node, on_plane()) - Vec3f{0, 1, 0}), 0, 1e-6);
}

TEST(VectorMap, ScalesVectors) {
    TestNode node = node_of("vector_map");
    node.set("input", Vec3f{1, 2, 3}).set("scale", 2.0F).set_enum("order", 0);
    EXPECT_NEAR(length(normal_of(node, on_plane()) - Vec3f{2, 4, 6}), 0, 1e-5);
}

}  // namespace
}  // namespace lightsieve
