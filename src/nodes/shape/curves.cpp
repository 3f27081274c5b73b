// curves: hair, fur, grass, thread.
//
// Writers disagree about how many radii a curve has, so the count decides: one a control point, one a segment end, one a
// curve, or one for all. Cubic curves of every basis become Bezier segments here. Curves that cannot be drawn (too few
// points, no radius anywhere, numbers that are not finite) are left out and counted; the others are shown.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>

#include "nodes/common/pixel_width.h"
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class Basis : std::int32_t { Bezier, BSpline, CatmullRom, Linear };
enum class Mode : std::int32_t { Ribbon, Thick, Oriented };

struct Curves : ShapeNode {
    Array<std::uint32_t> num_points;
    Array<Vec3f> points, orientations;
    Array<float> radius;
    Array<Vec2f> uvs;
    Basis basis = Basis::Bezier;
    Mode mode = Mode::Ribbon;
    float min_pixel_width = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const;
};

NodeType Curves::describe() {
    Describe<Curves> d("curves", NodeKind::Shape,
                       "Hair, fur, grass, thread: curves with a radius.");
    describe_shape_common(d);
    d.param(
        "num_points", &Curves::num_points,
        "Control points of each curve; one number: of every curve; left out: all are one curve.");
    d.param("points", &Curves::points,
            "Control points, object space, curve after curve; one list a motion key.")
        .unit("scene units");
    d.param("radius", &Curves::radius,
            "Radius: one for all, or one a curve, a segment end or a control point.")
        .unit("scene units");
    d.param("basis", &Curves::basis, "What the control points mean.")
        .names({"bezier", "b-spline", "catmull-rom", "linear"});
    d.param(
         "mode", &Curves::mode,
         "ribbon: flat, turned to the viewer; thick: round; oriented: flat, across orientations.")
        .names({"ribbon", "thick", "oriented"});
    d.param("orientations", &Curves::orientations,
            "Normals of oriented curves, object space, one a control point.");
    d.param("uvs", &Curves::uvs,
            "Texture coordinate of each curve; left out: across and along the curve.");
    d.param("min_pixel_width", &Curves::min_pixel_width,
            "Curves thinner than that on the picture are widened to it and as much more "
            "transparent; 0: none.")
        .unit("pixels")
        .range(0, 1);
    return d.done();
}

