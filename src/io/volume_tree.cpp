#include "io/volume_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightsieve {

namespace {

/// Larger magnitudes are brought here, so that differences and products of values stay finite.
constexpr float kMaxValue = 1e30F;
/// Memory of a grid for each cell of maxima at the finest level [bytes]: a full leaf has 2 or 6 kB, so cells cost little, and
/// all leaves have cells of their own unless less than one in 30 is there.
constexpr std::size_t kBytesPerCell = 64;
/// A table of this size always fits; more cells than the second number are never made.
constexpr std::size_t kMinCells = 4096, kMaxCells = std::size_t{1} << 24;
/// Cells along an axis that one look-up of a maximum visits at most.
constexpr std::int64_t kMaxCellsAcross = 4;

float value_of(float v) { return v; }
Color value_of(const nanovdb::Vec3f& v) { return {v[0], v[1], v[2]}; }

float max_of(float a, float b) { return std::max(a, b); }
float min_of(float a, float b) { return std::min(a, b); }
Color max_of(Color a, Color b) {
    return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}
Color min_of(Color a, Color b) {
    return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)};
}
bool any_above(float a, float b) { return a > b; }
bool any_above(Color a, Color b) { return a.r > b.r || a.g > b.g || a.b > b.b; }

void make_sane(float& v) { v = std::isfinite(v) ? std::clamp(v, -kMaxValue, kMaxValue) : 0; }
void make_sane(nanovdb::Vec3f& v) {
    for (int i = 0; i < 3; ++i)
        make_sane(v[i]);
}

/// Never outside of [a,b], whatever rounding does: maxima are bounds for interpolated values too.
template <class Value>
Value between(const Value& a, const Value& b, float t) {
    return min_of(max_of(lerp(a, b, t), min_of(a, b)), max_of(a, b));
}

/// Catmull-Rom weights. Source: Keys 1981, "Cubic Convolution Interpolation for Digital Image Processing", eq. 15 (a = -1/2).
std::array<float, 4> cubic_weights(float t) {
    return {t * (-0.5F + t * (1 - 0.5F * t)), 1 + t * t * (-2.5F + 1.5F * t),
            t * (0.5F + t * (2 - 1.5F * t)), t * t * (-0.5F + 0.5F * t)};
}

/// Keys of the root's table, as in nanovdb::RootData::CoordToKey.
std::uint64_t root_key(int x, int y, int z) {
    const auto part = [](int c) { return std::uint64_t{static_cast<std::uint32_t>(c) >> 12U}; };
    return part(z) | (part(y) << 21U) | (part(x) << 42U);
}
std::array<std::int64_t, 3> root_origin(std::uint64_t key) {
    const auto part = [key](unsigned shift) {
        return std::int64_t{static_cast<std::int32_t>(
            static_cast<std::uint32_t>((key >> shift) & 0xFFFFFU) << 12U)};
    };
    return {part(42), part(21), part(0)};
}

/// The cube of width 2^log2 whose first voxel is `origin`.
VoxelBox cube(const std::array<std::int64_t, 3>& origin, int log2) {
    const std::int64_t last = (std::int64_t{1} << log2) - 1;
    return {origin, {origin[0] + last, origin[1] + last, origin[2] + last}};
}

/// The n-th of the (2^log2)^3 children of a node, each of width 2^child_log2; z is the fastest.
std::array<std::int64_t, 3> child_origin(const std::array<std::int64_t, 3>& origin,
                                         std::uint32_t n, int log2, int child_log2) {
    const std::uint32_t mask = (1U << log2) - 1;
    return {origin[0] + (std::int64_t{n >> (2 * log2)} << child_log2),
            origin[1] + (std::int64_t{(n >> log2) & mask} << child_log2),
            origin[2] + (std::int64_t{n & mask} << child_log2)};
}

}  // namespace

void VoxelBox::grow(const VoxelBox& box) {
    for (std::size_t i = 0; i < 3; ++i) {
        lower[i] = std::min(lower[i], box.lower[i]);
        upper[i] = std::max(upper[i], box.upper[i]);
    }
}

bool VoxelBox::contains(const VoxelBox& box) const {
    for (std::size_t i = 0; i < 3; ++i)
        if (box.lower[i] < lower[i] || box.upper[i] > upper[i]) return false;
    return true;
}

