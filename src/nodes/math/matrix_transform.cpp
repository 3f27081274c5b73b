// matrix_transform: a matrix from scale, rotation and translation.
#include "nodes/common/rotations.h"
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

/// Named in the order in which the parts act.
enum class TransformOrder : std::int32_t { Srt, Str, Rst, Rts, Tsr, Trs };
enum class RotationType : std::int32_t { Euler, AxisAngle };

struct MatrixTransform {
    TransformOrder transform_order = TransformOrder::Srt;
    RotationType rotation_type = RotationType::Euler;
    AngleUnits units = AngleUnits::Degrees;
    RotationOrder rotation_order = RotationOrder::Xyz;
    Vec3f rotation;
    Vec3f axis{1, 0, 0};
    float angle = 0;
    Vec3f translate;
    Vec3f scale{1, 1, 1};
    Vec3f pivot;

    static NodeType describe();
    [[nodiscard]] Mat4f eval(const ShadePoint&) const;

  private:
    [[nodiscard]] Mat4f rotated() const;
};

NodeType MatrixTransform::describe() {
    Describe<MatrixTransform> d("matrix_transform", NodeKind::Shader,
                                "A matrix from scale, rotation and translation.");
    d.param("transform_order", &MatrixTransform::transform_order,
            "Which part acts first: scale, rotation, translation.")
        .names({"srt", "str", "rst", "rts", "tsr", "trs"});
    d.param("rotation_type", &MatrixTransform::rotation_type,
            "Rotation about the three axes in turn, or about one axis.")
        .names({"euler", "axis_angle"});
    d.param("units", &MatrixTransform::units, "Of the angles.").names(angle_unit_names());
    d.param("rotation_order", &MatrixTransform::rotation_order,
            "Which axis comes first, for rotation_type euler.")
        .names(rotation_order_names());
    d.param("rotation", &MatrixTransform::rotation, "Angles about x, y and z.");
    d.param("axis", &MatrixTransform::axis, "Axis for rotation_type axis_angle.");
    d.param("angle", &MatrixTransform::angle, "Angle about it.");
    d.param("translate", &MatrixTransform::translate, "Translation.");
    d.param("scale", &MatrixTransform::scale, "Scale along the axes.");
    d.param("pivot", &MatrixTransform::pivot, "What scale and rotation leave in its place.");
    return d.done();
}

Mat4f MatrixTransform::rotated() const {
    const float unit = units == AngleUnits::Degrees ? kPi / 180 : 1.0F;
    if (rotation_type == RotationType::AxisAngle)
        return rotation_about(normalize(axis, {1, 0, 0}), angle * unit);
    return rotation_in_order(rotation * unit, rotation_order);
}

Mat4f MatrixTransform::eval(const ShadePoint&) const {
    const Mat4f to_pivot = Mat4f::translation(-pivot), from_pivot = Mat4f::translation(pivot);
    const Mat4f s = to_pivot * Mat4f::scale(scale) * from_pivot,
                r = to_pivot * rotated() * from_pivot, t = Mat4f::translation(translate);
    switch (transform_order) {
        case TransformOrder::Srt: return s * r * t;
        case TransformOrder::Str: return s * t * r;
        case TransformOrder::Rst: return r * s * t;
        case TransformOrder::Rts: return r * t * s;
        case TransformOrder::Tsr: return t * s * r;
        case TransformOrder::Trs: return t * r * s;
    }
    return {};
}

}  // namespace

NodeType node_matrix_transform() { return MatrixTransform::describe(); }

}  // namespace lightsieve
