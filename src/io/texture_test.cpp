// Textures: known texels, colours before filtering, orientation, wrap modes, filters, levels, bad files.
#include "io/texture.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

#include "io/exr_write.h"
#include "io/image_write.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

class TextureTest : public FolderTest {
  protected:
    const Texture* open(const std::string& name, const char* space = "auto") {
        return cache_.open(in_folder(name), space, diagnostics_, {});
    }

    /// An 8-bit or float picture of `width` by values / width / n_channels.
    void write(const std::string& name, int width, int n_channels,
               const std::vector<float>& values, PictureType type = PictureType::UInt8) {
        PictureSpec spec;
        spec.width = width;
        spec.height = static_cast<int>(values.size()) / width / n_channels;
        spec.n_channels = n_channels;
        spec.type = type;
        spec.format = name.ends_with(".png") ? PictureFormat::Png : PictureFormat::Tiff;
        write_picture(in_folder(name), spec, values);
    }
    /// Closest texel of a picture of w by h texels, counted from the top left.
    [[nodiscard]] Rgba texel(const Texture& texture, int x, int y, int w, int h) const {
        TextureSampling sampling;
        sampling.filter = TextureFilter::Closest;
        return cache_.lookup(texture,
                             {(static_cast<float>(x) + 0.5F) / static_cast<float>(w),
                              1 - (static_cast<float>(y) + 0.5F) / static_cast<float>(h)},
                             {}, sampling);
    }
    Diagnostics diagnostics_;
    TextureCache cache_;
};

void expect_near(const Rgba& a, const Rgba& b, float tolerance) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(a.rgb[i], b.rgb[i], tolerance) << i;
    EXPECT_NEAR(a.a, b.a, tolerance);
}

