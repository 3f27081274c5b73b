#include "render/light_sampler.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>

#include "core/sampling.h"
#include "core/sobol.h"

namespace lightsieve {
namespace {

/// A light that only has bounds.
class BoundsOnly final : public Light {
  public:
    explicit BoundsOnly(const LightBounds& bounds, float irradiance = -1)
        : bounds_(bounds), irradiance_(irradiance) {}
    [[nodiscard]] LightSample sample(Vec3f, Vec2f) const override { return {}; }
    [[nodiscard]] bool infinite() const override { return irradiance_ >= 0; }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }
    [[nodiscard]] float irradiance() const override { return irradiance_; }

  private:
    LightBounds bounds_;
    float irradiance_;
};

/// Random numbers of a test, always the same.
class Random {
  public:
    float next() { return unit_float(hash_combine(0x51ed270bU, count_++)); }
    Vec2f next2() {
        const float x = next();
        return {x, next()};
    }
    Vec3f in_box(float half) {
        return {half * (2 * next() - 1), half * (2 * next() - 1), half * (2 * next() - 1)};
    }
    Vec3f direction() { return sample_uniform_sphere(next2()); }

  private:
    std::uint32_t count_ = 0;
};

class Lights {
  public:
    void add(const LightBounds& bounds, float irradiance = -1) {
        owned_.push_back(std::make_unique<BoundsOnly>(bounds, irradiance));
        pointers_.push_back(owned_.back().get());
    }
    void add_infinite(Vec3f axis, float cos_spread, float irradiance) {
        LightBounds bounds;
        bounds.axis = axis;
        bounds.cos_spread = cos_spread;
        add(bounds, irradiance);
    }
    /// A small one-sided square emitter.
    void add_panel(Vec3f center, Vec3f normal, float half, float intensity) {
        LightBounds bounds;
        const Frame frame = Frame::from_z(normal);
        for (const float x : {-half, half})
            for (const float y : {-half, half})
                bounds.box.grow(center + frame.x * x + frame.y * y);
        bounds.axis = normal;
        bounds.cos_spread = 1;
        bounds.cos_emission = 0;
        bounds.intensity = intensity;
        add(bounds);
    }
    void add_point(Vec3f center, float intensity) {
        LightBounds bounds;
        bounds.box.grow(center);
        bounds.intensity = intensity;
        add(bounds);
    }
    /// spread_deg  half angle of the cone of normals
    void add_spot(Vec3f center, Vec3f axis, float half_angle_deg, float intensity,
                  float spread_deg = 0) {
        LightBounds bounds;
        bounds.box.grow(center);
        bounds.axis = axis;
        bounds.cos_spread = std::cos(deg_to_rad(spread_deg));
        bounds.cos_emission = std::cos(deg_to_rad(half_angle_deg));
        bounds.intensity = intensity;
        add(bounds);
    }
    [[nodiscard]] std::span<const Light* const> span() const { return pointers_; }
    [[nodiscard]] std::uint32_t size() const {
        return static_cast<std::uint32_t>(pointers_.size());
    }

