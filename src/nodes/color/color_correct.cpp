// color_correct: gamma, hue, saturation, contrast, exposure and more, in the order of the parameters.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct ColorCorrect {
    Rgba input{{1, 1, 1}, 1};
    bool alpha_is_luminance = false;
    float alpha_multiply = 1, alpha_add = 0;
    bool invert = false, invert_alpha = false;
    float gamma = 1, hue_shift = 0, saturation = 1, contrast = 1, contrast_pivot = 0.18F,
          exposure = 0;
    Color multiply{1, 1, 1}, add;
    float mask = 1;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint&) const;

  private:
    [[nodiscard]] Color corrected(Color c) const;
};

NodeType ColorCorrect::describe() {
    Describe<ColorCorrect> d("color_correct", NodeKind::Shader,
                             "Corrects a colour, step by step in the order of the parameters.");
    d.param("input", &ColorCorrect::input, "The colour.");
    d.param("alpha_is_luminance", &ColorCorrect::alpha_is_luminance,
            "Alpha is the input's luminance instead of its alpha.");
    d.param("alpha_multiply", &ColorCorrect::alpha_multiply, "Factor on alpha.");
    d.param("alpha_add", &ColorCorrect::alpha_add, "Added to alpha.");
    d.param("invert", &ColorCorrect::invert, "1 minus the colour.");
    d.param("invert_alpha", &ColorCorrect::invert_alpha, "1 minus alpha.");
    d.param("gamma", &ColorCorrect::gamma, "The colour to the power of 1 / gamma.").range(0, 5);
    d.param("hue_shift", &ColorCorrect::hue_shift, "Turns the hue; 1 is a full turn.")
        .range(-1, 1);
    d.param("saturation", &ColorCorrect::saturation, "0: grey; above 1: more colourful.")
        .range(0, 2);
    d.param("contrast", &ColorCorrect::contrast, "Factor on the distance from contrast_pivot.")
        .range(0, 2);
    d.param("contrast_pivot", &ColorCorrect::contrast_pivot, "What contrast leaves as it is.");
    d.param("exposure", &ColorCorrect::exposure, "Brightness in powers of two.").unit("f-stops");
    d.param("multiply", &ColorCorrect::multiply, "Factor on the colour.");
    d.param("add", &ColorCorrect::add, "Added to the colour.");
    d.param("mask", &ColorCorrect::mask, "Part of the correction; 0: the input.").range(0, 1);
    return d.done();
}

Color ColorCorrect::corrected(Color c) const {
    if (invert) c = kWhite - c;
    if (gamma != 1 && gamma > 0)
        for (int i = 0; i < 3; ++i)
            c[i] = c[i] > 0 ? std::pow(c[i], 1 / gamma) : c[i];
    if (hue_shift != 0) {
        Color hsv = hsv_from_rgb(c);
        hsv.r += hue_shift;
        c = rgb_from_hsv(hsv);
    }
    if (saturation != 1) c = lerp(Color::grey(luminance(c)), c, saturation);
    if (contrast != 1) c = lerp(Color::grey(contrast_pivot), c, contrast);
    return c * std::exp2(exposure) * multiply + add;
}

Rgba ColorCorrect::eval(const ShadePoint&) const {
    float alpha = alpha_is_luminance ? luminance(input.rgb) : input.a;
    alpha = alpha * alpha_multiply + alpha_add;
    if (invert_alpha) alpha = 1 - alpha;
    return {lerp(input.rgb, corrected(input.rgb), mask), lerp(input.a, alpha, mask)};
}

}  // namespace

NodeType node_color_correct() { return ColorCorrect::describe(); }

}  // namespace lightsieve
