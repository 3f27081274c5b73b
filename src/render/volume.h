// Volumes of a compiled scene: where they are and what fills them.
#pragma once

#include <memory>
#include <vector>

#include "bsdf/closure.h"
#include "io/volume_grid.h"
#include "render/accel.h"
#include "render/majorants.h"
#include "render/scene_object.h"

namespace lightsieve {

/// A volume: a box with grids, or the inside of a closed shape.
struct SceneVolume {
    SceneObject object;  ///< boundary, placement, lights; one shader, which says what is inside
    std::unique_ptr<Accel> boundary;  ///< null: the boundary is the geometry's volume_box
    Box3f bounds;                     ///< world space, over the shutter
    MajorantGrid majorants;           ///< object space
    bool homogeneous = false;         ///< the same everywhere
    Medium medium;                    ///< if homogeneous

    [[nodiscard]] const ShaderProgram& shader() const { return *object.shaders[0]; }
    [[nodiscard]] const VolumeGrids* grids() const { return object.geometry->grids.get(); }
};

/// A part of a ray within a volume.
struct VolumeInterval {
    const SceneVolume* volume = nullptr;
    float begin = 0, end = 0;
};

/// Adds the parts of a ray, from t_min to t_max, that lie in the volume. Parts of closed boundaries are counted from the
/// end of the ray, so that it does not matter whether it begins inside.
void find_intervals(const SceneVolume& volume, const Ray& ray, std::vector<VolumeInterval>& out);

/// What the volume's shader says of a point: out.media() and, per length, out.emissions().
///
/// position  world space
void look_into(const SceneVolume& volume, Vec3f position, Vec3f wo, float time, RayType ray_type,
               ClosureSet& out);

/// Position and direction of a ray in the volume's object space; the parameter t stays the same.
struct ObjectRay {
    Vec3f origin, direction;
};
[[nodiscard]] ObjectRay to_object(const SceneVolume& volume, const Ray& ray);

/// Makes the bounds of the volume's extinction by asking its shader, cell by cell, for the largest values of all channels.
/// Where textures drive a shader a cell is asked at several points; what exceeds the bound between them is still accounted
/// for without bias, only with more noise.
void make_majorants(SceneVolume& volume);

}  // namespace lightsieve
