#include "nodes/common/subdivision.h"

#include <gtest/gtest.h>

#include "nodes/common/refined_mesh.h"
#include "scene/mesh_origin.h"

namespace lightsieve {
namespace {

/// Faces with the same number of corners each.
SubdivisionCage cage(std::size_t n_corners, std::vector<std::uint32_t> vertex,
                     std::size_t n_vertices) {
    SubdivisionCage out;
    for (std::size_t i = 0; i <= vertex.size(); i += n_corners)
        out.first_corner.push_back(static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < vertex.size(); ++i)
        out.corner.push_back(static_cast<std::uint32_t>(i));
    out.vertex = std::move(vertex);
    out.n_vertices = n_vertices;
    return out;
}

/// Corners of a cube with edges of 2; vertex i has +1 along x, y, z where bits 0, 1, 2 of i are set.
std::vector<Vec3f> cube_points() {
    std::vector<Vec3f> out;
    for (unsigned i = 0; i < 8; ++i)
        out.push_back({(i & 1U) != 0 ? 1.0F : -1.0F, (i & 2U) != 0 ? 1.0F : -1.0F,
                       (i & 4U) != 0 ? 1.0F : -1.0F});
    return out;
}
SubdivisionCage cube() {
    return cage(4, {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6}, 8);
}

float nearest(const std::vector<Vec3f>& points, Vec3f to, std::size_t* which = nullptr) {
    float least = kInfinity;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float d = length(points[i] - to);
        if (d >= least) continue;
        least = d;
        if (which != nullptr) *which = i;
    }
    return least;
}

TEST(Subdivision, CubesComeToTheirLimitAtEveryLevel) {
    // By hand: a corner of valence n with neighbours e and diagonals f comes to (n^2 v + 4 sum e + sum f) / (n (n + 5)),
    // here (9 + 4 - 1) / 24 = 1/2. After one level the middle of a face has neighbours at 3/4 and diagonals at 5/9:
    // (16 + 4 * 4 * 3/4 + 4 * 5/9) / 36. Source: Halstead, Kass and DeRose 1993, eq. 2.
    const float middle = (16 + 12 + 20.0F / 9) / 36;
    for (const int levels : {1, 2, 4}) {
        SubdivisionCage c = cube();
        c.levels = levels;
        const Subdivision subdivision(c);
        ASSERT_TRUE(subdivision.valid());
        std::vector<Vec3f> normals;
        const std::vector<Vec3f> p = subdivision.positions(cube_points(), &normals);
        EXPECT_EQ(subdivision.quads().size() / 4,
                  static_cast<std::size_t>(n_refined_quads(c.first_corner, levels)));
        std::size_t corner = 0, face = 0;
        EXPECT_LT(nearest(p, {0.5F, 0.5F, 0.5F}, &corner), 1e-5F);
        EXPECT_LT(nearest(p, {0, 0, middle}, &face), 1e-5F);
        EXPECT_LT(length(normals[corner] - normalize(Vec3f{1, 1, 1})), 1e-4F);
        EXPECT_LT(length(normals[face] - Vec3f{0, 0, 1}), 1e-4F);
        EXPECT_EQ(subdivision.positions(cube_points(), nullptr), p);
    }
}

TEST(Subdivision, CreasesKeepEdgesAndVertices) {
    SubdivisionCage c = cube();
    for (std::uint32_t a = 0; a < 8; ++a)
        for (const std::uint32_t bit : {1U, 2U, 4U})
            if ((a & bit) == 0) c.creases.push_back({a, a | bit, 10});
    c.levels = 2;
    const std::vector<Vec3f> p = Subdivision(c).positions(cube_points(), nullptr);
    for (const Vec3f corner : cube_points())
        EXPECT_LT(nearest(p, corner), 1e-6F);
    for (const Vec3f v : p)
        EXPECT_NEAR(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}), 1, 1e-6F);
    // The same vertex twice: that vertex alone.
    SubdivisionCage pointed = cube();
    pointed.creases = {{7, 7, 10}, {0, 6, 10}};  // the second is no edge
    const std::vector<Vec3f> q = Subdivision(pointed).positions(cube_points(), nullptr);
    EXPECT_LT(nearest(q, {1, 1, 1}), 1e-6F);
    EXPECT_GT(nearest(q, {-1, -1, -1}), 0.5F);
}

TEST(Subdivision, BordersStayAndCornersBecomeRound) {
    const std::vector<Vec3f> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    SubdivisionCage c = cage(4, {0, 1, 2, 3}, 4);
    c.levels = 3;
    // A corner of an open mesh is a point of a spline along the border: (1 + 4 + 1) / 6.
    EXPECT_LT(nearest(Subdivision(c).positions(square, nullptr), {1 / 6.0F, 1 / 6.0F, 0}), 1e-5F);
    c.linear = true;
    const std::vector<Vec3f> p = Subdivision(c).positions(square, nullptr);
    ASSERT_EQ(p.size(), 81U);
    for (const Vec3f v : p) {
        EXPECT_NEAR(v.x * 8, std::round(v.x * 8), 1e-5F);
        EXPECT_NEAR(v.y * 8, std::round(v.y * 8), 1e-5F);
    }
}

