// color_convert: a colour taken from one colour space to another.
#include "core/color.h"
#include "nodes/math/math_node.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct ColorConvert {
    Color input;
    Name from = "RGB", to = "RGB";
    ColorConversion conversion;  ///< found by prepare()

    static NodeType describe() {
        Describe<ColorConvert> d("color_convert", NodeKind::Shader,
                                 "A colour taken from one colour space to another.");
        d.param("input", &ColorConvert::input, "The colour.");
        d.param(
            "from", &ColorConvert::from,
            "Its space, by name; RGB or auto: the rendering space; HSV: hue, saturation, value.");
        d.param("to", &ColorConvert::to, "The space of the result.");
        return d.done();
    }
    void prepare(NodeContext& context) {
        const ColorSpaces& spaces = context.color_spaces();
        const auto space = [&](Name name, const char* param) {
            const bool rendering = name.view() == "RGB" || name.view() == "HSV";
            return rendering ? spaces.rendering()
                             : spaces.resolve(name.view(), spaces.rendering(),
                                              context.diagnostics(), context.where(param));
        };
        conversion = ColorConversion(space(from, "from"), space(to, "to"));
    }
    [[nodiscard]] Color eval(const ShadePoint&) const {
        static const Name kHsv("HSV");
        const Color rgb = conversion(from == kHsv ? rgb_from_hsv(input) : input);
        return to == kHsv ? hsv_from_rgb(rgb) : rgb;
    }
};

}  // namespace

NodeType node_color_convert() { return ColorConvert::describe(); }

}  // namespace lightsieve
