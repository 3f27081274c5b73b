// state_float: numbers of the point that is shaded.
#include "scene/describe.h"
#include "scene/shade_services.h"

namespace lightsieve {
namespace {

enum class Variable : std::int32_t { Sx, Sy, Px, Py, Rl, U, V, Bu, Bv, Area, Time };

struct StateFloat {
    Variable variable = Variable::Sx;

    static NodeType describe();
    [[nodiscard]] float eval(const ShadePoint& at) const;
};

NodeType StateFloat::describe() {
    Describe<StateFloat> d("state_float", NodeKind::Shader, "A number of the shaded point.");
    d.param(
         "variable", &StateFloat::variable,
         "sx, sy: place in the picture, -1..1; px, py: place in the pixel, 0..1; Rl: length of "
         "the ray; u, v: texture coordinates; bu, bv: place in the triangle; area: of the ray's "
         "footprint; time: within the shutter.")
        .names({"sx", "sy", "px", "py", "Rl", "u", "v", "bu", "bv", "area", "time"});
    return d.done();
}

float StateFloat::eval(const ShadePoint& at) const {
    static const RayState none;
    const RayState& ray = at.ray != nullptr ? *at.ray : none;
    switch (variable) {
        case Variable::Sx: return ray.screen.x;
        case Variable::Sy: return ray.screen.y;
        case Variable::Px: return ray.subpixel.x;
        case Variable::Py: return ray.subpixel.y;
        case Variable::Rl: return at.ray_length;
        case Variable::U: return at.uv.x;
        case Variable::V: return at.uv.y;
        case Variable::Bu: return at.barycentric.x;
        case Variable::Bv: return at.barycentric.y;
        case Variable::Area: return at.width * at.width;
        case Variable::Time: return at.time;
    }
    return 0;
}

}  // namespace

NodeType node_state_float() { return StateFloat::describe(); }

}  // namespace lightsieve
