// Writes src/bsdf/albedo_table_data.inc: the directional albedos that have no closed form, by brute force.
//
// Each entry is a midpoint rule over the square that the visible-normal sampling of microfacets (Dupuy and Benyoub
// 2023) maps to directions, so the integrand is the sample weight and nearly smooth. In double precision, and on
// purpose without any code of the lobe models: the unit tests compare the two.
//
//     ninja make_albedo_table && ./make_albedo_table > src/bsdf/albedo_table_data.inc        (about half a minute)
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "bsdf/albedo_grid.h"
#include "bsdf/sheen.h"

namespace {

using namespace lightsieve::albedo_grid;

/// Points along each axis of the square; the error is about 1e-4.
constexpr int kPoints = 256;

struct Fresnel {
    double reflectance, cos_far;
};

Fresnel fresnel(double c, double eta) {
    const double g2 = eta * eta - 1 + c * c;
    if (g2 <= 0) return {1, 0};
    const double g = std::sqrt(g2), perpendicular = (c - g) / (c + g), parallel = (eta * eta * c - g) / (eta * eta * c + g);
    return {(perpendicular * perpendicular + parallel * parallel) / 2, g / eta};
}

/// Calls body(cosine at the microfacet, microfacet normal's z, G2 / G1 of reflection, or 0 if that goes below).
void for_each_visible_normal(double mu, double alpha, const std::function<void(double, double, double)>& body) {
    const double sin_o = std::sqrt(1 - mu * mu), v_o = std::hypot(mu, alpha * sin_o);
    const double sx = alpha * sin_o / v_o, sz = mu / v_o;
    for (int i = 0; i < kPoints; ++i) {
        // The lobe is symmetric in phi: half of it will do. Rows are shifted so that columns do not line up.
        const double phi = std::numbers::pi * (i + 0.5) / kPoints;
        for (int j = 0; j < kPoints; ++j) {
            const double u = std::fmod((j + 0.5 + i * std::numbers::phi) / kPoints, 1.0);
            const double z = (1 - u) * (1 + sz) - sz, r = std::sqrt(std::max(0.0, 1 - z * z));
            const double hx = alpha * (r * std::cos(phi) + sx), hy = alpha * r * std::sin(phi), hz = z + sz;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            const double c = std::clamp((sin_o * hx + mu * hz) / length, 0.0, 1.0), normal_z = hz / length;
            const double mu_i = 2 * c * normal_z - mu;
            const double v_i = std::sqrt(mu_i * mu_i + alpha * alpha * std::max(0.0, 1 - mu_i * mu_i));
            body(c, normal_z, mu_i > 0 ? mu_i * (mu + v_o) / (mu_i * v_o + mu * v_i) : 0);
        }
    }
}

constexpr double kPointWeight = 1.0 / (kPoints * kPoints);

double white(double mu, double alpha) {
    double sum = 0;
    for_each_visible_normal(mu, alpha, [&](double, double, double weight) { sum += weight; });
    return sum * kPointWeight;
}

/// The Gauss quadrature of three points of the distribution of the cosine at the microfacets that reflect.
std::array<double, kMeanValues> mean_cosines(double mu, double alpha) {
    std::vector<std::array<double, 2>> points;  // cosine, weight
    for_each_visible_normal(mu, alpha, [&](double c, double, double weight) { points.push_back({c, weight}); });

    // Coefficients of the recurrence of the orthogonal polynomials, by Stieltjes' procedure.
    std::array<double, 3> a{}, b{};
    std::vector<double> before(points.size(), 0), now(points.size(), 1);
    double norm_before = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        double norm = 0, first = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            norm += points[i][1] * now[i] * now[i];
            first += points[i][1] * now[i] * now[i] * points[i][0];
        }
        a[k] = first / norm;
        b[k] = k == 0 ? 0 : norm / norm_before;
        norm_before = norm;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double next = (points[i][0] - a[k]) * now[i] - b[k] * before[i];
            before[i] = now[i];
            now[i] = next;
        }
    }

    // The nodes are the roots of the third polynomial, one between each two of 0, the roots of the second, and 1.
    const auto p1 = [&](double x) { return x - a[0]; };
    const auto p2 = [&](double x) { return (x - a[1]) * p1(x) - b[1]; };
    const auto p3 = [&](double x) { return (x - a[2]) * p2(x) - b[2] * p1(x); };
    const double middle = (a[0] + a[1]) / 2, half = std::sqrt((a[0] - a[1]) * (a[0] - a[1]) / 4 + b[1]);
    const std::array<double, 4> between{0, middle - half, middle + half, 1};
    std::array<double, kMeanValues> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        double low = between[i], high = between[i + 1];
        const bool rising = i != 1;
        for (int step = 0; step < 60; ++step) {
            const double x = (low + high) / 2;
            ((p3(x) < 0) == rising ? low : high) = x;
        }
        // Christoffel number: 1 / sum of the squares of the normalised polynomials.
        const double x = (low + high) / 2;
        result[i] = x;
        if (i < 2) result[3 + i] = 1 / (1 + p1(x) * p1(x) / b[1] + p2(x) * p2(x) / (b[1] * b[2]));
    }
    return result;
}

