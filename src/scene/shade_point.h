// One hit, as shaders see it. World space unless said otherwise.
#pragma once

#include <cstdint>

#include "core/ray_type.h"
#include "core/vec.h"

namespace lightsieve {

class VolumeLookup;   // scene/volume_lookup.h
class ShadeServices;  // scene/shade_services.h
struct RayState;      // scene/shade_services.h

struct ShadePoint {
    Vec3f position;                   ///< world space
    Vec3f wo{0, 0, 1};                ///< unit, toward where the ray came from
    Vec3f geometric_normal{0, 0, 1};  ///< unit, of the surface as modelled (outward), not flipped
    Vec3f normal{0, 0, 1};            ///< unit shading normal, flipped to the side of `wo`
    Vec3f tangent{1, 0, 0};           ///< dP/du normalised, orthogonal to `normal` where uv exist
    Vec3f dp_du, dp_dv;               ///< dP/du and dP/dv of `uv`; zero where there is no uv
    Vec2f uv;                         ///< first uv set
    Vec2f barycentric;                ///< of the triangle
    float uv_width = 0;               ///< footprint of the ray in uv units, for texture filtering
    float width = 0;                  ///< the same in scene units, across the ray
    float ray_length = 0;             ///< from where the ray started
    std::uint32_t primitive = 0;      ///< triangle, sphere or segment of the shape's geometry
    std::uint32_t face = 0;           ///< polygon or curve number within the shape
    bool on_curve = false;            ///< `tangent` is along the fibre, the next two are set
    Vec2f curve_uv;                   ///< x across, y from root to tip, [0,1]
    float curve_offset = 0;           ///< across, [-1,1], as seen from `wo`
    std::uint32_t shape_id = 0;       ///< the shape's `id` parameter or a hash of its name
    RayType ray_type = RayType::Camera;  ///< of the ray that hit
    bool entering = true;  ///< the ray came from the side that `geometric_normal` points to
    float time = 0;        ///< [0,1) within the shutter
    float outer_ior = 1;   ///< index of what surrounds the body here: of another body, or of air
    /// A wavelength for bodies that bend light by colour [nm]. `monochromatic`: the path already has that one, so that all
    /// that depends on it must; else only what is refracted.
    float wavelength = 587.6F;
    bool monochromatic = false;
    const void* shape = nullptr;  ///< the renderer's record of the shape, for `services`
    const VolumeLookup* volume =
        nullptr;  ///< in a volume with grids; null on surfaces and in containers without
    /// What else can be asked about the shape and the scene; null where there is no surface (environment look-ups, lights).
    const ShadeServices* services = nullptr;
    const RayState* ray = nullptr;  ///< how the ray came here; null where no path is traced

    /// Of the ray, world space. In environment look-ups (skydome colour, background) only `uv` and this are set.
    Vec3f direction{0, 0, 1};
};

}  // namespace lightsieve
