#include "nodes/common/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lightsieve {

void Triangulator::choose_projection(std::span<const std::uint32_t> ring,
                                     std::span<const std::uint32_t> point_of,
                                     std::span<const Vec3f> positions) {
    // Newell's normal, relative to the first corner so that far away polygons keep their digits.
    const Vec3f o = positions[point_of[ring[0]]];
    const auto at = [&](std::size_t i, int axis) {
        return static_cast<double>(positions[point_of[ring[i % ring.size()]]][axis]) -
               static_cast<double>(o[axis]);
    };
    std::array<double, 3> n{};
    for (std::size_t i = 0; i < ring.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            n[static_cast<std::size_t>(k)] += at(i, u) * at(i + 1, v) - at(i, v) * at(i + 1, u);
        }
    // Leave out the coordinate in which the normal is largest: it keeps convexity and what lies inside what.
    int drop = 2;
    if (std::abs(n[0]) > std::abs(n[1]) && std::abs(n[0]) > std::abs(n[2]))
        drop = 0;
    else if (std::abs(n[1]) > std::abs(n[2]))
        drop = 1;
    axis_x_ = (drop + 1) % 3;
    axis_y_ = (drop + 2) % 3;
    if (n[static_cast<std::size_t>(drop)] < 0) std::swap(axis_x_, axis_y_);
}

void Triangulator::add_ring(std::span<const std::uint32_t> ring,
                            std::span<const std::uint32_t> point_of,
                            std::span<const Vec3f> positions, bool hole) {
    const std::size_t from = ring_.size(), n = ring.size();
    double area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3f p = positions[point_of[ring[i]]];
        ring_.push_back(
            {{static_cast<double>(p[axis_x_]), static_cast<double>(p[axis_y_])}, ring[i]});
        if (i >= 2) area += cross(ring_[from].p, ring_[from + i - 1].p, ring_[from + i].p);
    }
    // Holes run the other way round, so that the inside is always to the left.
    if (hole && area > 0)
        std::reverse(ring_.begin() + static_cast<std::ptrdiff_t>(from), ring_.end());
    for (std::size_t i = 0; i < n; ++i) {
        ring_[from + i].previous = static_cast<std::uint32_t>(from + (i + n - 1) % n);
        ring_[from + i].next = static_cast<std::uint32_t>(from + (i + 1) % n);
    }
}

bool Triangulator::convex() const {
    // All corners turn left, and the ring goes round once: x falls on one stretch and rises on one.
    const std::size_t n = ring_.size();
    int turns = 0;
    double last_dx = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        const Point a = ring_[i % n].p, b = ring_[(i + 1) % n].p, c = ring_[(i + 2) % n].p;
        if (!(cross(a, b, c) > 0)) return false;
        const double dx = b.x - a.x;
        if (dx == 0) continue;
        if (last_dx * dx < 0) ++turns;
        last_dx = dx > 0 ? 1 : -1;
    }
    return turns <= 2;
}

bool Triangulator::in_cone(const Vertex& at, Point toward) const {
    // Source: O'Rourke, Computational Geometry in C, 2nd edition, code 1.11.
    const Point before = ring_[at.previous].p, after = ring_[at.next].p;
    if (cross(at.p, after, before) >= 0)
        return cross(at.p, toward, before) > 0 && cross(toward, at.p, after) > 0;
    return !(cross(at.p, toward, after) >= 0 && cross(toward, at.p, before) >= 0);
}

std::int64_t Triangulator::visible_from(Point from) const {
    // Find the first edge that a ray toward +x meets.
    double nearest = std::numeric_limits<double>::infinity();
    Point end{};
    std::uint32_t i = 0;
    do {
        const Point a = ring_[i].p, b = ring_[ring_[i].next].p;
        if (a.y <= from.y && from.y <= b.y && a.y != b.y) {
            const double x = a.x + (from.y - a.y) * (b.x - a.x) / (b.y - a.y);
            if (x >= from.x && x < nearest) {
                nearest = x;
                end = from.y == a.y ? a : from.y == b.y ? b : a.x > b.x ? a : b;
            }
        }
        i = ring_[i].next;
    } while (i != 0);
    if (!std::isfinite(nearest)) return -1;
    // Take the edge's end, or a corner in the way to it: the one nearest to the ray.
    const Point hit{nearest, from.y};
    const bool up = end.y > from.y;
    double best_tan = std::numeric_limits<double>::infinity(), best_x = 0;
    std::int64_t best = -1;
    i = 0;
    do {
        const Vertex& v = ring_[i];
        if (same(v.p, from)) return i;
        const bool inside = up ? cross(from, hit, v.p) >= 0 && cross(hit, end, v.p) >= 0 &&
                                     cross(end, from, v.p) >= 0
                               : cross(from, end, v.p) >= 0 && cross(end, hit, v.p) >= 0 &&
                                     cross(hit, from, v.p) >= 0;
        if (inside && v.p.x > from.x && in_cone(v, from)) {
            const double tan = std::abs(v.p.y - from.y) / (v.p.x - from.x);
            if (tan < best_tan || (tan == best_tan && v.p.x < best_x)) {
                best = i;
                best_tan = tan;
                best_x = v.p.x;
            }
        }
        i = v.next;
    } while (i != 0);
    return best;
}

