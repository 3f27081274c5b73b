// Copies of EXR files: what changes, and that nothing else does.
#include "io/exr_rewrite.h"

#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

namespace exr = OPENEXR_IMF_NAMESPACE;

constexpr int kWidth = 70, kHeight = 300;

std::vector<float> ramp(float offset) {
    std::vector<float> pixels(kWidth * kHeight);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = offset + 0.37F * static_cast<float>(i);
    return pixels;
}

class ExrRewriteTest : public FolderTest {
  protected:
    ExrRewriteTest() {
        ids_[5] = std::bit_cast<float>(0xFB123456U);
        floats_[7] = std::numeric_limits<float>::quiet_NaN();
        floats_[8] = -0.0F;
        halfs_[9] = std::numeric_limits<float>::infinity();
        spec_.width = 100;
        spec_.height = 400;
        spec_.data_x = -3;
        spec_.data_y = 20;
        spec_.data_width = kWidth;
        spec_.data_height = kHeight;
        spec_.tile_size = 32;
        spec_.attributes = {{"lightsieve/list", std::vector<float>{1, 2, 3}},
                            {"lightsieve/text", std::string("as it was")},
                            {"lightsieve/number", 7}};
        spec_.parts = {
            {"RGBA",
             {{"R", ExrPixelType::Float}, {"H", ExrPixelType::Half}, {"ID", ExrPixelType::UInt}}},
            {"Z", {{"Z", ExrPixelType::Float}}}};
    }

    void write(const std::string& name) const {
        ExrWriter writer(in_folder(name), spec_);
        const std::vector<ExrPlane> planes = {{floats_.data(), 1, kWidth},
                                              {halfs_.data(), 1, kWidth},
                                              {ids_.data(), 1, kWidth},
                                              {depths_.data(), 1, kWidth}};
        writer.write(-3, 20, kWidth, kHeight, planes);
        writer.close();
    }
    /// The file with channel `name` replaced by `pixels`.
    void rewrite(const std::string& from, const std::string& to, const std::string& name,
                 const std::vector<float>& pixels) const {
        ExrChanges changes;
        const ExrFile file = read_exr_header(in_folder(from));
        for (std::size_t i = 0; i < file.channels.size(); ++i)
            if (file.channels[i].name == name) changes.channels[i] = {pixels.data(), 1, kWidth};
        EXPECT_EQ(changes.channels.size(), 1U);
        changes.attributes = {{"lightsieve/denoised", std::string("R")},
                              {"lightsieve/text", std::string("other")}};
        rewrite_exr(in_folder(from), in_folder(to), changes);
    }

    std::vector<float> floats_ = ramp(0.5F), halfs_ = ramp(1), ids_ = ramp(2), depths_ = ramp(3);
    ExrWriteSpec spec_;
};

/// The bits of all values.
std::vector<std::uint32_t> bits(const std::vector<float>& pixels) {
    std::vector<std::uint32_t> out;
    for (const float v : pixels)
        out.push_back(std::bit_cast<std::uint32_t>(v));
    return out;
}

