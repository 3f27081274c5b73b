// Pictures: what is stored for known values, and what comes back.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "io/exr_write.h"
#include "io/image_read.h"
#include "io/image_write.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

class ImageTest : public FolderTest {
  protected:
    /// The picture as stored, alpha untouched, read by another reader than ours.
    template <class T>
    std::vector<T> stored(const std::string& name, OIIO::ImageSpec* spec = nullptr) const {
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        const auto input = OIIO::ImageInput::open(in_folder(name), &config);
        if (!input) {
            ADD_FAILURE() << OIIO::geterror();
            return {};
        }
        if (spec != nullptr) *spec = input->spec();
        EXPECT_EQ(input->spec().format, OIIO::TypeDesc(OIIO::BaseTypeFromC<T>::value));
        std::vector<T> pixels(static_cast<std::size_t>(input->spec().image_pixels()) *
                              static_cast<std::size_t>(input->spec().nchannels));
        EXPECT_TRUE(input->read_image(0, 0, 0, input->spec().nchannels,
                                      OIIO::BaseTypeFromC<T>::value, pixels.data()));
        return pixels;
    }
};

const std::vector<float> kValues = {0.5F, -1, 2, 0.25F, std::nanf(""), 1, 0, 1};

PictureSpec two_pixels(PictureFormat format, PictureType type) {
    PictureSpec spec;
    spec.width = 2;
    spec.height = 1;
    spec.n_channels = 4;
    spec.format = format;
    spec.type = type;
    return spec;
}

TEST_F(ImageTest, IntegersAreClampedAndRounded) {
    EXPECT_EQ(quantize(0.5F, 255), 128U);
    EXPECT_EQ(quantize(1, 0xffffffffU), 0xffffffffU);
    for (const auto& [format, name] :
         {std::pair(PictureFormat::Png, "a.png"), std::pair(PictureFormat::Tiff, "a.tif")}) {
        write_picture(in_folder(name), two_pixels(format, PictureType::UInt8), kValues);
        EXPECT_EQ(stored<std::uint8_t>(name),
                  (std::vector<std::uint8_t>{128, 0, 255, 64, 0, 255, 0, 255}));
        write_picture(in_folder(name), two_pixels(format, PictureType::UInt16), kValues);
        EXPECT_EQ(stored<std::uint16_t>(name),
                  (std::vector<std::uint16_t>{32768, 0, 65535, 16384, 0, 65535, 0, 65535}));
    }
    write_picture(in_folder("a.tif"), two_pixels(PictureFormat::Tiff, PictureType::UInt32),
                  kValues);
    EXPECT_EQ(stored<std::uint32_t>("a.tif")[0], 2147483648U);
    EXPECT_EQ(n_files(), 2U);
}

TEST_F(ImageTest, FloatTiffKeepsValuesInTilesAndAllCompressions) {
    for (const TiffCompression compression : {TiffCompression::None, TiffCompression::Lzw,
                                              TiffCompression::Rle, TiffCompression::Zip}) {
        for (const int tile : {0, 64}) {
            PictureSpec spec = two_pixels(PictureFormat::Tiff, PictureType::Float);
            spec.compression = compression;
            spec.tile_size = tile;
            write_picture(in_folder("a.tif"), spec, kValues);
            OIIO::ImageSpec read;
            const auto pixels = stored<float>("a.tif", &read);
            EXPECT_EQ(read.tile_width, tile);
            EXPECT_EQ(pixels[1], -1);
            EXPECT_EQ(pixels[2], 2);
            EXPECT_TRUE(std::isnan(pixels[4]));
        }
    }
}

TEST_F(ImageTest, TiffSaysWhetherColorsAreMultipliedByAlpha) {
    PictureSpec spec = two_pixels(PictureFormat::Tiff, PictureType::UInt8);
    OIIO::ImageSpec read;
    write_picture(in_folder("a.tif"), spec, kValues);
    (void)stored<std::uint8_t>("a.tif", &read);
    EXPECT_EQ(read.get_int_attribute("oiio:UnassociatedAlpha"), 0);
    spec.unassociated_alpha = true;
    write_picture(in_folder("a.tif"), spec, kValues);
    EXPECT_EQ(stored<std::uint8_t>("a.tif", &read)[0], 128);
    EXPECT_EQ(read.get_int_attribute("oiio:UnassociatedAlpha"), 1);
}

