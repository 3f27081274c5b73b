#include "scene/driver.h"

namespace lightsieve {

std::vector<std::string> channel_names(const ImageLayer& layer, bool bare) {
    const bool is_rgb = layer.aov_type == "RGB" || layer.aov_type == "RGBA";
    if (layer.n_channels == 1) return {layer.name};
    const std::string letters = layer.aov_type.starts_with("VECTOR") ? "XYZ" : "RGBA";
    std::vector<std::string> names;
    for (std::size_t c = 0; c < layer.n_channels; ++c)
        names.push_back((bare && is_rgb ? "" : layer.name + ".") + letters[c]);
    return names;
}

bool is_beauty(const ImageLayer& layer) { return layer.name == "RGBA" || layer.name == "RGB"; }

}  // namespace lightsieve