  private:
    std::vector<std::unique_ptr<Light>> owned_;
    std::vector<const Light*> pointers_;
};

/// A scene of every kind of light.
Lights mixed_lights(int n, bool with_infinite) {
    Random random;
    Lights lights;
    for (int i = 0; i < n; ++i) {
        const Vec3f place = random.in_box(10);
        const float strength = std::exp2(6 * random.next() - 3);
        if (i % 3 == 0) lights.add_point(place, strength);
        if (i % 3 == 1) lights.add_panel(place, random.direction(), 0.5F, strength);
        if (i % 3 == 2)
            lights.add_spot(place, random.direction(), 10 + 50 * random.next(), strength);
    }
    if (with_infinite) {
        lights.add_infinite({0, -1, 0}, 1, 0.2F);
        lights.add_infinite({0, 0, 1}, -1, 0.1F);
        lights.add_infinite(normalize({1, -1, 0}), std::cos(deg_to_rad(10)), 0.3F);
    }
    return lights;
}

/// Draws with evenly spaced numbers and compares the counts with probability(): each light owns one interval of u,
/// so a count is exact to one draw at each end.
void expect_pick_agrees(const LightSampler& sampler, std::uint32_t n_lights, Vec3f position,
                        Vec3f normal) {
    constexpr int kDraws = 20000;
    std::vector<int> counts(n_lights);
    std::vector<double> sum_of_u(n_lights);
    for (int i = 0; i < kDraws; ++i) {
        const LightPick pick =
            sampler.pick(position, normal, (static_cast<float>(i) + 0.5F) / kDraws);
        ASSERT_GE(pick.u, 0);
        ASSERT_LT(pick.u, 1);
        if (pick.probability == 0) continue;
        ASSERT_LT(pick.light, n_lights);
        EXPECT_EQ(pick.probability, sampler.probability(position, normal, pick.light));
        ++counts[pick.light];
        sum_of_u[pick.light] += static_cast<double>(pick.u);
    }
    double sum = 0;
    for (std::uint32_t i = 0; i < n_lights; ++i) {
        const float p = sampler.probability(position, normal, i);
        sum += static_cast<double>(p);
        EXPECT_NEAR(counts[i], p * kDraws, 2.5) << "light " << i;
        if (counts[i] > 200) {
            EXPECT_NEAR(sum_of_u[i] / counts[i], 0.5, 0.01) << "light " << i;
        }
    }
    const int drawn = std::accumulate(counts.begin(), counts.end(), 0);
    EXPECT_NEAR(sum, static_cast<double>(drawn) / kDraws, 0.001);
}

TEST(LightSampler, ProbabilityIsThatOfPick) {
    for (const bool with_infinite : {false, true}) {
        const Lights lights = mixed_lights(60, with_infinite);
        const LightSampler sampler(lights.span());
        Random random;
        for (int i = 0; i < 20; ++i) {
            const Vec3f position = random.in_box(12);
            expect_pick_agrees(sampler, lights.size(), position,
                               i % 4 == 0 ? Vec3f{} : random.direction());
        }
    }
}

TEST(LightSampler, ProbabilitiesAddUpToOneWherePointLightsSurroundThePoint) {
    Lights lights;
    Random random;
    for (int i = 0; i < 100; ++i)
        lights.add_point(random.in_box(5), 1 + random.next());
    lights.add_infinite({0, -1, 0}, -1, 3);
    const LightSampler sampler(lights.span());
    for (int i = 0; i < 50; ++i) {
        const Vec3f position = random.in_box(5);
        double sum = 0;
        for (std::uint32_t light = 0; light < lights.size(); ++light)
            sum += static_cast<double>(sampler.probability(position, {}, light));
        EXPECT_NEAR(sum, 1, 1e-5);
    }
}

TEST(LightSampler, NeverMissesALightThatContributes) {
    // Panels and spots: wherever a ray from some point of the light reaches the front of the surface, p > 0.
    Random random;
    Lights lights;
    struct Panel {
        Vec3f center, normal;
        float half;
    };
    std::vector<Panel> panels;
    for (int i = 0; i < 40; ++i) {
        const Panel p{random.in_box(4), random.direction(), 0.1F + random.next()};
        lights.add_panel(p.center, p.normal, p.half, 1);
        panels.push_back(p);
    }
    struct Spot {
        Vec3f place, axis;
        float half_angle_deg;
    };
    std::vector<Spot> spots;
    for (int i = 0; i < 40; ++i) {
        const Spot s{random.in_box(4), random.direction(), 5 + 80 * random.next()};
        lights.add_spot(s.place, s.axis, s.half_angle_deg, 1);
        spots.push_back(s);
    }
    const LightSampler sampler(lights.span());
    int contributing = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3f position = random.in_box(6), normal = random.direction();
        for (std::uint32_t l = 0; l < 40; ++l) {
            const Panel& p = panels[l];
            const Frame frame = Frame::from_z(p.normal);
            const Vec3f on = p.center + frame.x * (p.half * (2 * random.next() - 1)) +
                             frame.y * (p.half * (2 * random.next() - 1));
            if (dot(position - on, p.normal) <= 0 || dot(on - position, normal) <= 0) continue;
            ++contributing;
            EXPECT_GT(sampler.probability(position, normal, l), 0);
        }
        for (std::uint32_t l = 0; l < 40; ++l) {
            const Spot& s = spots[l];
            const Vec3f away = normalize(position - s.place);
            if (dot(away, s.axis) < std::cos(deg_to_rad(s.half_angle_deg)) ||
                dot(away, normal) >= 0)
                continue;
            ++contributing;
            EXPECT_GT(sampler.probability(position, normal, 40 + l), 0);
        }
    }
    EXPECT_GT(contributing, 30000);
}

