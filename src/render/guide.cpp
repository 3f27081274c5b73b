#include "render/guide.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"

namespace lightsieve {
namespace {

/// A quadrant with more of a tree's weight than this is divided. Source: Mueller et al. 2017, section 3.2.
constexpr float kLargestShare = 0.01F;
/// Light that is added at once: millions of times that is not more than a float can hold.
constexpr float kMostWeight = 1e28F;
/// Leaves of the quadtree are no smaller than 4 pi / 4^16, a tenth of the sun's disc.
constexpr int kMostLevels = 16;
/// Cells are no smaller than the scene's extent / 2^(48 / 3).
constexpr unsigned kMostSplits = 48;

/// The half of [0,1) that `u` is in, of which the lower one has weight `low` of `total`; u becomes a number of its own again.
bool choose_upper(float& u, float low, float total) {
    const float split = low / total;
    if (u < split) {
        u = std::min(u / split, kOneMinusEpsilon);
        return false;
    }
    u = std::min((u - split) / (1 - split), kOneMinusEpsilon);
    return true;
}

/// Surfaces are told apart by the axis that they face most, and its sign.
constexpr std::uint32_t kFacings = 6;

std::uint32_t facing_of(Vec3f n) {
    const Vec3f size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return static_cast<std::uint32_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

/// The lower 16 digits of a binary number, two apart.
constexpr std::uint64_t spread_digits(std::uint64_t v) {
    v = (v | v << 16U) & 0x0000'0000'ff00'00ffU;
    v = (v | v << 8U) & 0x0000'00f0'0f00'f00fU;
    v = (v | v << 4U) & 0x0000'0c30'c30c'30c3U;
    return (v | v << 2U) & 0x0000'2492'4924'9249U;
}

/// Which half of the unit cube the point lies in, by x; which half of that, by y; then by z, and again by x: kMostSplits
/// binary digits.
std::uint64_t digits_in_turns(Vec3f p) {
    const auto digits = [](float v) {
        constexpr float kEnd = 0x1p16F;
        return spread_digits(v > 0 ? static_cast<std::uint32_t>(std::min(v * kEnd, kEnd - 1)) : 0);
    };
    return digits(p.x) << 2U | digits(p.y) << 1U | digits(p.z);
}

/// The quadrant of the unit square that the point lies in; the point moves on to the quadrant's own square.
std::size_t enter_quadrant(Vec2f& p) {
    const bool right = p.x >= 0.5F, upper = p.y >= 0.5F;
    p = {2 * p.x - (right ? 1.0F : 0.0F), 2 * p.y - (upper ? 1.0F : 0.0F)};
    return (right ? 1U : 0U) + (upper ? 2U : 0U);
}

}  // namespace

Vec2f square_from_direction(Vec3f d) {
    const float turn = std::atan2(d.y, d.x) * (0.5F * kInvPi);
    return {std::clamp(0.5F * (d.z + 1), 0.0F, kOneMinusEpsilon),
            std::clamp(turn < 0 ? turn + 1 : turn, 0.0F, kOneMinusEpsilon)};
}

Vec3f direction_from_square(Vec2f p) {
    const float z = 2 * p.x - 1, radius = safe_sqrt(1 - z * z), angle = 2 * kPi * p.y;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

Vec3f DirectionTree::sample(Vec2f u) const {
    Vec2f corner{0, 0};
    float size = 1;
    for (const Node* node = nodes_.data();;) {
        const auto& w = node->weight;
        const bool right = choose_upper(u.x, w[0] + w[2], node->total());
        const std::size_t column = right ? 1 : 0;
        const bool upper = choose_upper(u.y, w[column], w[column] + w[column + 2]);
        size *= 0.5F;
        corner = corner + Vec2f{right ? size : 0, upper ? size : 0};
        const std::uint32_t child = node->child[column + (upper ? 2 : 0)];
        if (child == 0) return direction_from_square(corner + u * size);
        node = &nodes_[child];
    }
}

float DirectionTree::pdf(Vec3f direction) const {
    // A quadrant weighs what lies in it, so the leaf and the whole tell the density.
    const Vec2f p = square_from_direction(direction);
    auto x = static_cast<std::uint32_t>(p.x * 0x1p24F),
         y = static_cast<std::uint32_t>(p.y * 0x1p24F);
    float leaves = 0.25F * kInvPi;  // like this one, per solid angle
    for (const Node* node = nodes_.data();; x <<= 1U, y <<= 1U) {
        const std::size_t q = ((x >> 23U) & 1U) | ((y >> 22U) & 2U);
        leaves *= 4;
        if (node->child[q] == 0) return leaves * (node->weight[q] / total());
        node = &nodes_[node->child[q]];
    }
}

float DirectionTree::leaf_size(Vec2f p) const {
    float size = 0.5F;
    for (std::uint32_t node = 0;; size *= 0.5F) {
        node = nodes_[node].child[enter_quadrant(p)];
        if (node == 0) return size;
    }
}

float DirectionTree::add_box(std::uint32_t index, Vec2f corner, float size, Vec2f low, Vec2f high,
                             float density) {
    const float half = 0.5F * size;
    float sum = 0;
    for (std::size_t q = 0; q < 4; ++q) {
        const Vec2f at = corner + Vec2f{(q & 1U) != 0 ? half : 0, (q & 2U) != 0 ? half : 0};
        const float width = std::min(high.x, at.x + half) - std::max(low.x, at.x),
                    height = std::min(high.y, at.y + half) - std::max(low.y, at.y);
        if (!(width > 0) || !(height > 0)) continue;
        const std::uint32_t child = nodes_[index].child[q];
        const float w =
            child != 0 ? add_box(child, at, half, low, high, density) : width * height * density;
        nodes_[index].weight[q] += w;
        sum += w;
    }
    return sum;
}

void DirectionTree::add(Vec2f p, float weight) {
    const float size = leaf_size(p), half = 0.5F * size;
    // What would stick out at the poles is pushed back; around the axis the square is closed.
    p.x = std::clamp(p.x, half, 1 - half);
    const Vec2f low = p - Vec2f{half, half}, high = p + Vec2f{half, half};
    const float density = std::min(weight, kMostWeight) / (size * size);
    for (const float turn : {0.0F, 1.0F, -1.0F})
        if (low.y + turn < 1 && high.y + turn > 0)
            add_box(0, {0, 0}, 1, low + Vec2f{0, turn}, high + Vec2f{0, turn}, density);
}

float DirectionTree::take_roots(std::uint32_t index, float area) {
    float sum = 0;
    for (std::size_t q = 0; q < 4; ++q) {
        const std::uint32_t child = nodes_[index].child[q];
        const float w = child != 0 ? take_roots(child, 0.25F * area)
                                   : std::sqrt(nodes_[index].weight[q] * area);
        nodes_[index].weight[q] = w;
        sum += w;
    }
    return sum;
}

DirectionTree DirectionTree::uniform() {
    DirectionTree even;
    even.nodes_[0].weight.fill(1);
    return even.refined();
}

DirectionTree DirectionTree::refined() const {
    DirectionTree out;
    const float all = total();
    if (all > 0) refine(out, 0, nodes_.data(), nodes_[0].weight, all, 1);
    return out;
}

/// Divides the quadrants of `out`'s node `to`, as `from` is divided, and further where a leaf of it is too heavy.
///
/// from    the same node of this tree, or null where it has none
/// weight  of the quadrants
void DirectionTree::refine(DirectionTree& out, std::uint32_t to, const Node* from,
                           const std::array<float, 4>& weight, float all, int depth) const {
    if (depth >= kMostLevels) return;
    for (std::size_t q = 0; q < 4; ++q) {
        if (!(weight[q] > kLargestShare * all)) continue;
        const auto child = static_cast<std::uint32_t>(out.nodes_.size());
        out.nodes_.emplace_back();
        out.nodes_[to].child[q] = child;
        const Node* below =
            from != nullptr && from->child[q] != 0 ? &nodes_[from->child[q]] : nullptr;
        std::array<float, 4> parts{};
        parts.fill(0.25F * weight[q]);
        refine(out, child, below, below != nullptr ? below->weight : parts, all, depth + 1);
    }
}

Guide::Guide(const Box3f& bounds) : bounds_(bounds), cells_(kFacings) {
    for (std::uint32_t i = 0; i < kFacings; ++i)
        nodes_.push_back({0, i});
    const Vec3f size = bounds.size();
    const float extent = std::max({size.x, size.y, size.z});
    const Vec3f half = Vec3f{extent, extent, extent} * 0.5F;
    bounds_ = {bounds.center() - half, bounds.center() + half};
    per_extent_ = extent > 0 ? Vec3f{1, 1, 1} * (1 / extent) : Vec3f{};
}

std::uint32_t Guide::cell_at(Vec3f position, Vec3f normal) const {
    const Vec3f p = position - bounds_.lower;
    std::uint64_t halves =
        digits_in_turns({p.x * per_extent_.x, p.y * per_extent_.y, p.z * per_extent_.z});
    const Node* node = &nodes_[facing_of(normal)];
    for (; node->children != 0; halves <<= 1U)
        node = &nodes_[node->children + ((halves >> (kMostSplits - 1U)) & 1U)];
    return node->cell;
}

void Guide::split(std::uint64_t most) {
    const std::size_t n = nodes_.size();
    std::vector<unsigned> depth(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        // Children stand behind their parents.
        if (nodes_[i].children == 0) {
            split(i, most, depth[i]);
            continue;
        }
        depth[nodes_[i].children] = depth[nodes_[i].children + 1] = depth[i] + 1;
    }
}

void Guide::split(std::uint32_t index, std::uint64_t most, unsigned depth) {
    const std::uint32_t cell = nodes_[index].cell;
    if (cells_[cell].n_records <= most || depth >= kMostSplits || cells_.size() >= kMostCells)
        return;
    cells_[cell].n_records /= 2;
    const auto copy = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(Cell(cells_[cell]));
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({0, cell});
    nodes_.push_back({0, copy});
    nodes_[index].children = children;
    split(children, most, depth + 1);
    split(children + 1, most, depth + 1);
}

bool Guide::guides() const {
    return std::ranges::any_of(
        cells_, [](const Cell& cell) { return cell.share > 0 && !cell.tree.empty(); });
}

std::size_t Guide::memory() const {
    std::size_t n = nodes_.capacity() * sizeof(Node) + cells_.capacity() * sizeof(Cell);
    for (const Cell& cell : cells_)
        n += cell.tree.memory();
    return n;
}

}  // namespace lightsieve