/// R (inside with compensation, as DielectricReflect) and T / (1 - R).
std::array<double, 2> dielectric(double mu, double alpha, double eta) {
    const double lost = eta < 1 ? 1 / white(mu, alpha) - 1 : 0;
    double reflected = 0, refracted = 0;
    for_each_visible_normal(mu, alpha, [&](double c, double normal_z, double weight) {
        const Fresnel f = fresnel(c, eta);
        reflected += weight * f.reflectance * (1 + lost * f.reflectance);
        const double mu_t = mu / eta - (c / eta - f.cos_far) * normal_z;
        if (f.cos_far > 0 && mu_t > 0) {
            const double v_t = std::sqrt(mu_t * mu_t + alpha * alpha * (1 - mu_t * mu_t));
            refracted += (1 - f.reflectance) * 2 * mu_t / (mu_t + v_t);
        }
    });
    const double r = reflected * kPointWeight, t = refracted * kPointWeight;
    return {r, 1 - r > 1e-9 ? t / (1 - r) : 1};
}

/// exp(L) of Estevez and Kulla, for cos < 1/2 mirrored.
double sheen_lambda(double cos_theta, double roughness) {
    const double t = (1 - roughness) * (1 - roughness);
    const auto mix = [t](double at_0, double at_1) { return t * at_0 + (1 - t) * at_1; };
    const auto l = [&](double x) {
        return mix(25.3245, 21.5473) / (1 + mix(3.32435, 3.82987) * std::pow(x, mix(0.16801, 0.19823))) + mix(-1.27393, -1.97760) * x + mix(-4.85967, -4.32054);
    };
    return std::exp(cos_theta < 0.5 ? l(cos_theta) : 2 * l(0.5) - l(1 - cos_theta));
}

double sheen(double mu, double roughness) {
    const double sin_o = std::sqrt(1 - mu * mu), lambda_o = sheen_lambda(mu, roughness);
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        // Uniform in cos theta and phi, denser toward the horizon.
        const double s = (i + 0.5) / kPoints, mu_i = s * s, sin_i = std::sqrt(1 - mu_i * mu_i);
        const double weight = 2 * s / (1 + sheen_lambda(mu_i, roughness) + lambda_o);
        for (int j = 0; j < kPoints; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / kPoints;
            const double x = sin_i * std::cos(phi) + sin_o, y = sin_i * std::sin(phi), z = mu + mu_i;
            const double sin_h = std::sqrt((x * x + y * y) / (x * x + y * y + z * z));
            sum += weight * std::pow(sin_h, 1 / roughness);
        }
    }
    // D / (4 mu), integrated over phi in [0, 2 pi].
    return sum * kPointWeight * (2 + 1 / roughness) / (4 * mu);
}

