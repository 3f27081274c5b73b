// What a render took, and what was foretold of it.
#include "render/statistics.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "render/memory_use.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

namespace fs = std::filesystem;

std::uint64_t rays(const RenderResult& result, RayKind kind) {
    return result.rays_by_kind[static_cast<std::size_t>(kind)];
}

/// Light, matter and glass: rays of many kinds.
std::string room(int size, const std::string& options = "") {
    return frame_text(size, size, 2, from_above(2),
                      " GI_diffuse_depth 2\n GI_specular_depth 2\n" + options) +
           lambert("white", 0.8F) + floor("ground", 0, 2, "white") +
           node("standard_surface", "glass", " base 0\n transmission 1\n specular_roughness 0.2") +
           sphere("ball", {0, 0.5F, 0}, 0.4F, "glass") +
           square_light("key", 1.8F, 0.5F, " intensity 2");
}

TEST(Statistics, RaysByKindAddUpOnAnyNumberOfThreads) {
    RenderOptions options = in_memory();
    const RenderResult one = render(room(32, " bucket_size 8"), options).result();
    EXPECT_EQ(sum_of(one.rays_by_kind), one.rays);
    EXPECT_GE(rays(one, RayKind::Camera), one.samples);
    for (const RayKind kind :
         {RayKind::Shadow, RayKind::Diffuse, RayKind::Specular, RayKind::Transmission})
        EXPECT_GT(rays(one, kind), 0U) << kRayKindNames[static_cast<std::size_t>(kind)];
    EXPECT_EQ(rays(one, RayKind::Volume), 0U);
    EXPECT_EQ(rays(one, RayKind::Subsurface), 0U);
    options.threads = 3;
    EXPECT_EQ(render(room(32, " bucket_size 8"), options).result().rays_by_kind, one.rays_by_kind);
}

TEST(Statistics, EveryKindOfRayIsOfItsKind) {
    const auto result = [](const std::string& shader) {
        return render(frame_text(8, 8, 2, from_above(1)) + shader + floor("ground", 0, 2, "it"))
            .result();
    };
    const RenderResult emission = result(node("flat", "it", ""));
    EXPECT_EQ(rays(emission, RayKind::Camera), emission.samples);
    EXPECT_EQ(emission.rays, emission.samples);
    const RenderResult wax =
        render(frame_text(8, 8, 2, from_above(1)) +
               node("standard_surface", "it", " subsurface 1\n base 0") +
               sphere("ball", {}, 0.5F, "it") + square_light("key", 1.8F, 0.5F, ""))
            .result();
    EXPECT_GT(rays(wax, RayKind::Subsurface), 0U);
}

TEST(Statistics, RaysThatCanOnlyMissLampsAreNotTraced) {
    const auto diffuse_rays = [](const std::string& more) {
        return rays(render(frame_text(16, 16, 2, from_above(1), " GI_diffuse_depth 0") +
                           lambert("white", 0.8F) + floor("ground", 0, 2, "white") + more)
                        .result(),
                    RayKind::Diffuse);
    };
    // The lamp fills a thirtieth of the hemisphere, the sky all of it.
    const std::string lamp = square_light("key", 1.8F, 0.3F, "");
    const std::uint64_t to_lamp = diffuse_rays(lamp),
                        to_sky = diffuse_rays(node("skydome_light", "sky", ""));
    EXPECT_GT(to_lamp, 0U);
    EXPECT_LT(to_lamp, to_sky / 8);
    EXPECT_GE(to_sky, 16U * 16U * 4U);
    // Lights without extent are met by none.
    const std::string sun = node("distant_light", "sun", " angle 0"),
                      point = node("point_light", "point", " position 0 1.5 0\n radius 0");
    EXPECT_LT(diffuse_rays(lamp + sun), to_sky / 8);
    EXPECT_EQ(diffuse_rays(sun), 0U);
    EXPECT_EQ(diffuse_rays(point), 0U);
    // Nor does it matter what else rays may pass on the way to no lamp.
    const std::string pane = node("standard_surface", "pane", " opacity 0.5 0.5 0.5") +
                             quad("aside", {3, 0, -1}, {3, 0, 1}, {3, 2, 1}, {3, 2, -1}, "pane");
    EXPECT_LT(diffuse_rays(lamp + pane), to_sky / 8);
}

TEST(Statistics, ProgressKnowsTheNoiseOfWhatIsDone) {
    const TestScene scene(room(32, " bucket_size 16"));
    std::vector<double> told;
    RenderControl control;
    control.progress = [&](const RenderProgress& now) { told.push_back(now.noise); };
    Diagnostics diagnostics;
    const RenderResult result = render_scene(scene.scene(), control, diagnostics);
    ASSERT_GE(told.size(), 4U);
    ASSERT_FALSE(result.noise.empty());
    EXPECT_NEAR(told.back(), result.noise[0].error / result.noise[0].level, 1e-9);
    EXPECT_GT(told.back(), 0);
}

TEST(Statistics, TimesOfAllStagesAreThere) {
    const TestScene scene(room(8));
    const StageTimes& times = scene.scene().summary.times;
    EXPECT_GT(times.compile, 0);
    EXPECT_GT(times.accel, 0);
    EXPECT_EQ(times.volumes, 0);
}

