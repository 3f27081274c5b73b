// Colour spaces of an OpenColorIO configuration: what a small one gives, and what is said of bad ones.
#include "io/color_config.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace lightsieve {
namespace {

/// A configuration whose reference, `lin`, is what light is computed in.
constexpr std::string_view kConfig = R"(ocio_profile_version: 1
roles:
  default: raw
  scene_linear: lin
  texture: squares
displays:
  screen:
    - !<View> {name: plain, colorspace: raw}
colorspaces:
  - !<ColorSpace>
    name: lin
  - !<ColorSpace>
    name: raw
    isdata: true
  - !<ColorSpace>
    name: twice
    to_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: squares
    to_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
  - !<ColorSpace>
    name: broken
    to_reference: !<FileTransform> {src: no_such_file.cube, interpolation: linear}
)";

class ColorConfig : public testing::Test {
  protected:
    ColorConfig() : path_(testing::TempDir() + "lightsieve_config.ocio") {
        std::ofstream(path_) << kConfig;
    }
    ~ColorConfig() override { std::filesystem::remove(path_); }

    std::shared_ptr<const ColorSpaces> read(ColorConfigOptions options = {}) {
        if (options.path.empty()) options.path = path_;
        return read_color_config(options, diagnostics_);
    }
    static Color converted(ColorSpace from, ColorSpace to, Color c) {
        return ColorConversion(from, to)(c);
    }
    static void expect_near(Color a, Color b) {
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(a[i], b[i], 1e-5F) << i;
    }
    /// The one report.
    const Error& report() {
        EXPECT_EQ(diagnostics_.items().size(), 1U) << diagnostics_.render();
        return diagnostics_.items().front();
    }

    std::string path_;
    Diagnostics diagnostics_;
};

TEST_F(ColorConfig, ConvertsToWhatItRendersInAndBack) {
    const auto spaces = read();
    ASSERT_NE(spaces, nullptr) << diagnostics_.render();
    const ColorSpace twice = *spaces->find("twice"), squares = *spaces->find("squares");
    const Color c{0.1F, 0.25F, 0.5F};
    expect_near(converted(twice, spaces->rendering(), c), c * 2);
    expect_near(converted(spaces->rendering(), twice, c), c * 0.5F);
    expect_near(converted(squares, spaces->rendering(), c), {0.01F, 0.0625F, 0.25F});
    expect_near(converted(squares, twice, c), {0.005F, 0.03125F, 0.125F});
    EXPECT_NEAR(ColorConversion(squares, spaces->rendering()).grey(0.5F), 0.25F, 1e-5F);
    EXPECT_TRUE(ColorConversion(twice, twice).identity());
    EXPECT_EQ(color_space_text(twice), "twice");
}

TEST_F(ColorConfig, KnowsRolesDataAndBuiltInNames) {
    const auto spaces = read();
    ASSERT_NE(spaces, nullptr);
    EXPECT_EQ(spaces->find("lin"), spaces->rendering());
    EXPECT_EQ(spaces->find("scene_linear"), spaces->rendering());
    EXPECT_EQ(spaces->find("texture"), spaces->find("squares"));
    EXPECT_EQ(spaces->find("raw"), kRawSpace);
    EXPECT_EQ(spaces->find(""), kRawSpace);
    EXPECT_EQ(spaces->find("lin_rec709"), find_color_space("lin_rec709"));
    EXPECT_EQ(spaces->find("broken"), std::nullopt) << "the library cannot convert it";
    EXPECT_EQ(spaces->integers(), kSrgb) << "the configuration has no space for them";
    EXPECT_EQ(spaces->resolve("twise", kSrgb, diagnostics_, {}), kSrgb);
    EXPECT_EQ(report().code, Code::UnknownColorSpace);
    EXPECT_NE(report().hint.find("\"twice\""), std::string::npos) << report().hint;
}

TEST_F(ColorConfig, TakesWhatTheSceneSays) {
    ColorConfigOptions options;
    options.integers = "squares";
    options.rendering_space = "twice";
    const auto spaces = read(options);
    ASSERT_NE(spaces, nullptr);
    EXPECT_EQ(spaces->integers(), spaces->find("squares"));
    expect_near(converted(*spaces->find("lin"), spaces->rendering(), {1, 1, 1}),
                Color::grey(0.5F));
}

TEST_F(ColorConfig, BadOnesAreTold) {
    ColorConfigOptions missing;
    missing.path = "/no/such/config.ocio";
    EXPECT_EQ(read(missing), nullptr);
    EXPECT_EQ(report().code, Code::ColorConfig);
    EXPECT_EQ(report().severity, Severity::Warning);
}

TEST_F(ColorConfig, FoldersAndPipesAreTold) {
    ColorConfigOptions folder;
    folder.path = testing::TempDir();
    EXPECT_EQ(read(folder), nullptr);
    EXPECT_NE(report().message.find("is not a file"), std::string::npos);
}

TEST_F(ColorConfig, DamagedOnesAreTold) {
    std::ofstream(path_) << "ocio_profile_version: 1\ncolorspaces: [";
    EXPECT_EQ(read(), nullptr);
    EXPECT_EQ(report().code, Code::ColorConfig);
}

TEST_F(ColorConfig, OnesWithoutALinearSpaceAreTold) {
    std::string text(kConfig);
    text.erase(text.find("  scene_linear: lin\n"), std::string("  scene_linear: lin\n").size());
    std::ofstream(path_) << text;
    EXPECT_EQ(read(), nullptr);
    EXPECT_EQ(report().code, Code::ColorConfig);
    EXPECT_NE(report().message.find("does not say"), std::string::npos) << report().message;
}

TEST_F(ColorConfig, UnknownRenderingSpacesAreErrors) {
    ColorConfigOptions options;
    options.rendering_space = "twicc";
    EXPECT_EQ(read(options), nullptr);
    EXPECT_EQ(report().code, Code::UnknownColorSpace);
    EXPECT_EQ(report().severity, Severity::Error);
    EXPECT_NE(report().hint.find("\"twice\""), std::string::npos) << report().hint;
}

}  // namespace
}  // namespace lightsieve
