// set_transform: moves the selected nodes.
#include <cmath>

#include "nodes/common/rotations.h"
#include "nodes/operator/operator_common.h"
#include "scene/value_text.h"

namespace lightsieve {
namespace {

enum class TransformOrder : std::int32_t { Srt, Str, Tsr, Trs, Rst, Rts };
enum class Mode : std::int32_t { Append, Replace };

struct SetTransform : SelectingOperator {
    Vec3f translate, rotate, scale{1, 1, 1};
    TransformOrder transform_order = TransformOrder::Srt;
    RotationOrder rotate_order = RotationOrder::Xyz;
    Mat4f matrix;
    Mode mode = Mode::Append;

    static NodeType describe() {
        Describe<SetTransform> d("set_transform", NodeKind::Operator,
                                 "Moves, turns and scales the selected nodes.");
        describe_selecting_operator(d);
        d.param("translate", &SetTransform::translate, "Translation.").unit("scene units");
        d.param("rotate", &SetTransform::rotate, "Angles about the axes.").unit("deg");
        d.param("scale", &SetTransform::scale, "Scale along the axes.");
        d.param("transform_order", &SetTransform::transform_order,
                "Which part acts first: scale, rotation, translation.")
            .names({"srt", "str", "tsr", "trs", "rst", "rts"});
        d.param("rotate_order", &SetTransform::rotate_order, "Which axis comes first.")
            .names(rotation_order_names());
        d.param("matrix", &SetTransform::matrix, "Acts after all of these.");
        d.param("mode", &SetTransform::mode,
                "append: acts after the node's own matrix; replace: in its place.")
            .names({"append", "replace"});
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        cook_inputs(context);
        if (!enable) return;
        static const Name kMatrix("matrix");
        const Mat4f change = transform();
        for (NodeInstance* node : select(context)) {
            const auto* keys = node->find<Array<Mat4f>>(kMatrix);
            if (keys == nullptr) continue;
            std::vector<Mat4f> moved{change};
            const std::uint32_t n = keys->n, n_keys = keys->n_keys;
            if (mode == Mode::Append && !keys->empty())
                moved.assign(keys->data, keys->data + std::size_t{n} * n_keys);
            if (mode == Mode::Append && !keys->empty())
                for (Mat4f& m : moved)
                    m = m * change;
            const bool kept = moved.size() == std::size_t{n} * n_keys;
            context.set(
                *node, kMatrix.view(),
                array_text(ParamType::Matrix, reinterpret_cast<const std::byte*>(moved.data()),
                           kept ? n : 1, kept ? n_keys : 1, nullptr, " "));
        }
    }

  private:
    [[nodiscard]] Mat4f transform() const {
        const Mat4f s = Mat4f::scale(scale),
                    r = rotation_in_order(rotate * (kPi / 180), rotate_order),
                    t = Mat4f::translation(translate);
        switch (transform_order) {
            case TransformOrder::Srt: return s * r * t * matrix;
            case TransformOrder::Str: return s * t * r * matrix;
            case TransformOrder::Tsr: return t * s * r * matrix;
            case TransformOrder::Trs: return t * r * s * matrix;
            case TransformOrder::Rst: return r * s * t * matrix;
            case TransformOrder::Rts: return r * t * s * matrix;
        }
        return matrix;
    }
};

}  // namespace

NodeType node_set_transform() { return SetTransform::describe(); }

}  // namespace lightsieve