template <class Value>
MaximumPyramid<Value>::MaximumPyramid(const VoxelBox& box, const Value& background,
                                      std::size_t max_cells)
    : box_(box), background_(background) {
    if (box.empty()) return;
    for (;; ++cell_log2_) {
        // Double: with the finest cells the product of three sizes may be beyond any integer.
        double n = 1;
        for (std::size_t i = 0; i < 3; ++i)
            n *= static_cast<double>((box.upper[i] >> cell_log2_) - (box.lower[i] >> cell_log2_) +
                                     1);
        if (n <= static_cast<double>(max_cells)) break;
    }
    Level finest;
    std::size_t n = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        origin_[i] = box.lower[i] >> cell_log2_;
        finest.size[i] = (box.upper[i] >> cell_log2_) - origin_[i] + 1;
        n *= static_cast<std::size_t>(finest.size[i]);
    }
    finest.cells.assign(n, background);
    levels_.push_back(std::move(finest));
}

template <class Value>
VoxelBox MaximumPyramid<Value>::cells_of(const VoxelBox& box, int level) const noexcept {
    VoxelBox cells;
    for (std::size_t i = 0; i < 3; ++i) {
        cells.lower[i] = ((box.lower[i] >> cell_log2_) - origin_[i]) >> level;
        cells.upper[i] = ((box.upper[i] >> cell_log2_) - origin_[i]) >> level;
    }
    return cells;
}

template <class Value>
void MaximumPyramid<Value>::raise(const VoxelBox& box, const Value& value) {
    const VoxelBox range = cells_of(box, 0);
    Level& level = levels_.front();
    for (std::int64_t x = range.lower[0]; x <= range.upper[0]; ++x)
        for (std::int64_t y = range.lower[1]; y <= range.upper[1]; ++y)
            for (std::int64_t z = range.lower[2]; z <= range.upper[2]; ++z) {
                Value& cell = level.cells[level.at({x, y, z})];
                cell = max_of(cell, value);
            }
}

template <class Value>
void MaximumPyramid<Value>::build_levels() {
    while (!levels_.empty() && levels_.back().cells.size() > 1) {
        const Level& fine = levels_.back();
        Level coarse;
        for (std::size_t i = 0; i < 3; ++i)
            coarse.size[i] = (fine.size[i] + 1) / 2;
        coarse.cells.assign(
            static_cast<std::size_t>(coarse.size[0] * coarse.size[1] * coarse.size[2]),
            background_);
        for (std::int64_t x = 0; x < fine.size[0]; ++x)
            for (std::int64_t y = 0; y < fine.size[1]; ++y)
                for (std::int64_t z = 0; z < fine.size[2]; ++z) {
                    Value& cell = coarse.cells[coarse.at({x / 2, y / 2, z / 2})];
                    cell = max_of(cell, fine.cells[fine.at({x, y, z})]);
                }
        levels_.push_back(std::move(coarse));
    }
}

template <class Value>
Value MaximumPyramid<Value>::maximum(const VoxelBox& box) const noexcept {
    // What lies outside has the background's value, which every cell starts from.
    VoxelBox inside;
    for (std::size_t i = 0; i < 3; ++i) {
        inside.lower[i] = std::max(box.lower[i], box_.lower[i]);
        inside.upper[i] = std::min(box.upper[i], box_.upper[i]);
        if (inside.lower[i] > inside.upper[i]) return background_;
    }
    // Take the finest level at which few cells cover the box.
    int level = 0;
    VoxelBox range = cells_of(inside, level);
    const auto too_many = [](const VoxelBox& cells) {
        for (std::size_t i = 0; i < 3; ++i)
            if (cells.upper[i] - cells.lower[i] >= kMaxCellsAcross) return true;
        return false;
    };
    while (too_many(range))
        range = cells_of(inside, ++level);
    const Level& cells = levels_[static_cast<std::size_t>(level)];
    Value result = background_;
    for (std::int64_t x = range.lower[0]; x <= range.upper[0]; ++x)
        for (std::int64_t y = range.lower[1]; y <= range.upper[1]; ++y)
            for (std::int64_t z = range.lower[2]; z <= range.upper[2]; ++z)
                result = max_of(result, cells.cells[cells.at({x, y, z})]);
    return result;
}

template <class Value>
std::size_t MaximumPyramid<Value>::memory() const {
    std::size_t n = 0;
    for (const Level& level : levels_)
        n += level.cells.size() * sizeof(Value);
    return n;
}

/// Walks over a block that nobody has checked: every node and every tile once.
///
/// Nodes may not overlap what a sound block of this size can hold: their number is bounded by it, so that offsets that lead
/// many times to one place end the walk.
template <class Build>
class TreeWalk {
  public:
    using Tree = VolumeTree<Build>;
    using Root = nanovdb::NanoRoot<Build>;
    using Upper = nanovdb::NanoUpper<Build>;
    using Lower = nanovdb::NanoLower<Build>;
    using Leaf = nanovdb::NanoLeaf<Build>;
    using Origin = std::array<std::int64_t, 3>;

