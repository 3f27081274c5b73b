#include "core/matrix.h"

#include <utility>

namespace lightsieve {

Mat4f operator*(const Mat4f& a, const Mat4f& b) {
    Mat4f out;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            float sum = 0;
            for (std::size_t k = 0; k < 4; ++k)
                sum += a.m[i][k] * b.m[k][j];
            out.m[i][j] = sum;
        }
    return out;
}

Mat4f Mat4f::transposed() const {
    Mat4f out;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            out.m[i][j] = m[j][i];
    return out;
}

Mat4f Mat4f::inverse(bool* ok) const {
    // Gauss-Jordan with partial pivoting, in double: scene scales differ by many orders of magnitude.
    std::array<std::array<double, 8>, 4> a{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            a[i][j] = m[i][j];
            a[i][j + 4] = i == j ? 1 : 0;
        }
    for (std::size_t c = 0; c < 4; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < 4; ++r)
            if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
        if (!(std::abs(a[pivot][c]) > 0)) {
            if (ok != nullptr) *ok = false;
            return {};
        }
        std::swap(a[c], a[pivot]);
        const double inv = 1 / a[c][c];
        for (double& v : a[c])
            v *= inv;
        for (std::size_t r = 0; r < 4; ++r) {
            if (r == c) continue;
            const double f = a[r][c];
            for (std::size_t j = 0; j < 8; ++j)
                a[r][j] -= f * a[c][j];
        }
    }
    Mat4f out;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            out.m[i][j] = static_cast<float>(a[i][j + 4]);
    const bool good = out.finite();
    if (ok != nullptr) *ok = good;
    return good ? out : Mat4f{};
}

float Mat4f::determinant3() const {
    const Vec3f x{m[0][0], m[0][1], m[0][2]}, y{m[1][0], m[1][1], m[1][2]},
        z{m[2][0], m[2][1], m[2][2]};
    return dot(x, cross(y, z));
}

bool Mat4f::finite() const {
    for (const auto& row : m)
        for (float v : row)
            if (!std::isfinite(v)) return false;
    return true;
}

Mat4f Mat4f::translation(Vec3f t) {
    Mat4f out;
    out.m[3] = {t.x, t.y, t.z, 1};
    return out;
}

Mat4f Mat4f::scale(Vec3f s) {
    Mat4f out;
    out.m[0][0] = s.x;
    out.m[1][1] = s.y;
    out.m[2][2] = s.z;
    return out;
}

Mat4f Mat4f::look_at(Vec3f eye, Vec3f target, Vec3f up) {
    const Vec3f z = normalize(eye - target);
    Vec3f x = cross(up, z);
    if (!(length_squared(x) > 1e-12F)) x = Frame::from_z(z).x;
    x = normalize(x);
    const Vec3f y = cross(z, x);
    Mat4f out;
    out.m[0] = {x.x, x.y, x.z, 0};
    out.m[1] = {y.x, y.y, y.z, 0};
    out.m[2] = {z.x, z.y, z.z, 0};
    out.m[3] = {eye.x, eye.y, eye.z, 1};
    return out;
}

Mat4f lerp(const Mat4f& a, const Mat4f& b, float t) {
    Mat4f out;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            out.m[i][j] = a.m[i][j] + (b.m[i][j] - a.m[i][j]) * t;
    return out;
}

}  // namespace lightsieve