TEST_F(TextureTest, RawTexelsInTheRightPlaces) {
    // Upper row red, green; lower row blue, white.
    write("a.png", 2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
    const Texture* t = open("a.png", "");
    ASSERT_NE(t, nullptr) << diagnostics_.render();
    expect_near(texel(*t, 0, 0, 2, 2), {{1, 0, 0}, 1}, 1e-6F);
    expect_near(texel(*t, 1, 0, 2, 2), {{0, 1, 0}, 1}, 1e-6F);
    expect_near(texel(*t, 0, 1, 2, 2), {{0, 0, 1}, 1}, 1e-6F);
    expect_near(texel(*t, 1, 1, 2, 2), {{1, 1, 1}, 1}, 1e-6F);
    EXPECT_EQ(TextureCache::info(*t).width, 2);
    EXPECT_FALSE(TextureCache::info(*t).is_float);
    EXPECT_FALSE(TextureCache::info(*t).has_alpha);
}

TEST_F(TextureTest, AutoTakesIntegersForSrgbAndFloatsForTheRenderingSpace) {
    const std::vector<float> values = {0.2F, 0.6F, 1};
    write("a.png", 1, 3, values);
    write("a16.tif", 1, 3, values, PictureType::UInt16);
    write("a.tif", 1, 3, values, PictureType::Float);
    const ColorConversion to_rendering(kSrgb, kRenderingSpace);
    expect_near(texel(*open("a.png"), 0, 0, 1, 1),
                {to_rendering({51 / 255.0F, 153 / 255.0F, 1}), 1}, 1e-5F);
    expect_near(texel(*open("a16.tif"), 0, 0, 1, 1), {to_rendering({0.2F, 0.6F, 1}), 1}, 2e-5F);
    expect_near(texel(*open("a.tif"), 0, 0, 1, 1), {{0.2F, 0.6F, 1}, 1}, 1e-6F);
    expect_near(texel(*open("a.tif", "sRGB"), 0, 0, 1, 1), {to_rendering({0.2F, 0.6F, 1}), 1},
                1e-5F);
    expect_near(texel(*open("a.tif", "lin_rec709"), 0, 0, 1, 1),
                {ColorConversion({Primaries::Rec709, Transfer::Linear, false},
                                 kRenderingSpace)({0.2F, 0.6F, 1}),
                 1},
                1e-5F);
}

TEST_F(TextureTest, OneFileInTwoSpacesIsTwoTextures) {
    write("a.png", 1, 3, {0.5F, 0.5F, 0.5F});
    const Texture* raw = open("a.png", "");
    const Texture* srgb = open("a.png", "sRGB");
    EXPECT_NE(raw, srgb);
    EXPECT_EQ(raw, open("a.png", "raw"));
    EXPECT_NEAR(texel(*raw, 0, 0, 1, 1).rgb.g, 128 / 255.0F, 1e-6F);
    EXPECT_NEAR(texel(*srgb, 0, 0, 1, 1).rgb.g, decode(Transfer::Srgb, 128 / 255.0F), 1e-5F);
}

TEST_F(TextureTest, ColorsAreLinearBeforeTheyAreFiltered) {
    write("a.png", 2, 1, {0, 1, 0, 1});
    TextureSampling sampling;
    sampling.filter = TextureFilter::Bilinear;
    // Halfway between black and white is half the light, not what code value 128 stands for (0.2158).
    EXPECT_NEAR(cache_.lookup(*open("a.png"), {0.5F, 0.5F}, {}, sampling).rgb.r, 0.5F, 1e-5F);
    // The same for the mean over the whole picture, from a mip level.
    EXPECT_NEAR(
        cache_.lookup(*open("a.png"), {0.3F, 0.4F}, TextureFootprint::round(4), sampling).rgb.r,
        0.5F, 1e-5F);
}

TEST_F(TextureTest, GreyAndAlphaChannels) {
    write("grey.png", 1, 1, {0.5F});
    const float grey = decode(Transfer::Srgb, 128 / 255.0F);
    expect_near(texel(*open("grey.png"), 0, 0, 1, 1), {Color::grey(grey), 1}, 1e-5F);
    // PNG stores colours that are not multiplied by alpha; look-ups give multiplied ones. Alpha itself is linear.
    write("rgba.png", 1, 4, {1, 0.5F, 0, 0.25F});
    const float alpha = 64 / 255.0F;
    const Color c = ColorConversion(kSrgb, kRenderingSpace)({1, 128 / 255.0F, 0});
    expect_near(texel(*open("rgba.png"), 0, 0, 1, 1), {c * alpha, alpha}, 1e-5F);
    expect_near(texel(*open("rgba.png", ""), 0, 0, 1, 1),
                {Color(1, 128 / 255.0F, 0) * alpha, alpha}, 1e-5F);
    EXPECT_TRUE(TextureCache::info(*open("rgba.png")).has_alpha);
    // TIFF stores multiplied colours: they are divided before the curve and multiplied again.
    write("rgba.tif", 1, 4, {alpha, alpha * 0.5F, 0, alpha}, PictureType::Float);
    expect_near(texel(*open("rgba.tif", "sRGB"), 0, 0, 1, 1),
                {ColorConversion(kSrgb, kRenderingSpace)({1, 0.5F, 0}) * alpha, alpha}, 1e-5F);
}

TEST_F(TextureTest, ChannelsMayBeChosen) {
    write("a.png", 1, 4, {0.2F, 0.4F, 0.6F, 1});
    const Texture& t = *open("a.png", "");
    TextureSampling sampling;
    sampling.single_channel = true;
    sampling.start_channel = 1;
    expect_near(cache_.lookup(t, {0.5F, 0.5F}, {}, sampling), {Color::grey(0.4F), 1}, 1e-6F);
    sampling.single_channel = false;
    expect_near(cache_.lookup(t, {0.5F, 0.5F}, {}, sampling), {{0.4F, 0.6F, 1}, 1}, 1e-6F);
    sampling.start_channel = 9;
    expect_near(cache_.lookup(t, {0.5F, 0.5F}, {}, sampling), {kBlack, 1}, 0);
    sampling.start_channel = -1;
    expect_near(cache_.lookup(t, {0.5F, 0.5F}, {}, sampling), {kBlack, 1}, 0);
}

TEST_F(TextureTest, WrapModes) {
    write("a.tif", 4, 1, {0.1F, 0.2F, 0.3F, 0.4F}, PictureType::Float);
    const Texture& t = *open("a.tif");
    const auto at = [&](float u, TextureWrap wrap) {
        TextureSampling sampling;
        sampling.filter = TextureFilter::Closest;
        sampling.wrap_s = sampling.wrap_t = wrap;
        return cache_.lookup(t, {u, 0.5F}, {}, sampling).rgb.r;
    };
    EXPECT_NEAR(at(1.125F, TextureWrap::Periodic), 0.1F, 1e-6F);
    EXPECT_NEAR(at(-0.125F, TextureWrap::Periodic), 0.4F, 1e-6F);
    EXPECT_NEAR(at(1000000.375F, TextureWrap::Periodic), 0.2F, 1e-6F);
    EXPECT_NEAR(at(1.125F, TextureWrap::Clamp), 0.4F, 1e-6F);
    EXPECT_NEAR(at(-1e9F, TextureWrap::Clamp), 0.1F, 1e-6F);
    EXPECT_EQ(at(1.125F, TextureWrap::Black), 0);
    EXPECT_EQ(at(-1e9F, TextureWrap::Black), 0);
    EXPECT_NEAR(at(0.625F, TextureWrap::Black), 0.3F, 1e-6F);
    EXPECT_NEAR(at(1.125F, TextureWrap::Mirror), 0.4F, 1e-6F);
    EXPECT_NEAR(at(2.125F, TextureWrap::Mirror), 0.1F, 1e-6F);
    EXPECT_NEAR(at(-0.375F, TextureWrap::Mirror), 0.2F, 1e-6F);
    EXPECT_TRUE(std::isfinite(at(std::nanf(""), TextureWrap::Periodic)));
    EXPECT_TRUE(std::isfinite(at(INFINITY, TextureWrap::Mirror)));
}

TEST_F(TextureTest, MirrorTurnsTheRightWayInV) {
    write("a.tif", 1, 1, {0.1F, 0.2F, 0.3F, 0.4F}, PictureType::Float);  // top to bottom
    TextureSampling sampling;
    sampling.filter = TextureFilter::Closest;
    sampling.wrap_t = TextureWrap::Mirror;
    EXPECT_NEAR(cache_.lookup(*open("a.tif"), {0.5F, 0.125F}, {}, sampling).rgb.r, 0.4F, 1e-6F);
    EXPECT_NEAR(cache_.lookup(*open("a.tif"), {0.5F, 1.125F}, {}, sampling).rgb.r, 0.1F, 1e-6F);
    EXPECT_NEAR(cache_.lookup(*open("a.tif"), {0.5F, -0.125F}, {}, sampling).rgb.r, 0.4F, 1e-6F);
}

TEST_F(TextureTest, MagnificationIsACubicBSpline) {
    std::vector<float> values(8, 0.0F);
    values[4] = 1;
    write("a.tif", 8, 1, values, PictureType::Float);
    const auto at = [&](float texels, TextureFilter filter) {
        TextureSampling sampling;
        sampling.filter = filter;
        return cache_
            .lookup(*open("a.tif"), {texels / 8, 0.5F}, TextureFootprint::round(1e-4F), sampling)
            .rgb.r;
    };
    // The uniform cubic B-spline: 4/6 at its centre, 23/48 half a texel off, 1/6 at the next texel.
    EXPECT_NEAR(at(4.5F, TextureFilter::SmartBicubic), 4.0F / 6, 2e-3F);
    EXPECT_NEAR(at(5.0F, TextureFilter::SmartBicubic), 23.0F / 48, 2e-3F);
    EXPECT_NEAR(at(5.5F, TextureFilter::SmartBicubic), 1.0F / 6, 2e-3F);
    EXPECT_NEAR(at(5.5F, TextureFilter::Bicubic), 1.0F / 6, 2e-3F);
    EXPECT_NEAR(at(4.75F, TextureFilter::Bilinear), 0.75F, 2e-3F);
    EXPECT_NEAR(at(4.9F, TextureFilter::Closest), 1, 1e-6F);
}

TEST_F(TextureTest, LargeFootprintsAverage) {
    std::vector<float> values;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x)
            values.push_back((x + y) % 2 == 0 ? 1.0F : 0.0F);
    }
    write("a.png", 64, 1, values);
    const Texture& t = *open("a.png", "");
    EXPECT_NEAR(cache_.lookup(t, {0.37F, 0.61F}, TextureFootprint::round(1), {}).rgb.g, 0.5F,
                0.01F);
    EXPECT_NEAR(cache_.lookup(t, {0.37F, 0.61F}, TextureFootprint::round(0.1F), {}).rgb.g, 0.5F,
                0.05F);
}