    explicit TreeWalk(std::span<std::byte> bytes)
        : bytes_(bytes), nodes_left_(bytes.size() / sizeof(Leaf)) {}

    /// Visits `leaf(origin, Leaf::DataType&)` and `tile(origin, log2 of its width, active, Build&)`. False: not sound.
    template <class LeafVisit, class TileVisit>
    bool visit(const LeafVisit& leaf, const TileVisit& tile) {
        auto* root = find_root();
        if (root == nullptr) return false;
        for (std::uint32_t i = 0; i < root->mTableSize; ++i) {
            auto* entry = root->tile(i);
            const Origin origin = root_origin(entry->key);
            if (entry->child == 0) {
                tile(origin, 12, entry->state != 0, entry->value);
                continue;
            }
            auto* upper = node<Upper>(root, entry->child);
            if (upper == nullptr || !visit_upper(*upper, origin, leaf, tile)) return false;
        }
        return true;
    }

    /// The root's data if the head of the block is sound, else null.
    typename Root::DataType* find_root() {
        using nanovdb::GridData;
        using TreeData = nanovdb::TreeData<3>;
        if (bytes_.size() < sizeof(GridData) + sizeof(TreeData)) return nullptr;
        const auto* grid = reinterpret_cast<const GridData*>(bytes_.data());
        if (grid->mMagic != NANOVDB_MAGIC_NUMBER || grid->mGridSize != bytes_.size() ||
            grid->mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER ||
            grid->mGridType != nanovdb::mapToGridType<Build>())
            return nullptr;
        const auto* tree = reinterpret_cast<const TreeData*>(grid + 1);
        using RootData = typename Root::DataType;
        auto* root = node<RootData>(tree, static_cast<std::int64_t>(tree->mNodeOffset[3]));
        if (root == nullptr) return nullptr;
        const std::size_t room = static_cast<std::size_t>(
            bytes_.data() + bytes_.size() - reinterpret_cast<const std::byte*>(root + 1));
        return root->mTableSize <= room / sizeof(typename RootData::Tile) ? root : nullptr;
    }

  private:
    /// The node at an offset from `base`, if it is in the block and aligned.
    template <class Node>
    Node* node(const void* base, std::int64_t offset) {
        const std::int64_t from = reinterpret_cast<const std::byte*>(base) - bytes_.data();
        const auto size = static_cast<std::int64_t>(bytes_.size());
        constexpr auto kAlignment = static_cast<std::int64_t>(kVolumeGridAlignment);
        std::int64_t at = 0;
        if (__builtin_add_overflow(from, offset, &at) || at < 0 ||
            at > size - static_cast<std::int64_t>(sizeof(Node)) || at % kAlignment != 0)
            return nullptr;
        return reinterpret_cast<Node*>(bytes_.data() + at);
    }

    template <class LeafVisit, class TileVisit>
    bool visit_upper(Upper& upper, const Origin& origin, const LeafVisit& leaf,
                     const TileVisit& tile) {
        if (nodes_left_-- == 0) return false;
        auto& data = *upper.data();
        for (std::uint32_t n = 0; n < Upper::SIZE; ++n) {
            const Origin at = child_origin(origin, n, 5, 7);
            if (!data.mChildMask.isOn(n)) {
                tile(at, 7, data.mValueMask.isOn(n), data.mTable[n].value);
                continue;
            }
            auto* lower = node<Lower>(&upper, data.mTable[n].child);
            if (lower == nullptr || !visit_lower(*lower, at, leaf, tile)) return false;
        }
        return true;
    }

    template <class LeafVisit, class TileVisit>
    bool visit_lower(Lower& lower, const Origin& origin, const LeafVisit& leaf,
                     const TileVisit& tile) {
        if (nodes_left_-- == 0) return false;
        auto& data = *lower.data();
        for (std::uint32_t n = 0; n < Lower::SIZE; ++n) {
            const Origin at = child_origin(origin, n, 4, 3);
            if (!data.mChildMask.isOn(n)) {
                tile(at, 3, data.mValueMask.isOn(n), data.mTable[n].value);
                continue;
            }
            auto* child = node<Leaf>(&lower, data.mTable[n].child);
            if (child == nullptr || nodes_left_-- == 0) return false;
            leaf(at, *child->data());
        }
        return true;
    }

    std::span<std::byte> bytes_;
    std::size_t nodes_left_;
};

