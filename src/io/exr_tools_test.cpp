// Layers, sums and differences of EXR files.
#include "io/exr_tools.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/error.h"
#include "io/image_read.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

constexpr int kWidth = 5, kHeight = 4;
using Planes = std::map<std::string, std::vector<float>>;  ///< full channel name to pixels

std::vector<float> constant(float v) { return std::vector<float>(kWidth * kHeight, v); }

class ExrToolsTest : public FolderTest {
  protected:
    void write(const std::string& name, const Planes& planes,
               const std::map<std::string, ExrAttribute>& attributes = {},
               ExrPixelType type = ExrPixelType::Float,
               ExrCompression compression = ExrCompression::Zip) const {
        ExrWriteSpec spec;
        spec.width = 20;
        spec.height = 10;
        spec.data_x = 3;
        spec.data_y = 2;
        spec.data_width = kWidth;
        spec.data_height = kHeight;
        spec.compression = compression;
        spec.attributes = attributes;
        spec.parts.push_back({"", {}});
        std::vector<ExrPlane> pixels;
        for (const auto& [channel, values] : planes) {
            spec.parts[0].channels.push_back(
                {channel, channel == "ID" ? ExrPixelType::UInt : type});
            pixels.push_back({values.data(), 1, kWidth});
        }
        ExrWriter writer(in_folder(name), spec);
        writer.write(3, 2, kWidth, kHeight, pixels);
        writer.close();
    }
    [[nodiscard]] ExrSumCheck verify_one(const std::string& name) const {
        const ExrVerifyResult result = exr_verify(in_folder(name));
        EXPECT_EQ(result.checks.size(), 1U);
        return result.checks.empty() ? ExrSumCheck{} : result.checks[0];
    }
};

/// RGBA = a + b + c in R, G and B; alpha does not add up.
Planes additive() {
    Planes planes;
    int i = 0;
    for (const char* suffix : {"R", "G", "B"}) {
        const float k = static_cast<float>(++i);
        planes[suffix] = constant(0.7F * k);
        planes[std::string("a.") + suffix] = constant(0.1F * k);
        planes[std::string("b.") + suffix] = constant(0.2F * k);
        planes[std::string("c.") + suffix] = constant(0.4F * k);
    }
    planes["A"] = planes["a.A"] = constant(1);
    return planes;
}

const std::map<std::string, ExrAttribute> kSum = {
    {"lightsieve/partitions", std::string("RGBA = a + b + c")}};