TEST_F(TextureTest, LongFootprintsAverageAlongTheirLengthAlone) {
    // Stripes four texels wide, upright, and a slope that rises with v.
    std::vector<float> values;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            values.push_back(x % 8 < 4 ? 1.0F : 0.0F);
            values.push_back(1 - (static_cast<float>(y) + 0.5F) / 64);
            values.push_back(0);
        }
    write("a.tif", 64, 3, values, PictureType::Float);
    const Texture& t = *open("a.tif", "");
    TextureSampling sampling;
    sampling.filter = TextureFilter::Bilinear;
    const float texel = 1 / 64.0F;
    const Vec2f lit{34 * texel, 0.5F};  // in the middle of a bright stripe
    const TextureFootprint upright{{texel, 0}, {0, 16 * texel}},
        level{{texel, 0}, {16 * texel, 0}};
    EXPECT_GT(cache_.lookup(t, lit, upright, sampling).rgb.r, 0.98F);
    EXPECT_NEAR(cache_.lookup(t, lit, TextureFootprint::round(16 * texel), sampling).rgb.r, 0.5F,
                0.1F);
    EXPECT_NEAR(cache_.lookup(t, lit, level, sampling).rgb.r, 0.5F, 0.1F);
    // v grows upward also in footprints: along a slanted one colours vary as along its mirror image if they rise evenly,
    // but stripes turned by 45 degrees tell it from that.
    std::vector<float> slanted;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            slanted.push_back((x + y) % 16 < 8 ? 1.0F : 0.0F);  // along v = u + constant
    write("b.tif", 64, 1, slanted, PictureType::Float);
    const Texture& b = *open("b.tif", "");
    const Vec2f middle{(4 + 0.5F) * texel, 1 - 0.5F * texel};
    const float side = 12 * texel;
    const TextureFootprint along{{0.7F * texel, -0.7F * texel}, {side, side}},
        across{{0.7F * texel, 0.7F * texel}, {side, -side}};
    EXPECT_GT(cache_.lookup(b, middle, along, sampling).rgb.r, 0.9F);
    EXPECT_LT(cache_.lookup(b, middle, across, sampling).rgb.r, 0.75F);
    // Impossible footprints are points.
    const float nan = std::nanf("");
    EXPECT_GT(cache_.lookup(t, lit, {{nan, 0}, {0, 1}}, sampling).rgb.r, -1);
    EXPECT_GT(cache_.lookup(t, lit, {{1e30F, 0}, {0, kInfinity}}, sampling).rgb.r, -1);
}

