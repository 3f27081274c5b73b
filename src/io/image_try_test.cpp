// Pictures are tried in another process; formats and sizes are limited.
#include "io/image_try.h"

#include <gtest/gtest.h>

#include <array>

#include "io/child_process.h"
#include "io/image_open.h"
#include "io/image_write.h"
#include "io/testing/test_folder.h"

namespace lightsieve {

namespace {

using namespace std::string_literals;

const std::string kCrasher =
    std::string(LIGHTSIEVE_SOURCE_DIR) + "/tests/data/pictures/crashes_its_reader.tif";

class ImageTryTest : public FolderTest {
  protected:
    [[nodiscard]] std::string good_picture() const {
        const std::string path = in_folder("good.png");
        PictureSpec spec;
        spec.width = spec.height = 2;
        spec.n_channels = 1;
        const std::array<float, 4> pixels{0, 0.25F, 0.5F, 1};
        write_picture(path, spec, pixels);
        return path;
    }
    /// What is wrong with a file of these bytes, for open_image.
    [[nodiscard]] std::string problem_with(const std::string& name,
                                           const std::string& bytes) const {
        write_bytes(in_folder(name), bytes);
        std::string problem;
        EXPECT_EQ(open_image(in_folder(name), problem), nullptr) << name;
        return problem;
    }
};

TEST_F(ImageTryTest, AGoodPictureSurvives) {
    std::string problem;
    EXPECT_TRUE(try_image_with(helper_path(kImageReaderName), good_picture(), problem)) << problem;
}

TEST_F(ImageTryTest, WhatCrashesItsReaderIsRefusedAndTheNextIsNot) {
    std::string problem;
    EXPECT_FALSE(try_image(kCrasher, problem));
    EXPECT_NE(problem.find("crashes its reader"), std::string::npos) << problem;
    EXPECT_TRUE(try_image(good_picture(), problem));
    // It is not remembered as harmless.
    EXPECT_FALSE(try_image(kCrasher, problem));
}

TEST_F(ImageTryTest, EveryAnswerOfTheReader) {
    const auto answers = [&](const std::string& bytes) {
        std::string problem;
        const bool fine = try_image_with(
            script("printf '" + bytes + "'; cat >" + in_folder("asked")), "some picture", problem);
        EXPECT_EQ(fine, problem.empty());
        return problem;
    };
    EXPECT_EQ(answers("s\\000"), "");
    EXPECT_EQ(answers("t\\000"), "reading it takes too long");
    EXPECT_EQ(answers("m\\000"), "reading it takes too much memory");
    EXPECT_EQ(answers("c\\013"),
              "it is damaged in a way that crashes its reader (Segmentation fault)");
}

TEST_F(ImageTryTest, WithoutAReaderPicturesAreReadUntried) {
    std::string problem;
    EXPECT_TRUE(try_image_with(in_folder("none"), kCrasher, problem));
    EXPECT_TRUE(try_image_with(script("exit 0"), kCrasher, problem));
}

TEST_F(ImageTryTest, FormatsAreKnownByHowTheyBegin) {
    EXPECT_EQ(image_format("II*\0 and more"s, "x"), "tiff");
    EXPECT_EQ(image_format("\xff\xd8\xff\xe0"s, "x.png"), "jpeg");
    EXPECT_EQ(image_format("#?RADIANCE\n"s, "x.hdr"), "hdr");
    EXPECT_EQ(image_format("\0\0\2"s, "x.TGA"), "targa");
    EXPECT_EQ(image_format("FOR4"s, "x.iff"), "");
    EXPECT_EQ(image_format("", ""), "");
}

TEST_F(ImageTryTest, OtherFormatsAreRefusedWhateverTheirName) {
    const std::string problem = problem_with("pnm.png", "P5 1 1 255 x");
    EXPECT_NE(problem.find("EXR, TIFF"), std::string::npos) << problem;
    EXPECT_FALSE(problem_with("empty.tif", "").empty());
    EXPECT_FALSE(problem_with("short.exr", "\x76\x2f\x31\x01").empty());
    ASSERT_EQ(::mkfifo(in_folder("pipe.png").c_str(), 0600), 0);
    std::string why;
    EXPECT_EQ(open_image(in_folder("pipe.png"), why), nullptr);
    EXPECT_EQ(why, "it is not a file");
}

TEST_F(ImageTryTest, AHeaderThatPromisesTooMuchIsRefused) {
    EXPECT_FALSE(
        problem_with("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n")
            .empty());
    // A bitmap of 60,000 x 60,000 pixels of 24 bits: 10.8 GB.
    std::string bmp("BM\x36\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0"s);
    bmp += "\x60\xea\0\0\x60\xea\0\0\1\0\x18\0"s + std::string(24, '\0');
    EXPECT_FALSE(problem_with("huge.bmp", bmp).empty());
    // Every limit that OpenImageIO has is set, and ours besides.
    int limit = 0;
    EXPECT_TRUE(OIIO::getattribute("limits:imagesize_MB", limit));
    EXPECT_EQ(limit, kMaxImageMb);
    EXPECT_TRUE(OIIO::getattribute("limits:channels", limit));
    EXPECT_EQ(limit, kMaxImageChannels);
}

}  // namespace

}  // namespace lightsieve