TEST(Subdivision, UvsAsSmoothAsAsked) {
    const std::vector<Vec2f> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const auto refined = [&](UvSmoothing smoothing) {
        SubdivisionCage c = cage(4, {0, 1, 2, 3}, 4);
        c.uv = {0, 1, 2, 3};
        c.n_uvs = 4;
        c.levels = 2;
        c.uv_smoothing = smoothing;
        const Subdivision subdivision(c);
        EXPECT_EQ(subdivision.uv_quads().size(), subdivision.quads().size());
        return subdivision.uvs(square);
    };
    const auto has = [](const std::vector<Vec2f>& all, Vec2f uv) {
        return std::any_of(all.begin(), all.end(), [&](Vec2f v) {
            return std::abs(v.x - uv.x) + std::abs(v.y - uv.y) < 1e-5F;
        });
    };
    EXPECT_TRUE(has(refined(UvSmoothing::Smooth), {1 / 6.0F, 1 / 6.0F}));
    EXPECT_FALSE(has(refined(UvSmoothing::Smooth), {0, 0}));
    EXPECT_TRUE(has(refined(UvSmoothing::PinCorners), {0, 0}));
    EXPECT_TRUE(has(refined(UvSmoothing::PinBorders), {0.25F, 0}));
    for (const Vec2f v : refined(UvSmoothing::Linear))
        EXPECT_NEAR(v.x * 4, std::round(v.x * 4), 1e-5F);
}

TEST(Subdivision, SharesOfCornersGiveTheLinearSurface) {
    // A triangle, a quad and a pentagon around common edges: blended by shares, positions of the cage are those of the
    // linearly refined mesh, at every corner of every triangle.
    SubdivisionCage c;
    c.first_corner = {0, 3, 7, 12};
    c.vertex = {0, 1, 2, 1, 3, 4, 2, 2, 4, 5, 6, 7};
    for (std::uint32_t i = 0; i < 12; ++i)
        c.corner.push_back(i);
    c.n_vertices = 8;
    c.linear = true;
    const std::vector<Vec3f> p{{0, 0, 0}, {1, 0, 0}, {0.5F, 1, 0.3F}, {2, 0, 0.1F},
                               {2, 1, 0}, {2, 2, 1}, {1, 3, 0},       {0, 2, 0.5F}};
    for (const int levels : {1, 2, 3}) {
        RefinedMeshInput input;
        input.cage = c;
        input.cage.levels = levels;
        input.polygon = {10, 11, 12};
        input.positions = {p};
        const std::optional<TriangleMesh> mesh = refined_mesh(input);
        ASSERT_TRUE(mesh.has_value());
        ASSERT_EQ(mesh->indices.size(),
                  6 * static_cast<std::size_t>(n_refined_quads(c.first_corner, levels)));
        for (std::size_t i = 0; i < mesh->indices.size(); ++i) {
            std::array<float, 3> at{};
            at[i % 3] = 1;
            Vec3f sum;
            float total = 0;
            for_each_share(*mesh->origin, i / 3, at, [&](std::size_t slot, float share) {
                sum += p[mesh->origin->vertex[slot]] * share;
                total += share;
            });
            EXPECT_NEAR(total, 1, 1e-5F);
            EXPECT_LT(length(sum - mesh->positions[0][mesh->indices[i]]), 1e-5F) << i;
        }
        EXPECT_EQ(mesh->face.front(), 10U);
        EXPECT_EQ(mesh->face.back(), 12U);
    }
}

TEST(Subdivision, LevelsByEdgesAndByFlatness) {
    FinenessRule rule;
    rule.by_edges = true;
    const auto levels = [&](float error) {
        rule.error = error;
        return levels_needed(cube(), cube_points(), rule, 6);
    };
    EXPECT_EQ(levels(0), 6);  // no error: all
    EXPECT_EQ(levels(2.1F), 0);
    EXPECT_EQ(levels(1.1F), 1);
    EXPECT_EQ(levels(0.3F), 3);
    EXPECT_EQ(levels(1e-6F), 6);
    rule.by_edges = false;
    EXPECT_LT(levels(0.1F), 4);
    EXPECT_GT(levels(0.1F), levels(0.5F));
    // Linear subdivision without displacement changes nothing.
    SubdivisionCage flat = cube();
    flat.linear = true;
    rule.error = 1e-6F;
    EXPECT_EQ(levels_needed(flat, cube_points(), rule, 6), 0);
}

}  // namespace
}  // namespace lightsieve
