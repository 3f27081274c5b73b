// Guides: densities of directions, boxes of space, and renders that go by them.
#include "render/guide.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <set>

#include "core/sobol.h"
#include "render/guide_training.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

Vec2f random_point(std::uint32_t i) {
    return {unit_float(hash_combine(11U, i)), unit_float(hash_combine(12U, i))};
}

/// A tree that learned in several rounds: a bright spot, a dim one, and a little light from all around.
DirectionTree spots() {
    DirectionTree tree = DirectionTree::uniform();
    for (int round = 0; round < 5; ++round) {
        tree = tree.refined();
        for (std::uint32_t i = 0; i < 4000; ++i) {
            const Vec2f u = random_point(i);
            tree.add(Vec2f{0.3F, 0.98F} + 0.04F * u, 1);  // over the seam of the square
            tree.add(Vec2f{0.97F, 0.5F} + 0.03F * u, 0.2F);
            tree.add(u, 0.1F);
        }
        if (round < 4) continue;
        tree.take_roots();
    }
    return tree;
}

TEST(DirectionTree, SquareKeepsDirectionsAndAreas) {
    constexpr int kSide = 64;
    Vec3f squares;  // a third each, if no direction gets more area than another
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Vec2f p{(static_cast<float>(x) + 0.5F) / kSide,
                          (static_cast<float>(y) + 0.5F) / kSide};
            const Vec3f d = direction_from_square(p);
            const Vec2f back = square_from_direction(d);
            EXPECT_NEAR(length(d), 1, 1e-6);
            EXPECT_NEAR(back.x, p.x, 1e-5);
            EXPECT_NEAR(back.y, p.y, 1e-5);
            squares += Vec3f{d.x * d.x, d.y * d.y, d.z * d.z} * (1.0F / (kSide * kSide));
        }
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(squares[i], 1.0 / 3, 1e-3);
    for (const Vec3f axis :
         {Vec3f{0, 0, 1}, Vec3f{0, 0, -1}, Vec3f{-1, 0, 0}, Vec3f{1, -0.0F, 0}}) {
        const Vec2f p = square_from_direction(axis);
        EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    }
}

TEST(DirectionTree, DensityIntegratesToOne) {
    const DirectionTree tree = spots();
    constexpr int kSide = 1024;  // finer than the leaves
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            sum +=
                double{tree.pdf(direction_from_square({(static_cast<float>(x) + 0.5F) / kSide,
                                                       (static_cast<float>(y) + 0.5F) / kSide}))};
    EXPECT_NEAR(sum * 4 * static_cast<double>(kPi) / (kSide * kSide), 1, 1e-4);
}

TEST(DirectionTree, SamplesHaveTheDensityThatItTells) {
    // The mean of 1 / pdf over the samples that fall into a region is the region's size.
    const DirectionTree tree = spots();
    constexpr std::uint32_t kN = 1U << 18U;
    constexpr std::size_t kSide = 8;
    std::array<std::array<double, kSide>, kSide> size{}, squares{};
    for (std::uint32_t i = 0; i < kN; ++i) {
        const Vec3f d = tree.sample(random_point(i));
        const Vec2f p = square_from_direction(d);
        const double weight = 1 / double{tree.pdf(d)};
        const auto x = static_cast<std::size_t>(p.x * kSide),
                   y = static_cast<std::size_t>(p.y * kSide);
        size[y][x] += weight;
        squares[y][x] += weight * weight;
    }
    const double truth = 4 * static_cast<double>(kPi) / (kSide * kSide);
    for (std::size_t y = 0; y < kSide; ++y)
        for (std::size_t x = 0; x < kSide; ++x) {
            const double mean = size[y][x] / kN,
                         error = std::sqrt((squares[y][x] / kN - mean * mean) / kN);
            EXPECT_NEAR(mean, truth, 5 * error + 1e-6) << x << ' ' << y;
        }
}

TEST(DirectionTree, LightIsSpreadOverTheSizeOfALeafAndNoneIsLost) {
    DirectionTree tree = DirectionTree::uniform();
    // At the poles and over the seam, too.
    for (const Vec2f p :
         {Vec2f{0, 0}, Vec2f{0.9999F, 0.9999F}, Vec2f{0.5F, 0.0001F}, Vec2f{0.3F, 0.7F}})
        tree.add(p, 1);
    EXPECT_NEAR(tree.total(), 4, 1e-5);
    EXPECT_GT(tree.pdf(direction_from_square({0.5F, 0.9999F})), 0) << "beyond the seam";
    EXPECT_FALSE(tree.empty());
    EXPECT_TRUE(DirectionTree::uniform().empty());
}

TEST(DirectionTree, BearsLightOfAnySize) {
    // Squares of light may be more than floats can hold, and so may their sum.
    DirectionTree tree = DirectionTree::uniform();
    for (int i = 0; i < 100; ++i)
        tree.add({0.3F, 0.3F}, i == 0 ? kInfinity : 3e38F);
    tree.take_roots();
    const Vec3f there = direction_from_square({0.3F, 0.3F});
    EXPECT_TRUE(std::isfinite(tree.pdf(there)) && tree.pdf(there) > 1);
    EXPECT_GT(dot(tree.sample({0.5F, 0.5F}), there), 0.9F);
}

