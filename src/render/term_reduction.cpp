#include "render/term_reduction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lightsieve {
namespace {

/// Three equations in four unknowns: rows are channels, columns the four colours. In double, because the sum must hold for
/// floats to their last bits.
using Equations = std::array<std::array<double, 4>, 3>;

/// v with sum v_i y_i = 0, not all 0, for colours y whose largest channel is 1.
///
/// Elimination with complete pivoting, which is exact to rounding however nearly the colours lie in a plane or a line, and
/// keeps v small. Source: Golub and Van Loan, "Matrix Computations", 4th ed., section 3.4.
std::array<double, 4> null_vector(Equations a) {
    constexpr double kNothing = 1e-14;  // what remains of an entry of size 1 that cancels
    std::array<std::size_t, 4> column{0, 1, 2, 3};
    std::size_t rank = 0;
    for (; rank < 3; ++rank) {
        // Bring the largest entry that is left to the diagonal.
        std::size_t row = rank, col = rank;
        for (std::size_t i = rank; i < 3; ++i)
            for (std::size_t j = rank; j < 4; ++j)
                if (std::abs(a[i][j]) > std::abs(a[row][col])) row = i, col = j;
        if (std::abs(a[row][col]) <= kNothing) break;
        std::swap(a[rank], a[row]);
        std::swap(column[rank], column[col]);
        for (auto& r : a)
            std::swap(r[rank], r[col]);
        for (std::size_t i = rank + 1; i < 3; ++i) {
            const double factor = a[i][rank] / a[rank][rank];
            for (std::size_t j = rank; j < 4; ++j)
                a[i][j] -= factor * a[rank][j];
        }
    }
    // One unknown is free; the pivots' follow from the last to the first, the rest stays 0.
    std::array<double, 4> v{};
    v[column[rank]] = 1;
    for (std::size_t i = rank; i-- > 0;) {
        double sum = 0;
        for (std::size_t j = i + 1; j <= rank; ++j)
            sum += a[i][j] * v[column[j]];
        v[column[i]] = -sum / a[i][i];
    }
    return v;
}

}  // namespace

std::size_t drop_one_of_four(std::array<Color, 4>& x, float u) {
    for (std::size_t i = 0; i < 4; ++i)
        if (is_black(x[i])) return i;
    // Found for vectors of size 1, so that faint entries count as much as bright ones.
    Equations unit;
    for (std::size_t i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c)
            unit[static_cast<std::size_t>(c)][i] = double{x[i][c]} / double{max_component(x[i])};
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
