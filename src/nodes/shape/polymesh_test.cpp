#include <gtest/gtest.h>

#include <limits>

#include "nodes/common/node_test_support.h"
#include "nodes/common/polygon.h"
#include "scene/shape.h"

namespace lightsieve {

NodeType node_polymesh();
NodeType node_sphere();
NodeType node_ginstance();

namespace {

using Indices = std::vector<std::uint32_t>;

/// Two squares side by side, the second one bent up at the common edge.
TestNode two_quads() {
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("nsides", {4, 4});
    node.set_array<std::uint32_t>("vidxs", {0, 1, 4, 3, 1, 2, 5, 4});
    node.set_array<Vec3f>("vlist",
                          {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}});
    return node;
}

std::unique_ptr<ShapeGeometry> build(const TestNode& node, TestContext& context) {
    return node.type().make_geometry(node.block(), context);
}

TriangleMesh built(const TestNode& node) {
    TestContext context;
    const auto geometry = build(node, context);
    EXPECT_FALSE(context.diagnostics().has_errors()) << context.diagnostics().render();
    return geometry == nullptr ? TriangleMesh{} : std::get<TriangleMesh>(geometry->data);
}

/// The mesh is refused with one error at `param`.
void expect_refused(const TestNode& node, const std::string& param) {
    TestContext context;
    EXPECT_EQ(build(node, context), nullptr);
    ASSERT_EQ(context.diagnostics().n_errors(), 1U) << context.diagnostics().render();
    EXPECT_EQ(context.diagnostics().items()[0].code, Code::BadMesh);
    EXPECT_EQ(context.diagnostics().items()[0].where.text(), param);
}

TEST(Polymesh, QuadsBecomeTriangles) {
    const TriangleMesh mesh = built(two_quads());
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}));
    EXPECT_EQ(mesh.corner, (Indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}));
    EXPECT_EQ(mesh.face, (Indices{0, 0, 1, 1}));
    ASSERT_EQ(mesh.positions.size(), 1U);
    EXPECT_EQ(mesh.positions[0][5], (Vec3f{1, 1, 1}));
    EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty() && mesh.shader_index.empty());
}

