// matrix_multiply_vector: a point, vector or normal transformed.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class Transformed : std::int32_t { Point, Vector, Normal };

struct MatrixMultiplyVector {
    Vec3f input;
    Transformed type = Transformed::Point;
    Mat4f matrix;

    static NodeType describe() {
        Describe<MatrixMultiplyVector> d("matrix_multiply_vector", NodeKind::Shader,
                                         "A point, vector or normal transformed by a matrix.");
        d.param("input", &MatrixMultiplyVector::input, "What is transformed.");
        d.param("type", &MatrixMultiplyVector::type,
                "What it is: vectors are not moved, normals stay across their surface.")
            .names({"point", "vector", "normal"});
        d.param("matrix", &MatrixMultiplyVector::matrix, "The transform, row vectors.");
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint&) const {
        switch (type) {
            case Transformed::Point: return matrix.point(input);
            case Transformed::Vector: return matrix.vector(input);
            case Transformed::Normal: break;
        }
        return matrix.inverse().normal_by_inverse(input);
    }
};

}  // namespace

NodeType node_matrix_multiply_vector() { return MatrixMultiplyVector::describe(); }

}  // namespace lightsieve