TEST(LightSampler, NeverMissesALightOfAClusterThatPointsOneWay) {
    // Narrow beams in tight groups, each group tilted around its own axis: bounds of groups have to do the work.
    Random random;
    Lights lights;
    struct Beam {
        Vec3f place, axis;
        float half_angle_deg;
    };
    std::vector<Beam> beams;
    for (int group = 0; group < 30; ++group) {
        const Vec3f center = random.in_box(50);
        const Frame frame = Frame::from_z(random.direction());
        for (int i = 0; i < 20; ++i) {
            const float spread = 12 * random.next();
            const Vec3f axis = frame.world_from_local(sample_uniform_cone(random.next2(), 0.06F));
            beams.push_back({center + random.in_box(0.1F), axis, spread + 2});
            lights.add_spot(beams.back().place, axis, 2, 1, spread);
        }
    }
    const LightSampler sampler(lights.span());
    for (std::uint32_t l = 0; l < lights.size(); ++l)
        for (int i = 0; i < 20; ++i) {
            const Vec3f local = sample_uniform_cone(
                {0.999F, random.next()}, 1 - std::cos(deg_to_rad(beams[l].half_angle_deg)));
            const Vec3f away = Frame::from_z(beams[l].axis).world_from_local(local);
            EXPECT_GT(sampler.probability(beams[l].place + away * (20 * random.next()), {}, l), 0)
                << l;
        }
}

TEST(LightSampler, ProvesDarkness) {
    Lights lights;
    lights.add_panel({0, 5, 0}, {0, -1, 0}, 1, 1);   // 0: shines down on the point
    lights.add_panel({5, 5, 0}, {0, 1, 0}, 1, 1);    // 1: turns its back
    lights.add_panel({0, -5, 0}, {0, 1, 0}, 1, 1);   // 2: below the surface
    lights.add_spot({-5, 5, 0}, {0, -1, 0}, 20, 1);  // 3: the point is outside its cone
    lights.add_infinite({0, 1, 0}, 1, 1);            // 4: a sun below the surface
    const LightSampler sampler(lights.span());
    EXPECT_GT(sampler.probability({}, {0, 1, 0}, 0), 0);
    for (const std::uint32_t dark : {1U, 2U, 3U, 4U})
        EXPECT_EQ(sampler.probability({}, {0, 1, 0}, dark), 0) << dark;
    // Without a normal light from below counts.
    EXPECT_GT(sampler.probability({}, {}, 2), 0);
    EXPECT_GT(sampler.probability({}, {}, 4), 0);
}

TEST(LightSampler, IsMuchBetterThanUniformForManyLights) {
    // A ceiling of 16 x 16 panels over a floor; the variance of one pick's estimate of the irradiance.
    Lights lights;
    std::vector<Vec3f> places;
    for (int x = 0; x < 16; ++x)
        for (int y = 0; y < 16; ++y) {
            places.push_back({2 * static_cast<float>(x), 2, 2 * static_cast<float>(y)});
            lights.add_panel(places.back(), {0, -1, 0}, 0.05F, 1);
        }
    const LightSampler sampler(lights.span());
    Random random;
    double tree = 0, uniform = 0;
    for (int i = 0; i < 20; ++i) {
        const Vec3f position{30 * random.next(), 0, 30 * random.next()};
        double mean = 0, tree_square = 0, uniform_square = 0;
        for (std::uint32_t l = 0; l < lights.size(); ++l) {
            const double r2 = static_cast<double>(length_squared(places[l] - position));
            const double value = 4 / (r2 * r2);  // cos cos / r^2 with both cosines 2 / r
            const double p = static_cast<double>(sampler.probability(position, {0, 1, 0}, l));
            mean += value;
            tree_square += value * value / p;
            uniform_square += value * value * lights.size();
        }
        tree += tree_square / (mean * mean) - 1;
        uniform += uniform_square / (mean * mean) - 1;
    }
    EXPECT_LT(tree, uniform / 300);
}

