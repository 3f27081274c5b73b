// atan: angle of a point, channel by channel.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct Atan {
    Color y, x{1, 1, 1};
    AngleUnits units = AngleUnits::Radians;

    static NodeType describe() {
        Describe<Atan> d("atan", NodeKind::Shader,
                         "Angle of the points (x, y), one a channel: the arc tangent of y / x.");
        d.param("y", &Atan::y, "Upward.");
        d.param("x", &Atan::x, "To the right.");
        d.param("units", &Atan::units, "Of the result.").names(angle_unit_names());
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const {
        const float unit = units == AngleUnits::Degrees ? 180 / kPi : 1.0F;
        return Color{std::atan2(y.r, x.r), std::atan2(y.g, x.g), std::atan2(y.b, x.b)} * unit;
    }
};

}  // namespace

NodeType node_atan() { return Atan::describe(); }

}  // namespace lightsieve
