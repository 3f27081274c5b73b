// Checkpoints: a render that was ended anywhere and goes on is the same bits as one that was not, damaged and foreign files
// are told apart from good ones.
#include "render/checkpoint.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

namespace fs = std::filesystem;

const RenderIdentity kIdentity{{"scene", "a"}, {"frame", "8 x 8"}};

std::vector<std::byte> bytes(std::string_view text) {
    const auto view = std::as_bytes(std::span(text.data(), text.size()));
    return {view.begin(), view.end()};
}

class CheckpointFile : public ::testing::Test {
  protected:
    CheckpointFile() {
        fs::create_directories(folder_);
        fs::remove(path_);
    }
    [[nodiscard]] CheckpointSettings settings(bool resume) const {
        return {path_.string(), 0, resume, false};
    }
    /// Writes a file with two buckets, the first of them twice.
    void write() const {
        Checkpoint file(settings(false), kIdentity, 9);
        file.save(0, 0, bytes("old"));
        file.flush();
        file.save(1, 0, bytes("other"));
        file.save(0, 0, bytes("new and longer"));
        file.flush();
        EXPECT_EQ(file.problem(), "");
    }
    /// Every difference that the file is refused for; empty if it is not.
    [[nodiscard]] std::string refusal(const RenderIdentity& identity, int samples) const {
        try {
            const Checkpoint file(settings(true), identity, samples);
        } catch (const InputError& e) {
            EXPECT_EQ(e.errors()[0].code, Code::CheckpointOther);
            Diagnostics all;
            all.add(e.errors()[0]);
            return all.render();
        }
        return "";
    }

    fs::path folder_ = fs::path(::testing::TempDir()) / "checkpoints";
    fs::path path_ =
        folder_ / (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
                   ".checkpoint");
};

TEST_F(CheckpointFile, TheLastStateOfABucketCounts) {
    write();
    Checkpoint file(settings(true), kIdentity, 9);
    EXPECT_EQ(file.load(0, 0), bytes("new and longer"));
    EXPECT_EQ(file.load(1, 0), bytes("other"));
    EXPECT_FALSE(file.load(0, 1));
    // And it is added to.
    file.save(0, 1, bytes("second pass"));
    file.flush();
    EXPECT_EQ(Checkpoint(settings(true), kIdentity, 9).load(0, 1), bytes("second pass"));
}

TEST_F(CheckpointFile, LeavesRoomForPictures) {
    CheckpointSettings greedy = settings(false);
    greedy.keep_free = fs::space(folder_).capacity + 1;
    Checkpoint file(greedy, kIdentity, 9);
    file.save(0, 0, bytes("state"));
    file.flush();
    EXPECT_NE(file.problem().find("no more room than the pictures need"), std::string::npos)
        << file.problem();
    EXPECT_FALSE(fs::exists(path_));
    greedy.keep_free = 1;
    Checkpoint modest(greedy, kIdentity, 9);
    modest.save(0, 0, bytes("state"));
    modest.flush();
    EXPECT_EQ(modest.problem(), "");
    EXPECT_TRUE(fs::exists(path_));
}

TEST_F(CheckpointFile, WhateverEndsItEarlierRecordsAreGood) {
    write();
    const auto whole = static_cast<std::size_t>(fs::file_size(path_));
    std::string all(whole, '\0');
    std::ifstream(path_, std::ios::binary).read(all.data(), static_cast<std::streamsize>(whole));
    std::size_t n_old = 0, n_new = 0;
    for (std::size_t size = 0; size <= whole; ++size) {
        std::ofstream(path_, std::ios::binary | std::ios::trunc)
            .write(all.data(), static_cast<std::streamsize>(size));
        try {
            Checkpoint file(settings(true), kIdentity, 9);
            const auto state = file.load(0, 0);
            n_old += state == bytes("old") ? 1U : 0U;
            n_new += state == bytes("new and longer") ? 1U : 0U;
            EXPECT_TRUE(!state || state == bytes("old") || state == bytes("new and longer"));
        } catch (const InputError&) {
            EXPECT_EQ(n_old, 0U) << "only within the header";
        }
    }
    EXPECT_GT(n_old, 10U);
    EXPECT_EQ(n_new, 1U);
}

