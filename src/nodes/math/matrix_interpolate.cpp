// matrix_interpolate: a matrix between keys, by the time or by a number.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class InterpolateBy : std::int32_t { Time, Value };

struct MatrixInterpolate {
    Array<Mat4f> matrix;
    InterpolateBy type = InterpolateBy::Time;
    float value = 0;

    static NodeType describe();
    [[nodiscard]] Mat4f eval(const ShadePoint& at) const;
};

NodeType MatrixInterpolate::describe() {
    Describe<MatrixInterpolate> d("matrix_interpolate", NodeKind::Shader,
                                  "A matrix between several, evenly spaced ones.");
    d.param("matrix", &MatrixInterpolate::matrix, "The keys.");
    d.param("type", &MatrixInterpolate::type,
            "What moves from the first key to the last: the time within the shutter, or `value`.")
        .names({"time", "value"});
    d.param("value", &MatrixInterpolate::value, "0: the first key; 1: the last.").range(0, 1);
    return d.done();
}

Mat4f MatrixInterpolate::eval(const ShadePoint& at) const {
    const std::size_t n = std::size_t{matrix.n} * matrix.n_keys;
    if (n == 0) return {};
    const float place =
        unit(type == InterpolateBy::Time ? at.time : value) * static_cast<float>(n - 1);
    const auto first = std::min(static_cast<std::size_t>(place), n - 1);
    return lerp(matrix[first], matrix[std::min(first + 1, n - 1)],
                place - static_cast<float>(first));
}

}  // namespace

NodeType node_matrix_interpolate() { return MatrixInterpolate::describe(); }

}  // namespace lightsieve