/// Writes a tiled file with mip levels 64, 32 and 16 texels wide, each level of its own value.
/// TIFF keeps levels as further pictures; the attribute says what they are.
void write_mipmapped(const std::string& path, OIIO::TypeDesc type) {
    const auto output = OIIO::ImageOutput::create("tiff");
    for (int level = 0; level < 3; ++level) {
        const int size = 64 >> level;
        OIIO::ImageSpec spec(size, size, 3, type);
        spec.tile_width = spec.tile_height = 16;
        spec.tile_depth = 1;
        spec.attribute("textureformat", "Plain Texture");
        spec.attribute("oiio:SHA-1", "0123456789012345678901234567890123456789");
        ASSERT_TRUE(output->open(
            path, spec,
            level == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage))
            << output->geterror();
        const std::vector<float> pixels(
            static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 3,
            0.2F * static_cast<float>(level + 1));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, pixels.data()));
    }
    ASSERT_TRUE(output->close());
}

TEST_F(TextureTest, MipLevelsOfTheFileAreUsedAndConverted) {
    write_mipmapped(in_folder("a.tx"), OIIO::TypeUInt8);
    const Texture* raw = open("a.tx", "");
    const Texture* srgb = open("a.tx");  // the same fingerprint must not make them one
    ASSERT_NE(raw, nullptr) << diagnostics_.render();
    EXPECT_NEAR(cache_.lookup(*raw, {0.3F, 0.3F}, {}, {}).rgb.r, 0.2F, 1e-6F);
    EXPECT_NEAR(cache_.lookup(*raw, {0.3F, 0.3F}, TextureFootprint::round(1 / 32.0F), {}).rgb.r,
                0.4F, 1e-6F);
    EXPECT_NEAR(cache_.lookup(*raw, {0.3F, 0.3F}, TextureFootprint::round(2), {}).rgb.r, 0.6F,
                1e-6F);
    EXPECT_NEAR(cache_.lookup(*srgb, {0.3F, 0.3F}, TextureFootprint::round(2), {}).rgb.r,
                decode(Transfer::Srgb, 0.6F), 1e-5F);
}

