#include "scene/missing_nodes.h"

#include <algorithm>
#include <array>

namespace lightsieve {
namespace {

struct Missing {
    std::string_view type, lost;
};

constexpr std::string_view kValue =
    "what links to it keeps the value that is written beside the link";
constexpr std::string_view kShape =
    "the shape is missing from the picture; export it as a polymesh";

/// Sorted by type.
constexpr std::array kMissing{
    Missing{
        "alembic",
        "everything in its file is missing from the picture; export it as .ass, for a procedural"},
    Missing{"c4d_texture_tag", kValue},
    Missing{"c4d_texture_tag_rgba", kValue},
    Missing{"distance", kValue},
    Missing{"implicit", kShape},
    Missing{"material", "what refers to it has the default surface"},
    Missing{"materialx",
            "the looks in its file are not assigned: shapes keep the shaders that they have"},
    Missing{"motion_vector", kValue},
    Missing{"nurbs", kShape},
    Missing{"override", "what it would change keeps its values"},
    Missing{"query_shape", kValue},
    Missing{
        "usd",
        "everything in its file is missing from the picture; export it as .ass, for a procedural"},
    Missing{"uv_camera", "textures cannot be baked; choose another camera"},
    Missing{"visible_light", "the light is missing from the picture; use a mesh_light"},
    Missing{"volume_implicit", "the volume is missing from the picture"},
    Missing{"volume_sample_float", kValue},
    Missing{"volume_sample_rgb", kValue},
};
static_assert(std::is_sorted(kMissing.begin(), kMissing.end(),
                             [](const Missing& a, const Missing& b) { return a.type < b.type; }));

}  // namespace

std::string_view lost_without(std::string_view node_type) {
    if (node_type.starts_with("imager_"))
        return "files have the picture without it, and without the imagers before it in the chain";
    const auto* found = std::lower_bound(
        kMissing.begin(), kMissing.end(), node_type,
        [](const Missing& missing, std::string_view type) { return missing.type < type; });
    return found != kMissing.end() && found->type == node_type ? found->lost : std::string_view{};
}

}  // namespace lightsieve
