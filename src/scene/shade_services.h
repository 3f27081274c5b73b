// What shaders may ask about a hit beyond the numbers of a ShadePoint: user data, uv sets, placement, rays of their own.
//
// The renderer implements it. Most shaders need none of it, so nothing is computed before somebody asks.
// `RayState` is what the path knows of itself: pixel, bounces, random numbers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/matrix.h"
#include "core/name.h"
#include "core/sobol.h"
#include "scene/node_type.h"
#include "scene/shade_point.h"

namespace lightsieve {

/// What a shader writes into an AOV of its own at a hit that the camera sees.
struct WrittenAov {
    ShaderValue value;
    bool set = false;    ///< something was written at this hit
    bool blend = false;  ///< by opacity, over what lies behind; else the nearest value counts
};

/// A sample's way to the point; one for the whole path, changed from hit to hit.
struct RayState {
    std::int32_t x = 0, y = 0;  ///< pixel
    Vec2f screen;               ///< [-1,1], y up
    Vec2f subpixel;             ///< [0,1] within the pixel
    std::uint32_t sample = 0;   ///< number of the sample within the pixel
    /// Where shaders' random numbers come from: others for each segment of the path. Null: the same everywhere.
    const Sampler* sampler = nullptr;
    std::uint32_t segment = 0;
    std::int32_t bounces = 0;  ///< scattering events so far, of each kind below
    std::int32_t diffuse = 0, specular = 0, transmission = 0, volume = 0, transparent = 0;
    const Mat4f* camera_from_world = nullptr;  ///< of the sample's camera at its time
    /// By the numbers of NodeContext::written_aov; null where the camera does not look.
    WrittenAov* written = nullptr;
    /// Ids by the numbers of NodeContext::add_matte, 0 before an aov_shader writes one; null where the camera does not look.
    std::uint32_t* mattes = nullptr;
    float pixel_angle = 0;  ///< angle between neighbouring pixels [rad]; 0: parallel rays
};

/// A uv set at a point.
struct UvPoint {
    Vec2f uv;
    Vec3f dp_du, dp_dv;  ///< world space; zero where the uv are degenerate
    float width = 0;     ///< of the ray's footprint [uv units]
};

/// A ray that a shader sends out to feel the surroundings.
struct Probe {
    Vec3f origin, direction;  ///< world space; the direction is a unit vector
    float t_min = 0, t_max = kInfinity;
    bool self_only = false;  ///< meets only the shape of the point
    Name trace_set;          ///< see `inclusive`; empty: meets everything
    bool inclusive = true;   ///< meets what is in `trace_set`, or only what is not
};

/// What a probe met first.
struct ProbeHit {
    float t = 0;
    Vec3f position;
    Vec3f geometric_normal;  ///< unit, as modelled
    Vec3f normal;            ///< unit shading normal on the side of the geometric one
    bool same_shape = false;
};

class ShadeServices {
  public:
    virtual ~ShadeServices() = default;
    /// User data of the shape, as up to four numbers; false if it has none of that name or it is text.
    [[nodiscard]] virtual bool user_value(const ShadePoint& at, Name name,
                                          ShaderValue& out) const = 0;
    /// User data that is text; false if the shape has none of that name.
    [[nodiscard]] virtual bool user_text(const ShadePoint& at, Name name, Name& out) const = 0;
    /// Another uv set than the first: user data of two floats at face corners. False if the shape has none of that name.
    [[nodiscard]] virtual bool uv_set(const ShadePoint& at, Name name, UvPoint& out) const = 0;
    /// Placement of the shape at the point's time.
    [[nodiscard]] virtual Mat4f world_from_object(const ShadePoint& at) const = 0;
    [[nodiscard]] virtual Mat4f object_from_world(const ShadePoint& at) const = 0;
    /// Corners of the triangle at the point, world space, and which of its edges (from corner i to i + 1) are edges of the
    /// polygon that it is part of; false for shapes that have none.
    struct Triangle {
        std::array<Vec3f, 3> corners;
        std::array<bool, 3> polygon_edge{true, true, true};
    };
    [[nodiscard]] virtual bool triangle(const ShadePoint& at, Triangle& out) const = 0;
    /// Name of the shape in the scene.
    [[nodiscard]] virtual Name shape_name(const ShadePoint& at) const = 0;
    /// Name of the shader of the surface at the point; empty if it has none of its own.
    [[nodiscard]] virtual Name material_name(const ShadePoint& /*at*/) const { return {}; }
    /// Every text that user data of that name has on the shape, integers in decimal. Slow: for preparation.
    [[nodiscard]] virtual std::vector<Name> user_values(const ShadePoint& /*at*/,
                                                        Name /*name*/) const {
        return {};
    }
    /// The nearest surface along a probe; false if there is none.
    [[nodiscard]] virtual bool trace(const ShadePoint& at, const Probe& probe,
                                     ProbeHit& hit) const = 0;
    /// Number of lights in the scene.
    [[nodiscard]] virtual std::int32_t n_lights() const = 0;
};

/// A random number in [0,1) for a shader's own use: the same for the same sample, hit, stream and index.
[[nodiscard]] inline float shader_random(const ShadePoint& at, std::uint32_t stream,
                                         std::uint32_t index) {
    // Apart from the path's own streams, which are small numbers.
    constexpr std::uint32_t kShaderStream = 64;
    std::uint32_t seed = 0;
    if (at.ray != nullptr && at.ray->sampler != nullptr)
        seed = static_cast<std::uint32_t>(
            at.ray->sampler->random(hash_combine(at.ray->segment, kShaderStream)) * 0x1p24F);
    return unit_float(hash_combine(hash_combine(seed, stream), index));
}

/// Point number `index` of n_side * n_side in the unit square, one in each of its cells. Takes this stream and the next.
[[nodiscard]] inline Vec2f shader_stratum(const ShadePoint& at, std::uint32_t stream,
                                          std::uint32_t index, std::uint32_t n_side) {
    const auto side = static_cast<float>(n_side);
    return {(static_cast<float>(index % n_side) + shader_random(at, stream, index)) / side,
            (static_cast<float>(index / n_side) + shader_random(at, stream + 1, index)) / side};
}

}  // namespace lightsieve