TEST_F(TextureTest, ManyTilesAndAStrip) {
    // Larger than one tile of the cache, not a multiple of it; a ramp in x and y.
    const int w = 150, h = 133;
    std::vector<float> values;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x)
            values.insert(values.end(), {static_cast<float>(x), static_cast<float>(y), 0.5F});
    }
    write("a.tif", w, 3, values, PictureType::Float);
    const Texture& t = *open("a.tif");
    for (int y = 0; y < h; y += 11) {
        for (int x = 0; x < w; x += 7)
            expect_near(texel(t, x, y, w, h),
                        {{static_cast<float>(x), static_cast<float>(y), 0.5F}, 1}, 1e-4F);
    }
    expect_near(texel(t, w - 1, h - 1, w, h),
                {{static_cast<float>(w - 1), static_cast<float>(h - 1), 0.5F}, 1}, 1e-4F);
}

TEST_F(TextureTest, ExrTexturesMayBeTiledHalfAndMixed) {
    ExrWriteSpec spec;
    spec.width = spec.data_width = 40;
    spec.height = spec.data_height = 40;
    spec.tile_size = 16;
    spec.parts = {
        {"", {{"R", ExrPixelType::Half}, {"G", ExrPixelType::Float}, {"B", ExrPixelType::Half}}}};
    std::vector<float> pixels;
    for (int i = 0; i < 1600; ++i)
        pixels.insert(pixels.end(),
                      {static_cast<float>(i % 40), static_cast<float>(i / 40), 0.5F});
    ExrWriter writer(in_folder("a.exr"), spec);
    writer.write(
        0, 0, 40, 40,
        std::vector<ExrPlane>{{&pixels[0], 3, 120}, {&pixels[1], 3, 120}, {&pixels[2], 3, 120}});
    writer.close();
    const Texture* t = open("a.exr");
    ASSERT_NE(t, nullptr) << diagnostics_.render();
    EXPECT_TRUE(TextureCache::info(*t).is_float);
    expect_near(texel(*t, 33, 7, 40, 40), {{33, 7, 0.5F}, 1}, 1e-4F);
    expect_near(texel(*t, 2, 39, 40, 40), {{2, 39, 0.5F}, 1}, 1e-4F);
}

TEST_F(TextureTest, NamesAreNoPatterns) {
    write("a <UDIM> %04d #.tif", 1, 1, {0.25F}, PictureType::Float);
    const Texture* t = open("a <UDIM> %04d #.tif");
    ASSERT_NE(t, nullptr) << diagnostics_.render();
    EXPECT_NEAR(texel(*t, 0, 0, 1, 1).rgb.r, 0.25F, 1e-6F);
}

TEST_F(TextureTest, BadFilesAreReportedWhenOpened) {
    EXPECT_EQ(open("none.png"), nullptr);
    std::vector<float> noise;
    for (int i = 0; i < 200 * 200; ++i)
        noise.push_back(static_cast<float>((i * 7919) % 251) / 251);
    write("good.png", 200, 1, noise);
    write_bytes(
        in_folder("cut.png"),
        bytes_of(in_folder("good.png")).substr(0, bytes_of(in_folder("good.png")).size() / 2));
    EXPECT_EQ(open("cut.png"), nullptr);
    write_bytes(in_folder("text.tx"), "no picture");
    EXPECT_EQ(open("text.tx"), nullptr);
    ASSERT_EQ(diagnostics_.items().size(), 3U);
    EXPECT_EQ(diagnostics_.items()[0].code, Code::FileNotFound);
    EXPECT_EQ(diagnostics_.items()[1].code, Code::FileFormat);
    EXPECT_EQ(diagnostics_.items()[2].code, Code::FileFormat);
    for (const Error& e : diagnostics_.items())
        EXPECT_FALSE(e.hint.empty());
}

