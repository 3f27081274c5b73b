#include "render/light_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/sampling.h"

namespace lightsieve {

namespace {

// Cosines are compared with this much room, so that rounding never turns a light off that just reaches a point.
constexpr float kCosineSlack = 1e-4F;
// The least factor that a cosine in an importance has: bounds are crude, and a tiny importance is a noisy weight.
constexpr float kMinCosine = 1e-3F;
// Bounding spheres are this much larger than exact ones, for rounding.
constexpr float kRadiusRoom = 1.0001F;
// Distances below are as good as zero; keeps importances finite.
constexpr float kMinDistanceSquared = 1e-20F;
constexpr float kMaxImportance = 1e30F;
// The least probability of a branch that can contribute: far above the resolution of a random float.
constexpr float kMinBranch = 0x1p-20F;  // of a node's branches
// Share of the picks that the tree and the infinite lights each have at least: importances know nothing of shadows.
constexpr float kMinShare = 0.1F;
// From this depth on the binary tree is split in halves, so that 2^28 lights stay below kMaxDepth.
constexpr int kMaxUnevenDepth = 36;
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kBuckets = 12;

constexpr double kPiDouble = std::numbers::pi;

float sine(float cosine) { return safe_sqrt(1 - cosine * cosine); }

/// cos(max(0, a - b)) for angles in [0, pi].
Float4 cos_difference(Float4 sin_a, Float4 cos_a, Float4 sin_b, Float4 cos_b) {
    return cos_a > cos_b ? all(1) : cos_a * cos_b + sin_a * sin_b;
}
/// sin(max(0, a - b)) for angles in [0, pi].
Float4 sin_difference(Float4 sin_a, Float4 cos_a, Float4 sin_b, Float4 cos_b) {
    return cos_a > cos_b ? all(0) : sin_a * cos_b - cos_a * sin_b;
}

/// Part of a random number below `p`, or above it, stretched to [0,1).
float stretch(float u, float low, float width) {
    return std::clamp((u - low) / width, 0.0F, kOneMinusEpsilon);
}

/// A cone of directions in double precision, for building.
struct Cone {
    Vec3f axis{0, 0, 1};
    double spread = 0;    ///< theta_o, of the normals
    double emission = 0;  ///< theta_e, further
};

double angle_between(Vec3f a, Vec3f b) {
    return std::atan2(static_cast<double>(length(cross(a, b))), static_cast<double>(dot(a, b)));
}

/// The smallest cone around two. Source: Conty Estevez and Kulla 2018, algorithm 1.
Cone merge(Cone a, Cone b) {
    if (b.spread > a.spread) std::swap(a, b);
    const double between = angle_between(a.axis, b.axis);
    Cone out = a;
    out.emission = std::max(a.emission, b.emission);
    if (std::min(between + b.spread, kPiDouble) <= a.spread) return out;
    out.spread = (a.spread + between + b.spread) / 2;
    const Vec3f side = b.axis - a.axis * dot(a.axis, b.axis);
    // Opposite axes have no plane to turn in; then nothing is known about directions.
    if (out.spread >= kPiDouble || !(length_squared(side) > 1e-12F)) {
        out.spread = kPiDouble;
        return out;
    }
    const double turn = out.spread - a.spread;
    out.axis = normalize(a.axis * static_cast<float>(std::cos(turn)) +
                         normalize(side) * static_cast<float>(std::sin(turn)));
    return out;
}

/// Measure of the directions that a cone's lights can send to. Source: Conty Estevez and Kulla 2018, section 4.2.
double orientation_measure(const Cone& c) {
    const double o = c.spread, w = std::min(o + c.emission, kPiDouble);
    return 2 * kPiDouble * (1 - std::cos(o)) +
           kPiDouble / 2 *
               (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

/// A light, or several together, while the tree is built.
struct Cluster {
    Box3f box;
    Cone cone;
    double intensity = 0;
    std::uint32_t light = 0;

    void add(const Cluster& o) {
        cone = intensity > 0 ? merge(cone, o.cone) : o.cone;
        box.grow(o.box);
        intensity += o.intensity;
    }
    /// Cost of leaving these lights together. The squared diagonal stands in for the area of Conty Estevez and
    /// Kulla 2018, eq. 8, because lights in a row have none.
    [[nodiscard]] double cost() const {
        return intensity > 0 ? intensity * orientation_measure(cone) *
                                   static_cast<double>(length_squared(box.size()))
                             : 0;
    }
};

double cos_to_angle(float cosine) {
    return std::acos(static_cast<double>(std::clamp(cosine, -1.0F, 1.0F)));
}

bool can_light(float strength) { return strength > 0 && std::isfinite(strength); }

}  // namespace

/// Builds a binary tree, then joins its nodes to wide ones.
struct LightSampler::Builder {
    LightSampler& out;
    std::vector<Cluster> clusters;  ///< the lights, sorted while the tree grows

    /// A node of the binary tree over clusters [begin, end).
    struct Binary {
        Cluster all;
        std::size_t first = 0, second = 0;  ///< children; 0: a leaf
    };
    std::vector<Binary> binary;

    /// The best division of clusters [begin, end) by cost over buckets along each axis; returns the first of the
    /// second part. Source: Conty Estevez and Kulla 2018, section 4.3.
    std::size_t split(std::size_t begin, std::size_t end, const Cluster& all, int depth) {
        const std::size_t half = begin + (end - begin) / 2;
        if (depth >= kMaxUnevenDepth) return half;
        Box3f centers;
        for (std::size_t i = begin; i < end; ++i)
            centers.grow(clusters[i].box.center());
        const Vec3f size = all.box.size();
        const float longest = std::max(size.x, std::max(size.y, size.z));
        double best_cost = HUGE_VAL;
        int best_axis = -1;
        std::size_t best_bucket = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = centers.upper[axis] - centers.lower[axis];
            if (!(extent > 0) || !std::isfinite(extent)) continue;
            const auto [cost, bucket] = best_plane(begin, end, centers, axis);
            // Thin boxes are not cut along their short side without need.
            const double regular =
                static_cast<double>(size[axis] > 0 ? longest / size[axis] : 1) * cost;
            if (regular < best_cost) {
                best_cost = regular;
                best_axis = axis;
                best_bucket = bucket;
            }
        }
        if (best_axis < 0) return half;
        const auto middle = std::stable_partition(
            clusters.begin() + static_cast<std::ptrdiff_t>(begin),
            clusters.begin() + static_cast<std::ptrdiff_t>(end),
            [&](const Cluster& c) { return bucket_of(c, centers, best_axis) <= best_bucket; });
        const std::size_t place = static_cast<std::size_t>(middle - clusters.begin());
        return place == begin || place == end ? half : place;
    }

    static std::size_t bucket_of(const Cluster& c, const Box3f& centers, int axis) {
        const float x = (c.box.center()[axis] - centers.lower[axis]) /
                        (centers.upper[axis] - centers.lower[axis]);
        return std::min(kBuckets - 1, static_cast<std::size_t>(std::max(0.0F, x) *
                                                               static_cast<float>(kBuckets)));
    }

    /// Cost of the best plane along an axis and the last bucket before it.
    [[nodiscard]] std::pair<double, std::size_t> best_plane(std::size_t begin, std::size_t end,
                                                            const Box3f& centers, int axis) const {
        std::array<Cluster, kBuckets> buckets{};
        for (std::size_t i = begin; i < end; ++i)
            buckets[bucket_of(clusters[i], centers, axis)].add(clusters[i]);
        std::array<double, kBuckets> cost{};
        Cluster low, high;
        for (std::size_t b = 0; b + 1 < kBuckets; ++b) {
            if (buckets[b].intensity > 0) low.add(buckets[b]);
            cost[b] += low.cost();
            const std::size_t t = kBuckets - 1 - b;
            if (buckets[t].intensity > 0) high.add(buckets[t]);
            cost[t - 1] += high.cost();
        }
        const auto best = std::min_element(cost.begin(), cost.end() - 1);
        return {*best, static_cast<std::size_t>(best - cost.begin())};
    }

    std::size_t build_binary(std::size_t begin, std::size_t end, int depth) {
        const std::size_t index = binary.size();
        binary.emplace_back();
        Cluster all = clusters[begin];
        for (std::size_t i = begin + 1; i < end; ++i)
            all.add(clusters[i]);
        binary[index].all = all;
        if (end - begin > 1) {
            const std::size_t middle = split(begin, end, all, depth);
            const std::size_t first = build_binary(begin, middle, depth + 1);
            const std::size_t second = build_binary(middle, end, depth + 1);
            binary[index].first = first;
            binary[index].second = second;
        }
        return index;
    }

    /// Opens the branches of a binary node, most uncertain first, until there are enough.
    [[nodiscard]] std::vector<std::size_t> open(std::size_t root) const {
        std::vector<std::size_t> branches{root};
        while (branches.size() < kBranches) {
            std::size_t best = branches.size();
            double best_doubt = -1;
            for (std::size_t i = 0; i < branches.size(); ++i) {
                const Binary& b = binary[branches[i]];
                const double doubt =
                    b.all.intensity * static_cast<double>(length_squared(b.all.box.size()));
                if (b.first == 0 || !(doubt > best_doubt)) continue;
                best = i;
                best_doubt = doubt;
            }
            if (best == branches.size()) break;
            const Binary& opened = binary[branches[best]];
            branches[best] = opened.first;
            branches.insert(branches.begin() + static_cast<std::ptrdiff_t>(best) + 1,
                            opened.second);
        }
        return branches;
    }

    std::uint32_t build_wide(std::size_t root, std::uint32_t parent, std::uint32_t parent_branch) {
        const std::vector<std::size_t> branches = open(root);
        const std::uint32_t index = static_cast<std::uint32_t>(out.nodes_.size());
        Node node;
        node.first_bounds = static_cast<std::uint32_t>(out.bounds_.size());
        node.n_branches = static_cast<std::uint32_t>(branches.size());
        node.parent = parent;
        node.parent_branch = parent_branch;
        out.nodes_.push_back(node);
        out.bounds_.resize(out.bounds_.size() + (branches.size() + kLanes - 1) / kLanes);
        for (std::size_t i = 0; i < branches.size(); ++i) {
            const Binary& b = binary[branches[i]];
            const std::uint32_t branch = static_cast<std::uint32_t>(i);
            set_lane(out.bounds_[node.first_bounds + i / kLanes], i % kLanes, b.all);
            if (b.first == 0) {
                out.nodes_[index].branches[i] = b.all.light | kLeaf;
                out.places_[b.all.light] = {Place::Kind::Tree, index, branch};
            } else {
                const std::uint32_t below = build_wide(branches[i], index, branch);
                out.nodes_[index].branches[i] = below;
            }
        }
        return index;
    }

    static void set_lane(Bounds4& bounds, std::size_t lane, const Cluster& c) {
        const Vec3f center = c.box.center();
        bounds.center_x[lane] = center.x;
        bounds.center_y[lane] = center.y;
        bounds.center_z[lane] = center.z;
        bounds.radius[lane] = length(c.box.size()) * (0.5F * kRadiusRoom);
        bounds.axis_x[lane] = c.cone.axis.x;
        bounds.axis_y[lane] = c.cone.axis.y;
        bounds.axis_z[lane] = c.cone.axis.z;
        bounds.cos_spread[lane] = static_cast<float>(std::cos(c.cone.spread));
        bounds.sin_spread[lane] = static_cast<float>(std::sin(c.cone.spread));
        bounds.cos_emission[lane] = static_cast<float>(std::cos(c.cone.emission));
        bounds.intensity[lane] = static_cast<float>(c.intensity);
    }

    void build() {
        for (std::uint32_t i = 0; i < out.places_.size(); ++i)
            if (out.contains(i)) out.lights_.push_back(i);
        if (out.lights_.size() == 1) out.lone_ = out.lights_.front();
        if (clusters.empty()) return;
        binary.reserve(2 * clusters.size());
        build_wide(build_binary(0, clusters.size(), 0), kNone, 0);
    }

    /// Takes in one light of the caller's span.
    void add(const Light& light, std::uint32_t index) {
        if (out.places_[index].kind != Place::Kind::Absent) return;
        const LightBounds bounds = light.bounds();
        if (light.infinite()) {
            const float irradiance = light.irradiance();
            if (!can_light(irradiance)) return;
            out.places_[index].kind = Place::Kind::Infinite;
            out.places_[index].index = static_cast<std::uint32_t>(out.infinite_.size());
            out.infinite_.push_back(
                {bounds.axis, bounds.cos_spread, sine(bounds.cos_spread), irradiance, index});
            return;
        }
        if (!can_light(bounds.intensity) || bounds.box.empty()) return;
        if (!is_finite(bounds.box.lower) || !is_finite(bounds.box.upper)) return;
        out.places_[index].kind = Place::Kind::Tree;
        const Cone cone{bounds.axis, cos_to_angle(bounds.cos_spread),
                        cos_to_angle(bounds.cos_emission)};
        clusters.push_back({bounds.box, cone, static_cast<double>(bounds.intensity), index});
    }
};

LightSampler::LightSampler(std::span<const Light* const> lights) : places_(lights.size()) {
    Builder builder{*this, {}, {}};
    for (std::size_t i = 0; i < lights.size(); ++i)
        builder.add(*lights[i], static_cast<std::uint32_t>(i));
    builder.build();
}

LightSampler::LightSampler(std::span<const Light* const> lights,
                           std::span<const std::uint32_t> subset)
    : places_(lights.size()) {
    Builder builder{*this, {}, {}};
    for (const std::uint32_t index : subset)
        builder.add(*lights[index], index);
    builder.build();
}

// Source of the bounds: Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed., section 12.6.3. Here the
// intensity of the strongest direction stands for the power, so that a narrow spot and a bare point of the same
// brightness count the same where both reach; and each cosine is the mean of its bound and of its value at the
// centre, which estimates large clusters better than the bound alone (it halves the variance on a ceiling of panels)
// and is still 0 only where the bound is.
auto LightSampler::importance(const Bounds4& bounds, Vec3f position, Vec3f normal) noexcept
    -> Float4 {
    const Float4 x = position.x - load(bounds.center_x), y = position.y - load(bounds.center_y),
                 z = position.z - load(bounds.center_z);
    const Float4 radius = load(bounds.radius), intensity = load(bounds.intensity);
    const Float4 distance_squared = larger(x * x + y * y + z * z, all(kMinDistanceSquared));
    const Float4 radius_squared = larger(radius * radius, all(kMinDistanceSquared));
    const Float4 inverse_distance = 1 / root(distance_squared);
    const Float4 sin_u = smaller(radius * inverse_distance, all(1)),
                 cos_u = root(1 - sin_u * sin_u);

    // Angle between the nearest possible emitter normal and the direction to the point.
    const Float4 cos_spread = load(bounds.cos_spread), sin_spread = load(bounds.sin_spread),
                 cos_emission = load(bounds.cos_emission);
    const Float4 along =
        (load(bounds.axis_x) * x + load(bounds.axis_y) * y + load(bounds.axis_z) * z) *
        inverse_distance;
    const Float4 cos_w = larger(smaller(along, all(1)), all(-1)), sin_w = root(1 - cos_w * cos_w);
    const Float4 cos_x = cos_difference(sin_w, cos_w, sin_spread, cos_spread);
    const Float4 sin_x = sin_difference(sin_w, cos_w, sin_spread, cos_spread);
    const Float4 emitter_bound = cos_difference(sin_x, cos_x, sin_u, cos_u);
    const Float4 emitter_center = cos_x > cos_emission ? cos_x : all(0);
    Float4 factor = larger(0.5F * (emitter_bound + emitter_center), all(kMinCosine));
    factor = emitter_bound < cos_emission - kCosineSlack ? all(0) : factor;

    // Angle between the surface's normal and the nearest possible direction to a light.
    if (!(normal == Vec3f{})) {
        const Float4 facing = -(normal.x * x + normal.y * y + normal.z * z) * inverse_distance;
        const Float4 cos_i = larger(smaller(facing, all(1)), all(-1)),
                     sin_i = root(1 - cos_i * cos_i);
        const Float4 receiver_bound = cos_difference(sin_i, cos_i, sin_u, cos_u);
        const Float4 receiver = 0.5F * (receiver_bound + larger(cos_i, all(0)));
        factor *= receiver_bound < all(-kCosineSlack) ? all(0) : larger(receiver, all(kMinCosine));
    }

    // Within the bounding sphere nothing is known about directions.
    const Float4 inside = intensity / radius_squared;
    const Float4 outside = intensity * factor / larger(distance_squared, radius_squared);
    return smaller(distance_squared <= radius_squared ? inside : outside, all(kMaxImportance));
}

LightSampler::Weights LightSampler::weigh(const Node& node, Vec3f position,
                                          Vec3f normal) const noexcept {
    Weights out;
    const std::span<const Bounds4> bounds(bounds_.data() + node.first_bounds,
                                          (node.n_branches + kLanes - 1) / kLanes);
    std::array<Float4, kBranches / kLanes> weights;
    Float4 sum{};
    for (std::size_t i = 0; i < bounds.size(); ++i)
        sum += weights[i] = importance(bounds[i], position, normal);
    // What can contribute stays well within the resolution of a random float.
    const Float4 least = all(sum_of(sum) * kMinBranch);
    sum = Float4{};
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const Float4 of = weights[i] > 0 ? larger(weights[i], least) : all(0);
        store(of, out.of.data() + i * kLanes);
        sum += of;
    }
    out.sum = sum_of(sum);
    return out;
}

LightSampler::Weights LightSampler::weigh_root(Vec3f position, Vec3f normal) const noexcept {
    return nodes_.empty() ? Weights{} : weigh(nodes_[0], position, normal);
}

float LightSampler::importance(const Infinite& light, Vec3f normal) noexcept {
    if (normal == Vec3f{}) return light.irradiance;
    const float cos_i = std::clamp(-dot(normal, light.axis), -1.0F, 1.0F);
    const float cos_receiver =
        cos_i > light.cos_spread ? 1 : cos_i * light.cos_spread + sine(cos_i) * light.sin_spread;
    if (cos_receiver < -kCosineSlack) return 0;
    return std::min(light.irradiance * std::max(cos_receiver, kMinCosine), kMaxImportance);
}

float LightSampler::infinite_importance(Vec3f normal) const noexcept {
    float sum = 0;
    for (const Infinite& light : infinite_)
        sum += importance(light, normal);
    return sum;
}

float LightSampler::tree_probability(float tree, float infinite) noexcept {
    if (!(tree > 0)) return 0;
    if (!(infinite > 0)) return 1;
    return kMinShare + (1 - 2 * kMinShare) * (tree / (tree + infinite));
}

LightPick LightSampler::pick(Vec3f position, Vec3f normal, float u) const noexcept {
    if (lone_ != kNone) return {lone_, 1, u};
    const Weights root = weigh_root(position, normal);
    const float infinite = infinite_.empty() ? 0 : infinite_importance(normal);
    const float p_tree = tree_probability(root.sum, infinite);
    if (u < p_tree) return pick_finite(position, normal, root, {0, p_tree, stretch(u, 0, p_tree)});
    if (!(infinite > 0)) return {0, 0, u};
    return pick_infinite(normal, infinite, {0, 1 - p_tree, stretch(u, p_tree, 1 - p_tree)});
}

LightPick LightSampler::pick_finite(Vec3f position, Vec3f normal, Weights weights,
                                    LightPick so_far) const noexcept {
    std::uint32_t index = 0;
    // The parent's bound may have been too crude: then no branch can send anything.
    while (weights.sum > 0) {
        const Node& node = nodes_[index];
        const float target = so_far.u * weights.sum;
        std::size_t chosen = 0;
        float before = 0, low = 0;
        for (std::size_t i = 0; i < node.n_branches; ++i) {
            if (!(weights.of[i] > 0)) continue;
            // The last branch that can contribute also takes what rounding leaves over.
            chosen = i;
            low = before;
            before += weights.of[i];
            if (target < before) break;
        }
        so_far.probability *= weights.of[chosen] / weights.sum;
        so_far.u = stretch(target, low, weights.of[chosen]);
        const std::uint32_t below = node.branches[chosen];
        if ((below & kLeaf) != 0) {
            so_far.light = below & ~kLeaf;
            return so_far;
        }
        index = below;
        weights = weigh(nodes_[index], position, normal);
    }
    return {0, 0, so_far.u};
}

LightPick LightSampler::pick_infinite(Vec3f normal, float sum, LightPick so_far) const noexcept {
    LightPick out{0, 0, so_far.u};
    float before = 0;
    for (const Infinite& light : infinite_) {
        const float p = importance(light, normal) / sum;
        if (!(p > 0)) continue;
        // The last one that can contribute also takes what rounding leaves over.
        out = {light.light, so_far.probability * p, stretch(so_far.u, before, p)};
        before += p;
        if (so_far.u < before) break;
    }
    return out;
}

float LightSampler::probability(Vec3f position, Vec3f normal, std::uint32_t light) const noexcept {
    if (light >= places_.size() || places_[light].kind == Place::Kind::Absent) return 0;
    if (lone_ != kNone) return 1;
    const Place& place = places_[light];
    const Weights root = weigh_root(position, normal);
    const float infinite = infinite_.empty() ? 0 : infinite_importance(normal);
    const float p_tree = tree_probability(root.sum, infinite);
    if (place.kind == Place::Kind::Infinite)
        return infinite > 0
                   ? (1 - p_tree) * (importance(infinite_[place.index], normal) / infinite)
                   : 0;

    // Collect the way up, then multiply on the way down, in the order of `pick`.
    std::array<Place, kMaxDepth> way;
    std::size_t depth = 0;
    for (std::uint32_t node = place.index, branch = place.branch; node != kNone;) {
        way[depth++] = {Place::Kind::Tree, node, branch};
        branch = nodes_[node].parent_branch;
        node = nodes_[node].parent;
    }
    float p = p_tree;
    while (depth > 0 && p > 0) {
        const Place& at = way[--depth];
        const Weights weights = at.index == 0 ? root : weigh(nodes_[at.index], position, normal);
        p = weights.sum > 0 ? p * (weights.of[at.branch] / weights.sum) : 0;
    }
    return p;
}

}  // namespace lightsieve
