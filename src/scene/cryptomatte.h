// Cryptomatte 1.2: pictures of names, from which compositing programs cut masks.
//
// A matte is a set of layers. Each pixel has pairs of an id and how much of the pixel it covers, most covered first, two
// pairs a layer. An id is the hash of a name, as the bits of a float; 0 is nothing. The header says which layers belong
// together, and its manifest which names have which ids. Source: Friedman and Jones, "Cryptomatte specification" 1.2.0.
// Shaders announce mattes and write ids (scene/node_context.h, RayState::mattes); the film sorts what arrives.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/name.h"
#include "scene/shade_point.h"

namespace lightsieve {

/// MurmurHash3_x86_32 with seed 0. Source: A. Appleby, "MurmurHash3" (public domain).
[[nodiscard]] std::uint32_t murmur_hash(std::string_view text);

/// The hash of a name as the bits of a float that is neither NaN, infinite, 0 nor denormal: bit 23 is toggled where the
/// exponent would make it one of these.
[[nodiscard]] std::uint32_t matte_id(std::string_view name);

/// Names and their ids.
using MatteManifest = std::map<std::string, std::uint32_t>;

/// The manifest as it stands in headers and files: JSON, name to eight hexadecimal digits.
[[nodiscard]] std::string manifest_json(const MatteManifest& manifest);

/// What headers call a matte: seven hexadecimal digits.
[[nodiscard]] std::string matte_key(std::string_view name);

/// A matte that a shader writes.
struct Matte {
    Name name;                     ///< the AOV: "crypto_object"
    int n_layers = 3;              ///< of two ids each
    bool preview_in_file = false;  ///< EXR files get the coloured preview, too
    bool sidecar = false;          ///< the manifest goes into a file of its own
    MatteManifest manifest;
};

/// A shape where it stands in the scene.
struct PlacedShape {
    ShadePoint at;  ///< `shape` and `services` are set
    /// Names of its surface shaders; an empty one is the default shader.
    std::vector<Name> materials;
};

}  // namespace lightsieve
