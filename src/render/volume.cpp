#include "render/volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/placement.h"
#include "render/shader_program.h"
#include "scene/shade_point.h"
#include "scene/volume_lookup.h"

namespace lightsieve {
namespace {

/// Cells of a majorant grid along the longest axis, and voxels that a cell spans at least.
constexpr int kMostCells = 64;
constexpr float kVoxelsPerCell = 8;
/// Cells along the longest axis where only textures say how the medium varies.
constexpr int kTexturedCells = 24;
/// Points at which a cell is asked where textures drive the shader, and how far above the largest answer the bound lies.
constexpr int kProbesPerCell = 9;
constexpr float kProbeMargin = 1.2F;
/// Boundaries of one volume that a ray may cross.
constexpr int kMaxCrossings = 256;
/// Emission is gathered at collisions, so it needs some even where nothing scatters: a cell's width makes this many.
constexpr float kCollisionsForEmission = 1;

VolumeInterpolation to_grid(ChannelInterpolation i) { return static_cast<VolumeInterpolation>(i); }

/// Values at a point.
class PointLookup final : public VolumeLookup {
  public:
    PointLookup(const VolumeGrids& grids, Vec3f position) : grids_(grids), position_(position) {}
    bool channel(Name name, ChannelInterpolation interpolation, Color& value) const override {
        const int grid = grids_.find(name);
        if (grid < 0) return false;
        value = grids_.sample(grid, position_, to_grid(interpolation));
        return true;
    }

  private:
    const VolumeGrids& grids_;
    Vec3f position_;
};

/// The largest values in a cell.
class CellLookup final : public VolumeLookup {
  public:
    CellLookup(const VolumeGrids& grids, const Box3f& box) : grids_(grids), box_(box) {}
    bool channel(Name name, ChannelInterpolation, Color& value) const override {
        const int grid = grids_.find(name);
        if (grid < 0) return false;
        value = grids_.maximum(grid, box_);
        return true;
    }

  private:
    const VolumeGrids& grids_;
    Box3f box_;
};

ShadePoint shade_point(const SceneVolume& volume, Vec3f position, Vec3f wo, float time,
                       RayType ray_type) {
    ShadePoint at;
    at.position = position;
    at.wo = wo;
    at.geometric_normal = at.normal = wo;
    at.direction = -wo;
    at.time = time;
    at.ray_type = ray_type;
    at.shape_id = volume.object.id;
    at.shape = &volume.object;
    at.services = volume.object.services;
    return at;
}

/// Whether a network's answer depends on more than the channels.
bool is_textured(const ShaderProgram& program) {
    return program.is_linked() ||
           std::any_of(program.parts.begin(), program.parts.end(),
                       [](const ShaderProgram* part) { return is_textured(*part); });
}

/// Part of a line in a box. False if there is none.
bool clip(const Box3f& box, const ObjectRay& ray, float& t0, float& t1) {
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis], d = ray.direction[axis];
        if (d == 0) {
            if (o < box.lower[axis] || o > box.upper[axis]) return false;
            continue;
        }
        float a = (box.lower[axis] - o) / d, b = (box.upper[axis] - o) / d;
        if (a > b) std::swap(a, b);
        t0 = std::max(t0, a);
        t1 = std::min(t1, b);
    }
    return t0 < t1;
}

/// The inside of a closed shape: between the crossings of its boundary, counted from the end.
void find_inside(const Accel& boundary, const Ray& ray, const SceneVolume& volume,
                 std::vector<VolumeInterval>& out) {
    std::array<float, kMaxCrossings> crossings;
    int n = 0;
    Ray rest = ray;
    rest.t_max = kInfinity;
    RayHit hit;
    while (n < kMaxCrossings && boundary.intersect(rest, 0xffffffffU, hit)) {
        crossings[static_cast<std::size_t>(n++)] = hit.t;
        rest.t_min = std::nextafter(hit.t, kInfinity);
    }
    const auto add = [&](float begin, float end) {
        begin = std::max(begin, ray.t_min);
        end = std::min(end, ray.t_max);
        if (begin < end) out.push_back({&volume, begin, end});
    };
    int i = 0;
    if (n % 2 == 1) add(ray.t_min, crossings[static_cast<std::size_t>(i++)]);
    for (; i + 1 < n; i += 2)
        add(crossings[static_cast<std::size_t>(i)], crossings[static_cast<std::size_t>(i) + 1]);
}

/// Bound of the extinction that the shader says, raised where there is emission.
float bound_of(const ClosureSet& said, float cell_width) {
    float out = max_component(said.extinction());
    if (!said.emissions().empty()) out = std::max(out, kCollisionsForEmission / cell_width);
    return out;
}

/// Fills the cells by asking the shader. world_from_object is that of the first key: bounds of a moving volume are those of
/// where it begins, because grids move along and textures are only probed.
class MajorantMaker {
  public:
    explicit MajorantMaker(SceneVolume& volume)
        : volume_(volume),
          grids_(volume.grids()),
          textured_(is_textured(volume.shader())),
          place_(volume.object.world_from_object[0]) {}