TEST(Polymesh, WithoutNsidesAllAreTriangles) {
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("vidxs", {0, 1, 2, 2, 1, 3});
    node.set_array<Vec3f>("vlist", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
    EXPECT_EQ(built(node).face, (Indices{0, 1}));
    node.set_array<std::uint32_t>("vidxs", {0, 1, 2, 2});
    expect_refused(node, "vidxs");
}

TEST(Polymesh, NormalsActWithSmoothing) {
    TestNode node = two_quads();
    node.set_array<Vec3f>("nlist", {{0, 0, 1}, {-1, 0, 0}});
    node.set_array<std::uint32_t>("nidxs", {0, 0, 0, 0, 1, 1, 1, 1});
    EXPECT_TRUE(built(node).normals.empty());
    node.set("smoothing", true);
    const TriangleMesh mesh = built(node);
    ASSERT_EQ(mesh.normals.size(), 1U);
    EXPECT_EQ(mesh.normal_indices, (Indices{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
}

TEST(Polymesh, SmoothingWithoutNormalsAveragesThem) {
    TestNode node = two_quads();
    node.set("smoothing", true);
    const TriangleMesh mesh = built(node);
    ASSERT_EQ(mesh.normals.size(), 1U);
    EXPECT_EQ(mesh.normal_indices, mesh.indices);
    // Vertex 0 belongs to the first square only. Vertex 1 has one triangle of the first and two of the second: (-1,0,0)
    // for each of the second's, (0,0,1) for the first's.
    EXPECT_NEAR(mesh.normals[0][0].z, 1, 1e-6);
    EXPECT_NEAR(mesh.normals[0][1].x, -2 / std::sqrt(5.0F), 1e-6);
    EXPECT_NEAR(mesh.normals[0][1].z, 1 / std::sqrt(5.0F), 1e-6);
}

TEST(Polymesh, UvsFollowTheCorners) {
    TestNode node = two_quads();
    node.set_array<Vec2f>("uvlist", {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    expect_refused(
        node,
        "vidxs");  // without uvidxs the vertices' indices are used, and there are more of those
    node.set_array<std::uint32_t>("uvidxs", {0, 1, 2, 3, 3, 2, 1, 0});
    EXPECT_EQ(built(node).uv_indices, (Indices{0, 1, 2, 0, 2, 3, 3, 2, 1, 3, 1, 0}));
}

TEST(Polymesh, KeysAreKept) {
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("vidxs", {0, 1, 2});
    node.set_array<Vec3f>("vlist",
                          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}}, 2);
    const TriangleMesh mesh = built(node);
    ASSERT_EQ(mesh.positions.size(), 2U);
    EXPECT_EQ(mesh.positions[1][2], (Vec3f{0, 1, 5}));
}

TEST(Polymesh, ShadersAreChosenByPolygon) {
    TestNode node = two_quads();
    node.set_array<NodeRef>("shader", {{}, {}});
    node.set_array<std::uint8_t>("shidxs", {1, 0});
    EXPECT_EQ(built(node).shader_index, (std::vector<std::uint8_t>{1, 1, 0, 0}));
    node.set_array<std::uint8_t>("shidxs", {1});
    expect_refused(node, "shidxs");
    node.set_array<std::uint8_t>("shidxs", {0, 7});
    TestContext context;
    EXPECT_NE(build(node, context), nullptr);
    EXPECT_EQ(context.diagnostics().n_warnings(), 1U);
}

TEST(Polymesh, HolesAreCutOutOfTheirPolygon) {
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("nsides", {4, 4});
    node.set_array<std::uint32_t>("vidxs", {0, 1, 2, 3, 4, 5, 6, 7});
    node.set_array<Vec3f>(
        "vlist",
        {{0, 0, 0}, {9, 0, 0}, {9, 0, 9}, {0, 0, 9}, {3, 0, 3}, {6, 0, 3}, {6, 0, 6}, {3, 0, 6}});
    node.set_array<std::uint32_t>("polygon_holes", {1, 0});
    const TriangleMesh mesh = built(node);
    ASSERT_EQ(mesh.face, Indices(8, 0));
    float area = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto& p = mesh.positions[0];
        area += 0.5F * length(cross(p[mesh.indices[t + 1]] - p[mesh.indices[t]],
                                    p[mesh.indices[t + 2]] - p[mesh.indices[t]]));
    }
    EXPECT_NEAR(area, 81 - 9, 1e-4);
    node.set_array<std::uint32_t>("polygon_holes", {1});
    expect_refused(node, "polygon_holes");
    node.set_array<std::uint32_t>("polygon_holes", {1, 2});
    expect_refused(node, "polygon_holes");
    node.set_array<std::uint32_t>("polygon_holes", {1, 1});
    expect_refused(node, "polygon_holes");
}

TEST(Polymesh, HostileArraysAreRefusedWhereTheyStand) {
    TestNode node = two_quads();
    node.set_array<std::uint32_t>("vidxs", {0, 1, 4, 3, 1, 2, 6, 4});
    expect_refused(node, "vidxs");
    node.set_array<std::uint32_t>("vidxs", {0, 1, 4, 3, 1, 2, 4294967295U, 4});
    expect_refused(node, "vidxs");

    node = two_quads();
    node.set_array<std::uint32_t>("nsides", {4, 5});
    expect_refused(node, "nsides");
    node.set_array<std::uint32_t>("nsides", {4294967295U, 4294967295U});
    expect_refused(node, "nsides");

    node = two_quads();
    node.set_array<Vec3f>("vlist", {{0, 0, 0},
                                    {1, 0, 0},
                                    {1, std::numeric_limits<float>::quiet_NaN(), 1},
                                    {0, 1, 0},
                                    {1, 1, 0},
                                    {1, 1, 1}});
    expect_refused(node, "vlist");
    node.set_array<Vec3f>("vlist", {});
    expect_refused(node, "vidxs");

    node = two_quads();
    node.set("smoothing", true);
    node.set_array<Vec3f>("nlist", {{0, 0, 1}});
    expect_refused(node, "vidxs");
    node.set_array<std::uint32_t>("nidxs", {0, 0, 0});
    expect_refused(node, "nidxs");
    node.set_array<std::uint32_t>("nidxs", {0, 0, 0, 0, 0, 0, 0, 9});
    expect_refused(node, "nidxs");
}

TEST(Polymesh, WhatCanBeLeftOutIsAWarning) {
    TestNode node = two_quads();
    node.set_array<std::uint32_t>("nsides",
                                  {4, 2});  // two corners too many in vidxs, and a polygon of two
    TestContext context;
    const auto geometry = build(node, context);
    ASSERT_NE(geometry, nullptr);
    EXPECT_EQ(std::get<TriangleMesh>(geometry->data).face.size(), 2U);
    EXPECT_EQ(context.count(Code::BadMesh), 2U);
    EXPECT_FALSE(context.diagnostics().has_errors());

    TestContext empty_context;
    const auto empty = build(TestNode(node_polymesh()), empty_context);
    ASSERT_NE(empty, nullptr);
    EXPECT_TRUE(std::get<TriangleMesh>(empty->data).indices.empty());
    EXPECT_EQ(empty_context.diagnostics().n_warnings(), 1U);
}

TEST(Polymesh, HugeConcavePolygonsAreRefused) {
    const auto n = static_cast<std::uint32_t>(kMaxConcaveCorners + 2);
    Indices vidxs;
    std::vector<Vec3f> vlist{{0, 0, 0}};
    for (std::uint32_t i = 0; i < n; ++i)
        vidxs.push_back(i);
    for (std::uint32_t i = 1; i < n; ++i)
        vlist.push_back({static_cast<float>(n - i), i % 2 == 0 ? 5.0F : 4.0F, 0});
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("nsides", {n})
        .set_array("vidxs", vidxs)
        .set_array("vlist", vlist);
    TestContext context;
    EXPECT_EQ(build(node, context), nullptr);
    EXPECT_EQ(context.count(Code::LimitPolygon), 1U);
}

TEST(Polymesh, SubdivisionIsNotSilentlyLeftOut) {
    TestNode node = two_quads();
    node.set_enum("subdiv_type", 1);
    TestContext context;
    EXPECT_NE(build(node, context), nullptr);
    EXPECT_EQ(context.count(Code::ParamPending), 1U);
}

TEST(Sphere, IsCheckedAndExact) {
    TestNode node(node_sphere());
    node.set("center", Vec3f{1, 2, 3}).set("radius", 2.0F);
    TestContext context;
    const auto geometry = build(node, context);
    ASSERT_NE(geometry, nullptr);
    const auto& list = std::get<SphereList>(geometry->data);
    EXPECT_EQ(list.centers, (std::vector<std::vector<Vec3f>>{{{1, 2, 3}}}));
    EXPECT_EQ(list.radii, std::vector<float>{2});
    node.set("radius", kInfinity);
    EXPECT_EQ(build(node, context), nullptr);
    EXPECT_EQ(context.count(Code::InvalidValue), 1U);
    node.set("radius", 0.0F);
    const auto nothing = build(node, context);
    ASSERT_NE(nothing, nullptr);
    EXPECT_TRUE(std::get<SphereList>(nothing->data).radii.empty());
    EXPECT_EQ(context.diagnostics().n_warnings(), 1U);
}

TEST(Ginstance, NeedsASource) {
    TestContext context;
    EXPECT_EQ(build(TestNode(node_ginstance()), context), nullptr);
    EXPECT_EQ(context.count(Code::InvalidValue), 1U);
}

}  // namespace
}  // namespace lightsieve
