// Polygons in space to triangles.
//
// A polygon is projected along its normal (Newell's sum of cross products, so slightly bent ones are fine). Convex ones
// become a fan; others lose one ear after the other; holes are first joined to the outer ring by a bridge, which
// makes one ring of them all. Self-intersecting and degenerate rings still give n - 2 triangles, of whatever
// shape: input never makes the loop stop early or run on.
// Source: Eberly, "Triangulation by Ear Clipping", 2002; bridges: section 3 there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

/// Concave polygons with more corners (holes included) are refused: clipping takes time by the square.
inline constexpr std::size_t kMaxConcaveCorners = 10000;

enum class PolygonResult : std::uint8_t {
    Done,
    HoleOutside,  ///< a hole does not lie in the outer ring; it was left out
    TooLarge,     ///< concave, with more corners than kMaxConcaveCorners; nothing was added
};

/// Splits polygons; keeps its memory from one polygon to the next.
class Triangulator {
  public:
    /// Appends the corners of the triangles, three each, to `out`; they wind as the outer ring does.
    ///
    /// rings  the outer ring, then its holes, each as corner numbers; rings of fewer than 3 corners are skipped
    /// point  of corner number c: `positions[point_of[c]]`
    PolygonResult split(std::span<const std::span<const std::uint32_t>> rings,
                        std::span<const std::uint32_t> point_of, std::span<const Vec3f> positions,
                        std::vector<std::uint32_t>& out);

  private:
    struct Point {
        double x = 0, y = 0;
    };
    /// Whether clipping a vertex would be right, where it was asked already.
    enum class Ear : std::uint8_t { Unknown, Yes, No };
    /// One corner of the ring that is being clipped; linked to its neighbours by index.
    struct Vertex {
        Point p;
        std::uint32_t corner = 0;
        std::uint32_t previous = 0, next = 0;
        Ear ear = Ear::Unknown;
    };
    /// How much an ear must satisfy. Simple rings never need more than the first.
    enum class Rule : std::uint8_t { Strict, NothingInside, Anything };

    static double cross(Point a, Point b, Point c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }
    static bool same(Point a, Point b) { return a.x == b.x && a.y == b.y; }

    void choose_projection(std::span<const std::uint32_t> ring,
                           std::span<const std::uint32_t> point_of,
                           std::span<const Vec3f> positions);
    void add_ring(std::span<const std::uint32_t> ring, std::span<const std::uint32_t> point_of,
                  std::span<const Vec3f> positions, bool hole);
    [[nodiscard]] bool convex() const;
    [[nodiscard]] bool in_cone(const Vertex& at, Point toward) const;
    bool bridge(std::uint32_t hole_vertex);
    [[nodiscard]] std::int64_t visible_from(Point from) const;
    [[nodiscard]] bool is_ear(std::uint32_t at, Rule rule) const;
    void clip(std::size_t n_left, std::vector<std::uint32_t>& out);

    std::vector<Vertex> ring_;
    int axis_x_ = 0,
        axis_y_ =
            1;  ///< coordinates that the projection keeps, so that the outer ring winds to the left
};

}  // namespace lightsieve