TEST_F(CheckpointFile, AFlippedBitIsFound) {
    write();
    const auto whole = static_cast<std::size_t>(fs::file_size(path_));
    std::string all(whole, '\0');
    std::ifstream(path_, std::ios::binary).read(all.data(), static_cast<std::streamsize>(whole));
    for (std::size_t i = 0; i < whole; ++i) {
        std::string damaged = all;
        damaged[i] = static_cast<char>(damaged[i] ^ 4);
        std::ofstream(path_, std::ios::binary | std::ios::trunc)
            .write(damaged.data(), static_cast<std::streamsize>(whole));
        try {
            Checkpoint file(settings(true), kIdentity, 9);
            for (const auto& [bucket, texts] :
                 {std::pair{0U, std::vector{"old", "new and longer"}}, {1U, std::vector{"other"}}})
                if (const auto state = file.load(bucket, 0)) {
                    const bool known = std::ranges::any_of(
                        texts, [&](const char* text) { return state == bytes(text); });
                    EXPECT_TRUE(known) << i;
                }
        } catch (const InputError&) {
        }
    }
}

TEST_F(CheckpointFile, OthersAreRefusedWithTheReason) {
    write();
    EXPECT_EQ(refusal(kIdentity, 9), "");
    EXPECT_EQ(refusal(kIdentity, 100), "") << "more samples are fine";
    EXPECT_NE(refusal(kIdentity, 4).find("up to 9 samples a pixel, more than the 4"),
              std::string::npos);
    const std::string other = refusal({{"scene", "b"}, {"frame", "9 x 8"}}, 9);
    EXPECT_NE(other.find("scene: then \"a\", now \"b\""), std::string::npos) << other;
    EXPECT_NE(other.find("frame: then \"8 x 8\", now \"9 x 8\""), std::string::npos) << other;
    std::ofstream(path_, std::ios::trunc) << "v/1.0 something else, long enough for a header";
    EXPECT_NE(refusal(kIdentity, 9).find("it is no checkpoint"), std::string::npos);
    // Who does not resume replaces it only when there is something to put in its place.
    {
        Checkpoint file(settings(false), kIdentity, 9);
        file.finish();
    }
    EXPECT_NE(refusal(kIdentity, 9).find("it is no checkpoint"), std::string::npos);
    fs::remove(path_);
    EXPECT_EQ(refusal(kIdentity, 9), "") << "nothing to resume: from the beginning";
}

TEST_F(CheckpointFile, GoesAwayWhenTheRenderIsDoneUnlessItIsToBeKept) {
    write();
    Checkpoint(settings(true), kIdentity, 9).finish();
    EXPECT_FALSE(fs::exists(path_));
    CheckpointSettings keep = settings(false);
    keep.keep = true;
    Checkpoint kept(keep, kIdentity, 9);
    kept.save(0, 0, bytes("all"));
    kept.finish();
    EXPECT_EQ(Checkpoint(settings(true), kIdentity, 9).load(0, 0), bytes("all"));
}

TEST_F(CheckpointFile, AFolderThatIsGoneIsAProblemAndNoMore) {
    fs::create_directories(folder_ / "gone");
    Checkpoint file({(folder_ / "gone/a.checkpoint").string(), 0, false, false}, kIdentity, 9);
    fs::remove_all(folder_ / "gone");
    file.save(0, 0, bytes("lost"));
    file.flush();
    EXPECT_NE(file.problem().find("could not be written"), std::string::npos);
}

// Renders ------------------------------------------------------------------------------------------------------------