TEST_F(ExrToolsTest, InfoNamesLayersAndWhatTheHeaderSaysOfThem) {
    Planes planes = additive();
    planes["Z"] = planes["N.X"] = planes["N.Y"] = planes["N.Z"] = planes["ID"] = constant(0);
    write("a.exr", planes,
          {{"arnold/aovs/a/source", std::string("diffuse_key")},
           {"arnold/aovs/a/filter", std::string("gaussian_filter")},
           {"arnold/aovs/a/filter_width", 2.0F},
           {"arnold/aovs/a/lpe_expression", std::string("C<RD>.*<L.'key'>")},
           {"arnold/aovs/a/light_group", std::string("key")}});
    const ExrInfo info = exr_info(in_folder("a.exr"));
    std::vector<std::string> names;
    for (const ExrLayer& layer : info.layers)
        names.push_back(layer.name);
    EXPECT_EQ(names, (std::vector<std::string>{"RGBA", "ID", "N", "Z", "a", "b", "c"}));
    EXPECT_EQ(info.layers[0].suffixes, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(info.layers[1].type, ExrPixelType::UInt);
    EXPECT_EQ(info.layers[2].suffixes, (std::vector<std::string>{"X", "Y", "Z"}));
    EXPECT_EQ(info.layers[3].suffixes, std::vector<std::string>{""});
    EXPECT_EQ(info.layers[4].source, "diffuse_key");
    EXPECT_EQ(info.layers[4].filter, "gaussian_filter");
    EXPECT_EQ(info.layers[4].filter_width, 2);
    EXPECT_EQ(info.layers[4].expression, "C<RD>.*<L.'key'>");
    EXPECT_EQ(info.layers[4].light_group, "key");
}

TEST_F(ExrToolsTest, BareChannelsMayBelongToAnotherLayer) {
    write("a.exr", {{"R", constant(0)}, {"G", constant(0)}, {"B", constant(0)}},
          {{"arnold/aovs/diffuse/source", std::string("diffuse")}});
    EXPECT_EQ(exr_info(in_folder("a.exr")).layers[0].name, "diffuse");
}

TEST_F(ExrToolsTest, SumsThatHoldPass) {
    write("a.exr", additive(), kSum);
    const ExrSumCheck check = verify_one("a.exr");
    EXPECT_TRUE(check.checked && check.passed) << check.reason;
    EXPECT_EQ(check.text, "RGBA = a + b + c");
    EXPECT_LT(check.residual, 1e-6);
    EXPECT_TRUE(exr_verify(in_folder("a.exr")).passed());
}

TEST_F(ExrToolsTest, TheWorstPixelIsNamed) {
    Planes planes = additive();
    planes["b.G"][2 * kWidth + 4] += 1e-4F;
    planes["b.G"][3 * kWidth + 1] += 2e-3F;
    write("a.exr", planes, kSum);
    const ExrSumCheck check = verify_one("a.exr");
    EXPECT_TRUE(check.checked);
    EXPECT_FALSE(check.passed);
    EXPECT_EQ(check.n_failed, 2U);
    EXPECT_EQ(check.worst_x, 3 + 1);
    EXPECT_EQ(check.worst_y, 2 + 3);
    EXPECT_EQ(check.worst_channel, "G");
    EXPECT_NEAR(check.residual, 2e-3, 1e-5);
    EXPECT_NEAR(check.tolerance, 1e-5 * 1.4, 1e-6);
    EXPECT_NEAR(check.whole, 1.4, 1e-5);
    EXPECT_NEAR(check.sum, 1.402, 1e-5);
    EXPECT_FALSE(exr_verify(in_folder("a.exr")).passed());
}

TEST_F(ExrToolsTest, ToleranceGoesByThePixelType) {
    Planes planes = additive();
    for (float& v : planes["b.G"])
        v += 4e-4F;  // within a half's rounding, far beyond a float's
    write("float.exr", planes, kSum);
    write("half.exr", planes, kSum, ExrPixelType::Half);
    EXPECT_FALSE(verify_one("float.exr").passed);
    EXPECT_TRUE(verify_one("half.exr").passed);
    for (float& v : planes["b.G"])
        v += 4e-3F;
    write("half.exr", planes, kSum, ExrPixelType::Half);
    EXPECT_FALSE(verify_one("half.exr").passed);
}

TEST_F(ExrToolsTest, LightInAnEmptySumIsFound) {
    Planes planes = additive();
    for (const char* name : {"a.R", "b.R", "c.R"})
        planes[name] = constant(0);
    planes["R"] = constant(1e-30F);
    write("a.exr", planes, kSum);
    EXPECT_FALSE(verify_one("a.exr").passed);
}

TEST_F(ExrToolsTest, NotANumberFails) {
    Planes planes = additive();
    planes["c.B"][7] = std::nanf("");
    write("a.exr", planes, kSum);
    const ExrSumCheck check = verify_one("a.exr");
    EXPECT_FALSE(check.passed);
    EXPECT_EQ(check.n_failed, 1U);
    EXPECT_EQ(check.worst_channel, "B");
    EXPECT_EQ(check.worst_x, 3 + 7 % kWidth);
}

TEST_F(ExrToolsTest, WhatCannotBeCheckedSaysWhy) {
    const auto reason = [&](const std::map<std::string, ExrAttribute>& attributes,
                            ExrCompression compression = ExrCompression::Zip) {
        write("a.exr", additive(), attributes, ExrPixelType::Float, compression);
        const ExrSumCheck check = verify_one("a.exr");
        EXPECT_FALSE(check.checked);
        EXPECT_FALSE(exr_verify(in_folder("a.exr")).passed());
        return check.reason;
    };
    EXPECT_EQ(reason({{"lightsieve/partitions", std::string("RGBA = a + x")}}),
              "the file has no layer \"x\"");
    EXPECT_EQ(reason({{"lightsieve/partitions", std::string("nonsense")}}),
              "it is not of the form \"whole = part + part\"");
    auto filters = kSum;
    filters["arnold/aovs/b/filter"] = std::string("box_filter");
    EXPECT_EQ(reason(filters), "\"b\" went through another filter than \"RGBA\"");
    EXPECT_EQ(reason(kSum, ExrCompression::Pxr24), "the file's compression loses precision");
    write("a.exr", additive());
    EXPECT_TRUE(exr_verify(in_folder("a.exr")).checks.empty());
    EXPECT_FALSE(exr_verify(in_folder("a.exr")).passed());
}

TEST_F(ExrToolsTest, SeveralSumsAndLayersOfOneChannel) {
    Planes planes = additive();
    planes["lum"] = constant(3);
    planes["lum_a"] = constant(1);
    planes["lum_b"] = constant(2);
    write("a.exr", planes,
          {{"lightsieve/partitions", std::string("beauty = a + b + c\nlum = lum_a + lum_b")}});
    const ExrVerifyResult result = exr_verify(in_folder("a.exr"));
    ASSERT_EQ(result.checks.size(), 2U);
    EXPECT_TRUE(result.passed());
}

TEST_F(ExrToolsTest, DiffGivesFiguresPerLayer) {
    Planes a = additive(), b = additive();
    a["ID"] = b["ID"] = constant(std::bit_cast<float>(5U));
    a["ID"][0] = std::bit_cast<float>(7U);
    for (const char* channel : {"a.R", "a.G", "a.B"})
        b[channel] = constant(0.5F);
    for (const char* channel : {"a.R", "a.G", "a.B"})
        a[channel] = constant(0.5F);
    a["a.G"][kWidth + 3] = 0.8F;
    a["b.R"][0] = std::nanf("");
    a["extra.R"] = constant(0);
    write("a.exr", a);
    write("b.exr", b);
    const ExrDiffResult result = exr_diff(in_folder("a.exr"), in_folder("b.exr"));
    EXPECT_EQ(result.only_a, std::vector<std::string>{"extra"});
    EXPECT_TRUE(result.only_b.empty());
    std::map<std::string, ExrLayerDiff> by_name;
    for (const ExrLayerDiff& diff : result.layers)
        by_name[diff.name] = diff;
    const double n = kWidth * kHeight * 4;  // a has alpha
    EXPECT_EQ(by_name["a"].n_different, 1U);
    EXPECT_NEAR(by_name["a"].rmse, std::sqrt(0.09 / n), 1e-6);
    EXPECT_NEAR(by_name["a"].relative_mse, 0.09 / (0.25 + 0.01) / n, 1e-6);
    EXPECT_NEAR(by_name["a"].max_difference, 0.3, 1e-6);
    EXPECT_EQ(by_name["a"].max_x, 3 + 3);
    EXPECT_EQ(by_name["a"].max_y, 2 + 1);
    EXPECT_EQ(by_name["b"].n_nonfinite, 1U);
    EXPECT_EQ(by_name["b"].rmse, 0);
    EXPECT_EQ(by_name["ID"].n_different, 1U);
    EXPECT_EQ(by_name["ID"].max_difference, 2);
    EXPECT_EQ(by_name["c"].n_different, 0U);
    EXPECT_EQ(by_name["RGBA"].n_values, static_cast<std::size_t>(n));
}

TEST_F(ExrToolsTest, DiffWritesPictures) {
    Planes a = additive(), b = additive();
    a["a.G"] = constant(0.7F);  // differs by 0.5
    write("a.exr", a);
    write("b.exr", b);
    (void)exr_diff(in_folder("a.exr"), in_folder("b.exr"), in_folder("d.exr"));
    const ExrFile file = read_exr(in_folder("d.exr"));
    EXPECT_EQ(file.channels.size(), a.size());
    EXPECT_NEAR(file.find("a.G")->pixels[3], 0.5F, 1e-6F);
    EXPECT_EQ(file.find("a.R")->pixels[3], 0);
    (void)exr_diff(in_folder("a.exr"), in_folder("b.exr"), in_folder("d.png"), "a");
    Diagnostics diagnostics;
    const ColorImage picture = read_color_image(in_folder("d.png"), "", diagnostics);
    EXPECT_EQ(picture.width, kWidth);
    EXPECT_NEAR(picture.at(1, 1).g, 188 / 255.0F, 1e-6F);  // sRGB of 0.5
    EXPECT_EQ(picture.at(1, 1).r, 0);
}

TEST_F(ExrToolsTest, DiffRefusesWhatCannotBeCompared) {
    write("a.exr", additive());
    ExrWriteSpec spec;
    spec.width = spec.height = spec.data_width = spec.data_height = 2;
    spec.parts = {{"", {{"R"}}}};
    ExrWriter(in_folder("small.exr"), spec).close();
    spec.width = 20;
    spec.height = 10;
    spec.parts = {{"", {{"other"}}}};
    ExrWriter(in_folder("other.exr"), spec).close();
    const auto code_of = [&](const std::string& b, const std::string& picture,
                             const std::string& layer) {
        try {
            (void)exr_diff(in_folder("a.exr"), in_folder(b),
                           picture.empty() ? picture : in_folder(picture), layer);
        } catch (const InputError& e) {
            EXPECT_FALSE(e.errors()[0].message.empty());
            return e.errors()[0].code;
        }
        return Code{};
    };
    EXPECT_EQ(code_of("small.exr", "", ""), Code::PictureSize);
    EXPECT_EQ(code_of("none.exr", "", ""), Code::FileNotFound);
    EXPECT_EQ(code_of("a.exr", "d.png", "x"), Code::UnknownLayer);
    EXPECT_EQ(code_of("other.exr", "d.png", ""), Code::UnknownLayer);
    EXPECT_EQ(code_of("a.exr", "d.gif", ""), Code::FileUnwritable);
    EXPECT_EQ(code_of("a.exr", "none/d.exr", ""), Code::FileUnwritable);
}

}  // namespace
}  // namespace lightsieve
