// Colour spaces of an OpenColorIO configuration. OpenColorIO is used in color_config.cpp and nowhere else.
//
// The configuration says what light is computed in (the role scene_linear, or `rendering`), and its spaces stand beside those that are
// built in (core/color.h): a name is looked for in the configuration first. Every space is converted to and from the rendering
// space by a processor of the library, made when the scene is compiled.
#pragma once

#include <memory>
#include <string>

#include "core/color.h"
#include "core/diagnostics.h"

namespace lightsieve {

/// What a scene or a command says about the configuration; empty: as the configuration says.
struct ColorConfigOptions {
    std::string path;             ///< of the configuration
    std::string rendering_space;  ///< name of a space or role; light is computed in it
    std::string integers;         ///< space of 8-bit pictures, for "auto"
    SourceSpan where;             ///< of the path, for reports
    SourceSpan where_rendering;   ///< of rendering_space
};

/// Reads a configuration. Null with a warning reported (color-config) if it cannot be read or has no linear space.
[[nodiscard]] std::shared_ptr<const ColorSpaces> read_color_config(
    const ColorConfigOptions& options, Diagnostics& diagnostics);

}  // namespace lightsieve
