#include "render/term_reduction.h"

#include <algorithm>
#include <cmath>

namespace lightsieve {
namespace {

double determinant(Color a, Color b, Color c) {
    return double{a.r} * (double{b.g} * c.b - double{b.b} * c.g) - double{a.g} * (double{b.r} * c.b - double{b.b} * c.r) + double{a.b} * (double{b.r} * c.g - double{b.g} * c.r);
}

/// v with sum v_i y_i = 0, not all 0, for vectors whose largest channel is 1.
///
/// By Cramer's rule where the four span space; from three of them where they lie in a plane; from two where all are parallel.
std::array<double, 4> null_vector(const std::array<Color, 4>& y) {
    // Below this a determinant of unit-sized vectors is rounding noise.
    constexpr double kFlat = 1e-5;
    const std::array<double, 4> v{determinant(y[1], y[2], y[3]), -determinant(y[0], y[2], y[3]), determinant(y[0], y[1], y[3]), -determinant(y[0], y[1], y[2])};
    for (double entry : v)
        if (std::abs(entry) > kFlat) return v;
    for (std::size_t drop = 0; drop < 4; ++drop) {
        std::array<std::size_t, 3> at{};
        for (std::size_t i = 0, n = 0; i < 4; ++i)
            if (i != drop) at[n++] = i;
        for (int axis = 0; axis < 3; ++axis) {
            const int b = (axis + 1) % 3, c = (axis + 2) % 3;
            const auto minor = [&](std::size_t p, std::size_t q) { return double{y[p][b]} * y[q][c] - double{y[p][c]} * y[q][b]; };
            const std::array<double, 3> w{minor(at[1], at[2]), -minor(at[0], at[2]), minor(at[0], at[1])};
            if (std::max({std::abs(w[0]), std::abs(w[1]), std::abs(w[2])}) <= kFlat) continue;
            std::array<double, 4> out{};
            for (std::size_t i = 0; i < 3; ++i)
                out[at[i]] = w[i];
            return out;
        }
    }
    return {1, -1, 0, 0};
}

}  // namespace

std::size_t drop_one_of_four(std::array<Color, 4>& x, float u) {
    for (std::size_t i = 0; i < 4; ++i)
        if (is_black(x[i])) return i;
    // Found for vectors of size 1, so that faint entries count as much as bright ones.
    std::array<Color, 4> unit;
    for (std::size_t i = 0; i < 4; ++i)
        unit[i] = x[i] * (1 / max_component(x[i]));
    std::array<double, 4> v = null_vector(unit);
    for (std::size_t i = 0; i < 4; ++i)
        v[i] /= double{max_component(x[i])};
    // Largest steps along +v and -v that keep every factor >= 0, and the entries that reach 0 there.
    double up = HUGE_VAL, down = HUGE_VAL;
    std::size_t at_up = 0, at_down = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (v[i] < 0 && -1 / v[i] < up) {
            up = -1 / v[i];
            at_up = i;
        }
        if (v[i] > 0 && 1 / v[i] < down) {
            down = 1 / v[i];
            at_down = i;
        }
    }
    // x has no negative entries, so v has both signs and both steps are finite.
    const bool go_up = double{u} * (up + down) < down;
    const double step = go_up ? up : -down;
    for (std::size_t i = 0; i < 4; ++i)
        x[i] *= static_cast<float>(std::max(0.0, 1 + step * v[i]));
    const std::size_t dropped = go_up ? at_up : at_down;
    x[dropped] = Color{};
    return dropped;
}

}  // namespace lightsieve
