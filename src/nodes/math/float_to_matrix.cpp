// float_to_matrix: sixteen numbers as a matrix.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct FloatToMatrix {
    float input_00 = 1, input_01 = 0, input_02 = 0, input_03 = 0;
    float input_10 = 0, input_11 = 1, input_12 = 0, input_13 = 0;
    float input_20 = 0, input_21 = 0, input_22 = 1, input_23 = 0;
    float input_30 = 0, input_31 = 0, input_32 = 0, input_33 = 1;

    static NodeType describe();
    [[nodiscard]] Mat4f eval(const ShadePoint&) const {
        Mat4f out;
        out.m = {{{input_00, input_01, input_02, input_03},
                  {input_10, input_11, input_12, input_13},
                  {input_20, input_21, input_22, input_23},
                  {input_30, input_31, input_32, input_33}}};
        return out;
    }
};

NodeType FloatToMatrix::describe() {
    Describe<FloatToMatrix> d("float_to_matrix", NodeKind::Shader, "Sixteen numbers as a matrix.");
    const char* no_effect = "Column 3, which transforms of points and vectors leave out.";
    d.param("input_00", &FloatToMatrix::input_00, "Row 0, column 0.");
    d.param("input_01", &FloatToMatrix::input_01, "Row 0, column 1.");
    d.param("input_02", &FloatToMatrix::input_02, "Row 0, column 2.");
    d.param("input_03", &FloatToMatrix::input_03, no_effect).ignored();
    d.param("input_10", &FloatToMatrix::input_10, "Row 1, column 0.");
    d.param("input_11", &FloatToMatrix::input_11, "Row 1, column 1.");
    d.param("input_12", &FloatToMatrix::input_12, "Row 1, column 2.");
    d.param("input_13", &FloatToMatrix::input_13, no_effect).ignored();
    d.param("input_20", &FloatToMatrix::input_20, "Row 2, column 0.");
    d.param("input_21", &FloatToMatrix::input_21, "Row 2, column 1.");
    d.param("input_22", &FloatToMatrix::input_22, "Row 2, column 2.");
    d.param("input_23", &FloatToMatrix::input_23, no_effect).ignored();
    d.param("input_30", &FloatToMatrix::input_30, "Row 3, column 0.");
    d.param("input_31", &FloatToMatrix::input_31, "Row 3, column 1.");
    d.param("input_32", &FloatToMatrix::input_32, "Row 3, column 2.");
    d.param("input_33", &FloatToMatrix::input_33, no_effect).ignored();
    return d.done();
}

}  // namespace

NodeType node_float_to_matrix() { return FloatToMatrix::describe(); }

}  // namespace lightsieve
