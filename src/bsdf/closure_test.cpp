// The set of closures at one hit: what is kept, scaled and turned to world space.
#include "bsdf/closure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lightsieve {
namespace {

const std::array<LobeRecord, 2> kRecords{
    LobeRecord{}, LobeRecord{.event_class = 7, .lobe = EventLobe::Specular}};

ClosureSet begun(Vec3f wo, const Frame& frame) {
    ClosureSet set;
    set.begin(wo, frame);
    set.set_records(kRecords);
    return set;
}

TEST(ClosureSet, KeepsOnlyWeightsThatCount) {
    ClosureSet set = begun({0, 0, 1}, Frame{});
    const DiffuseReflect white(kWhite);
    set.add(0, white, kBlack);
    set.add(0, white, Color(-1, -2, 0));
    set.add(0, white, Color(std::nanf(""), 1, 1));
    set.add(0, white, Color(kInfinity, 1, 1));
    EXPECT_TRUE(set.closures().empty());
    set.add(1, white, Color(-1, 0.5F, 0));
    ASSERT_EQ(set.closures().size(), 1U);
    EXPECT_EQ(set.closures()[0].weight, Color(0, 0.5F, 0));
    EXPECT_EQ(set.closures()[0].record->event_class, 7U);
    set.emit(1, Color(0, std::nanf(""), 0));
    EXPECT_TRUE(set.emissions().empty());
    set.emit(1, Color(0, 3, 0));
    EXPECT_EQ(set.emissions()[0].radiance, Color(0, 3, 0));
}

TEST(ClosureSet, ScaleActsOnEverything) {
    ClosureSet set = begun({0, 0, 1}, Frame{});
    set.set_scale(Color::grey(0.5F));
    set.add(0, DiffuseReflect(kWhite), kWhite);
    set.emit(0, kWhite);
    set.transparent(kWhite);
    set.matte(kWhite);
    EXPECT_EQ(set.closures()[0].weight, Color::grey(0.5F));
    EXPECT_EQ(set.emissions()[0].radiance, Color::grey(0.5F));
    EXPECT_EQ(set.transparency(), Color::grey(0.5F));
    EXPECT_EQ(set.matte(), Color::grey(0.5F));
    set.begin({0, 0, 1}, Frame{});
    EXPECT_TRUE(set.closures().empty());
    EXPECT_EQ(set.scale(), kWhite);
    EXPECT_EQ(set.transparency(), kBlack);
}

TEST(ClosureSet, CountsWhatDoesNotFit) {
    ClosureSet set = begun({0, 0, 1}, Frame{});
    for (std::size_t i = 0; i < ClosureSet::kMaxClosures + 3; ++i)
        set.add(0, DiffuseReflect(kWhite), kWhite);
    EXPECT_EQ(set.closures().size(), ClosureSet::kMaxClosures);
    EXPECT_EQ(set.n_dropped(), 3U);
    // Frames that do not fit are the shading frame.
    for (std::size_t i = 1; i < ClosureSet::kMaxFrames; ++i)
        EXPECT_EQ(set.add_frame(Frame{}), i);
    EXPECT_EQ(set.add_frame(Frame{}), 0);
}

TEST(ClosureSet, TurnsDirectionsToTheWorld) {
    const Vec3f n = normalize({1, 2, -0.5F}), wo = normalize({0.3F, 1, 0.2F});
    ClosureSet set = begun(wo, Frame::from_z(n));
    set.add(1, DielectricReflect(GgxAlpha(0), 1.5F), Color(0.5F, 1, 1));
    set.add(0, DiffuseReflect(Color::grey(0.8F)), Color::grey(0.25F));
    ASSERT_EQ(set.closures().size(), 2U);

    // A mirror reflects about the normal, its weight is Fresnel times the closure's.
    const LobeSample mirror = set.sample(0, {0.5F, 0.5F}, 0);
    EXPECT_TRUE(set.delta(0));
    EXPECT_LT(length(mirror.wi - (n * (2 * dot(n, wo)) - wo)), 1e-6F);
    EXPECT_NEAR(mirror.f.r, 0.5F * mirror.f.g, 1e-7F);
    EXPECT_EQ(set.albedo(0), mirror.f);

    const Vec3f wi = normalize(n + Vec3f{0.2F, 0, 0.3F});
    EXPECT_FALSE(set.delta(1));
    EXPECT_NEAR(set.eval(1, wi).f.r, 0.25F * 0.8F * kInvPi * dot(wi, n), 1e-6F);
    EXPECT_EQ(set.eval(1, -wi).f, kBlack);
    EXPECT_EQ(set.eval(0, wi).pdf, 0);
}

TEST(ClosureSet, FramesAreOnTheSideOfTheFirst) {
    ClosureSet set = begun({0, 0, 1}, Frame{});
    const Frame below{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    set.add(0, DiffuseReflect(kWhite), kWhite, set.add_frame(below), true);
    EXPECT_GT(set.eval(0, {0, 0, 1}).f.r, 0);
    EXPECT_EQ(set.eval(0, {0, 0, -1}).f.r, 0);
}

TEST(ClosureSet, NormalThatLeansAwaySeesTheViewerAtTheHorizon) {
    ClosureSet set = begun(normalize({1, 0, -0.2F}), Frame{});
    set.add(1, DielectricReflect(GgxAlpha(0), 1.5F), kWhite);
    const LobeSample s = set.sample(0, {0.5F, 0.5F}, 0);
    EXPECT_GT(s.wi.z, 0);
    EXPECT_NEAR(length(s.wi), 1, 1e-6F);
    EXPECT_NEAR(s.f.r, 1, 1e-3F);
}

TEST(ClosureSet, LobesKeepTheirOwnFrame) {
    ClosureSet set = begun({0, 0, 1}, Frame{});
    const Vec3f tilted = normalize({1, 0, 1});
    set.add(0, DiffuseReflect(kWhite), kWhite, set.add_frame(Frame::from_z(tilted)), true);
    EXPECT_NEAR(set.eval(0, tilted).f.r, kInvPi, 1e-6F);
    // Above the surface, but below the lobe's horizon: black.
    EXPECT_EQ(set.eval(0, normalize({-1, 0, 0.5F})).f, kBlack);
}

TEST(ClosureSet, GrazingViewerIsSane) {
    ClosureSet set = begun({1, 0, 0}, Frame{});
    set.add(1, DielectricReflect(GgxAlpha(0.3F), 1.5F), kWhite);
    set.add(0, SheenReflect(0.3F), kWhite);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(is_finite(set.albedo(i)));
        EXPECT_TRUE(is_finite(set.eval(i, normalize({-1, 0, 0.2F})).f));
        EXPECT_TRUE(is_finite(set.sample(i, {0.3F, 0.6F}, 0).f));
    }
}

}  // namespace
}  // namespace lightsieve
