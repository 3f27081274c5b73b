// box, cylinder, cone, disk, plane: what they make of their parameters, and of wrong ones.
#include <gtest/gtest.h>

#include <limits>

#include "nodes/common/node_test_support.h"
#include "scene/shape.h"

namespace lightsieve {

NodeType node_box();
NodeType node_cone();
NodeType node_cylinder();
NodeType node_disk();
NodeType node_plane();

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::unique_ptr<ShapeGeometry> geometry(const TestNode& node, std::size_t n_warnings = 0) {
    TestContext context;
    auto out = node.type().make_geometry(node.block(), context);
    EXPECT_FALSE(context.diagnostics().has_errors()) << context.diagnostics().render();
    EXPECT_EQ(context.count(Code::ShapeBad), n_warnings) << context.diagnostics().render();
    EXPECT_EQ(out == nullptr, n_warnings > 0);
    return out;
}

SimpleShape built(const TestNode& node) { return std::get<SimpleShape>(geometry(node)->data); }

/// The node is left out with one warning.
void expect_left_out(const TestNode& node) { EXPECT_EQ(geometry(node, 1), nullptr); }

TEST(SimpleShapeNodes, MantlesRunFromBottomToTop) {
    TestNode cone(node_cone());
    cone.set("bottom", Vec3f{1, 1, 1}).set("top", Vec3f{1, 1, 4});
    cone.set("bottom_radius", 2.0F).set("top_radius", 1.0F);
    const SimpleShape shape = built(cone);
    EXPECT_EQ(shape.base, (Vec3f{1, 1, 1}));
    EXPECT_EQ(shape.axis, (Vec3f{0, 0, 1}));
    EXPECT_EQ(shape.height, 3);
    EXPECT_EQ(shape.radius, 2);
    EXPECT_EQ(shape.second_radius, 1);
    const SimpleShape cylinder = built(TestNode(node_cylinder()));
    EXPECT_EQ(cylinder.radius, cylinder.second_radius);
}

TEST(SimpleShapeNodes, WrongNumbersLeaveTheShapeOut) {
    for (const float bad : {kNan, kInfinity, -1.0F, 1e30F}) {
        expect_left_out(TestNode(node_cylinder()).set("radius", bad));
        expect_left_out(TestNode(node_cone()).set("top_radius", bad));
        expect_left_out(TestNode(node_disk()).set("radius", bad));
        expect_left_out(TestNode(node_disk()).set("hole", bad));
    }
    expect_left_out(TestNode(node_cylinder()).set("radius", 0.0F));
    expect_left_out(TestNode(node_cylinder()).set("top", Vec3f{0, 0, 0}));
    expect_left_out(TestNode(node_cone()).set("bottom_radius", 0.0F));
    expect_left_out(TestNode(node_disk()).set("normal", Vec3f{0, 0, 0}));
    expect_left_out(TestNode(node_disk()).set("hole", 0.5F));
    expect_left_out(TestNode(node_plane()).set("normal", Vec3f{0, 0, 0}));
    expect_left_out(TestNode(node_plane()).set("point", Vec3f{0, kNan, 0}));
    expect_left_out(TestNode(node_box()).set("max", Vec3f{0, kNan, 0}));
    expect_left_out(TestNode(node_box()).set("max", Vec3f{-0.5F, -0.5F, 1}));
}

TEST(SimpleShapeNodes, BoxesStandUpright) {
    // Corners in any order. On the sides that stand, v runs upward.
    TestNode box(node_box());
    box.set("min", Vec3f{1, 5, 3}).set("max", Vec3f{0, 2, 2});
    const auto made = geometry(box);
    const TriangleMesh& mesh = std::get<TriangleMesh>(made->data);
    ASSERT_EQ(mesh.indices.size(), 36U);
    ASSERT_EQ(mesh.uv_indices.size(), 36U);
    const Vec3f middle{0.5F, 3.5F, 2.5F};
    for (std::size_t t = 0; t < 36; t += 3) {
        const auto p = [&](std::size_t i) { return mesh.positions[0][mesh.indices[t + i]]; };
        const Vec3f n = cross(p(1) - p(0), p(2) - p(0));
        EXPECT_GT(dot(n, p(0) - middle), 0);
        if (n.y != 0) continue;
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(mesh.uvs[mesh.uv_indices[t + i]].y, (p(i).y - 2) / 3);
    }
    EXPECT_TRUE(made->volume_box.empty());
    box.set("step_size", 0.1F).set("volume_padding", 1.0F);
    EXPECT_EQ(geometry(box)->volume_box.lower, (Vec3f{-1, 1, 1}));
}

}  // namespace
}  // namespace lightsieve