TEST(Guide, CellsAreHalvedUntilNoneIsLearnedFromTooMuch) {
    Guide guide(Box3f{{-1, 0, 0}, {1, 1, 0.5F}});
    ASSERT_EQ(guide.cells().size(), 6U);
    const Vec3f up{0, 1, 0};
    const std::uint32_t first = guide.cell_at({0.9F, 0.1F, 0.1F}, up);
    EXPECT_NE(first, guide.cell_at({0.9F, 0.1F, 0.1F}, -up)) << "faces the other way";
    guide.cells()[first].n_records = 1000;
    guide.split(300);
    EXPECT_EQ(guide.cells().size(), 9U);
    std::set<std::uint32_t> found;
    for (std::uint32_t i = 0; i < 200; ++i) {
        const Vec2f u = random_point(i);
        const std::uint32_t cell = guide.cell_at({2 * u.x - 1, u.y, 0.2F}, up);
        ASSERT_LT(cell, guide.cells().size());
        EXPECT_EQ(guide.cells()[cell].n_records, 250U);
        found.insert(cell);
    }
    EXPECT_EQ(found.size(), 4U);
    // Points that are out of bounds, or nowhere, have a cell as well.
    for (const float x : {-9.0F, 9.0F, kInfinity})
        EXPECT_LT(guide.cell_at({x, x, x}, up), guide.cells().size());
}

TEST(Guide, HasOnlySoManyCells) {
    Guide guide(Box3f{{0, 0, 0}, {1, 1, 1}});
    guide.cells()[0].n_records = UINT64_MAX;
    guide.split(1);
    EXPECT_LE(guide.cells().size(), Guide::kMostCells + 1);
}

// Renders --------------------------------------------------------------------------------------------------------------------

const std::vector<std::string> kAovs{"direct", "indirect", "diffuse_indirect", "specular"};

/// A mirror ball beside a small lamp over a floor: caustics that only diffuse rays find.
std::string caustic(const std::string& options = "") {
    return frame_text(16, 16, 8, persp_camera({0, 2, 4}, {0, 0.3F, 0}, 40),
                      " GI_diffuse_depth 2\n GI_specular_depth 2\n GI_diffuse_samples 1\n"
                      " GI_specular_samples 1\n indirect_sample_clamp 1e30\n" +
                          options) +
           node("standard_surface", "mirror",
                " base 1\n base_color 1 1 1\n metalness 1\n specular_roughness 0\n caustics on") +
           lambert("grey", 0.6F) + floor("ground", 0, 3, "grey") +
           sphere("ball", {-0.6F, 0.7F, 0}, 0.6F, "mirror") +
           square_light("lamp", 2.5F, 0.3F, " intensity 10");
}

