// 4x4 transforms in Arnold's convention: row vectors, p' = p * M, translation in the last row.
//
// So `a * b` applies a first. Names read `to_from`: world_from_object.
#pragma once

#include <array>

#include "core/vec.h"

namespace lightsieve {

struct Mat4f {
    std::array<std::array<float, 4>, 4> m{
        {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

    friend constexpr bool operator==(const Mat4f&, const Mat4f&) = default;
    friend Mat4f operator*(const Mat4f& a, const Mat4f& b);
    /// Transforms a point (affine part only; w is taken as 1).
    [[nodiscard]] Vec3f point(Vec3f p) const {
        return vector(p) + Vec3f{m[3][0], m[3][1], m[3][2]};
    }
    /// Transforms a direction; its length changes with the scale.
    [[nodiscard]] Vec3f vector(Vec3f v) const {
        return {v.x * m[0][0] + v.y * m[1][0] + v.z * m[2][0],
                v.x * m[0][1] + v.y * m[1][1] + v.z * m[2][1],
                v.x * m[0][2] + v.y * m[1][2] + v.z * m[2][2]};
    }
    /// Transforms a normal with the inverse transpose; call on the INVERSE matrix. Not normalised.
    [[nodiscard]] Vec3f normal_by_inverse(Vec3f n) const {
        return {n.x * m[0][0] + n.y * m[0][1] + n.z * m[0][2],
                n.x * m[1][0] + n.y * m[1][1] + n.z * m[1][2],
                n.x * m[2][0] + n.y * m[2][1] + n.z * m[2][2]};
    }
    [[nodiscard]] Mat4f transposed() const;
    /// The inverse; `ok` (if given) tells whether the matrix was invertible, otherwise identity is returned.
    [[nodiscard]] Mat4f inverse(bool* ok = nullptr) const;
    /// Determinant of the upper 3x3; negative when handedness flips.
    [[nodiscard]] float determinant3() const;
    [[nodiscard]] bool finite() const;

    static Mat4f translation(Vec3f t);
    static Mat4f scale(Vec3f s);
    /// Camera or spot placement: origin at `eye`, local -Z toward `target`. `up` need not be orthogonal.
    static Mat4f look_at(Vec3f eye, Vec3f target, Vec3f up);
};

/// Blends two transforms for motion blur, element by element, as Arnold's matrix keys are.
[[nodiscard]] Mat4f lerp(const Mat4f& a, const Mat4f& b, float t);

}  // namespace lightsieve
