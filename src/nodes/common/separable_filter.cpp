#include "nodes/common/separable_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace lightsieve {

namespace {

/// Cells of [0, radius]; narrow enough that four points integrate any profile of these filters to double precision.
constexpr int kCells = 256;
/// Newton steps converge quadratically from a linear guess; the bracket catches the rest.
constexpr int kSteps = 12;

/// Zero of f in [a, b], where its signs differ.
double find_zero(const std::function<double(double)>& f, double a, double b) {
    const bool rising = f(b) > 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (a + b);
        ((f(middle) > 0) == rising ? b : a) = middle;
    }
    return 0.5 * (a + b);
}

/// Four-point Gauss-Legendre quadrature. Source: Abramowitz and Stegun, table 25.4.
template <class F>
double quadrature(const F& f, double a, double b) {
    constexpr std::array<double, 2> kNode = {0.339981043584856, 0.861136311594053};
    constexpr std::array<double, 2> kWeight = {0.652145154862546, 0.347854845137454};
    const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
    double sum = 0;
    for (std::size_t i = 0; i < 2; ++i)
        sum += kWeight[i] * (f(centre - half * kNode[i]) + f(centre + half * kNode[i]));
    return sum * half;
}

}  // namespace

SeparableFilter::SeparableFilter(float radius, std::function<double(double)> profile)
    : radius_(radius), profile_(std::move(profile)) {
    const double r = double{radius_};
    for (int i = 0; i <= kCells; ++i) {
        const double edge = r * i / kCells;
        if (i > 0) {
            const double before = profile_(edges_.back()), here = profile_(edge);
            if (before * here < 0) edges_.push_back(find_zero(profile_, edges_.back(), edge));
        }
        edges_.push_back(edge);
    }
    double sum = 0, total = 0;
    cumulative_.push_back(0);
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
        const double part = quadrature(profile_, edges_[i], edges_[i + 1]);
        sum += part;
        total += std::abs(part);
        cumulative_.push_back(total);
    }
    LIGHTSIEVE_ASSERT(sum > 0, "a filter without a positive integral");
    scale_ = (total / sum) * (total / sum);
}

double SeparableFilter::profile_at(float x) const {
    const float a = std::abs(x);
    return a <= radius_ ? profile_(double{a}) : 0;
}

float SeparableFilter::eval(Vec2f offset) const {
    return static_cast<float>(profile_at(offset.x) * profile_at(offset.y));
}

float SeparableFilter::pdf(Vec2f offset) const {
    const double whole = 2 * cumulative_.back();
    return static_cast<float>(std::abs(profile_at(offset.x) * profile_at(offset.y)) /
                              (whole * whole));
}

double SeparableFilter::magnitude(double a, double b) const {
    return quadrature([this](double x) { return std::abs(profile_(x)); }, a, b);
}

double SeparableFilter::invert(float u) const {
    // The filter is even: the middle half of the unit interval is the middle of the pixel.
    const double signed_u = 2 * double{u} - 1;
    const double target = std::abs(signed_u) * cumulative_.back();
    const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, target);
    const auto cell = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
    const double within = target - cumulative_[cell],
                 mass = cumulative_[cell + 1] - cumulative_[cell];
    const double start = edges_[cell];
    double low = start, high = edges_[cell + 1];
    double x = mass > 0 ? low + (high - low) * within / mass : low;
    for (int i = 0; i < kSteps; ++i) {
        const double error = magnitude(start, x) - within;
        (error > 0 ? high : low) = x;
        const double slope = std::abs(profile_(x));
        const double next = slope > 0 ? x - error / slope : 0.5 * (low + high);
        const double bounded = next > low && next < high ? next : 0.5 * (low + high);
        if (std::abs(bounded - x) < 1e-9 * double{radius_}) break;
        x = bounded;
    }
    return std::copysign(x, signed_u);
}

PixelFilter::Sample SeparableFilter::sample(Vec2f u) const {
    const Vec2f offset{static_cast<float>(invert(u.x)), static_cast<float>(invert(u.y))};
    const bool negative = profile_at(offset.x) * profile_at(offset.y) < 0;
    return {offset, static_cast<float>(negative ? -scale_ : scale_)};
}

}  // namespace lightsieve
