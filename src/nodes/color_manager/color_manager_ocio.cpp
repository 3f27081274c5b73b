// color_manager_ocio: colour spaces of an OpenColorIO configuration.
#include <cstdlib>

#include "io/color_config.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct ColorManagerOcio {
    Name config, color_space_narrow, color_space_linear;

    static NodeType describe() {
        Describe<ColorManagerOcio> d("color_manager_ocio", NodeKind::ColorManager,
                                     "Colour spaces of an OpenColorIO configuration.");
        d.param("config", &ColorManagerOcio::config,
                "File of the configuration; none: the one that $OCIO names.");
        d.param("color_space_narrow", &ColorManagerOcio::color_space_narrow,
                "Space of 8-bit and 16-bit pictures, for `auto`; none: the configuration's sRGB.");
        d.param("color_space_linear", &ColorManagerOcio::color_space_linear,
                "Space that light is computed in; none: the configuration's role scene_linear.");
        return d.done();
    }

    /// Null if there is no configuration, or none that can be read, which is reported.
    [[nodiscard]] std::shared_ptr<const ColorSpaces> make_color_spaces(
        NodeContext& context) const {
        ColorConfigOptions options;
        options.where = context.where("config");
        options.path = config.str();
        if (config.empty()) {
            const char* named = std::getenv("OCIO");
            if (named == nullptr || *named == '\0') return nullptr;
            options.path = named;
        } else if (const auto found = context.find_asset(config.view())) {
            options.path = *found;
        }
        options.integers = color_space_narrow.str();
        options.rendering_space = context.wanted_rendering_space();
        if (options.rendering_space.empty()) {
            options.rendering_space = color_space_linear.str();
            options.where_rendering = context.where("color_space_linear");
        }
        return read_color_config(options, context.diagnostics());
    }
};

}  // namespace

NodeType node_color_manager_ocio() { return ColorManagerOcio::describe(); }

}  // namespace lightsieve
