#include <gtest/gtest.h>

#include <array>
#include <set>

#include "bsdf/closure.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {

NodeType node_car_paint();

namespace {

constexpr int kFlakes = 2;

struct Flakes {
    int n = 0;
    Vec3f first;  ///< the viewer as the first flake sees it
};

Flakes flakes_at(const TestNode& node, Vec3f position) {
    std::array<LobeRecord, 4> records;
    ShadePoint at;
    at.position = position;
    at.wo = {0, 0, 1};
    ClosureSet set;
    set.begin(at.wo, Frame{});
    set.set_records(records);
    node.type().eval_closure(node.block(), at, set);
    Flakes out;
    for (const Closure& closure : set.closures())
        if (closure.record == &records[kFlakes] && out.n++ == 0)
            out.first = set.local_wo(closure.frame);
    return out;
}

TEST(CarPaint, FlakesCoverTheirDensity) {
    TestNode node(node_car_paint());
    node.set("flake_density", 0.3F).set("flake_scale", 0.1F).set("flake_layers", 2);
    int covered = 0;
    std::set<float> leans;
    for (int x = 0; x < 100; ++x)
        for (int y = 0; y < 100; ++y) {
            const Flakes here = flakes_at(
                node, {0.1F * static_cast<float>(x) + 0.02F, 0.1F * static_cast<float>(y), 0});
            covered += here.n;
            if (here.n > 0) leans.insert(here.first.z);
        }
    // Two layers of 10000 cells: a standard deviation of 65.
    EXPECT_NEAR(covered, 6000, 300);
    EXPECT_GT(leans.size(), 1000U) << "each flake has a normal of its own";
    EXPECT_GT(*leans.begin(), 0.85F) << "none leans by more than 27 degrees at 0.5";
}

TEST(CarPaint, AFlakeIsOneCell) {
    TestNode node(node_car_paint());
    node.set("flake_density", 1.0F).set("flake_scale", 1.0F);
    const auto first = [&](Vec3f position) { return flakes_at(node, position).first; };
    EXPECT_EQ(first({0.1F, 0.1F, 0.5F}), first({0.9F, 0.8F, 0.5F}));
    EXPECT_FALSE(first({0.1F, 0.1F, 0.5F}) == first({-0.1F, 0.1F, 0.5F}));
}

TEST(CarPaint, NoFlakesByDefault) {
    EXPECT_EQ(flakes_at(TestNode(node_car_paint()), {0, 0, 0}).n, 0);
    TestNode tiny(node_car_paint());
    tiny.set("flake_density", 1.0F).set("flake_scale", 1e-30F);
    EXPECT_EQ(flakes_at(tiny, {1, 2, 3}).n, 1) << "cells beyond all numbers are one";
}

}  // namespace
}  // namespace lightsieve