    void run() {
        const Box3f box = object_box();
        volume_.homogeneous = grids_ == nullptr && !textured_;
        volume_.majorants = MajorantGrid(box, size_of(box));
        MajorantGrid& grid = volume_.majorants;
        const auto [nx, ny, nz] = grid.size();
        for (int z = 0; z < nz; ++z)
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x)
                    grid.at(x, y, z) = bound(grid.cell(x, y, z));
        if (!volume_.homogeneous) return;
        ask(box.center(), nullptr);
        volume_.medium = mixed(said_.media());
        if (!said_.emissions().empty() || said_.media().size() > 1) volume_.homogeneous = false;
    }

  private:
    [[nodiscard]] Box3f object_box() const {
        if (!volume_.object.geometry->volume_box.empty())
            return volume_.object.geometry->volume_box;
        // The boundary's bounds are in world space: its corners, taken back, bound the object.
        Box3f out;
        const Box3f& b = volume_.bounds;
        for (unsigned i = 0; i < 8; ++i)
            for (const Mat4f& back : volume_.object.object_from_world)
                out.grow(back.point({(i & 1U) != 0 ? b.upper.x : b.lower.x,
                                     (i & 2U) != 0 ? b.upper.y : b.lower.y,
                                     (i & 4U) != 0 ? b.upper.z : b.lower.z}));
        return out;
    }

    [[nodiscard]] std::array<int, 3> size_of(const Box3f& box) const {
        if (volume_.homogeneous) return {1, 1, 1};
        const Vec3f extent = box.size();
        const float longest = std::max({extent.x, extent.y, extent.z});
        float width =
            longest / static_cast<float>(grids_ != nullptr ? kMostCells : kTexturedCells);
        if (grids_ != nullptr)
            for (const VolumeGrids::Info& info : grids_->grids())
                width = std::max(width, info.voxel_size * kVoxelsPerCell);
        const auto cells = [&](float length) {
            return std::clamp(static_cast<int>(std::ceil(length / width)), 1, kMostCells);
        };
        return {cells(extent.x), cells(extent.y), cells(extent.z)};
    }

    [[nodiscard]] float bound(const Box3f& cell) {
        // Emission should be met about as often as scattering in a cell that is crossed the short way.
        const Vec3f size = cell.size();
        const float width =
            std::max({length(place_.vector({size.x, 0, 0})), length(place_.vector({0, size.y, 0})),
                      length(place_.vector({0, 0, size.z}))});
        std::optional<CellLookup> lookup;
        if (grids_ != nullptr) lookup.emplace(*grids_, cell);
        const VolumeLookup* channels = lookup ? &*lookup : nullptr;
        ask(cell.center(), channels);
        float out = bound_of(said_, width);
        if (!textured_) return out;
        for (unsigned i = 0; i + 1 < kProbesPerCell; ++i) {
            const Vec3f part{(i & 1U) != 0 ? 0.9F : 0.1F, (i & 2U) != 0 ? 0.9F : 0.1F,
                             (i & 4U) != 0 ? 0.9F : 0.1F};
            ask({lerp(cell.lower.x, cell.upper.x, part.x),
                 lerp(cell.lower.y, cell.upper.y, part.y),
                 lerp(cell.lower.z, cell.upper.z, part.z)},
                channels);
            out = std::max(out, bound_of(said_, width));
        }
        return out * kProbeMargin;
    }

    void ask(Vec3f object_position, const VolumeLookup* channels) {
        ShadePoint at =
            shade_point(volume_, place_.point(object_position), {0, 0, 1}, 0, RayType::Camera);
        at.volume = channels;
        said_.begin_volume(at.wo);
        volume_.shader().closures(at, said_);
    }

    SceneVolume& volume_;
    const VolumeGrids* grids_;
    bool textured_;
    Mat4f place_;
    ClosureSet said_;
};

}  // namespace

void find_intervals(const SceneVolume& volume, const Ray& ray, std::vector<VolumeInterval>& out) {
    float t0 = ray.t_min, t1 = ray.t_max;
    if (!clip(volume.bounds, {ray.origin, ray.direction}, t0, t1)) return;
    if (volume.boundary) return find_inside(*volume.boundary, ray, volume, out);
    t0 = ray.t_min;
    t1 = ray.t_max;
    if (clip(volume.object.geometry->volume_box, to_object(volume, ray), t0, t1))
        out.push_back({&volume, t0, t1});
}

void look_into(const SceneVolume& volume, Vec3f position, Vec3f wo, float time, RayType ray_type,
               ClosureSet& out) {
    ShadePoint at = shade_point(volume, position, wo, time, ray_type);
    out.begin_volume(wo);
    if (volume.grids() == nullptr) return volume.shader().closures(at, out);
    const PointLookup channels(*volume.grids(),
                               with_placement(volume.object, time, [&](const Placement& place) {
                                   return place.point_to_object(position);
                               }));
    at.volume = &channels;
    volume.shader().closures(at, out);
}

ObjectRay to_object(const SceneVolume& volume, const Ray& ray) {
    return with_placement(volume.object, ray.time, [&](const Placement& place) {
        return ObjectRay{place.point_to_object(ray.origin), place.vector_to_object(ray.direction)};
    });
}

void make_majorants(SceneVolume& volume) { MajorantMaker(volume).run(); }

}  // namespace lightsieve