TEST(LightSampler, SharesPicksBetweenFiniteAndInfiniteLights) {
    Lights lights;
    lights.add_point({0, 1, 0}, 100);
    lights.add_infinite({0, -1, 0}, 1, 1);
    const LightSampler sampler(lights.span());
    // Near the point light it gets nearly all, far away the sun; neither ever less than a tenth.
    EXPECT_GT(sampler.probability({}, {0, 1, 0}, 0), 0.85F);
    EXPECT_GE(sampler.probability({}, {0, 1, 0}, 1), 0.1F);
    EXPECT_LT(sampler.probability({0, -1000, 0}, {0, 1, 0}, 0), 0.11F);
    EXPECT_GE(sampler.probability({0, -1000, 0}, {0, 1, 0}, 0), 0.1F);
}

TEST(LightSampler, SubsetKeepsIndices) {
    const Lights lights = mixed_lights(30, true);
    const std::vector<std::uint32_t> subset{4, 9, 9, 21, 31};
    const LightSampler sampler(lights.span(), subset);
    Random random;
    for (int i = 0; i < 200; ++i) {
        const LightPick pick = sampler.pick(random.in_box(10), {}, random.next());
        if (pick.probability == 0) continue;
        EXPECT_NE(std::find(subset.begin(), subset.end(), pick.light), subset.end()) << pick.light;
    }
    expect_pick_agrees(sampler, lights.size(), {1, 2, 3}, {});
    EXPECT_EQ(sampler.probability({1, 2, 3}, {}, 3), 0);
    EXPECT_GT(sampler.probability({1, 2, 3}, {}, 9), 0);
    EXPECT_TRUE(LightSampler(lights.span(), std::span<const std::uint32_t>{}).empty());
}

TEST(LightSampler, HostileLightsAndPoints) {
    const LightSampler none;
    EXPECT_EQ(none.pick({}, {}, 0.5F).probability, 0);
    EXPECT_EQ(none.probability({}, {}, 0), 0);
    EXPECT_TRUE(none.empty());

    Lights lights;
    const float nan = std::nanf("");
    lights.add_point({0, 0, 0}, 0);         // 0: black
    lights.add_point({0, 0, 0}, nan);       // 1: not a number
    lights.add_point({nan, 0, 0}, 1);       // 2: nowhere
    lights.add_infinite({0, -1, 0}, 1, 0);  // 3: black
    lights.add({});                         // 4: without place
    EXPECT_TRUE(LightSampler(lights.span()).empty());
    lights.add_point({0, 0, 0}, 1);      // 5: sound
    lights.add_point({0, 0, 0}, 1e30F);  // 6: sound, at the same place
    const LightSampler sampler(lights.span());
    for (std::uint32_t dead = 0; dead < 5; ++dead)
        EXPECT_EQ(sampler.probability({1, 0, 0}, {}, dead), 0) << dead;
    EXPECT_GT(sampler.probability({1, 0, 0}, {}, 5), 0);
    expect_pick_agrees(sampler, lights.size(), {0, 0, 0}, {0, 1, 0});
    expect_pick_agrees(sampler, lights.size(), {1, 0, 0}, {});
    const LightPick nowhere = sampler.pick({nan, 0, 0}, {0, 1, 0}, 0.3F);
    EXPECT_TRUE(nowhere.probability >= 0 && nowhere.probability <= 1);
}

TEST(LightSampler, DegenerateTreesStayUsable) {
    // Equal places cannot be split by a plane; doubling distances make the most uneven tree.
    Lights lights;
    for (int i = 0; i < 3000; ++i)
        lights.add_point({1, 2, 3}, 1);
    for (int i = -60; i < 60; ++i)
        lights.add_point({std::exp2(static_cast<float>(i)), 0, 0}, 1);
    const LightSampler sampler(lights.span());
    double sum = 0;
    for (std::uint32_t l = 0; l < lights.size(); ++l) {
        const float p = sampler.probability({0, 0, 0}, {}, l);
        EXPECT_GT(p, 0) << l;
        sum += static_cast<double>(p);
    }
    EXPECT_NEAR(sum, 1, 1e-4);
}

TEST(LightSampler, SameLightsSameTree) {
    const Lights lights = mixed_lights(50, true);
    const LightSampler a(lights.span()), b(lights.span());
    Random random;
    for (int i = 0; i < 500; ++i) {
        const Vec3f position = random.in_box(10), normal = random.direction();
        const float u = random.next();
        const LightPick x = a.pick(position, normal, u), y = b.pick(position, normal, u);
        EXPECT_EQ(x.light, y.light);
        EXPECT_EQ(x.probability, y.probability);
    }
}

}  // namespace
}  // namespace lightsieve
