// What flat and deep EXR files say alike: the frame, how the file is cut, what each layer is.
#pragma once

#include <map>
#include <string>

#include "core/color.h"
#include "io/exr_write.h"
#include "scene/driver.h"

namespace lightsieve {

/// A file without parts for a frame, with the header's metadata.
///
/// tiled      in tiles of the frame's buckets, if those are of a size that makes good tiles
/// primaries  of the colour space that its colours are in
[[nodiscard]] ExrWriteSpec exr_spec(const ImageHeader& header, bool tiled, Primaries primaries);

/// What a layer is, as attributes `arnold/aovs/<layer>/...`.
void describe_exr_layer(const ImageLayer& layer, std::map<std::string, ExrAttribute>& attributes);

}  // namespace lightsieve