TEST(Statistics, WhatTheSceneAsksOfTheLog) {
    const TestScene scene(room(8,
                               " log_verbosity 3\n log_max_warnings 7\n log_file \"a.log\"\n "
                               "stats_file \"a.json\"\n stats_mode \"append\"\n"));
    const LogSettings& log = scene.scene().summary.log;
    EXPECT_EQ(log.verbosity, 3);
    EXPECT_EQ(log.max_warnings, 7);
    EXPECT_EQ(log.file, "a.log");
    EXPECT_EQ(log.stats_file, "a.json");
    EXPECT_TRUE(log.stats_append);
    EXPECT_FALSE(TestScene(room(8)).scene().summary.log.stats_append);
}

TEST(Forecast, OfTheFilmIsNearWhatItTakes) {
    // Every AOV gets light in the only bucket; two views, data layers and a matte are there as well.
    const std::string more =
        outputs({"RGBA RGBA f d", "diffuse RGB f d", "specular RGB f d", "transmission RGB f d",
                 "direct RGB g d", "indirect RGB g d", "Z FLOAT c d", "N VECTOR f d"}) +
        " bucket_size 32\n";
    const std::string filters =
        node("gaussian_filter", "g", " width 1") + node("closest_filter", "c", "");
    for (const int threads : {1, 2}) {
        RenderOptions options = in_memory();
        options.threads = threads;
        const TestScene scene(room(64, more) + filters, options);
        const MemoryForecast& told = scene.scene().summary.forecast;
        const RenderResult result = render(scene).result();
        // Whether a second thread got a bucket at all is a matter of luck.
        EXPECT_LE(result.memory.film, told.use.film) << threads;
        EXPECT_GE(result.memory.film * static_cast<std::size_t>(threads), told.use.film / 2);
        EXPECT_EQ(result.memory.layers, told.use.layers);
        EXPECT_EQ(result.memory.geometry, told.use.geometry);
        EXPECT_EQ(result.memory.accel, told.use.accel);
        EXPECT_EQ(result.memory.automata, told.use.automata);
        EXPECT_GT(result.memory.accel, 0U);
        EXPECT_GE(result.peak_memory, result.memory.total() - result.memory.other);
    }
}

TEST(Forecast, OfAFileIsWhatItsPixelsTake) {
    const fs::path folder = fs::path(::testing::TempDir()) / "forecast_files";
    fs::create_directories(folder);
    const std::string more =
        outputs({"RGBA RGBA f d", "diffuse RGB f d HALF", "Z FLOAT f d", "RGBA RGBA f eight"}) +
        "\n";
    const std::string drivers = node("driver_png", "eight", " filename \"b.png\"");
    std::string text = room(64, more) + drivers;
    const std::size_t at = text.find("driver_exr");
    ASSERT_NE(at, std::string::npos);
    text.insert(text.find('}', at), " compression \"none\" filename \"a.exr\"\n");
    RenderOptions options = in_memory();
    options.write_files = true;
    options.output = folder.string() + "/";
    const TestScene scene(text, options);
    const std::vector<std::size_t>& told = scene.scene().summary.forecast.file_bytes;
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0], 64U * 64 * (16 + 6 + 4));
    EXPECT_EQ(told[1], 64U * 64 * 4);
    (void)render(scene);
    const std::size_t found = fs::file_size(folder / "a.exr");
    EXPECT_GE(found, told[0]);
    EXPECT_LE(found, told[0] + 8192) << "the header";
    fs::remove_all(folder);
}

TEST(Forecast, MoreThanIsAllowedIsAnErrorThatSaysWhatHelps) {
    RenderOptions options = in_memory();
    options.max_memory = std::size_t{1} << 40;
    const TestScene fits(room(64), options);
    EXPECT_LE(fits.scene().summary.forecast.use.total(), options.max_memory);
    options.max_memory = fits.scene().summary.forecast.use.total() / 4;
    options.capture = true;
    try {
        // Larger than all that the tests before this one have left in the process.
        const TestScene refused(room(16384), options);
        FAIL();
    } catch (const std::exception& e) {
        const std::string why = e.what();
        EXPECT_NE(why.find("limit-memory"), std::string::npos) << why;
        EXPECT_NE(why.find("more than the"), std::string::npos) << why;
        EXPECT_NE(why.find("is for \"layers\": write files"), std::string::npos) << why;
    }
    const MemoryForecast forecast{{.film = std::size_t{5} << 30}, {}, 0};
    Diagnostics diagnostics;
    check_memory(forecast, forecast.use.total(), diagnostics);
    EXPECT_EQ(diagnostics.n_errors(), 0U);
    check_memory(forecast, forecast.use.total() - 1, diagnostics);
    ASSERT_EQ(diagnostics.n_errors(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LimitMemory);
    EXPECT_NE(diagnostics.items()[0].hint.find("5.0 GiB, is for \"film\": use fewer"),
              std::string::npos);
}

}  // namespace
}  // namespace lightsieve::testing
