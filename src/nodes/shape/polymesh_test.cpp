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

/// A unit square that is to be subdivided.
TestNode subdivided_square(std::int32_t type, std::uint8_t iterations) {
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("nsides", {4});
    node.set_array<std::uint32_t>("vidxs", {0, 1, 2, 3});
    node.set_array<Vec3f>("vlist", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    node.set_enum("subdiv_type", type);
    node.set("subdiv_iterations", iterations);
    return node;
}
constexpr std::int32_t kCatclark = 1, kLinear = 2;

TEST(Polymesh, IterationsMakeFourQuadsOfOne) {
    for (const std::int32_t type : {kCatclark, kLinear}) {
        const TriangleMesh mesh = built(subdivided_square(type, 3));
        EXPECT_EQ(mesh.indices.size(), 64U * 6);
        EXPECT_EQ(mesh.face, Indices(128, 0));
        EXPECT_EQ(mesh.positions[0].size(), 81U);
        EXPECT_NE(mesh.origin, nullptr);
        EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty());
    }
    EXPECT_EQ(built(subdivided_square(kCatclark, 0)).indices.size(), 6U);
    EXPECT_EQ(built(subdivided_square(kCatclark, 0)).origin, nullptr);
}

TEST(Polymesh, SubdivisionHasALimit) {
    // 4^255 quads are not made; what is possible is, and said.
    TestContext context;
    const auto geometry = build(subdivided_square(kLinear, 255), context);
    ASSERT_NE(geometry, nullptr);
    EXPECT_EQ(context.count(Code::LimitMemory), 1U);
    const std::size_t n = std::get<TriangleMesh>(geometry->data).indices.size() / 6;
    EXPECT_EQ(n, 1U << 22U);
}

TEST(Polymesh, LinearSubdivisionKeepsTheNodesNormals) {
    TestNode node = subdivided_square(kLinear, 1);
    node.set("smoothing", true);
    node.set_array<Vec3f>("nlist", {{0, 0, 1}, {1, 0, 0}});
    node.set_array<std::uint32_t>("nidxs", {0, 1, 1, 0});
    const TriangleMesh mesh = built(node);
    ASSERT_EQ(mesh.normal_indices.size(), mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const float x = mesh.positions[0][mesh.indices[i]].x;
        const Vec3f truth = normalize(Vec3f{x, 0, 1 - x});
        EXPECT_LT(length(mesh.normals[0][mesh.normal_indices[i]] - truth), 1e-6F);
    }
    // Without normals of the node: those of the mesh. A smooth surface has its own.
    node.set_array<Vec3f>("nlist", {});
    EXPECT_NEAR(built(node).normals[0][0].z, 1, 1e-6F);
    TestNode smooth = subdivided_square(kCatclark, 1);
    smooth.set("smoothing", true);
    const TriangleMesh limit = built(smooth);
    EXPECT_EQ(limit.normal_indices, limit.indices);
    EXPECT_NEAR(limit.normals[0][0].z, 1, 1e-6F);
}

TEST(Polymesh, SubdivisionTakesKeysHolesAndShaders) {
    TestNode node(node_polymesh());
    // A square with a square hole, and a triangle beside it; the second key is higher by 1.
    std::vector<Vec3f> points{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0},
                              {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {4, 0, 0}};
    for (std::size_t i = 0; i < 9; ++i)
        points.push_back(points[i] + Vec3f{0, 0, 1});
    node.set_array<std::uint32_t>("nsides", {4, 4, 3});
    node.set_array<std::uint32_t>("vidxs", {0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 2});
    node.set_array<Vec3f>("vlist", points, 2);
    node.set_array<std::uint32_t>("polygon_holes", {1, 0});
    node.set_array<std::uint8_t>("shidxs", {0, 0, 0});
    node.set_enum("subdiv_type", kLinear);
    const TriangleMesh mesh = built(node);
    ASSERT_EQ(mesh.positions.size(), 2U);
    double area = 0, beside = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto p = [&](std::size_t i) { return mesh.positions[0][mesh.indices[t + i]]; };
        const double a = 0.5 * static_cast<double>(length(cross(p(1) - p(0), p(2) - p(0))));
        (mesh.face[t / 3] == 2 ? beside : area) += a;
        EXPECT_NE(mesh.face[t / 3], 1U);
        EXPECT_EQ(mesh.positions[1][mesh.indices[t]], (p(0) + Vec3f{0, 0, 1}));
    }
    EXPECT_NEAR(area, 8, 1e-5);
    EXPECT_NEAR(beside, 1.5, 1e-5);
    EXPECT_EQ(mesh.shader_index.size(), mesh.face.size());
}

TEST(Polymesh, BadCreasesAreLeftOut) {
    TestNode node = subdivided_square(kCatclark, 1);
    node.set_array<std::uint32_t>("crease_idxs", {0, 0, 1, 99, 2, 2, 3});
    node.set_array<float>("crease_sharpness",
                          {kInfinity, 5, std::numeric_limits<float>::quiet_NaN()});
    TestContext context;
    const auto geometry = build(node, context);
    ASSERT_NE(geometry, nullptr);
    EXPECT_EQ(context.count(Code::BadMesh), 1U) << context.diagnostics().render();
    // Vertex 0 is pinned, the others are not.
    const auto& points = std::get<TriangleMesh>(geometry->data).positions[0];
    const auto has = [&](Vec3f p) {
        return std::any_of(points.begin(), points.end(),
                           [&](Vec3f q) { return length(p - q) < 1e-5F; });
    };
    EXPECT_TRUE(has({0, 0, 0}));
    EXPECT_FALSE(has({1, 1, 0}));
}

TEST(Polymesh, DegeneratePolygonsDoNotStopSubdivision) {
    TestNode node(node_polymesh());
    node.set_array<std::uint32_t>("nsides", {4, 4, 2, 4});
    node.set_array<std::uint32_t>("vidxs", {0, 0, 1, 2, 1, 1, 1, 2, 0, 1, 0, 1, 2, 0});
    node.set_array<Vec3f>("vlist", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    node.set_enum("subdiv_type", kCatclark);
    TestContext context;
    const auto geometry = build(node, context);
    ASSERT_NE(geometry, nullptr);
    EXPECT_EQ(context.count(Code::BadMesh), 1U);  // two polygons with fewer than three corners
    EXPECT_FALSE(std::get<TriangleMesh>(geometry->data).indices.empty());
    for (const Vec3f p : std::get<TriangleMesh>(geometry->data).positions[0])
        EXPECT_TRUE(is_finite(p));
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