class Resumed : public CheckpointFile {
  protected:
    Resumed() {
        options_ = in_memory({"direct", "indirect", "albedo", "N VECTOR", "ID UINT"});
        options_.write_files = true;
        options_.output = (folder_ / "picture.exr").string();
        options_.checkpoints = true;
        options_.spp = 20;
        fs::remove(options_.output + ".checkpoint");
    }
    /// Renders until so many samples are taken, then stops; goes on from a checkpoint if there is one.
    [[nodiscard]] Picture render_until(std::uint64_t samples, const std::string& text) {
        options_.resume = true;
        const TestScene scene(text, options_);
        std::atomic<bool> stop = false;
        RenderControl control;
        control.stop = &stop;
        control.progress = [&](const RenderProgress& now) { stop = now.samples_done >= samples; };
        Diagnostics diagnostics;
        return Picture(render_scene(scene.scene(), control, diagnostics));
    }
    void expect_same(const Picture& a, const Picture& b) const {
        for (const FrameLayer& layer : a.result().layers)
            EXPECT_TRUE(check_identical(a, layer.info.name, b, layer.info.name));
    }

    RenderOptions options_;
    static constexpr std::uint64_t kAll = ~std::uint64_t{0};
};

std::string lit_room(const std::string& options = "") {
    return frame_text(40, 36, 4, persp_camera({0, 1, 4}, {0, 0.5F, 0}, 40),
                      " GI_diffuse_depth 2\n bucket_size 16\n" + options) +
           lambert("grey", 0.7F) + floor("ground", 0, 3, "grey") +
           sphere("ball", {0, 0.6F, 0}, 0.6F, "grey") +
           square_light("lamp", 3, 0.5F, " intensity 20");
}

TEST_F(Resumed, IsTheSameBitsWhereverItWasStopped) {
    const Picture whole = render_until(kAll, lit_room());
    ASSERT_FALSE(whole.result().stopped);
    EXPECT_TRUE(whole.result().checkpoint.empty());
    for (const std::uint64_t samples : {1U, 3000U, 11000U, 20000U, 27000U}) {
        const Picture part = render_until(samples, lit_room());
        ASSERT_TRUE(part.result().stopped);
        EXPECT_EQ(part.result().checkpoint, options_.output + ".checkpoint");
        const Picture rest = render_until(kAll, lit_room());
        EXPECT_EQ(part.result().samples, rest.result().resumed_samples);
        EXPECT_EQ(part.result().samples + rest.result().samples, whole.result().samples);
        expect_same(whole, rest);
        EXPECT_FALSE(fs::exists(options_.output + ".checkpoint"));
    }
}

TEST_F(Resumed, GoesOnSeveralTimesAndWithMoreSamples) {
    options_.spp = 33;
    const Picture whole = render_until(kAll, lit_room());
    options_.spp = 20;
    for (const std::uint64_t samples : {5000U, 5000U, 5000U})
        ASSERT_TRUE(render_until(samples, lit_room()).result().stopped);
    options_.keep_checkpoint = true;
    const Picture twenty = render_until(kAll, lit_room());
    EXPECT_FALSE(twenty.result().stopped);
    EXPECT_FALSE(twenty.result().checkpoint.empty());
    options_.spp = 33;
    options_.keep_checkpoint = false;
    const Picture more = render_until(kAll, lit_room());
    EXPECT_EQ(more.result().resumed_samples, 40U * 36U * 20U);
    expect_same(whole, more);
}

TEST_F(Resumed, AdaptiveSamplingGoesOnAsItWould) {
    options_.spp = 0;
    const std::string text =
        lit_room(" enable_adaptive_sampling on\n AA_samples_max 8\n AA_adaptive_threshold 0.02\n");
    const Picture whole = render_until(kAll, text);
    ASSERT_GT(whole.result().samples, 40U * 36U * 16U);
    ASSERT_LT(whole.result().samples, 40U * 36U * 64U);
    for (const std::uint64_t samples : {9000U, 26000U}) {
        ASSERT_TRUE(render_until(samples, text).result().stopped);
        const Picture rest = render_until(kAll, text);
        EXPECT_GT(rest.result().resumed_samples, 0U);
        expect_same(whole, rest);
    }
}

TEST_F(Resumed, AnotherSceneIsRefused) {
    ASSERT_TRUE(render_until(3000, lit_room()).result().stopped);
    EXPECT_THROW((void)render_until(kAll, lit_room(" GI_specular_depth 1\n")), InputError);
    options_.aovs.pop_back();
    EXPECT_THROW((void)render_until(kAll, lit_room()), InputError);
}

}  // namespace
}  // namespace lightsieve::testing
