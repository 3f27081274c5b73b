#include "nodes/common/polygon.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace lightsieve {
namespace {

/// A polygon with holes in the plane z = 0, mapped somewhere into space.
struct Case {
    std::vector<std::vector<Vec2f>> rings;
};

struct Split {
    PolygonResult result{};
    std::vector<std::uint32_t> corners;
    std::vector<Vec2f> flat;
    /// Twice the signed area of triangle t, in the plane.
    [[nodiscard]] double area2(std::size_t t) const {
        const Vec2f a = flat[corners[3 * t]], b = flat[corners[3 * t + 1]],
                    c = flat[corners[3 * t + 2]];
        return static_cast<double>(b.x - a.x) * static_cast<double>(c.y - a.y) -
               static_cast<double>(b.y - a.y) * static_cast<double>(c.x - a.x);
    }
};

double ring_area(const std::vector<Vec2f>& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2f a = ring[i], b = ring[(i + 1) % ring.size()];
        sum += static_cast<double>(a.x) * static_cast<double>(b.y) -
               static_cast<double>(a.y) * static_cast<double>(b.x);
    }
    return sum / 2;
}

Split split(const Case& c, Vec3f x = {1, 0, 0}, Vec3f y = {0, 1, 0}, Vec3f origin = {}) {
    Split out;
    std::vector<Vec3f> positions;
    std::vector<std::vector<std::uint32_t>> rings;
    for (const auto& ring : c.rings) {
        rings.emplace_back();
        for (const Vec2f p : ring) {
            rings.back().push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(origin + x * p.x + y * p.y);
            out.flat.push_back(p);
        }
    }
    std::vector<std::uint32_t> point_of(positions.size());
    std::iota(point_of.begin(), point_of.end(), 0U);
    const std::vector<std::span<const std::uint32_t>> spans(rings.begin(), rings.end());
    Triangulator t;
    out.result = t.split(spans, point_of, positions, out.corners);
    return out;
}

/// All triangles wind as the outer ring, none overlap (areas add up), and there are as many as there must be.
void expect_exact_cover(const Case& c) {
    const double outer = ring_area(c.rings[0]);
    double area = std::abs(outer);
    std::size_t n = c.rings[0].size();
    for (std::size_t i = 1; i < c.rings.size(); ++i) {
        area -= std::abs(ring_area(c.rings[i]));
        n += c.rings[i].size() + 2;
    }
    const std::vector<std::array<Vec3f, 2>> planes{{{{1, 0, 0}, {0, 1, 0}}},
                                                   {{{0, 1, 0}, {0, 0, 1}}},
                                                   {{{0, 0, 1}, {1, 0, 0}}},
                                                   {{{0, 1, 0}, {1, 0, 0}}},
                                                   {{{0.6F, 0.8F, 0}, {0, 0.1F, -2}}}};
    for (const auto& plane : planes) {
        const Split s = split(c, plane[0], plane[1], {3, -2, 5});
        EXPECT_EQ(s.result, PolygonResult::Done);
        ASSERT_EQ(s.corners.size(), 3 * (n - 2));
        double sum = 0;
        for (std::size_t t = 0; t < n - 2; ++t) {
            EXPECT_GE(s.area2(t) * outer, 0) << "triangle " << t << " is turned over";
            sum += std::abs(s.area2(t)) / 2;
        }
        EXPECT_NEAR(sum, area, 1e-5 * area);
    }
}

std::vector<Vec2f> reversed(std::vector<Vec2f> ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
}

