#include "io/volume_grid.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "io/volume_reader.h"
#include "io/volume_tree.h"

namespace lightsieve {

namespace {

/// Axes of voxels that span less than this part of the product of their lengths are taken for lying in a plane.
constexpr double kMinDeterminant = 1e-9;
/// Bounds on rounding, in parts of the numbers that are added up: far above a double's, far below a voxel's width.
constexpr double kRounding = 1e-12;

/// Numbers of transforms beyond this, and voxels shorter than its inverse, are a sign of damage; products of such numbers
/// stay far within the range of a double.
constexpr double kMaxTransform = 1e30;

using Vec3 = std::array<double, 3>;

Vec3 to_double(Vec3f p) { return {p.x, p.y, p.z}; }

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// Object space to numbers of voxels: p -> (dot(row[i], p) + shift[i]).
struct IndexFromObject {
    std::array<Vec3, 3> row{};
    Vec3 shift{};

    [[nodiscard]] Vec3 point(const Vec3& p) const {
        return {dot(row[0], p) + shift[0], dot(row[1], p) + shift[1], dot(row[2], p) + shift[2]};
    }
};

/// The inverse of a grid's transform; empty if there is none, or its numbers make no sense.
std::optional<IndexFromObject> inverse(const VolumeTransform& m) {
    for (const auto& row : m)
        for (const double x : row)
            if (!(std::abs(x) < kMaxTransform)) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
        if (!(length(m[i]) > 1 / kMaxTransform)) return std::nullopt;
    const double lengths = length(m[0]) * length(m[1]) * length(m[2]);
    const double determinant = dot(m[0], cross(m[1], m[2]));
    if (!(std::abs(determinant) > kMinDeterminant * lengths)) return std::nullopt;
    IndexFromObject out;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 normal = cross(m[(i + 1) % 3], m[(i + 2) % 3]);
        for (std::size_t j = 0; j < 3; ++j)
            out.row[i][j] = normal[j] / determinant;
        out.shift[i] = -dot(out.row[i], m[3]);
    }
    return out;
}

/// Object-space box of voxels with half a voxel around, rounded outward.
Box3f object_bounds(const VoxelBox& voxels, const VolumeTransform& m) {
    Box3f box;
    if (voxels.empty()) return box;
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vec3 p = m[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const double index = (corner >> i & 1U) != 0
                                     ? static_cast<double>(voxels.upper[i]) + 0.5
                                     : static_cast<double>(voxels.lower[i]) - 0.5;
            for (std::size_t j = 0; j < 3; ++j)
                p[j] += m[i][j] * index;
        }
        box.grow(
            Vec3f{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    for (int i = 0; i < 3; ++i) {
        box.lower[i] = std::nextafter(box.lower[i], -kInfinity);
        box.upper[i] = std::nextafter(box.upper[i], kInfinity);
    }
    return box;
}

Color color_of(float v) { return Color::grey(v); }
Color color_of(Color v) { return v; }

[[noreturn]] void unusable(const std::string& path, const std::string& name,
                           const std::string& why) {
    throw InputError(Error{Code::VolumeGrid,
                           "grid \"" + name + "\" of \"" + path + "\" cannot be used: " + why,
                           {},
                           "leave it out, or write it again",
                           {},
                           Severity::Error});
}

/// A grid, ready for look-ups.
struct Grid {
    VolumeGrids::Info info;
    IndexFromObject index_from_object;
    std::variant<VolumeTree<float>, VolumeTree<nanovdb::Vec3f>> tree;
};

template <class Build>
VolumeTree<Build> take_tree(const std::string& path, const std::string& name,
                            VolumeBlock&& block) {
    std::string problem;
    std::optional<VolumeTree<Build>> tree = VolumeTree<Build>::take(std::move(block), problem);
    if (!tree) unusable(path, name, problem);
    return *std::move(tree);
}

Grid make_grid(const std::string& path, RawVolumeGrid&& raw) {
    const std::optional<IndexFromObject> index_from_object = inverse(raw.object_from_index);
    if (!index_from_object)
        unusable(path, raw.name, "its transform has no inverse, or numbers beyond all measure");
    VoxelBox active;
    const auto keep_active = [&](auto tree) {
        active = tree.active();
        return Grid{{}, *index_from_object, std::move(tree)};
    };
    Grid grid = raw.n_channels == 1
                    ? keep_active(take_tree<float>(path, raw.name, std::move(raw.block)))
                    : keep_active(take_tree<nanovdb::Vec3f>(path, raw.name, std::move(raw.block)));
    grid.info.name = Name(raw.name);
    grid.info.vector = raw.n_channels == 3;
    grid.info.bounds = object_bounds(active, raw.object_from_index);
    if (!grid.info.bounds.empty() &&
        !(is_finite(grid.info.bounds.lower) && is_finite(grid.info.bounds.upper)))
        unusable(path, raw.name, "it lies beyond the range of numbers");
    grid.info.voxel_size = static_cast<float>(
        std::min({length(raw.object_from_index[0]), length(raw.object_from_index[1]),
                  length(raw.object_from_index[2])}));
    return grid;
}

/// Numbers of all voxels that look-ups in an object-space box may take: those around it, two to each side.
VoxelBox voxels_for(const IndexFromObject& index_from_object, const Box3f& box) {
    const Vec3 lower = to_double(box.lower), upper = to_double(box.upper);
    VoxelBox voxels;
    for (std::size_t i = 0; i < 3; ++i) {
        double low = index_from_object.shift[i], high = low, scale = std::abs(low);
        for (std::size_t j = 0; j < 3; ++j) {
            const double a = index_from_object.row[i][j] * lower[j];
            const double b = index_from_object.row[i][j] * upper[j];
            low += std::min(a, b);
            high += std::max(a, b);
            scale += std::max(std::abs(a), std::abs(b));
        }
        // Points far away have the background's value, as has everything beyond the first voxels of the clamped range.
        constexpr auto kFar = static_cast<double>(2 * kMaxVoxel);
        const double slack = scale * kRounding;
        voxels.lower[i] =
            static_cast<std::int64_t>(std::floor(std::clamp(low - slack, -kFar, kFar)) - 1);
        voxels.upper[i] =
            static_cast<std::int64_t>(std::floor(std::clamp(high + slack, -kFar, kFar)) + 2);
    }
    return voxels;
}

}  // namespace

struct VolumeGrids::State {
    std::vector<Grid> grids;
    std::vector<Info> infos;
    Box3f bounds;
    double load_seconds = 0;
};

/// Makes VolumeGrids, whose constructor is private.
struct VolumeLoader {
    static std::shared_ptr<const VolumeGrids> load(const std::string& path,
                                                   std::vector<RawVolumeGrid>&& raw,
                                                   std::chrono::steady_clock::time_point start) {
        auto state = std::make_unique<VolumeGrids::State>();
        for (RawVolumeGrid& grid : raw) {
            state->grids.push_back(make_grid(path, std::move(grid)));
            state->infos.push_back(state->grids.back().info);
            state->bounds.grow(state->infos.back().bounds);
        }
        state->load_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::shared_ptr<const VolumeGrids>(new VolumeGrids(std::move(state)));
    }
};

VolumeGrids::VolumeGrids(std::unique_ptr<State> state) : state_(std::move(state)) {}
VolumeGrids::~VolumeGrids() = default;

std::span<const VolumeGrids::Info> VolumeGrids::grids() const { return state_->infos; }

int VolumeGrids::find(Name name) const {
    for (std::size_t i = 0; i < state_->infos.size(); ++i)
        if (state_->infos[i].name == name) return static_cast<int>(i);
    return -1;
}

Box3f VolumeGrids::bounds() const { return state_->bounds; }

Color VolumeGrids::sample(int grid, Vec3f object_position,
                          VolumeInterpolation interpolation) const noexcept {
    const Grid& g = state_->grids[static_cast<std::size_t>(grid)];
    const Vec3 index = g.index_from_object.point(to_double(object_position));
    const auto look_up = [&](const auto& tree) {
        for (const double x : index)
            if (!(std::abs(x) <= static_cast<double>(kMaxVoxel)))
                return color_of(tree.background());
        return color_of(tree.sample(index, interpolation));
    };
    if (const auto* scalars = std::get_if<0>(&g.tree)) return look_up(*scalars);
    return look_up(*std::get_if<1>(&g.tree));
}

Color VolumeGrids::maximum(int grid, const Box3f& object_box) const noexcept {
    const Grid& g = state_->grids[static_cast<std::size_t>(grid)];
    // Comparisons are false for what is not a number, which thus becomes everything.
    constexpr float kFarthest = std::numeric_limits<float>::max();
    Box3f box = object_box;
    for (int i = 0; i < 3; ++i) {
        box.lower[i] = box.lower[i] >= -kFarthest ? std::min(box.lower[i], kFarthest) : -kFarthest;
        box.upper[i] = box.upper[i] <= kFarthest ? std::max(box.upper[i], -kFarthest) : kFarthest;
    }
    const VoxelBox voxels = voxels_for(g.index_from_object, box);
    if (const auto* scalars = std::get_if<0>(&g.tree)) return color_of(scalars->maximum(voxels));
    return color_of(std::get_if<1>(&g.tree)->maximum(voxels));
}

std::size_t VolumeGrids::memory() const {
    std::size_t n = sizeof(State);
    for (const Grid& grid : state_->grids)
        n += sizeof(Grid) + sizeof(Info) +
             std::visit([](const auto& tree) { return tree.memory(); }, grid.tree);
    return n;
}

double VolumeGrids::load_seconds() const { return state_->load_seconds; }

std::shared_ptr<const VolumeGrids> load_volume_with(const std::string& reader,
                                                    const std::string& path,
                                                    std::span<const std::string> names,
                                                    const VolumeLimits& limits) {
    const auto start = std::chrono::steady_clock::now();
    return VolumeLoader::load(path, run_volume_reader(reader, path, names, limits), start);
}

std::shared_ptr<const VolumeGrids> load_volume(const std::string& path,
                                               std::span<const std::string> names,
                                               const VolumeLimits& limits) {
    return load_volume_with(volume_reader_path(), path, names, limits);
}

}  // namespace lightsieve