TEST_F(ExrRewriteTest, OneChannelChangesAndAllElseStays) {
    const std::vector<float> other = ramp(1000);
    const std::vector<ExrPart> parts = spec_.parts;
    std::vector<ExrChannel> all = parts[0].channels;
    all.push_back(parts[1].channels[0]);
    for (const bool tiled : {true, false}) {
        for (const bool multipart : {true, false}) {
            spec_.tiled = tiled;
            spec_.parts = multipart ? parts : std::vector<ExrPart>{{"", all}};
            write("a.exr");
            rewrite("a.exr", "b.exr", "R", other);
            const ExrFile a = read_exr(in_folder("a.exr")), b = read_exr(in_folder("b.exr"));
            ASSERT_EQ(a.channels.size(), b.channels.size());
            for (std::size_t i = 0; i < a.channels.size(); ++i) {
                EXPECT_EQ(a.channels[i].name, b.channels[i].name);
                EXPECT_EQ(a.channels[i].type, b.channels[i].type);
                if (a.channels[i].name == "R") continue;
                EXPECT_EQ(bits(a.channels[i].pixels), bits(b.channels[i].pixels))
                    << a.channels[i].name;
            }
            EXPECT_EQ(bits(b.find("R")->pixels), bits(other));
            EXPECT_EQ(b.tiled, tiled);
            EXPECT_EQ(b.n_parts, a.n_parts);
            EXPECT_EQ(b.width, 100);
            EXPECT_EQ(b.data_x, -3);
            EXPECT_EQ(b.data_y, 20);
            EXPECT_EQ(b.compression, ExrCompression::Zip);
            auto expected = a.attributes;
            expected["lightsieve/denoised"] = std::string("R");
            expected["lightsieve/text"] = std::string("other");
            EXPECT_EQ(b.attributes, expected);
        }
    }
}

TEST_F(ExrRewriteTest, EveryPartSaysWhatWasDone) {
    write("a.exr");
    rewrite("a.exr", "b.exr", "Z", ramp(9));
    const exr::MultiPartInputFile file(in_folder("b.exr").c_str(), 0);
    ASSERT_EQ(file.parts(), 2);
    for (int p = 0; p < 2; ++p)
        EXPECT_EQ(
            file.header(p).typedAttribute<exr::StringAttribute>("lightsieve/denoised").value(),
            "R");
}

TEST_F(ExrRewriteTest, AFileMayTakeItsOwnPlace) {
    write("a.exr");
    const std::vector<float> other = ramp(-5);
    rewrite("a.exr", "a.exr", "H", other);
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_NEAR(file.find("H")->pixels[3], other[3], 0.01);
    EXPECT_EQ(bits(file.find("R")->pixels), bits(floats_));
    EXPECT_EQ(n_files(), 1U);
}

TEST_F(ExrRewriteTest, PackingThatLosesBecomesZipWhereSomethingChanges) {
    for (const ExrCompression compression : {ExrCompression::Pxr24, ExrCompression::Dwaa}) {
        spec_.compression = compression;
        write("a.exr");
        const std::vector<float> other = ramp(0.123456F);
        rewrite("a.exr", "b.exr", "R", other);
        const ExrFile a = read_exr(in_folder("a.exr")), b = read_exr(in_folder("b.exr"));
        EXPECT_EQ(b.compression, ExrCompression::Zip);
        EXPECT_EQ(bits(b.find("R")->pixels), bits(other));
        EXPECT_EQ(bits(b.find("H")->pixels), bits(a.find("H")->pixels));
        EXPECT_EQ(bits(b.find("Z")->pixels), bits(a.find("Z")->pixels));
    }
    spec_.compression = ExrCompression::Piz;
    write("a.exr");
    rewrite("a.exr", "b.exr", "R", floats_);
    EXPECT_EQ(read_exr(in_folder("b.exr")).compression, ExrCompression::Piz);
}

TEST_F(ExrRewriteTest, WhatCannotBeDoneLeavesTheFileAsItWas) {
    write("a.exr");
    const std::string before = bytes_of(in_folder("a.exr"));
    const auto code_of = [](const std::function<void()>& call) {
        try {
            call();
        } catch (const InputError& e) {
            return e.errors()[0].code;
        }
        ADD_FAILURE() << "no error";
        return Code{};
    };
    EXPECT_EQ(code_of([&] { rewrite("a.exr", "none/b.exr", "R", floats_); }),
              Code::FileUnwritable);
    write_bytes(in_folder("text.exr"), "this is no picture");
    EXPECT_EQ(code_of([&] { rewrite_exr(in_folder("text.exr"), in_folder("a.exr"), {}); }),
              Code::FileUnwritable);
    EXPECT_EQ(bytes_of(in_folder("a.exr")), before);
    EXPECT_EQ(n_files(), 2U);
}

}  // namespace
}  // namespace lightsieve