/// x in [low, high] at which the monotone `coordinate` is s.
double inverse(double low, double high, double s, const std::function<float(float)>& coordinate) {
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (static_cast<double>(coordinate(static_cast<float>(middle))) < s ? low : high) = middle;
    }
    return (low + high) / 2;
}

double node(int i, int n) { return static_cast<double>(i) / (n - 1); }

double alpha_of(double s) { return inverse(static_cast<double>(lightsieve::kSmoothAlpha), 1, s, alpha_coordinate); }

void print(double value) {
    static int column = 0;
    std::printf("%ld,%c", std::lround(std::clamp(value, -1.0, 1.09) * static_cast<double>(kScale)), ++column % 24 == 0 ? '\n' : ' ');
}

/// Calls body(cos theta, alpha) at the nodes of a table of white microfacets.
void for_each_white_node(int n_cos, int n_alpha, const std::function<void(double, double)>& body) {
    for (int a = 0; a < n_alpha; ++a) {
        const double alpha = alpha_of(node(a, n_alpha));
        const auto coordinate = [&](float c) { return white_cos_coordinate(c, static_cast<float>(alpha)); };
        for (int m = 0; m < n_cos; ++m) body(inverse(static_cast<double>(kMinCos), 1, node(m, n_cos), coordinate), alpha);
    }
}

void print_dielectric(bool inside) {
    const int n_eta = inside ? kInsideEta : kOutsideEta;
    for (int e = 0; e < n_eta; ++e) {
        const double outer = std::max(1.0001, inverse(1, static_cast<double>(lightsieve::kMaxEta), node(e, n_eta), eta_coordinate));
        const double eta = inside ? 1 / outer : outer;
        for (int a = 0; a < kDielectricAlpha; ++a) {
            const double alpha = alpha_of(node(a, kDielectricAlpha));
            const auto coordinate = [&](float c) { return dielectric_cos_coordinate(c, static_cast<float>(alpha), static_cast<float>(eta)); };
            for (int m = 0; m < kDielectricCos; ++m) {
                const double mu = inverse(static_cast<double>(kMinCos), 1, node(m, kDielectricCos), coordinate);
                const auto [r, share] = dielectric(mu, alpha, eta);
                print(r - static_cast<double>(fresnel_share(static_cast<float>(alpha), static_cast<float>(eta))) * fresnel(mu, eta).reflectance);
                print(share);
            }
        }
    }
}

void print_sheen() {
    const double smallest = static_cast<double>(lightsieve::kMinSheenRoughness);
    for (int r = 0; r < kSheenRoughness; ++r)
        for (int m = 0; m < kSheenCos; ++m)
            print(sheen(inverse(static_cast<double>(kMinCos), 1, node(m, kSheenCos), sheen_cos_coordinate), smallest + (1 - smallest) * node(r, kSheenRoughness)));
}

void begin_table(const char* name, const char* size) { std::printf("inline constexpr std::array<std::int16_t, %s> %s{\n", size, name); }

}  // namespace

int main() {
    std::puts("// Written by tools/make_albedo_table.cpp; the layout is in albedo_grid.h.");
    begin_table("kWhiteData", "kWhiteAlpha * kWhiteCos");
    for_each_white_node(kWhiteCos, kWhiteAlpha, [](double mu, double alpha) { print(white(mu, alpha)); });
    std::puts("};");
    begin_table("kMeanData", "kMeanAlpha * kMeanCos * kMeanValues");
    for_each_white_node(kMeanCos, kMeanAlpha, [](double mu, double alpha) {
        for (const double value : mean_cosines(mu, alpha)) print(value);
    });
    std::puts("};");
    begin_table("kOutsideData", "kOutsideEta * kDielectricAlpha * kDielectricCos * kDielectricValues");
    print_dielectric(false);
    std::puts("};");
    begin_table("kInsideData", "kInsideEta * kDielectricAlpha * kDielectricCos * kDielectricValues");
    print_dielectric(true);
    std::puts("};");
    begin_table("kSheenData", "kSheenRoughness * kSheenCos");
    print_sheen();
    std::puts("};");
    return 0;
}