namespace {

/// Smallest box around the active voxels of a leaf.
template <class LeafData>
VoxelBox active_box(const std::array<std::int64_t, 3>& origin, const LeafData& leaf) {
    VoxelBox box;
    for (std::uint32_t n = 0; n < 512; ++n)
        if (leaf.mValueMask.isOn(n)) {
            const auto at = child_origin(origin, n, 3, 0);
            box.grow({at, at});
        }
    return box;
}

}  // namespace

template <class Build>
std::optional<VolumeTree<Build>> VolumeTree<Build>::take(VolumeBlock&& block,
                                                         std::string& problem) {
    VolumeTree tree;
    tree.block_ = std::move(block);
    const std::span<std::byte> bytes = tree.block_.bytes();
    auto* root = TreeWalk<Build>(bytes).find_root();
    if (root == nullptr) {
        problem = "its head is damaged";
        return std::nullopt;
    }
    make_sane(root->mBackground);
    tree.background_ = value_of(root->mBackground);

    // First check everything, set values right, and find the boxes.
    VoxelBox touched;
    const bool sound = TreeWalk<Build>(bytes).visit(
        [&](const auto& origin, auto& leaf) {
            for (Build& value : leaf.mValues)
                make_sane(value);
            const VoxelBox box = cube(origin, 3);
            touched.grow(box);
            if (!tree.active_.contains(box)) tree.active_.grow(active_box(origin, leaf));
        },
        [&](const auto& origin, int log2, bool active, Build& value) {
            make_sane(value);
            if (!active && value_of(value) == tree.background_) return;
            touched.grow(cube(origin, log2));
            if (active) tree.active_.grow(cube(origin, log2));
        });
    if (!sound || !tree.make_table()) {
        problem = "its tree is damaged";
        return std::nullopt;
    }
    if (!touched.empty() &&
        !VoxelBox{{-kMaxVoxel, -kMaxVoxel, -kMaxVoxel}, {kMaxVoxel, kMaxVoxel, kMaxVoxel}}
             .contains(touched)) {
        problem = "its voxels lie too far from the grid's origin";
        return std::nullopt;
    }

    // Then take the maxima, now that it is known where.
    tree.pyramid_.emplace(touched, tree.background_,
                          std::clamp(bytes.size() / kBytesPerCell, kMinCells, kMaxCells));
    (void)TreeWalk<Build>(bytes).visit(
        [&](const auto& origin, auto& leaf) {
            Value maximum = value_of(leaf.mValues[0]);
            for (const Build& value : leaf.mValues)
                maximum = max_of(maximum, value_of(value));
            tree.pyramid_->raise(cube(origin, 3), maximum);
        },
        [&](const auto& origin, int log2, bool, const Build& value) {
            if (any_above(value_of(value), tree.background_))
                tree.pyramid_->raise(cube(origin, log2), value_of(value));
        });
    tree.pyramid_->build_levels();

    return tree;
}

template <class Build>
bool VolumeTree<Build>::make_table() {
    const auto* root = TreeWalk<Build>(block_.bytes()).find_root();
    for (std::uint32_t i = 0; i < root->mTableSize; ++i) {
        const auto* entry = root->tile(i);
        const auto origin = root_origin(entry->key);
        if (root_key(static_cast<int>(origin[0]), static_cast<int>(origin[1]),
                     static_cast<int>(origin[2])) != entry->key)
            return false;
        table_.push_back({entry->key, entry->child == 0 ? nullptr : root->getChild(entry),
                          value_of(entry->value)});
    }
    std::sort(table_.begin(), table_.end(),
              [](const Entry& a, const Entry& b) { return a.key < b.key; });
    return std::adjacent_find(table_.begin(), table_.end(), [](const Entry& a, const Entry& b) {
               return a.key == b.key;
           }) == table_.end();
}

template <class Build>
std::size_t VolumeTree<Build>::memory() const {
    return block_.bytes().size() + table_.size() * sizeof(Entry) + pyramid_->memory();
}

