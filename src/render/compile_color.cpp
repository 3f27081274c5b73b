// Which colour spaces the scene has. See compiler.h.
#include <cstdlib>

#include "io/color_config.h"
#include "render/compiler.h"

namespace lightsieve {

/// A configuration: the scene's, or else that of the environment. Null if there is none, or none that can be read.
std::shared_ptr<const ColorSpaces> Compiler::configured_color_spaces() {
    if (const NodeRef manager = option<NodeRef>("color_manager", {}); manager) {
        const NodeType& type = manager.node->type();
        if (type.make_color_spaces != nullptr) {
            CompileContext context(*this, manager.node, manager.node->name());
            return type.make_color_spaces(manager.node->block(), context);
        }
        diagnostics_.warning(Code::LinkType,
                             "\"" + manager.node->name().str() + "\" is a " + type.name.str() +
                                 ", not a colour manager: it has no effect",
                             option_place("color_manager"));
    }
    const char* path = std::getenv("OCIO");
    if (path == nullptr || *path == '\0') return nullptr;
    ColorConfigOptions config;
    config.path = path;
    config.rendering_space = options_.rendering_space;
    return read_color_config(config, diagnostics_);
}

void Compiler::make_color_spaces() {
    scene_->color_spaces = configured_color_spaces();
    if (scene_->color_spaces) return;
    const ColorSpaces& known = ColorSpaces::built_in();
    if (options_.rendering_space.empty()) {
        scene_->color_spaces = std::make_shared<const ColorSpaces>();
        return;
    }
    const std::optional<ColorSpace> chosen = known.find(options_.rendering_space);
    const bool linear = chosen && !chosen->raw && chosen->transfer == Transfer::Linear;
    if (!linear)
        diagnostics_.error(Code::UnknownColorSpace,
                           chosen
                               ? "\"" + options_.rendering_space +
                                     "\" is not linear: light cannot be computed in it"
                               : "no colour space is called \"" + options_.rendering_space + "\"",
                           {},
                           chosen ? "ACEScg, lin_rec709 and lin_rec2020 are linear"
                                  : did_you_mean(options_.rendering_space, known.names()));
    scene_->color_spaces = std::make_shared<const ColorSpaces>(linear ? *chosen : kRenderingSpace);
}

}  // namespace lightsieve
