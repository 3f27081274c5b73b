// Which colours a scene renders in: the option, the configuration of the scene, that of the environment.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// Everything in the picture shows `input` taken from one space to another.
std::string converts(std::string_view from, std::string_view to, std::string_view options = "",
                     std::string_view more = "") {
    return frame_text(1, 1, 1, ortho_camera({0, 5, 0}, {0, 0, 0}, 1, {0, 0, -1}), options) +
           floor("ground", 0, 1, "paint") + node("flat", "paint", " color converted") +
           node("color_convert", "converted",
                " input 1 0 0.25\n from \"" + std::string(from) + "\"\n to \"" + std::string(to) +
                    '"') +
           std::string(more);
}
RenderOptions in_space(std::string name) {
    RenderOptions out = in_memory();
    out.rendering_space = std::move(name);
    return out;
}
Color seen(const std::string& text, const RenderOptions& options = in_memory(),
           const std::vector<std::string>& warnings = {}) {
    return render(TestScene(text, options, warnings)).color("RGBA", 0);
}
std::string errors_of(const std::string& text, const RenderOptions& options) {
    try {
        const TestScene scene(text, options);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "none";
}

TEST(RenderingSpace, IsAcesCgUnlessAnotherIsChosen) {
    const ColorMatrix m = rgb_to_rgb(Primaries::Rec709, Primaries::Ap1);
    const Color in_aces = seen(converts("lin_rec709", "RGB"));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(in_aces[i],
                    m[static_cast<std::size_t>(i)][0] + 0.25 * m[static_cast<std::size_t>(i)][2],
                    1e-5);
    EXPECT_EQ(seen(converts("lin_rec709", "RGB"), in_space("lin_rec709")), (Color{1, 0, 0.25F}));
    EXPECT_EQ(seen(converts("scene_linear", "lin_rec709"), in_space("lin_rec709")),
              (Color{1, 0, 0.25F}));
}

TEST(RenderingSpace, MustBeKnownAndLinear) {
    EXPECT_NE(
        errors_of(converts("RGB", "RGB"), in_space("ACESgc")).find("did you mean \"ACEScg\""),
        std::string::npos);
    EXPECT_NE(errors_of(converts("RGB", "RGB"), in_space("sRGB")).find("is not linear"),
              std::string::npos);
}

class ColorManagers : public ::testing::Test {
  protected:
    ColorManagers() : path_(::testing::TempDir() + "lightsieve_manager.ocio") {
        std::ofstream(path_)
            << "ocio_profile_version: 1\nroles:\n  default: lin\n  scene_linear: lin\n"
               "displays:\n  s:\n    - !<View> {name: v, colorspace: lin}\n"
               "colorspaces:\n  - !<ColorSpace>\n    name: lin\n"
               "  - !<ColorSpace>\n    name: twice\n    to_reference: "
               "!<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, "
               "0, 0, 1]}\n";
    }
    ~ColorManagers() override {
        std::filesystem::remove(path_);
        unsetenv("OCIO");
    }
    std::string path_;
};

TEST_F(ColorManagers, BringTheirSpaces) {
    const std::string manager = node("color_manager_ocio", "colors", " config \"" + path_ + '"');
    EXPECT_EQ(seen(converts("twice", "RGB", " color_manager colors\n", manager)),
              (Color{2, 0, 0.5F}));
    EXPECT_EQ(
        seen(converts("twice", "RGB", " color_manager colors\n", manager), in_space("twice")),
        (Color{1, 0, 0.25F}));
    const std::string narrow = node("color_manager_ocio", "colors",
                                    " config \"" + path_ + "\"\n color_space_linear twice");
    EXPECT_EQ(seen(converts("lin", "RGB", " color_manager colors\n", narrow)),
              (Color{0.5F, 0, 0.125F}));
}

TEST_F(ColorManagers, ComeFromTheEnvironment) {
    setenv("OCIO", path_.c_str(), 1);
    EXPECT_EQ(seen(converts("twice", "RGB")), (Color{2, 0, 0.5F}));
    EXPECT_EQ(seen(converts("twice", "RGB", " color_manager colors\n",
                            node("color_manager_ocio", "colors", ""))),
              (Color{2, 0, 0.5F}));
}

TEST_F(ColorManagers, ThatCannotBeReadLeaveTheBuiltInSpaces) {
    EXPECT_EQ(seen(converts("RGB", "ACEScg", " color_manager colors\n",
                            node("color_manager_ocio", "colors", " config \"/no/such.ocio\"")),
                   in_memory(), {"cannot be read"}),
              (Color{1, 0, 0.25F}));
    EXPECT_EQ(seen(converts("lin_rec709", "RGB", " color_manager colors\n",
                            node("color_manager_syncolor", "colors",
                                 " rendering_color_space lin_rec709")),
                   in_memory(), {"syncolor"}),
              (Color{1, 0, 0.25F}));
    EXPECT_EQ(seen(converts("RGB", "RGB", " color_manager paint\n"), in_memory(),
                   {"not a colour manager"}),
              (Color{1, 0, 0.25F}));
}

}  // namespace
}  // namespace lightsieve::testing