template <class Build>
typename VolumeTree<Build>::Block VolumeTree<Build>::block_at(int x, int y, int z) const noexcept {
    const std::uint64_t key = root_key(x, y, z);
    const auto entry = std::lower_bound(table_.begin(), table_.end(), key,
                                        [](const Entry& e, std::uint64_t k) { return e.key < k; });
    if (entry == table_.end() || entry->key != key) return {nullptr, background_};
    if (entry->node == nullptr) return {nullptr, entry->value};
    const auto child_number = [&](int log2, int child_log2) {
        const int mask = (1 << log2) - 1;
        const int cx = (x >> child_log2) & mask, cy = (y >> child_log2) & mask,
                  cz = (z >> child_log2) & mask;
        return static_cast<std::uint32_t>((((cx << log2) | cy) << log2) | cz);
    };
    const auto& upper = *entry->node->data();
    const std::uint32_t n = child_number(5, 7);
    if (!upper.mChildMask.isOn(n)) return {nullptr, value_of(upper.mTable[n].value)};
    const auto& lower = *upper.getChild(n)->data();
    const std::uint32_t m = child_number(4, 3);
    if (!lower.mChildMask.isOn(m)) return {nullptr, value_of(lower.mTable[m].value)};
    return {lower.getChild(m)->data()->mValues, {}};
}

/// The N^3 voxels from `base` on, z the fastest.
template <class Build>
template <int N>
void VolumeTree<Build>::gather(const std::array<int, 3>& base, Value* out) const noexcept {
    // Along each axis the voxels lie in one leaf or in two: those before `cut` and those from it on.
    std::array<int, 3> cut{};
    for (std::size_t i = 0; i < 3; ++i)
        cut[i] = std::min(N, 8 - (base[i] & 7));
    const auto copy = [&](const std::array<int, 3>& from, const std::array<int, 3>& to) {
        const Block block = block_at(base[0] + from[0], base[1] + from[1], base[2] + from[2]);
        for (int x = from[0]; x < to[0]; ++x)
            for (int y = from[1]; y < to[1]; ++y)
                for (int z = from[2]; z < to[2]; ++z) {
                    const int voxel = (((base[0] + x) & 7) << 6) | (((base[1] + y) & 7) << 3) |
                                      ((base[2] + z) & 7);
                    out[(x * N + y) * N + z] =
                        block.values == nullptr ? block.constant : value_of(block.values[voxel]);
                }
    };
    for (int part = 0; part < 8; ++part) {
        std::array<int, 3> from{}, to{};
        bool any = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const bool second = ((part >> i) & 1) != 0;
            from[i] = second ? cut[i] : 0;
            to[i] = second ? N : cut[i];
            any = any && from[i] < to[i];
        }
        if (any) copy(from, to);
    }
}

template <class Build>
typename VolumeTree<Build>::Value VolumeTree<Build>::trilinear(
    const std::array<double, 3>& index) const noexcept {
    std::array<int, 3> base{};
    std::array<float, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double floor = std::floor(index[i]);
        base[i] = static_cast<int>(floor);
        t[i] = static_cast<float>(index[i] - floor);
    }
    std::array<Value, 8> v{};
    gather<2>(base, v.data());
    const auto along_z = [&](std::size_t i) { return between(v[i], v[i + 1], t[2]); };
    return between(between(along_z(0), along_z(2), t[1]), between(along_z(4), along_z(6), t[1]),
                   t[0]);
}

template <class Build>
typename VolumeTree<Build>::Value VolumeTree<Build>::tricubic(
    const std::array<double, 3>& index) const noexcept {
    std::array<int, 3> base{};
    std::array<std::array<float, 4>, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double floor = std::floor(index[i]);
        base[i] = static_cast<int>(floor) - 1;
        weights[i] = cubic_weights(static_cast<float>(index[i] - floor));
    }
    std::array<Value, 64> v{};
    gather<4>(base, v.data());
    Value sum{}, low = v[0], high = v[0];
    for (std::size_t x = 0; x < 4; ++x)
        for (std::size_t y = 0; y < 4; ++y) {
            const float weight = weights[0][x] * weights[1][y];
            for (std::size_t z = 0; z < 4; ++z) {
                const Value& value = v[(x * 4 + y) * 4 + z];
                sum = sum + value * (weight * weights[2][z]);
                low = min_of(low, value);
                high = max_of(high, value);
            }
        }
    // Without overshoot: no negative densities, and maxima that hold.
    return min_of(max_of(sum, low), high);
}

template <class Build>
typename VolumeTree<Build>::Value VolumeTree<Build>::sample(
    const std::array<double, 3>& index, VolumeInterpolation interpolation) const noexcept {
    if (interpolation == VolumeInterpolation::Trilinear) return trilinear(index);
    if (interpolation == VolumeInterpolation::Tricubic) return tricubic(index);
    std::array<int, 3> nearest{};
    for (std::size_t i = 0; i < 3; ++i)
        nearest[i] = static_cast<int>(std::floor(index[i] + 0.5));
    Value value{};
    gather<1>(nearest, &value);
    return value;
}

template class VolumeTree<float>;
template class VolumeTree<nanovdb::Vec3f>;

}  // namespace lightsieve
