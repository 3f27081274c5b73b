#include "nodes/common/exr_layers.h"

namespace lightsieve {

ExrWriteSpec exr_spec(const ImageHeader& header, bool tiled, Primaries primaries) {
    // Buckets of other sizes than these make poor tiles: the writer gathers them.
    constexpr int kMinTile = 16, kMaxTile = 1024, kDefaultTile = 64;
    ExrWriteSpec spec;
    spec.width = header.width;
    spec.height = header.height;
    spec.data_x = header.data_x;
    spec.data_y = header.data_y;
    spec.data_width = header.data_width;
    spec.data_height = header.data_height;
    spec.pixel_aspect_ratio = header.pixel_aspect_ratio;
    spec.tiled = tiled;
    spec.tile_size = header.bucket_size >= kMinTile && header.bucket_size <= kMaxTile
                         ? header.bucket_size
                         : kDefaultTile;
    spec.primaries = primaries;
    spec.attributes.insert(header.metadata.begin(), header.metadata.end());
    return spec;
}

void describe_exr_layer(const ImageLayer& layer, std::map<std::string, ExrAttribute>& attributes) {
    const std::string prefix = "arnold/aovs/" + layer.name + "/";
    attributes[prefix + "source"] = layer.aov;
    attributes[prefix + "filter"] = layer.filter;
    attributes[prefix + "filter_width"] = layer.filter_width;
    if (!layer.light_group.empty()) attributes[prefix + "light_group"] = layer.light_group;
    if (layer.expression.empty()) return;
    attributes[prefix + "lpe"] = 1;
    attributes[prefix + "lpe_expression"] = layer.expression;
}

}  // namespace lightsieve
