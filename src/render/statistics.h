// What a render took and what it will take: rays, seconds and bytes, by what they were for.
//
// Counts are exact and do not depend on threads. Seconds are those of a clock on the wall. Bytes are counted where they are
// held; what nobody counts (the program, its libraries, the scene's text) is the difference to what the process holds in all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/ray_type.h"

namespace lightsieve {

/// What a ray is traced for: how the path came to where it leaves, or that it looks for a light.
enum class RayKind : std::uint8_t {
    Camera,        ///< from the camera, through transparent surfaces too
    Shadow,        ///< to a light
    Diffuse,       ///< after diffuse reflection or transmission
    Specular,      ///< after specular reflection
    Transmission,  ///< after specular transmission
    Volume,        ///< after scattering in a medium
    Subsurface,    ///< below surfaces, and where the light comes out
};
inline constexpr std::array<std::string_view, 7> kRayKindNames{
    "camera", "shadow", "diffuse", "specular", "transmission", "volume", "subsurface"};
/// Rays, by RayKind.
using RaysByKind = std::array<std::uint64_t, kRayKindNames.size()>;

[[nodiscard]] inline std::uint64_t sum_of(const RaysByKind& rays) {
    return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
}
[[nodiscard]] constexpr RayKind ray_kind_of(RayType type) {
    switch (type) {
        case RayType::Camera: return RayKind::Camera;
        case RayType::Shadow: return RayKind::Shadow;
        case RayType::DiffuseTransmit:
        case RayType::DiffuseReflect: return RayKind::Diffuse;
        case RayType::SpecularTransmit: return RayKind::Transmission;
        case RayType::SpecularReflect: return RayKind::Specular;
        case RayType::Volume: return RayKind::Volume;
        case RayType::Subsurface: break;
    }
    return RayKind::Subsurface;
}

/// Where the time before the first ray went [s].
struct StageTimes {
    double compile = 0;   ///< operators, shaders, shapes, expressions: all but what follows
    double textures = 0;  ///< opened and tried
    double volumes = 0;   ///< read
    double accel = 0;     ///< the structures that rays are traced through
};

/// Memory by what it holds [bytes].
struct MemoryUse {
    std::size_t geometry = 0;    ///< shapes and where they are placed
    std::size_t accel = 0;       ///< the structures that rays are traced through
    std::size_t volumes = 0;     ///< grids and bounds on them
    std::size_t textures = 0;    ///< texels in the cache
    std::size_t automata = 0;    ///< tables of the expressions
    std::size_t guide = 0;       ///< where light comes from, as paths have learned
    std::size_t film = 0;        ///< sums and layers of the buckets in work, and noise by bucket
    std::size_t layers = 0;      ///< kept for the caller
    std::size_t output = 0;      ///< pixels that wait until their file can be written
    std::size_t checkpoint = 0;  ///< what is done and waits to be saved
    std::size_t other = 0;       ///< the program, its libraries, the scene as it was read

    [[nodiscard]] std::size_t total() const;
    /// All of them with their names, in this order.
    [[nodiscard]] std::vector<std::pair<std::string_view, std::size_t>> by_name() const;
};

/// What a render will take at most, known before the first ray. What grows with what is seen (mattes of many objects, samples
/// of deep files) counts as it begins.
struct MemoryForecast {
    MemoryUse use;
    std::vector<std::size_t> file_bytes;  ///< of each file, before compression
    std::size_t checkpoint_file_bytes = 0;
};

/// What the scene asks of the log.
struct LogSettings {
    int verbosity =
        1;  ///< 0: errors, 1: warnings, progress and a summary, 2 and more: all that is known
    int max_warnings = 100;     ///< that are printed
    std::string file;           ///< that gets what is printed; empty: none
    std::string stats_file;     ///< for what machines read; empty: none
    bool stats_append = false;  ///< after what the file holds
};

}  // namespace lightsieve
