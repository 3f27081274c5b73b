// What may happen to files while a render is under way: another render that wants them, a folder that is removed.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "core/error.h"
#include "io/exr_read.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

namespace fs = std::filesystem;

class OutputSafety : public ::testing::Test {
  protected:
    OutputSafety() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        options_.write_files = true;
        options_.capture = false;
        options_.output = (folder_ / "a.exr").string();
        options_.spp = 16;
    }
    ~OutputSafety() override { fs::remove_all(folder_); }

    [[nodiscard]] TestScene scene() const {
        return TestScene(frame_text(32, 32, 1, from_above(1), " bucket_size 8") +
                             lambert("white", 0.8F) + floor("ground", 0, 2, "white") +
                             square_light("key", 1.8F, 0.5F, ""),
                         options_);
    }
    [[nodiscard]] std::vector<float> pixels() const {
        return read_exr((folder_ / "a.exr").string()).find("R")->pixels;
    }
    /// Renders and removes the folder when half is done; stops there if asked to.
    [[nodiscard]] RenderResult render_without_folder(Diagnostics& diagnostics, bool stop) const {
        std::atomic<bool> stopped = false;
        RenderControl control;
        control.stop = &stopped;
        control.progress = [&](const RenderProgress& now) {
            if (now.samples_done < now.samples_total / 2 || stopped) return;
            fs::remove_all(folder_);
            stopped = stop;
        };
        const TestScene it = scene();
        return render_scene(it.scene(), control, diagnostics);
    }

    fs::path folder_ = fs::path(::testing::TempDir()) / "output_safety";
    RenderOptions options_ = in_memory();
};

TEST_F(OutputSafety, TheSecondOfTwoRendersIsTold) {
    const TestScene first = scene(), second = scene();
    Diagnostics diagnostics, of_second;
    int n_refused = 0;
    RenderControl control;
    control.progress = [&](const RenderProgress&) {
        if (n_refused > 0) return;
        try {
            (void)render_scene(second.scene(), {}, of_second);
        } catch (const InputError& e) {
            EXPECT_EQ(e.errors()[0].code, Code::FileInUse);
            ++n_refused;
        }
    };
    const RenderResult result = render_scene(first.scene(), control, diagnostics);
    EXPECT_EQ(n_refused, 1);
    EXPECT_EQ(result.files.size(), 1U);
    // When the first is done the file is free.
    EXPECT_EQ(render_scene(second.scene(), {}, of_second).files.size(), 1U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(OutputSafety, AFolderThatIsRemovedComesBackWithThePicture) {
    (void)render(scene());
    const std::vector<float> whole = pixels();
    Diagnostics diagnostics;
    const RenderResult result = render_without_folder(diagnostics, false);
    EXPECT_EQ(result.files.size(), 1U);
    EXPECT_EQ(pixels(), whole);
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::FileUnwritable);
    EXPECT_EQ(diagnostics.items()[0].severity, Severity::Warning);
    EXPECT_NE(diagnostics.items()[0].message.find("was removed while rendering"),
              std::string::npos);
}

TEST_F(OutputSafety, AndSoDoesTheCheckpointOfARenderThatIsStopped) {
    (void)render(scene());
    const std::vector<float> whole = pixels();
    options_.checkpoints = true;
    options_.checkpoint_minutes = 1e-9;
    Diagnostics diagnostics;
    const RenderResult stopped = render_without_folder(diagnostics, true);
    EXPECT_TRUE(stopped.stopped);
    EXPECT_EQ(stopped.checkpoint, (folder_ / "a.exr.checkpoint").string());
    EXPECT_NE(pixels(), whole);
    options_.resume = true;
    const RenderResult rest = render(scene()).result();
    EXPECT_GT(rest.resumed_samples, 0U);
    EXPECT_EQ(pixels(), whole);
}

}  // namespace
}  // namespace lightsieve::testing