TEST_F(TextureTest, FilesThatVanishWhileRenderingAreReportedAtTheEnd) {
    write_mipmapped(in_folder("a.tx"), OIIO::TypeUInt8);
    const Texture* t = open("a.tx");
    ASSERT_NE(t, nullptr);
    Diagnostics before;
    cache_.report_failures(before);
    EXPECT_FALSE(before.has_errors());
    // Everything but the header is gone; the tile that was read on opening is still in memory.
    std::filesystem::resize_file(in_folder("a.tx"), 200);
    bool black = false;
    for (int i = 0; i < 16; ++i)
        black = black || is_black(texel(*t, i * 4, i * 3, 64, 64).rgb);
    EXPECT_TRUE(black);
    Diagnostics after;
    cache_.report_failures(after);
    ASSERT_EQ(after.items().size(), 1U);
    EXPECT_EQ(after.items()[0].code, Code::FileUnreadable);
}

TEST_F(TextureTest, MemoryStaysBelowWhatWasForetold) {
    constexpr int kSide = 512;
    constexpr std::size_t kBytes = std::size_t{kSide} * kSide * 3 * sizeof(float);
    write("a.tif", kSide, 3, std::vector<float>(kBytes / sizeof(float), 0.5F), PictureType::Float);
    EXPECT_EQ(cache_.most_memory(), 0U);
    EXPECT_EQ(cache_.open_seconds(), 0);
    const Texture* t = open("a.tif");
    ASSERT_NE(t, nullptr) << diagnostics_.render();
    EXPECT_GT(cache_.open_seconds(), 0);
    // All levels, and the file decoded as a whole.
    EXPECT_EQ(cache_.most_memory(), kBytes * 4 / 3 + kBytes);
    for (int i = 0; i < kSide; i += 32)
        for (int j = 0; j < kSide; j += 32)
            (void)texel(*t, i, j, kSide, kSide);
    EXPECT_GE(cache_.memory(), 2 * kBytes);
    EXPECT_LE(cache_.memory(), cache_.most_memory() + kBytes / 4) << "and what tiles cost each";
    TextureCache small(1);
    ASSERT_NE(small.open(in_folder("a.tif"), "auto", diagnostics_, {}), nullptr);
    EXPECT_EQ(small.most_memory(), (std::size_t{1} << 20U) + kBytes);
}

TEST_F(TextureTest, UnknownSpacesWarn) {
    write("a.png", 1, 3, {0.2F, 0.6F, 1});
    ASSERT_NE(open("a.png", "my space"), nullptr);
    ASSERT_EQ(diagnostics_.items().size(), 1U);
    EXPECT_EQ(diagnostics_.items()[0].severity, Severity::Warning);
    EXPECT_EQ(TextureCache::info(*open("a.png", "my space")).space, kSrgb);
}

TEST_F(TextureTest, ThreadsSeeTheSameTexels) {
    std::vector<float> values;
    for (int i = 0; i < 300 * 300; ++i)
        values.push_back(static_cast<float>(i % 251) / 251);
    write("a.png", 300, 1, values);
    const Texture& t = *open("a.png");
    const auto sum = [&] {
        double total = 0;
        for (int i = 0; i < 4000; ++i)
            total += static_cast<double>(
                cache_
                    .lookup(t, {static_cast<float>(i) * 0.37F, static_cast<float>(i) * 0.11F},
                            TextureFootprint::round(0.001F * static_cast<float>(i % 40)), {})
                    .rgb.r);
        return total;
    };
    const double expected = sum();
    std::array<double, 2> totals{};
    std::thread other([&] { totals[0] = sum(); });
    totals[1] = sum();
    other.join();
    EXPECT_EQ(totals[0], expected);
    EXPECT_EQ(totals[1], expected);
}

}  // namespace
}  // namespace lightsieve