const std::vector<Vec2f> kL{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
const std::vector<Vec2f> kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
std::vector<Vec2f> square_at(float x, float y, float size) {
    return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

TEST(Polygon, ConvexOnesBecomeFans) {
    const Split s = split({{kSquare}});
    EXPECT_EQ(s.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Polygon, ConcaveOnesAreCoveredExactly) {
    expect_exact_cover({{kL}});
    expect_exact_cover({{reversed(kL)}});
    expect_exact_cover({{{{0, 0}, {2, 1}, {4, 0}, {2, 4}}}});
    // Corners on straight edges.
    expect_exact_cover({{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}}});
    // A comb.
    std::vector<Vec2f> comb{{20, 0}, {20, 5}};
    for (int i = 9; i >= 0; --i) {
        const float x = static_cast<float>(2 * i);
        comb.insert(comb.end(), {{x + 1, 5}, {x + 0.5F, 1}, {x, 5}});
    }
    comb.push_back({0, 0});
    expect_exact_cover({{comb}});
}

TEST(Polygon, ConcaveQuadsUseTheInnerDiagonal) {
    // The dent is corner 3; a fan from corner 0 would turn a triangle over.
    const Split s = split({{{{0, 0}, {4, 0}, {4, 4}, {3, 1}}}});
    ASSERT_EQ(s.corners.size(), 6U);
    EXPECT_GT(s.area2(0), 0);
    EXPECT_GT(s.area2(1), 0);
}

TEST(Polygon, SpiralsAndRandomStarsAreCoveredExactly) {
    std::vector<Vec2f> spiral;
    for (int i = 0; i < 60; ++i) {
        const float a = 0.3F * static_cast<float>(i), r = 1 + 0.2F * static_cast<float>(i);
        spiral.push_back({r * std::cos(a), r * std::sin(a)});
    }
    for (int i = 59; i >= 0; --i) {
        const float a = 0.3F * static_cast<float>(i), r = 1.5F + 0.2F * static_cast<float>(i);
        spiral.push_back({r * std::cos(a), r * std::sin(a)});
    }
    expect_exact_cover({{spiral}});
    std::mt19937 rng(7);
    std::uniform_real_distribution<float> radius(0.2F, 3);
    for (int k = 0; k < 50; ++k) {
        std::vector<Vec2f> star;
        for (int i = 0; i < 17; ++i) {
            const float a = 2 * kPi * static_cast<float>(i) / 17, r = radius(rng);
            star.push_back({r * std::cos(a), r * std::sin(a)});
        }
        expect_exact_cover({{star}});
    }
}

TEST(Polygon, HolesAreCutOut) {
    expect_exact_cover({{kSquare, square_at(4, 4, 2)}});
    expect_exact_cover({{kSquare, reversed(square_at(4, 4, 2))}});
    expect_exact_cover({{reversed(kSquare), square_at(4, 4, 2)}});
    // Two in a row, one above the other, and an L shaped one: bridges meet the same corners.
    expect_exact_cover({{kSquare, square_at(1, 4, 2), square_at(6, 4, 2)}});
    expect_exact_cover({{kSquare, square_at(4, 1, 2), square_at(4, 6, 2)}});
    std::vector<Vec2f> l;
    for (const Vec2f p : kL)
        l.push_back(p * 2 + Vec2f{1, 1});
    expect_exact_cover({{kSquare, l, square_at(5, 5, 3)}});
    Case grid{{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}}};
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            grid.rings.push_back(
                square_at(5 + 20 * static_cast<float>(x), 5 + 20 * static_cast<float>(y), 10));
    expect_exact_cover(grid);
}

TEST(Polygon, HolesOutsideAreReported) {
    const Split s = split({{kSquare, square_at(20, 20, 2)}});
    EXPECT_EQ(s.result, PolygonResult::HoleOutside);
    EXPECT_EQ(s.corners.size(), 6U);
}

TEST(Polygon, DegenerateRingsGiveTrianglesAndEnd) {
    // A figure of eight, all corners in one place, all on a line, a pentagram.
    EXPECT_EQ(split({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}}).corners.size(), 6U);
    EXPECT_EQ(split({{std::vector<Vec2f>(7, Vec2f{1, 1})}}).corners.size(), 15U);
    EXPECT_EQ(split({{{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5F, 0}}}}).corners.size(), 9U);
    std::vector<Vec2f> pentagram;
    for (int i = 0; i < 5; ++i)
        pentagram.push_back({std::cos(static_cast<float>(i) * 0.8F * kPi),
                             std::sin(static_cast<float>(i) * 0.8F * kPi)});
    EXPECT_EQ(split({{pentagram}}).corners.size(), 9U);
    EXPECT_TRUE(split({{{{0, 0}, {1, 1}}}}).corners.empty());
    // A large random tangle: the search for ears must give up in time.
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> place(0, 1);
    std::vector<Vec2f> tangle;
    for (int i = 0; i < 1500; ++i)
        tangle.push_back({place(rng), place(rng)});
    EXPECT_EQ(split({{tangle}}).corners.size(), 3U * 1498U);
}

TEST(Polygon, HugeConcaveOnesAreRefused) {
    std::vector<Vec2f> saw{{0, 0}};
    for (std::size_t i = 0; i <= kMaxConcaveCorners; ++i)
        saw.push_back({static_cast<float>(kMaxConcaveCorners - i), i % 2 == 0 ? 5.0F : 4.0F});
    const Split s = split({{saw}});
    EXPECT_EQ(s.result, PolygonResult::TooLarge);
    EXPECT_TRUE(s.corners.empty());
}

}  // namespace
}  // namespace lightsieve
