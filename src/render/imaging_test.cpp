// Imagers: what is written, in which order, of which layers.
#include <gtest/gtest.h>

#include <stdexcept>

#include "io/exr_read.h"
#include "io/testing/test_folder.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A grey wall that glows by 0.25, in three layers of one file; `input` is the driver's last imager.
std::string wall(const std::string& chain, const std::string& input,
                 const std::string& options = "") {
    std::string text =
        frame_text(4, 4, 1, ortho_camera({0, 2, 0}, {0, 0, 0}, 0.2F, {0, 0, -1}),
                   outputs({"RGBA RGBA f d", "emission RGB f d", "N VECTOR f d"}) + options) +
        node("flat", "glow", " color 0.25 0.25 0.25") + floor("plane", 0, 1, "glow") + chain;
    const std::size_t at = text.find('{', text.find("driver_exr"));
    return input.empty() ? text : text.insert(at + 1, " input \"" + input + "\"\n");
}

class Imagers : public FolderTest {
  protected:
    /// The middle of a layer, as the file has it.
    struct Written {
        Color beauty, emission, normal;
    };
    [[nodiscard]] Written written(const std::string& text) const {
        RenderOptions options;
        options.threads = 1;
        options.write_files = true;
        options.output = in_folder("a.exr");
        (void)render(text, options);
        const ExrFile file = read_exr(options.output);
        const auto value = [&](const char* channel) { return file.find(channel)->pixels[5]; };
        return {{value("R"), value("G"), value("B")},
                {value("emission.R"), value("emission.G"), value("emission.B")},
                {value("N.X"), value("N.Y"), value("N.Z")}};
    }
    static void expect_near(Color is, Color wanted, const std::string& what = "") {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(is[c], wanted[c], 1e-5) << what << ' ' << c;
    }
};

constexpr Color kGrey{0.25F, 0.25F, 0.25F}, kUp{0, 1, 0};

TEST_F(Imagers, ActFromTheFirstToTheOneThatTheDriverNames) {
    const std::string chain = node("imager_exposure", "last", " exposure 1\n input \"first\"") +
                              node("imager_color_correct", "first", " main_offset 0.5 0 0");
    const Written file = written(wall(chain, "last"));
    expect_near(file.beauty, {1.5F, 0.5F, 0.5F});
    // Only the beauty is selected, and what is no colour never is.
    expect_near(file.emission, kGrey);
    expect_near(file.normal, kUp);
}

TEST_F(Imagers, ChangeTheLayersThatAreSelected) {
    const auto exposed = [&](const std::string& selection) {
        return written(wall(
            node("imager_exposure", "up", " exposure 2\n layer_selection \"" + selection + '"'),
            "up"));
    };
    for (const char* both : {"", "*", "RGBA or emission", "r'(RGBA|emis.*)'"}) {
        const Written file = exposed(both);
        expect_near(file.beauty, kWhite, both);
        expect_near(file.emission, kWhite, both);
        expect_near(file.normal, kUp, both);
    }
    const Written one = exposed("* and not RGBA");
    expect_near(one.beauty, kGrey);
    expect_near(one.emission, kWhite);
}

TEST_F(Imagers, OfTheOptionsActWhereADriverHasNone) {
    const std::string up = node("imager_exposure", "up", " exposure 1"),
                      down = node("imager_exposure", "down", " exposure -1"),
                      off = node("imager_exposure", "off", " exposure 1\n enable off");
    const std::string chain = up + down + off, option = " imager \"up\"\n";
    const auto seen = [&](const std::string& input, const std::string& options) {
        return written(wall(chain, input, options)).beauty.r;
    };
    EXPECT_NEAR(seen("", option), 0.5, 1e-5);
    EXPECT_NEAR(seen("down", option), 0.125, 1e-5);
    EXPECT_NEAR(seen("off", ""), 0.25, 1e-5);
    EXPECT_NEAR(seen("", option + " ignore_imagers on\n"), 0.25, 1e-5);
}

TEST_F(Imagers, CorrectTonesByBrightness) {
    const auto corrected = [&](const std::string& knobs) {
        return written(wall(node("imager_color_correct", "cc", knobs), "cc")).beauty;
    };
    // 0.25 is a middle tone: neither the dark nor the bright knobs reach it.
    EXPECT_EQ(corrected(" shadows_gain 3 3 3\n highlights_gain 3 3 3"), Color::grey(0.25F));
    EXPECT_NEAR(corrected(" midtones_gain 2 2 2").r, 0.5, 1e-5);
    EXPECT_NEAR(corrected(" main_contrast 2").r, 0.25 * 0.25 / 0.18, 1e-5);
    EXPECT_NEAR(corrected(" main_gamma 2").r, 0.5, 1e-5);
    const Color tinted = corrected(" main_gain 1 0.5 0\n shadows_gain 1 1 1");
    EXPECT_NEAR(tinted.g, 0.125, 1e-5);
    // Bright tones: 2 after the main knobs.
    EXPECT_NEAR(corrected(" main_gain 8 8 8\n highlights_offset 1 1 1").r, 3, 1e-5);
    EXPECT_NEAR(corrected(" main_gain 0.004 0.004 0.004\n shadows_gain 2 2 2").r, 0.002, 2e-5);
}

TEST_F(Imagers, TakeAwayWhatWasProved) {
    // RGBA is what shines and what does not, until one of them is changed.
    const RenderOptions options = in_memory({"direct", "indirect", "background"});
    const TestScene plain(wall("", ""), options),
        changed(wall(node("imager_exposure", "up", " exposure 1"), "up"), options);
    const auto sums = [](const TestScene& scene) {
        return proved_partitions(scene.scene().plan, 0, scene.scene().events);
    };
    EXPECT_EQ(sums(plain).size(), 1U);
    EXPECT_TRUE(sums(changed).empty());
}

TEST_F(Imagers, ThatCannotActAreReported) {
    const auto scene = [](const std::string& chain, const std::string& input,
                          const std::string& report) {
        return TestScene(wall(chain, input), in_memory(), {report});
    };
    EXPECT_EQ(scene("", "glow", "is no imager").diagnostics().items().size(), 1U);
    EXPECT_THROW(scene(node("imager_exposure", "up", " layer_selection \"r'(' or\""), "up", ""),
                 std::runtime_error);
}

}  // namespace
}  // namespace lightsieve::testing
