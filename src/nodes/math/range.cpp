// range: one interval of numbers mapped to another.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct Range {
    Color input;
    float input_min = 0, input_max = 1, output_min = 0, output_max = 1;
    bool smoothstep = false;
    float contrast = 1, contrast_pivot = 0.5F, bias = 0.5F, gain = 0.5F;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint&) const;

  private:
    [[nodiscard]] float of(float x) const;
};

NodeType Range::describe() {
    Describe<Range> d("range", NodeKind::Shader, "Maps an interval to another one.");
    d.param("input", &Range::input, "What is mapped, channel by channel.");
    d.param("input_min", &Range::input_min, "Becomes output_min.");
    d.param("input_max", &Range::input_max, "Becomes output_max.");
    d.param("output_min", &Range::output_min, "What input_min becomes.");
    d.param("output_max", &Range::output_max, "What input_max becomes.");
    d.param("smoothstep", &Range::smoothstep,
            "The way between the ends is smooth, and nothing goes past them.");
    d.param("contrast", &Range::contrast, "Factor on the distance from contrast_pivot.");
    d.param("contrast_pivot", &Range::contrast_pivot, "What contrast leaves as it is, in 0..1.");
    d.param("bias", &Range::bias, "Value that 1/2 becomes.").range(0, 1);
    d.param("gain", &Range::gain,
            "Below 1/2 middle values are spread, above they are drawn together.")
        .range(0, 1);
    return d.done();
}

float Range::of(float x) const {
    const float width = input_max - input_min;
    float f = width != 0 ? (x - input_min) / width : (x < input_min ? 0.0F : 1.0F);
    f = (f - contrast_pivot) * contrast + contrast_pivot;
    f = perlin_gain(perlin_bias(f, bias), gain);
    if (smoothstep) {
        f = unit(f);
        f = f * f * (3 - 2 * f);
    }
    return lerp(output_min, output_max, f);
}

Color Range::eval(const ShadePoint&) const { return {of(input.r), of(input.g), of(input.b)}; }

}  // namespace

NodeType node_range() { return Range::describe(); }

}  // namespace lightsieve
