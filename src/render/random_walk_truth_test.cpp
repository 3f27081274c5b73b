// Walks of light below surfaces and through fog against the plainest simulation there is: one channel at a time, double
// precision, no importance, no sharing. It shares only the numbers that describe a medium with the renderer.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "bsdf/subsurface.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

struct Vec {
    double x = 0, y = 0, z = 0;
    Vec operator+(Vec o) const { return {x + o.x, y + o.y, z + o.z}; }
    Vec operator*(double s) const { return {x * s, y * s, z * s}; }
};
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Uniform numbers that are the same everywhere.
class Dice {
  public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double roll() { return (static_cast<double>(engine_()) + 0.5) / 4294967296.0; }
    Vec direction() {
        const double z = 1 - 2 * roll(), phi = 2 * M_PI * roll(), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// Cosine-weighted around unit vector n: the sum of n and a point of the unit sphere.
    Vec lambertian(Vec n) {
        const Vec v = n + direction();
        return v * (1 / std::sqrt(dot(v, v)));
    }

  private:
    std::mt19937 engine_;
};

/// Where the way out of a body ends; negative: never.
using Boundary = std::function<double(Vec position, Vec direction)>;

double leave_half_space(Vec p, Vec d) { return d.z > 0 ? -p.z / d.z : -1; }

double leave_ball(Vec p, Vec d) {
    const double b = dot(p, d), c = dot(p, p) - 1;
    return -b + std::sqrt(std::max(0.0, b * b - c));
}

struct Fog {
    double extinction = 1, albedo = 1;
};

/// Walks until it comes out and hands over where and with what weight.
void walk(Vec position, Vec direction, const Fog& fog, const Boundary& leave, Dice& dice,
          const std::function<void(Vec, double)>& came_out) {
    double weight = 1;
    for (int i = 0; i < 2000 && weight > 1e-5; ++i) {
        const double far = leave(position, direction),
                     way = -std::log(dice.roll()) / fog.extinction;
        if (far >= 0 && way >= far) return came_out(position + direction * far, weight);
        position = position + direction * way;
        direction = dice.direction();
        weight *= fog.albedo;
    }
}

std::string skin(std::string_view more) {
    return node("standard_surface", "skin",
                " base 0\n specular 0\n subsurface 1\n" + std::string(more));
}

TEST(RandomWalkTruth, LightBehindAnEdgeFallsOffAsSimulated) {
    // Half of a floor is lit. What arrives d behind the edge is what a walk from there brings out before it.
    const Color color{0.8F, 0.8F, 0.8F}, radius{0.3F, 0.2F, 0.12F};
    const SubsurfaceMedium medium(color, radius, 0);
    const Picture p = render(
        frame_text(4, 48, 16, ortho_camera({0.25F, 2, 0}, {0.25F, 0, 0}, 0.02F, {0, 0, -1})) +
        skin(" subsurface_color 0.8 0.8 0.8\n subsurface_radius 0.3 0.2 0.12") +
        floor("slab", 0, 50, "skin") + lambert("black", 0) +
        quad("screen", {0, 3, -50}, {0, 3, 50}, {50, 3, 50}, {50, 3, -50}, "black") +
        node("distant_light", "sun", " direction 0 -1 0\n intensity 3.14159265"));
    for (int c = 0; c < 3; ++c) {
        const Fog fog{1 / static_cast<double>(medium.mean_free_path[c]),
                      static_cast<double>(medium.albedo[c])};
        Dice dice(static_cast<std::uint32_t>(c) + 1);
        double lit = 0;
        const int n = 150000;
        for (int i = 0; i < n; ++i)
            walk({}, dice.lambertian({0, 0, -1}), fog, leave_half_space, dice,
                 [&](Vec at, double weight) { lit += at.x < -0.25 ? weight : 0; });
        const double truth = lit / n;
        const Estimate e = estimate(p, "RGBA", c);
        EXPECT_NEAR(e.mean, truth, kZ * e.error + 0.02 * truth) << c << " error " << e.error;
        EXPECT_LT(e.error, 0.02 * truth);
    }
}

TEST(RandomWalkTruth, ABallLitFromBehindGlowsAsSimulated) {
    // Straight into the ball's middle, the sun on its far side.
    const SubsurfaceMedium medium({0.95F, 0.8F, 0.6F}, {0.8F, 0.8F, 0.8F}, 0);
    const Picture p =
        render(frame_text(48, 48, 16, ortho_camera({0, 0, 4}, {0, 0, 0}, 0.05F)) +
               skin(" subsurface_color 0.95 0.8 0.6\n subsurface_radius 0.8 0.8 0.8") +
               sphere("ball", {0, 0, 0}, 1, "skin") +
               node("distant_light", "sun", " direction 0 0 1\n intensity 3.14159265"));
    for (int c = 0; c < 3; ++c) {
        const Fog fog{1 / static_cast<double>(medium.mean_free_path[c]),
                      static_cast<double>(medium.albedo[c])};
        Dice dice(static_cast<std::uint32_t>(c) + 1);
        double sum = 0;
        const int n = 150000;
        for (int i = 0; i < n; ++i)
            walk({0, 0, 1}, dice.lambertian({0, 0, -1}), fog, leave_ball, dice,
                 [&](Vec at, double weight) { sum += weight * std::max(0.0, -at.z); });
        const double truth = sum / n;
        const Estimate e = estimate(p, "RGBA", c);
        EXPECT_NEAR(e.mean, truth, kZ * e.error + 0.01 * truth) << c << " error " << e.error;
        EXPECT_LT(e.error, 0.02 * truth);
    }
}

TEST(RandomWalkTruth, ABallOfFogIsLitAsSimulated) {
    // Light of every order: from the camera through the middle, the sun from the side.
    const std::array<Fog, 3> fogs{{{2, 0.9}, {1.5, 0.6}, {3, 1}}};
    const Picture p = render(
        frame_text(48, 48, 12, ortho_camera({0, 0, 4}, {0, 0, 0}, 0.05F),
                   " GI_volume_depth 100\n GI_total_depth 100\n indirect_sample_clamp 1e30") +
        node("anisotropic_vdf", "fog", " scattering 1.8 0.9 3\n absorption 0.2 0.6 0") +
        sphere("ball", {0, 0, 0}, 1, "fog", " step_size 0.1") +
        node("distant_light", "sun", " direction -1 0 0\n intensity 3.14159265"));
    const Vec to_sun{1, 0, 0};
    for (int c = 0; c < 3; ++c) {
        const Fog& fog = fogs[static_cast<std::size_t>(c)];
        Dice dice(static_cast<std::uint32_t>(c) + 1);
        double sum = 0;
        const int n = 150000;
        for (int i = 0; i < n; ++i) {
            Vec position{0, 0, 1}, direction{0, 0, -1};
            double weight = 1;
            for (int k = 0; k < 200 && weight > 1e-5; ++k) {
                const double way = -std::log(dice.roll()) / fog.extinction;
                if (way >= leave_ball(position, direction)) break;
                position = position + direction * way;
                weight *= fog.albedo;
                sum += weight * std::exp(-fog.extinction * leave_ball(position, to_sun)) / 4;
                direction = dice.direction();
            }
        }
        const double truth = sum / n;
        const Estimate e = estimate(p, "RGBA", c);
        EXPECT_NEAR(e.mean, truth, kZ * e.error + 0.005 * truth) << c << " error " << e.error;
        EXPECT_LT(e.error, 0.02 * truth);
    }
}

}  // namespace
}  // namespace lightsieve::testing