/// A closed grey room whose lamp shines up into a mirror on the ceiling: all light is hard to find.
std::string room() {
    std::string text =
        frame_text(12, 12, 8, persp_camera({0, 0, 0.95F}, {0, -0.3F, -1}, 60),
                   " GI_diffuse_depth 3\n GI_specular_depth 3\n GI_diffuse_samples 1\n"
                   " GI_specular_samples 1\n indirect_sample_clamp 1e30\n") +
        node("standard_surface", "mirror",
             " base 1\n base_color 1 1 1\n metalness 1\n specular_roughness 0\n caustics on") +
        lambert("grey", 0.5F) + floor("ground", -1, 1, "grey") + floor("ceiling", 1, 1, "grey") +
        floor("above", 0.99F, 0.4F, "mirror") +
        square_light("lamp", 0.6F, 0.15F,
                     " intensity 10\n matrix 1 0 0 0 0 -1 0 0 0 0 1 0 0 1.2 0 1\n");
    text += quad("left", {-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, "grey") +
            quad("right", {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, "grey") +
            quad("back", {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, "grey") +
            quad("front", {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, "grey");
    return text;
}

RenderOptions guided(std::vector<std::string> aovs = {}) {
    RenderOptions options = in_memory(std::move(aovs));
    options.guiding = true;
    return options;
}

/// Between two seeds.
double variance(const std::string& text, RenderOptions options) {
    options.seed = 1;
    const Picture a = render(text, options);
    options.seed = 2;
    const Picture b = render(text, options);
    double sum = 0;
    for (std::size_t i = 0; i < a.n_pixels(); ++i) {
        const double d = double{average(a.color("RGBA", i))} - double{average(b.color("RGBA", i))};
        sum += d * d;
    }
    return sum;
}

TEST(Guiding, MovesNoMean) {
    for (const std::string& text : {caustic(), scene_file("laws_lobes.ass")}) {
        RenderOptions with = guided(kAovs), without = in_memory(kAovs);
        with.spp = without.spp = 128;
        const Picture a = render(TestScene(text, with, {"caustics"})),
                      b = render(TestScene(text, without, {"caustics"}));
        EXPECT_FALSE(check_identical(a, "RGBA", b, "RGBA")) << "it must have acted";
        for (const char* layer : {"RGBA", "direct", "indirect", "diffuse_indirect", "specular"})
            EXPECT_TRUE(check_same_mean(a, layer, b, layer)) << layer;
    }
}

/// Enough for a guide that acts, and few enough to log every path.
constexpr int kFewSamples = 256;

/// Whether the picture is another one than without guiding.
bool has_acted(const Picture& picture, const std::string& text, RenderOptions options) {
    options.guiding = false;
    return !check_identical(picture, "RGBA", render(text, options), "RGBA");
}

TEST(Guiding, LayersAddUpAndAreWhatThePathsSay) {
    RenderOptions options = guided(kAovs);
    options.spp = kFewSamples;
    const TestScene scene(room(), options);
    const Picture picture = render(scene);
    EXPECT_TRUE(has_acted(picture, room(), options));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"direct", "indirect"}));
    EXPECT_TRUE(check_oracle(scene.scene(), picture, log_paths(scene.scene())));
}

TEST(Guiding, FindsCaustics) {
    RenderOptions with = guided(), without = in_memory();
    with.spp = without.spp = 2048;
    EXPECT_LT(variance(room(), with), 0.6 * variance(room(), without));
}

/// Renders what must complain that guiding is no use, and of nothing else.
Picture useless(const TestScene& scene) {
    Diagnostics diagnostics;
    RenderResult result = render_scene(scene.scene(), {}, diagnostics);
    EXPECT_EQ(diagnostics.items().size(), 1U);
    for (const auto& d : diagnostics.items())
        EXPECT_EQ(d.code, Code::GuidingUseless);
    return Picture(std::move(result));
}

TEST(Guiding, GuidesNothingWhereThereIsNothingToLearn) {
    // Under an even sky a diffuse lobe knows best: no cell takes the guide's advice, so the bits are the same.
    const std::string text =
        frame_text(16, 16, 8, persp_camera({0, 2, 4}, {0, 0, 0}, 40),
                   " background \"sky\"\n GI_diffuse_depth 1\n GI_diffuse_samples 1\n") +
        lambert("grey", 0.6F) + floor("ground", 0, 0.5F, "grey") +
        node("flat", "sky", " color 1 1 1");
    RenderOptions with = guided(), without = in_memory();
    with.spp = without.spp = 64;
    EXPECT_TRUE(
        check_identical(useless(TestScene(text, with)), "RGBA", render(text, without), "RGBA"));
}

TEST(Guiding, NeitherThreadsNorAovsMatter) {
    RenderOptions one = guided(kAovs);
    one.spp = kFewSamples;
    one.threads = 1;
    RenderOptions two = one, bare = guided();
    two.threads = 2;
    bare.spp = kFewSamples;
    const Picture a = render(room(), one), b = render(room(), two), c = render(room(), bare);
    EXPECT_TRUE(has_acted(a, room(), one));
    for (const char* layer : {"RGBA", "direct", "indirect", "diffuse_indirect", "specular"})
        EXPECT_TRUE(check_identical(a, layer, b, layer)) << layer;
    EXPECT_TRUE(check_identical(a, "RGBA", c, "RGBA"));
    EXPECT_EQ(a.result().training_samples, b.result().training_samples);
    EXPECT_GT(a.result().training_samples, 0U);
}

TEST(Guiding, IsToldAndForetold) {
    RenderOptions options = guided();
    options.spp = 64;
    const TestScene scene(caustic(), options);
    const Picture picture = render(scene);
    const RenderResult& result = picture.result();
    EXPECT_NEAR(static_cast<double>(result.training_samples), 16 * 16 * 64 / 8, 64);
    EXPECT_EQ(result.samples, 16U * 16 * 64);
    EXPECT_GT(result.memory.guide, 0U);
    EXPECT_LE(result.memory.guide, scene.scene().summary.forecast.use.guide);
    EXPECT_EQ(render(caustic()).result().memory.guide, 0U);
}

TEST(Guiding, LearnsNothingWhereNoLightIsAskedFor) {
    const TestScene scene(caustic(outputs({"Z FLOAT f d"})), guided());
    EXPECT_EQ(useless(scene).result().training_samples, 0U);
}

TEST(Guiding, SaysThatPlanesWithoutEndHaveNoPlaces) {
    const std::string text = frame_text(8, 8, 8, from_above(1), " GI_diffuse_depth 1\n") +
                             lambert("grey", 0.6F) + node("plane", "ground", " shader \"grey\"") +
                             square_light("key", 1.8F, 0.5F, "");
    EXPECT_EQ(useless(TestScene(text, guided())).result().training_samples, 0U);
}

TEST(Guiding, EndsWhenItIsStopped) {
    RenderOptions options = guided();
    options.spp = 4096;
    const TestScene scene(caustic(), options);
    const std::atomic<bool> stop = true;
    const GuideTraining training = train_guide(scene.scene(), [](std::uint64_t) {}, &stop);
    EXPECT_EQ(training.guide, nullptr);
    EXPECT_EQ(training.n_samples, 0U);
}

}  // namespace
}  // namespace lightsieve::testing
