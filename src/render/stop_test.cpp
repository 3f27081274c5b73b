// A render that is stopped: at once, with the samples that it took, and with true counts.
#include <gtest/gtest.h>

#include <atomic>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A picture that is 0.5 wherever it was sampled, of so many samples that no test waits for its end.
TestScene endless(const std::string& options = "", const std::string& more = "") {
    RenderOptions render = in_memory({"emission"});
    render.spp = 1'000'000'000;
    return TestScene(frame_text(64, 64, 1, from_above(1), options) +
                         node("flat", "grey", " color 0.5 0.5 0.5") +
                         floor("plane", 0, 2, "grey") + more,
                     render);
}

/// Stops at the first report of at least `n_samples`.
RenderResult stopped_after(const TestScene& scene, std::uint64_t n_samples) {
    std::atomic<bool> stop = false;
    RenderControl control;
    control.stop = &stop;
    control.progress = [&](const RenderProgress& now) {
        if (now.samples_done >= n_samples) stop = true;
    };
    Diagnostics diagnostics;
    return render_scene(scene.scene(), control, diagnostics);
}

/// Pixels of a layer that have light, all of which must be 0.5.
std::size_t n_lit(const Picture& picture, const std::string& layer) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        const float value = picture.color(layer, i).g;
        EXPECT_TRUE(value == 0 || value == 0.5F) << "pixel " << i << ": " << value;
        n += value > 0;
    }
    return n;
}

TEST(Stop, AnUnfinishedBucketHasThePixelsThatWereSampled) {
    // The first go gives each pixel 64 samples: 1024 samples are 16 pixels.
    RenderResult result = stopped_after(endless(), 1024);
    EXPECT_TRUE(result.stopped);
    EXPECT_EQ(result.samples, 1024U);
    const Picture picture(std::move(result));
    EXPECT_EQ(n_lit(picture, "RGBA"), 16U);
    EXPECT_EQ(n_lit(picture, "emission"), 16U);
    EXPECT_EQ(picture.alpha("RGBA", 15), 1);
    EXPECT_EQ(picture.alpha("RGBA", 16), 0);
}

TEST(Stop, ABucketOfManySamplesIsWholeBeforeItIsFine) {
    const std::uint64_t first_go = 64ULL * 64 * 64;
    RenderResult result = stopped_after(endless(), first_go);
    EXPECT_EQ(result.samples, first_go);
    EXPECT_EQ(n_lit(Picture(std::move(result)), "RGBA"), 64U * 64);
}

TEST(Stop, APassThatNeverBeganIsBlack) {
    const std::string two_cameras =
        " outputs 2 1 STRING \"RGBA RGBA f d\" \"side RGBA RGBA f d side\"";
    const std::string side = node("ortho_camera", "side", " position 0 2 0\n look_at 0 0 0");
    const Picture picture(stopped_after(endless(two_cameras, side), 1024));
    EXPECT_EQ(n_lit(picture, "RGBA"), 16U);
    EXPECT_EQ(n_lit(picture, "side"), 0U);
}

TEST(Stop, ARenderThatIsNotStoppedReportsAllOfItsSamples) {
    RenderOptions options = in_memory();
    options.spp = 150;  // more than a go, and no multiple of one
    const TestScene scene(frame_text(12, 10, 1, from_above(1), " bucket_size 8") +
                              node("flat", "grey", "") + floor("plane", 0, 2, "grey"),
                          options);
    std::uint64_t told = 0;
    RenderControl control;
    control.progress = [&](const RenderProgress& now) {
        EXPECT_GE(now.samples_done, told);
        EXPECT_EQ(now.samples_total, 12U * 10 * 150);
        told = now.samples_done;
    };
    Diagnostics diagnostics;
    const RenderResult result = render_scene(scene.scene(), control, diagnostics);
    EXPECT_FALSE(result.stopped);
    EXPECT_EQ(result.samples, 12U * 10 * 150);
    EXPECT_EQ(told, result.samples);
}

}  // namespace
}  // namespace lightsieve::testing
