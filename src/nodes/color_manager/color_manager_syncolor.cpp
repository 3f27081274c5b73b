// color_manager_syncolor: Autodesk's older colour management, which nothing outside of Autodesk's programs reads.
#include "core/color.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct ColorManagerSyncolor {
    Name native_catalog_path, custom_catalog_path, rendering_color_space, output_color_space;

    static NodeType describe() {
        Describe<ColorManagerSyncolor> d(
            "color_manager_syncolor", NodeKind::ColorManager,
            "Autodesk's older colour management: the built-in spaces stand for it.");
        const char* private_data = "A catalogue of Autodesk's own format.";
        d.param("native_catalog_path", &ColorManagerSyncolor::native_catalog_path, private_data)
            .ignored();
        d.param("custom_catalog_path", &ColorManagerSyncolor::custom_catalog_path, private_data)
            .ignored();
        d.param("rendering_color_space", &ColorManagerSyncolor::rendering_color_space,
                "Space that light is computed in, one of the built-in ones.");
        d.param("output_color_space", &ColorManagerSyncolor::output_color_space,
                "Space for display; here each driver says its own.")
            .ignored();
        return d.done();
    }

    [[nodiscard]] std::shared_ptr<const ColorSpaces> make_color_spaces(
        NodeContext& context) const {
        context.diagnostics().warning(Code::ColorConfig, "catalogues of syncolor cannot be read",
                                      context.where("rendering_color_space"),
                                      "the built-in spaces are used: ACEScg, sRGB and their like; "
                                      "or use color_manager_ocio");
        const std::string wanted = context.wanted_rendering_space();
        const std::string name = wanted.empty() ? rendering_color_space.str() : wanted;
        const std::optional<ColorSpace> space = find_color_space(name);
        const bool linear = space && !space->raw && space->transfer == Transfer::Linear;
        return std::make_shared<const ColorSpaces>(linear ? *space : kRenderingSpace);
    }
};

}  // namespace

NodeType node_color_manager_syncolor() { return ColorManagerSyncolor::describe(); }

}  // namespace lightsieve