/// Control points of a Bezier segment as weights of four points of another basis.
using ToBezier = std::array<std::array<float, 4>, 4>;
constexpr float kSixth = 1.0F / 6;
constexpr ToBezier kFromBezier{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
constexpr ToBezier kFromBSpline{{{kSixth, 4 * kSixth, kSixth, 0},
                                 {0, 4 * kSixth, 2 * kSixth, 0},
                                 {0, 2 * kSixth, 4 * kSixth, 0},
                                 {0, kSixth, 4 * kSixth, kSixth}}};
constexpr ToBezier kFromCatmullRom{
    {{0, 1, 0, 0}, {-kSixth, 1, kSixth, 0}, {0, kSixth, 1, -kSixth}, {0, 0, 1, 0}}};

/// Builds the segments of one node.
class CurveBuilder {
  public:
    CurveBuilder(const Curves& node, NodeContext& context)
        : node_(node),
          context_(context),
          pixel_width_(node.min_pixel_width, node.matrix, context) {
        switch (node.basis) {
            case Basis::Bezier: step_ = 3; break;
            case Basis::BSpline: to_bezier_ = kFromBSpline; break;
            case Basis::CatmullRom: to_bezier_ = kFromCatmullRom; break;
            case Basis::Linear: n_controls_ = 2; break;
        }
    }

    std::unique_ptr<ShapeGeometry> build() {
        out_.mode = static_cast<CurveList::Mode>(node_.mode);
        // Flat straight segments cannot be turned about their axis: they become cubic ones.
        out_.linear = node_.basis == Basis::Linear && node_.mode != Mode::Oriented;
        find_curves();
        choose_radii();
        check_orientations();
        for (std::uint32_t k = 0; k < n_keys(); ++k) {
            out_.points.emplace_back();
            out_.radii.emplace_back();
            if (pixel_width_.acts()) out_.own_radii.emplace_back();
        }
        if (out_.mode == CurveList::Mode::Oriented) out_.normals.resize(1);
        for (std::size_t i = 0; i + 1 < first_point_.size(); ++i)
            add_curve(i);
        if (out_.own_radii == out_.radii) out_.own_radii.clear();
        add_uvs();
        report_left_out();
        auto geometry = std::make_unique<ShapeGeometry>();
        geometry->data = std::move(out_);
        return geometry;
    }

  private:
    enum class RadiusPer { All, Curve, End, Point };

    [[nodiscard]] std::uint32_t n_keys() const { return std::max(1U, node_.points.n_keys); }
    [[nodiscard]] std::size_t n_points(std::size_t curve) const {
        return first_point_[curve + 1] - first_point_[curve];
    }
    [[nodiscard]] std::size_t n_segments(std::size_t curve) const {
        const std::size_t n = n_points(curve);
        return n < n_controls_ ? 0 : (n - n_controls_) / step_ + 1;
    }
    [[nodiscard]] std::size_t n_ends(std::size_t curve) const {
        const std::size_t n = n_segments(curve);
        return n == 0 ? 0 : n + 1;
    }

    void warning(std::string message, const char* param, std::string hint) {
        context_.diagnostics().warning(Code::BadMesh, std::move(message), context_.where(param),
                                       std::move(hint));
    }

    /// Where each curve's control points start.
    void find_curves() {
        const std::size_t n = node_.points.n;
        first_point_ = {0};
        const auto counts = node_.num_points.first_key();
        if (counts.empty()) {
            if (n > 0) first_point_.push_back(n);
            return;
        }
        const bool same = counts.size() == 1;
        std::size_t total = 0;
        for (std::size_t i = 0; same ? counts[0] > 0 && total + counts[0] <= n : i < counts.size();
             ++i) {
            total += counts[same ? 0 : i];
            if (total > n) break;
            first_point_.push_back(total);
        }
        if (total > n) {
            warning(fmt::format("num_points asks for more than the {} of points", n), "num_points",
                    "the sum of num_points must be the length of points; the curves that lack "
                    "points are left out");
        } else if (total < n) {
            warning(fmt::format("points has {} entries but num_points uses only {}", n, total),
                    "points",
                    "the sum of num_points must be the length of points; the rest is left out");
        }
    }

    void choose_radii() {
        const std::size_t n_curves = first_point_.size() - 1, n = node_.radius.n;
        std::size_t ends = 0;
        for (std::size_t i = 0; i < n_curves; ++i)
            ends += n_ends(i);
        first_end_.assign(n_curves + 1, 0);
        for (std::size_t i = 0; i < n_curves; ++i)
            first_end_[i + 1] = first_end_[i] + n_ends(i);
        if (n == 0) {
            warning("the curves have no radius: they show nothing", "radius", "write a radius");
        } else if (n == 1) {
            radius_per_ = RadiusPer::All;
        } else if (n == node_.points.n) {
            radius_per_ = RadiusPer::Point;
        } else if (n == ends) {
            radius_per_ = RadiusPer::End;
        } else if (n == n_curves) {
            radius_per_ = RadiusPer::Curve;
        } else {
            warning(fmt::format("radius has {} entries for {} curves of {} control points and {} "
                                "segment ends",
                                n, n_curves, node_.points.n, ends),
                    "radius", "all curves get the first radius");
        }
        if (node_.radius.n_keys > 1 && node_.radius.n_keys != n_keys())
            warning(fmt::format("radius has {} motion keys, points has {}", node_.radius.n_keys,
                                n_keys()),
                    "radius", "the first key is taken for all");
    }

    void check_orientations() {
        if (node_.mode != Mode::Oriented) return;
        if (node_.orientations.n == node_.points.n) return;
        warning(fmt::format("orientations has {} entries for {} control points",
                            node_.orientations.n, node_.points.n),
                "orientations", "oriented curves need one each; these are drawn as ribbons");
        out_.mode = CurveList::Mode::Ribbon;
    }

    [[nodiscard]] float radius_value(std::uint32_t key, std::size_t i) const {
        const bool moves = node_.radius.n_keys == n_keys();
        const float r = node_.radius.key(moves ? key : 0)[i];
        return std::isfinite(r) ? std::max(r, 0.0F) : 0.0F;
    }

    /// Radius at control point `c` of a segment, in the final (Bezier or linear) basis.
    [[nodiscard]] float radius_at(std::uint32_t key, std::size_t curve, std::size_t segment,
                                  std::size_t c) const {
        if (node_.radius.empty()) return 0;
        const float along = static_cast<float>(c) / static_cast<float>(out_.n_controls() - 1);
        switch (radius_per_) {
            case RadiusPer::All: return radius_value(key, 0);
            case RadiusPer::Curve: return radius_value(key, curve);
            case RadiusPer::End: {
                const std::size_t end = first_end_[curve] + segment;
                return lerp(radius_value(key, end), radius_value(key, end + 1), along);
            }
            case RadiusPer::Point: break;
        }
        const std::size_t first = first_point_[curve] + segment * step_;
        if (n_controls_ == 2)
            return lerp(radius_value(key, first), radius_value(key, first + 1), along);
        float sum = 0;
        for (std::size_t i = 0; i < 4; ++i)
            sum += to_bezier_[c][i] * radius_value(key, first + i);
        return std::max(sum, 0.0F);
    }

    [[nodiscard]] Vec3f blend(std::span<const Vec3f> values, std::size_t first,
                              std::size_t c) const {
        if (n_controls_ == 2) {
            const float along = static_cast<float>(c) / static_cast<float>(out_.n_controls() - 1);
            return values[first] * (1 - along) + values[first + 1] * along;
        }
        Vec3f sum;
        for (std::size_t i = 0; i < 4; ++i)
            sum += values[first + i] * to_bezier_[c][i];
        return sum;
    }

    [[nodiscard]] bool finite(std::size_t curve) const {
        for (std::uint32_t k = 0; k < n_keys(); ++k)
            for (const Vec3f& p :
                 node_.points.key(k).subspan(first_point_[curve], n_points(curve)))
                if (!is_finite(p)) return false;
        return true;
    }

    void add_curve(std::size_t curve) {
        const std::size_t n = n_segments(curve);
        if (n == 0) {
            ++n_short_;
            return;
        }
        if ((n_points(curve) - n_controls_) % step_ != 0) ++n_odd_;
        if (!finite(curve)) {
            ++n_not_finite_;
            return;
        }
        const auto first_control = static_cast<std::uint32_t>(out_.points[0].size());
        float widest = 0;
        for (std::uint32_t k = 0; k < n_keys(); ++k)
            widest = std::max(widest, add_controls(k, curve));
        if (!(widest > 0)) {
            ++n_thin_;
            for (std::uint32_t k = 0; k < n_keys(); ++k) {
                out_.points[k].resize(first_control);
                out_.radii[k].resize(first_control);
                if (pixel_width_.acts()) out_.own_radii[k].resize(first_control);
            }
            return;
        }
        add_normals(curve);
        const std::uint32_t stride = out_.n_controls() - 1;
        for (std::size_t s = 0; s < n; ++s)
            out_.segments.push_back({first_control + static_cast<std::uint32_t>(s) * stride,
                                     static_cast<std::uint32_t>(curve),
                                     static_cast<float>(s) / static_cast<float>(n),
                                     static_cast<float>(s + 1) / static_cast<float>(n)});
    }

    /// Control points and radii of a curve at one key; neighbouring segments share their ends. Returns the largest radius.
    float add_controls(std::uint32_t k, std::size_t curve) {
        float widest = 0;
        const auto values = node_.points.key(k);
        for_each_control(curve, [&](std::size_t s, std::size_t c) {
            const float r = radius_at(k, curve, s, c);
            widest = std::max(widest, r);
            const Vec3f p = blend(values, first_point_[curve] + s * step_, c);
            out_.points[k].push_back(p);
            out_.radii[k].push_back(pixel_width_.acts() ? pixel_width_.widened(p, r) : r);
            if (pixel_width_.acts()) out_.own_radii[k].push_back(r);
        });
        return widest;
    }

    void add_normals(std::size_t curve) {
        if (out_.mode != CurveList::Mode::Oriented) return;
        const auto values = node_.orientations.first_key();
        for_each_control(curve, [&](std::size_t s, std::size_t c) {
            const Vec3f n = blend(values, first_point_[curve] + s * step_, c);
            const bool usable = is_finite(n) && length_squared(n) > 0;
            out_.normals[0].push_back(usable ? n : Vec3f{0, 0, 1});
        });
    }

    template <class Body>
    void for_each_control(std::size_t curve, const Body& body) const {
        const std::size_t n = n_segments(curve), stride = out_.n_controls() - 1;
        for (std::size_t s = 0; s < n; ++s)
            for (std::size_t c = 0; c < stride; ++c)
                body(s, c);
        body(n - 1, stride);
    }

    void add_uvs() {
        if (node_.uvs.empty()) return;
        const std::size_t n_curves = first_point_.size() - 1;
        if (node_.uvs.n != n_curves)
            return warning(fmt::format("uvs has {} entries for {} curves", node_.uvs.n, n_curves),
                           "uvs", "one a curve is expected; they are left out");
        for (const Vec2f uv : node_.uvs.first_key())
            out_.uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : Vec2f{});
    }

    void report_left_out() {
        if (n_short_ > 0)
            warning(
                fmt::format("{} curves have too few control points and were left out", n_short_),
                "num_points", fmt::format("this basis needs at least {}", n_controls_));
        if (n_odd_ > 0)
            warning(fmt::format("{} curves have points after their last whole segment", n_odd_),
                    "num_points", "bezier curves have 4 points, and 3 more a further segment");
        if (n_not_finite_ > 0)
            warning(fmt::format("{} curves have points that are not finite and were left out",
                                n_not_finite_),
                    "points", "replace nan and inf in the scene");
        if (n_thin_ > 0 && !node_.radius.empty())
            warning(fmt::format("{} curves have no radius above 0 and were left out", n_thin_),
                    "radius", "negative and non-finite radii count as 0");
    }

    const Curves& node_;
    NodeContext& context_;
    PixelWidth pixel_width_;
    CurveList out_;
    std::size_t n_controls_ = 4;  ///< of a segment, in the node's basis
    std::size_t step_ = 1;        ///< control points from one segment to the next
    ToBezier to_bezier_ = kFromBezier;
    RadiusPer radius_per_ = RadiusPer::All;
    std::vector<std::size_t> first_point_;  ///< of each curve in points, and the end
    std::vector<std::size_t> first_end_;    ///< of each curve among segment ends, and the end
    std::size_t n_short_ = 0, n_odd_ = 0, n_not_finite_ = 0, n_thin_ = 0;
};

std::unique_ptr<ShapeGeometry> Curves::make_geometry(NodeContext& context) const {
    return CurveBuilder(*this, context).build();
}

}  // namespace

NodeType node_curves() { return Curves::describe(); }

}  // namespace lightsieve
