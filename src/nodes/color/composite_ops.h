// Ways to put one colour onto another, by their names in compositing programs; composite and layer_rgba share them.
//
// With A the upper colour, B the lower, and their alphas a and b. Sources: Porter and Duff 1984, "Compositing Digital
// Images"; the W3C's "Compositing and Blending Level 1"; for cojoint, disjoint, geometric and hypot_diagonal the formulas
// that Nuke documents for its Merge.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "nodes/shader/shader_common.h"

namespace lightsieve {

namespace composite_detail {

inline float hard_light(float a, float b) {
    return a < 0.5F ? 2 * a * b : 1 - 2 * (1 - a) * (1 - b);
}
inline float divided(float a, float b) { return b != 0 ? a / b : 0; }
inline float color_burn(float a, float b) {
    return b >= 1 ? 1.0F : a > 0 ? 1 - std::fmin(1.0F, (1 - b) / a) : 0.0F;
}
inline float color_dodge(float a, float b) {
    return !(b > 0) ? 0.0F : a < 1 ? std::fmin(1.0F, b / (1 - a)) : 1.0F;
}
inline float reflect(float a, float b) { return a < 1 ? std::fmin(1.0F, b * b / (1 - a)) : 1.0F; }
inline float vivid_light(float a, float b) {
    return a < 0.5F ? color_burn(2 * a, b) : color_dodge(2 * a - 1, b);
}
inline float pin_light(float a, float b) {
    return a < 0.5F ? std::fmin(b, 2 * a) : std::fmax(b, 2 * a - 1);
}
inline float screen(float a, float b) {
    const bool bounded = a >= 0 && a <= 1 && b >= 0 && b <= 1;
    return bounded ? a + b - a * b : std::fmax(a, b);
}

}  // namespace composite_detail

/// One way, with alpha or without.
struct CompositeOp {
    const char* name;
    /// Of one channel; `a` and `b` are the colours, `alpha_a` and `alpha_b` their alphas.
    float (*channel)(float a, float b, float alpha_a, float alpha_b);
};

/// All ways, in alphabetical order: enumerations of nodes count them so.
[[nodiscard]] inline const std::vector<CompositeOp>& composite_ops() {
    using namespace composite_detail;
    static const std::vector<CompositeOp> kAll{
        {"A", [](float a, float, float, float) { return a; }},
        {"B", [](float, float b, float, float) { return b; }},
        {"atop", [](float a, float b, float fa, float fb) { return a * fb + b * (1 - fa); }},
        {"average", [](float a, float b, float, float) { return 0.5F * (a + b); }},
        {"cojoint_over", [](float a, float b, float fa,
                            float fb) { return fa >= fb ? a : a + b * divided(fb - fa, fb); }},
        {"color_burn", [](float a, float b, float, float) { return color_burn(a, b); }},
        {"color_dodge", [](float a, float b, float, float) { return color_dodge(a, b); }},
        {"difference", [](float a, float b, float, float) { return std::abs(a - b); }},
        {"disjoint_over",
         [](float a, float b, float fa, float fb) {
             return fa + fb < 1 ? a + b : a + b * divided(1 - fa, fb);
         }},
        {"divide", [](float a, float b, float, float) { return divided(a, b); }},
        {"exclusion", [](float a, float b, float, float) { return a + b - 2 * a * b; }},
        {"from", [](float a, float b, float, float) { return b - a; }},
        {"geometric", [](float a, float b, float, float) { return divided(2 * a * b, a + b); }},
        {"glow", [](float a, float b, float, float) { return reflect(b, a); }},
        {"hard_light", [](float a, float b, float, float) { return hard_light(a, b); }},
        {"hard_mix",
         [](float a, float b, float, float) { return vivid_light(a, b) < 0.5F ? 0.0F : 1.0F; }},
        {"hypot_diagonal", [](float a, float b, float, float) { return std::hypot(a, b); }},
        {"in", [](float a, float, float, float fb) { return a * fb; }},
        {"linear_light", [](float a, float b, float, float) { return b + 2 * a - 1; }},
        {"mask", [](float, float b, float fa, float) { return b * fa; }},
        {"matte", [](float a, float b, float fa, float) { return a * fa + b * (1 - fa); }},
        {"max", [](float a, float b, float, float) { return std::fmax(a, b); }},
        {"min", [](float a, float b, float, float) { return std::fmin(a, b); }},
        {"minus", [](float a, float b, float, float) { return a - b; }},
        {"multiply", [](float a, float b, float, float) { return a * b; }},
        {"negation", [](float a, float b, float, float) { return 1 - std::abs(1 - a - b); }},
        {"out", [](float a, float, float, float fb) { return a * (1 - fb); }},
        {"over", [](float a, float b, float fa, float) { return a + b * (1 - fa); }},
        {"overlay", [](float a, float b, float, float) { return hard_light(b, a); }},
        {"phoenix",
         [](float a, float b, float, float) { return std::fmin(a, b) - std::fmax(a, b) + 1; }},
        {"pin_light", [](float a, float b, float, float) { return pin_light(a, b); }},
        {"plus", [](float a, float b, float, float) { return a + b; }},
        {"reflect", [](float a, float b, float, float) { return reflect(a, b); }},
        {"screen", [](float a, float b, float, float) { return screen(a, b); }},
        {"soft_light",
         [](float a, float b, float, float) { return (1 - 2 * a) * b * b + 2 * a * b; }},
        {"stencil", [](float, float b, float fa, float) { return b * (1 - fa); }},
        {"subtract", [](float a, float b, float, float) { return std::fmax(0.0F, b - a); }},
        {"under", [](float a, float b, float, float fb) { return a * (1 - fb) + b; }},
        {"vivid_light", [](float a, float b, float, float) { return vivid_light(a, b); }},
        {"xor", [](float a, float b, float fa, float fb) { return a * (1 - fb) + b * (1 - fa); }},
    };
    return kAll;
}

[[nodiscard]] inline std::vector<std::string> composite_op_names() {
    std::vector<std::string> out;
    for (const CompositeOp& op : composite_ops())
        out.emplace_back(op.name);
    return out;
}

}  // namespace lightsieve
