// What cryptomatte makes of the names of shapes and shaders before it hashes them.
//
// Exporters write whole paths and namespaces into names. Mattes are wanted by the last part of a shape's name (object) or by
// what comes before it (asset). The rules, and the switches that turn them off, are those of Arnold's cryptomatte shader:
//
//     /town/house/roof     object roof, asset /town/house    (paths)
//     house1:roof          object roof, asset house1         (maya)
//     c4d|house|roof, house.roof.SItoA.123                   (legacy: Cinema 4D, Softimage)
#pragma once

#include <string>
#include <string_view>

namespace lightsieve {

/// Which rules act.
struct NameRules {
    bool strip_namespaces = true;  ///< names without what is before their last part
    bool maya = true;              ///< namespaces end with a colon
    bool paths = true;             ///< names that begin with a slash are paths
    bool pipes_in_paths = true;    ///< of shapes: a pipe parts like a slash
    bool material_pipes = true;    ///< of shaders: what follows a pipe is a node of the network
    bool legacy = true;            ///< names of old exporters
    friend bool operator==(const NameRules&, const NameRules&) = default;
};

struct ShapeNames {
    std::string object, asset;
};
/// The asset of a name without a namespace is "default".
[[nodiscard]] ShapeNames shape_names(std::string_view name, const NameRules& rules);

[[nodiscard]] std::string material_name(std::string_view name, const NameRules& rules);

}  // namespace lightsieve