TEST_F(ImageTest, DitherKeepsTheMeanAndBlackAndWhite) {
    PictureSpec spec;
    spec.width = 128;
    spec.height = 96;
    spec.n_channels = 1;
    spec.dither = true;
    const std::size_t n = 128 * 96;
    write_picture(in_folder("a.png"), spec, std::vector<float>(n, 100.3F / 255));
    const auto pixels = stored<std::uint8_t>("a.png");
    double sum = 0;
    for (const std::uint8_t p : pixels) {
        ASSERT_TRUE(p == 100 || p == 101);
        sum += p;
    }
    // Standard error of the mean of 12288 values that are 0 or 1: 0.0041; five of them.
    EXPECT_NEAR(sum / static_cast<double>(n), 100.3, 0.0207);
    for (const float v : {0.0F, 1.0F}) {
        write_picture(in_folder("b.png"), spec, std::vector<float>(n, v));
        EXPECT_EQ(stored<std::uint8_t>("b.png"), std::vector<std::uint8_t>(n, v > 0 ? 255 : 0));
    }
}

TEST_F(ImageTest, UnwritableFolderIsAnError) {
    try {
        write_picture(in_folder("none/a.png"), two_pixels(PictureFormat::Png, PictureType::UInt8),
                      kValues);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_EQ(e.errors()[0].code, Code::FileUnwritable);
    }
}

TEST_F(ImageTest, WholePicturesAreConvertedToTheRenderingSpace) {
    Diagnostics diagnostics;
    PictureSpec spec = two_pixels(PictureFormat::Png, PictureType::UInt8);
    spec.n_channels = 3;
    write_picture(in_folder("a.png"), spec, std::vector<float>{1, 1, 1, 0, 1, 0});
    const ColorImage automatic = read_color_image(in_folder("a.png"), "auto", diagnostics);
    const Color green = ColorConversion(kSrgb, kRenderingSpace)({0, 1, 0});
    EXPECT_NEAR(automatic.at(0, 0).r, 1, 1e-5F);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(automatic.at(1, 0)[i], green[i], 1e-6F);
    EXPECT_EQ(read_color_image(in_folder("a.png"), "", diagnostics).at(1, 0), Color(0, 1, 0));
}

TEST_F(ImageTest, FloatPicturesStayAsTheyAre) {
    Diagnostics diagnostics;
    ExrWriteSpec spec;
    spec.width = spec.data_width = 100;
    spec.height = spec.data_height = 70;
    spec.tile_size = 32;
    spec.parts = {{"", {{"R"}, {"G"}, {"B"}}}};
    std::vector<float> pixels;
    for (int i = 0; i < 100 * 70 * 3; ++i)
        pixels.push_back(static_cast<float>(i));
    ExrWriter writer(in_folder("a.exr"), spec);
    writer.write(
        0, 0, 100, 70,
        std::vector<ExrPlane>{{&pixels[0], 3, 300}, {&pixels[1], 3, 300}, {&pixels[2], 3, 300}});
    writer.close();
    const ColorImage image = read_color_image(in_folder("a.exr"), "auto", diagnostics);
    EXPECT_EQ(image.width, 100);
    EXPECT_EQ(image.at(99, 69), Color(20997, 20998, 20999));
    EXPECT_EQ(image.at(3, 40), Color(12009, 12010, 12011));
}

TEST_F(ImageTest, BadPicturesAreErrors) {
    Diagnostics diagnostics;
    const auto code_of = [&](const std::string& name, std::size_t max = kMaxImagePixels) {
        try {
            (void)read_color_image(in_folder(name), "auto", diagnostics, {}, max);
        } catch (const InputError& e) {
            return e.errors()[0].code;
        }
        return Code{};
    };
    write_picture(in_folder("a.png"), two_pixels(PictureFormat::Png, PictureType::UInt8), kValues);
    write_bytes(in_folder("cut.png"), bytes_of(in_folder("a.png")).substr(0, 50));
    write_bytes(in_folder("text.png"), "no picture");
    EXPECT_EQ(code_of("none.png"), Code::FileNotFound);
    EXPECT_EQ(code_of("cut.png"), Code::FileFormat);
    EXPECT_EQ(code_of("text.png"), Code::FileFormat);
    EXPECT_EQ(code_of("a.png", 1), Code::LimitImageSize);
}

}  // namespace
}  // namespace lightsieve