bool Triangulator::bridge(std::uint32_t hole_vertex) {
    const std::int64_t found = visible_from(ring_[hole_vertex].p);
    if (found < 0) return false;
    // outer -> hole ... back to a twin of hole -> twin of outer -> what followed outer.
    const std::uint32_t outer = static_cast<std::uint32_t>(found);
    const std::uint32_t hole_twin = static_cast<std::uint32_t>(ring_.size()),
                        outer_twin = hole_twin + 1;
    ring_.push_back(ring_[hole_vertex]);
    ring_.push_back(ring_[outer]);
    ring_[hole_twin].next = outer_twin;
    ring_[outer_twin].previous = hole_twin;
    ring_[ring_[hole_vertex].previous].next = hole_twin;
    ring_[ring_[outer].next].previous = outer_twin;
    ring_[hole_vertex].previous = outer;
    ring_[outer].next = hole_vertex;
    return true;
}

bool Triangulator::is_ear(std::uint32_t at, Rule rule) const {
    if (rule == Rule::Anything) return true;
    const Vertex& v = ring_[at];
    const Vertex &p = ring_[v.previous], &n = ring_[v.next];
    const double area = cross(p.p, v.p, n.p);
    const bool strict = rule == Rule::Strict;
    if (strict ? !(area > 0 && in_cone(p, n.p) && in_cone(n, p.p)) : !(area >= 0)) return false;
    for (std::uint32_t i = n.next; i != v.previous; i = ring_[i].next) {
        const Vertex& q = ring_[i];
        const double a = cross(p.p, v.p, q.p), b = cross(v.p, n.p, q.p), c = cross(n.p, p.p, q.p);
        if (!strict) {
            if (a > 0 && b > 0 && c > 0) return false;
            continue;
        }
        if (a < 0 || b < 0 || c < 0 || same(q.p, p.p) || same(q.p, v.p) || same(q.p, n.p))
            continue;
        // A corner that turns left can only be inside if one that does not is inside too.
        if (cross(ring_[q.previous].p, q.p, ring_[q.next].p) <= 0) return false;
    }
    return true;
}

void Triangulator::clip(std::size_t n_left, std::vector<std::uint32_t>& out) {
    // Rings that cross themselves could make the search for ears take the cube of their size: it gets a budget.
    std::size_t budget = 6 * n_left * n_left + 10000;
    Rule rule = Rule::Strict;
    std::size_t n_refused = 0;
    std::uint32_t at = 0;
    while (n_left >= 3) {
        Vertex& v = ring_[at];
        bool ear = v.ear == Ear::Yes;
        if (rule != Rule::Strict || v.ear == Ear::Unknown) {
            ear = is_ear(at, rule);
            budget = budget > n_left ? budget - n_left : 0;
            if (rule == Rule::Strict) v.ear = ear ? Ear::Yes : Ear::No;
        }
        if (!ear && n_left > 3) {
            at = v.next;
            if (++n_refused < n_left) continue;
            rule = rule == Rule::Strict ? Rule::NothingInside : Rule::Anything;
            n_refused = 0;
            continue;
        }
        out.insert(out.end(), {ring_[v.previous].corner, v.corner, ring_[v.next].corner});
        ring_[v.previous].next = v.next;
        ring_[v.next].previous = v.previous;
        ring_[v.previous].ear = ring_[v.next].ear = Ear::Unknown;
        --n_left;
        // Go on behind the neighbour: clipping side by side would make a fan of slivers.
        at = ring_[v.next].next;
        n_refused = 0;
        rule = budget > 0 ? Rule::Strict : Rule::Anything;
    }
}

PolygonResult Triangulator::split(std::span<const std::span<const std::uint32_t>> rings,
                                  std::span<const std::uint32_t> point_of,
                                  std::span<const Vec3f> positions,
                                  std::vector<std::uint32_t>& out) {
    const std::span<const std::uint32_t> outer = rings[0];
    const std::size_t n = outer.size();
    if (n < 3) return PolygonResult::Done;
    if (n == 3 && rings.size() == 1) {
        out.insert(out.end(), outer.begin(), outer.end());
        return PolygonResult::Done;
    }
    choose_projection(outer, point_of, positions);
    ring_.clear();
    add_ring(outer, point_of, positions, false);
    if (rings.size() == 1 && convex()) {
        for (std::size_t i = 2; i < n; ++i)
            out.insert(out.end(), {outer[0], outer[i - 1], outer[i]});
        return PolygonResult::Done;
    }
    std::size_t total = 0;
    for (const auto& ring : rings)
        total += ring.size() + 2;
    if (total > kMaxConcaveCorners) return PolygonResult::TooLarge;

    // Join the holes from right to left, so that no bridge crosses a hole that comes later.
    std::vector<std::uint32_t> rightmost;
    std::vector<std::size_t> sizes;
    for (const auto& hole : rings.subspan(1)) {
        if (hole.size() < 3) continue;
        const std::size_t from = ring_.size();
        add_ring(hole, point_of, positions, true);
        std::size_t right = from;
        for (std::size_t i = from; i < ring_.size(); ++i)
            if (ring_[i].p.x > ring_[right].p.x) right = i;
        rightmost.push_back(static_cast<std::uint32_t>(right));
        sizes.push_back(hole.size());
    }
    std::vector<std::size_t> order(rightmost.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return ring_[rightmost[a]].p.x > ring_[rightmost[b]].p.x;
    });
    std::size_t n_left = n;
    PolygonResult result = PolygonResult::Done;
    for (const std::size_t i : order) {
        if (bridge(rightmost[i]))
            n_left += sizes[i] + 2;
        else
            result = PolygonResult::HoleOutside;
    }
    clip(n_left, out);
    return result;
}

}  // namespace lightsieve
