// sky: the old environment shader, a colour or a picture all around; what skydome_light took over from.
#include "nodes/light/dome_format.h"
#include "scene/describe.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

struct Sky {
    Lazy<Color> color{{1, 1, 1}, {}};
    float intensity = 1;
    std::int32_t visibility = 255;
    bool opaque_alpha = true;
    DomeFormat format = DomeFormat::Angular;
    Vec3f X{1, 0, 0}, Y{0, 1, 0}, Z{0, 0, 1};

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;
};

NodeType Sky::describe() {
    Describe<Sky> d("sky", NodeKind::Shader,
                    "A colour or a picture of the surroundings, for options.background.");
    d.param("color", &Sky::color, "Colour; what is linked is looked up by direction.");
    d.param("intensity", &Sky::intensity, "Factor on the colour.");
    d.param(
         "visibility", &Sky::visibility,
         "Types of rays that see it; options.background_visibility says it for all backgrounds.")
        .pending();
    d.param("opaque_alpha", &Sky::opaque_alpha, "Alpha is 1; off: 0.");
    d.param("format", &Sky::format, "Layout of the picture.")
        .names({"mirrored_ball", "angular", "latlong"});
    d.param("X", &Sky::X, "Direction in the world of the picture's X axis.");
    d.param("Y", &Sky::Y, "Direction in the world of the picture's Y axis.");
    d.param("Z", &Sky::Z, "Direction in the world of the picture's Z axis, its middle.");
    return d.done();
}

Rgba Sky::eval(const ShadePoint& at) const {
    ShadePoint there = at;
    there.uv = dome_uv(
        format, normalize(Vec3f{dot(at.direction, X), dot(at.direction, Y), dot(at.direction, Z)},
                          {0, 0, 1}));
    there.dp_du = there.dp_dv = {};
    return {color.at(there) * intensity, opaque_alpha ? 1.0F : 0.0F};
}

}  // namespace

NodeType node_sky() { return Sky::describe(); }

}  // namespace lightsieve
