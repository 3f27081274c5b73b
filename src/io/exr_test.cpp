// EXR files: round trips in every form, bad files, failures while writing.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <functional>
#include <limits>

#include "core/error.h"
#include "io/exr_read.h"
#include "io/exr_write.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

class ExrTest : public FolderTest {};

/// A value that tells where it belongs.
float value_at(int x, int y, int channel) {
    return static_cast<float>(x) + 100 * static_cast<float>(y) +
           0.25F * static_cast<float>(channel);
}

constexpr int kWidth = 70, kHeight = 50;

ExrWriteSpec small_spec() {
    ExrWriteSpec spec;
    spec.width = kWidth;
    spec.height = kHeight;
    spec.data_width = kWidth;
    spec.data_height = kHeight;
    spec.tile_size = 16;
    spec.parts = {{"RGBA",
                   {{"R", ExrPixelType::Float},
                    {"G", ExrPixelType::Float},
                    {"B", ExrPixelType::Float},
                    {"A", ExrPixelType::Float}}},
                  {"Z", {{"Z", ExrPixelType::Float}}}};
    return spec;
}

ExrWriteSpec one_part(ExrWriteSpec spec) {
    for (std::size_t p = 1; p < spec.parts.size(); ++p)
        spec.parts[0].channels.insert(spec.parts[0].channels.end(), spec.parts[p].channels.begin(),
                                      spec.parts[p].channels.end());
    spec.parts.resize(1);
    return spec;
}

std::size_t n_channels(const ExrWriteSpec& spec) {
    std::size_t n = 0;
    for (const ExrPart& part : spec.parts)
        n += part.channels.size();
    return n;
}

/// Hands the rectangle x0..x1, y0..y1 to the writer, channels interleaved as a renderer has them.
void write_rectangle(ExrWriter& writer, std::size_t n, int x0, int y0, int x1, int y1) {
    std::vector<float> pixels;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            for (std::size_t c = 0; c < n; ++c)
                pixels.push_back(value_at(x, y, static_cast<int>(c)));
        }
    }
    std::vector<ExrPlane> planes;
    const auto stride = static_cast<std::ptrdiff_t>(n);
    for (std::size_t c = 0; c < n; ++c)
        planes.push_back({pixels.data() + c, stride, stride * (x1 - x0)});
    writer.write(x0, y0, x1 - x0, y1 - y0, planes);
}

/// All buckets of side `size` from the data window's corner, last row first.
void write_buckets(ExrWriter& writer, const ExrWriteSpec& spec, int size) {
    for (int y = (spec.data_height - 1) / size * size; y >= 0; y -= size) {
        for (int x = 0; x < spec.data_width; x += size) {
            write_rectangle(writer, n_channels(spec), spec.data_x + x, spec.data_y + y,
                            spec.data_x + std::min(x + size, spec.data_width),
                            spec.data_y + std::min(y + size, spec.data_height));
        }
    }
}

void expect_values(const ExrFile& file, const ExrWriteSpec& spec, float relative = 0) {
    int c = 0;
    for (const ExrPart& part : spec.parts) {
        for (const ExrChannel& channel : part.channels) {
            const ExrReadChannel* read = file.find(channel.name);
            ASSERT_NE(read, nullptr) << channel.name;
            EXPECT_EQ(read->type, channel.type);
            for (int y = 0; y < spec.data_height; ++y) {
                for (int x = 0; x < spec.data_width; ++x) {
                    const float expected = value_at(spec.data_x + x, spec.data_y + y, c);
                    ASSERT_NEAR(read->pixels[static_cast<std::size_t>(y * spec.data_width + x)],
                                expected, std::abs(expected) * relative)
                        << channel.name << ' ' << x << ' ' << y;
                }
            }
            ++c;
        }
    }
}

TEST_F(ExrTest, RoundTripTiledAndScanlineOneAndManyParts) {
    for (const bool tiled : {true, false}) {
        for (const bool multipart : {true, false}) {
            for (const int bucket : {16, 24, 7}) {  // tiles, more than a tile, less than a tile
                ExrWriteSpec spec = multipart ? small_spec() : one_part(small_spec());
                spec.tiled = tiled;
                ExrWriter writer(in_folder("a.exr"), spec);
                write_buckets(writer, spec, bucket);
                writer.close();
                const ExrFile file = read_exr(in_folder("a.exr"));
                EXPECT_EQ(file.tiled, tiled);
                EXPECT_EQ(file.n_parts, multipart ? 2 : 1);
                expect_values(file, spec);
            }
        }
    }
    EXPECT_EQ(n_files(), 1U);
}

TEST_F(ExrTest, LosslessCompressionsKeepEveryBit) {
    for (const ExrCompression compression :
         {ExrCompression::None, ExrCompression::Rle, ExrCompression::Zip, ExrCompression::Zips,
          ExrCompression::Piz}) {
        ExrWriteSpec spec = one_part(small_spec());
        spec.compression = compression;
        ExrWriter writer(in_folder("a.exr"), spec);
        write_buckets(writer, spec, 16);
        writer.close();
        const ExrFile file = read_exr(in_folder("a.exr"));
        EXPECT_EQ(file.compression, compression);
        expect_values(file, spec);
    }
}

TEST_F(ExrTest, LossyCompressionsComeClose) {
    for (const ExrCompression compression :
         {ExrCompression::Pxr24, ExrCompression::B44, ExrCompression::B44a, ExrCompression::Dwaa,
          ExrCompression::Dwab}) {
        ExrWriteSpec spec = one_part(small_spec());
        for (ExrChannel& channel : spec.parts[0].channels)
            channel.type = ExrPixelType::Half;
        spec.compression = compression;
        ExrWriter writer(in_folder("a.exr"), spec);
        write_buckets(writer, spec, 16);
        writer.close();
        const ExrFile file = read_exr(in_folder("a.exr"));
        EXPECT_EQ(file.compression, compression);
        EXPECT_NEAR(file.find("G")->pixels[30 * kWidth + 40], value_at(40, 30, 1), 60);
    }
}

TEST_F(ExrTest, TypesMayBeMixedAndUIntsKeepTheirBits) {
    ExrWriteSpec spec;
    spec.width = spec.data_width = 3;
    spec.height = spec.data_height = 1;
    spec.parts = {
        {"", {{"ID", ExrPixelType::UInt}, {"H", ExrPixelType::Half}, {"F", ExrPixelType::Float}}}};
    const std::vector<float> ids = {std::bit_cast<float>(4213994615U), std::bit_cast<float>(7U),
                                    0};
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> halfs = {0.1F, 1e9F, inf};
    const std::vector<float> floats = {0.1F, 1e9F, std::nanf("")};
    ExrWriter writer(in_folder("a.exr"), spec);
    writer.write(
        0, 0, 3, 1,
        std::vector<ExrPlane>{{ids.data(), 1, 3}, {halfs.data(), 1, 3}, {floats.data(), 1, 3}});
    writer.close();
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(file.find("ID")->pixels[0]), 4213994615U);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(file.find("ID")->pixels[1]), 7U);
    EXPECT_NEAR(file.find("H")->pixels[0], 0.1F, 0.1F * 0x1p-11F);
    EXPECT_EQ(file.find("H")->pixels[1], 65504);  // finite stays finite
    EXPECT_EQ(file.find("H")->pixels[2], inf);
    EXPECT_EQ(file.find("F")->pixels[1], 1e9F);
    EXPECT_TRUE(std::isnan(file.find("F")->pixels[2]));
}

TEST_F(ExrTest, WindowsAspectAndAttributesComeBack) {
    ExrWriteSpec spec = one_part(small_spec());
    spec.width = 200;
    spec.height = 100;
    spec.data_x = -10;  // overscan
    spec.data_y = 20;
    spec.pixel_aspect_ratio = 1.5F;
    const std::vector<float> matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1};
    spec.attributes = {{"arnold/aovs/diffuse_key/lpe_expression", std::string("C<RD>.*<L.'key'>")},
                       {"lightsieve/samples", 16},
                       {"lightsieve/time", 1.5F},
                       {"worldToCamera", matrix},
                       {"lightsieve/list", std::vector<float>{1, 2, 3}}};
    ExrWriter writer(in_folder("a.exr"), spec);
    write_buckets(writer, spec, 16);
    writer.close();
    for (const ExrFile& file :
         {read_exr_header(in_folder("a.exr")), read_exr(in_folder("a.exr"))}) {
        EXPECT_EQ(file.width, 200);
        EXPECT_EQ(file.height, 100);
        EXPECT_EQ(file.data_x, -10);
        EXPECT_EQ(file.data_y, 20);
        EXPECT_EQ(file.data_width, kWidth);
        EXPECT_FLOAT_EQ(file.pixel_aspect_ratio, 1.5F);
        for (const auto& [name, value] : spec.attributes)
            EXPECT_EQ(file.attributes.at(name), value) << name;
    }
    expect_values(read_exr(in_folder("a.exr")), spec);
    EXPECT_TRUE(read_exr_header(in_folder("a.exr")).find("R")->pixels.empty());
}

TEST_F(ExrTest, WhatNeverCameIsZero) {
    for (const bool tiled : {true, false}) {
        ExrWriteSpec spec = one_part(small_spec());
        spec.tiled = tiled;
        ExrWriter writer(in_folder("a.exr"), spec);
        write_rectangle(writer, n_channels(spec), 20, 20, 30, 30);
        writer.close();
        const ExrFile file = read_exr(in_folder("a.exr"));
        EXPECT_EQ(file.find("R")->pixels[0], 0);
        EXPECT_EQ(file.find("R")->pixels[25 * kWidth + 25], value_at(25, 25, 0));
        EXPECT_EQ(file.find("R")->pixels[25 * kWidth + 31], 0);
    }
}

TEST_F(ExrTest, NothingAppearsUnderTheNameBeforeTheEnd) {
    write_bytes(in_folder("a.exr"), "older");
    {
        const ExrWriteSpec spec = one_part(small_spec());
        ExrWriter writer(in_folder("a.exr"), spec);
        write_rectangle(writer, n_channels(spec), 0, 0, 16, 16);
        EXPECT_EQ(bytes_of(in_folder("a.exr")), "older");
    }
    EXPECT_EQ(bytes_of(in_folder("a.exr")), "older");
    EXPECT_EQ(n_files(), 1U);  // the temporary file is gone
}

Code code_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const InputError& e) {
        EXPECT_FALSE(e.errors()[0].hint.empty());
        return e.errors()[0].code;
    }
    ADD_FAILURE() << "no error";
    return {};
}

TEST_F(ExrTest, FilesThatCannotBeWrittenAreRefusedAtOnce) {
    const ExrWriteSpec spec = one_part(small_spec());
    EXPECT_EQ(code_of([&] { ExrWriter(in_folder("none/a.exr"), spec); }), Code::FileUnwritable);
    EXPECT_EQ(code_of([&] { ExrWriter(in_folder("."), spec); }), Code::FileUnwritable);
    EXPECT_EQ(code_of([&] { ExrWriter("", spec); }), Code::FileUnwritable);
    EXPECT_EQ(code_of([&] { ExrWriter("/dev/null", spec); }), Code::FileUnwritable);
    ExrWriteSpec twice = spec;
    twice.parts[0].channels.push_back({"R", ExrPixelType::Half});
    EXPECT_EQ(code_of([&] { ExrWriter(in_folder("a.exr"), twice); }), Code::FileUnwritable);
    ExrWriteSpec reserved = spec;
    reserved.attributes["dataWindow"] = 1;
    EXPECT_EQ(code_of([&] { ExrWriter(in_folder("a.exr"), reserved); }), Code::FileUnwritable);
    EXPECT_EQ(n_files(), 0U);
}

TEST_F(ExrTest, AFullDiskIsReportedAndLeavesNothing) {
    // A limit on the size of files stands for the full disk. It strikes while pixels are written, or at the very end.
    ExrWriteSpec spec = one_part(small_spec());
    spec.compression = ExrCompression::None;
    const auto write_all = [&] {
        ExrWriter writer(in_folder("a.exr"), spec);
        write_buckets(writer, spec, 16);
        writer.close();
    };
    write_all();
    const auto size = static_cast<rlim_t>(std::filesystem::file_size(in_folder("a.exr")));
    std::filesystem::remove(in_folder("a.exr"));
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    for (const rlim_t limit : {size / 4, size - 1}) {
        const rlimit low{limit, old.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
        EXPECT_EQ(code_of(write_all), Code::FileUnwritable);
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
        EXPECT_EQ(n_files(), 0U);
    }
    (void)std::signal(SIGXFSZ, ignored);
}

TEST_F(ExrTest, DamagedFilesGiveErrors) {
    const ExrWriteSpec spec = one_part(small_spec());
    ExrWriter writer(in_folder("a.exr"), spec);
    write_buckets(writer, spec, 16);
    writer.close();
    const std::string good = bytes_of(in_folder("a.exr"));
    // Cut anywhere: in the magic number, the header, the index, the last tile.
    for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{40},
                                   good.size() / 8, good.size() / 2, good.size() - 5}) {
        write_bytes(in_folder("cut.exr"), good.substr(0, size));
        EXPECT_EQ(code_of([&] { (void)read_exr(in_folder("cut.exr")); }), Code::FileFormat)
            << size;
    }
    write_bytes(in_folder("text.exr"), "this is no picture");
    EXPECT_EQ(code_of([&] { (void)read_exr_header(in_folder("text.exr")); }), Code::FileFormat);
    EXPECT_EQ(code_of([&] { (void)read_exr(in_folder("none.exr")); }), Code::FileNotFound);
    EXPECT_EQ(code_of([&] { (void)read_exr(in_folder(".")); }), Code::FileUnreadable);
    EXPECT_EQ(code_of([&] { (void)read_exr(in_folder("a.exr"), 1000); }), Code::LimitImageSize);
}

TEST_F(ExrTest, AttributesLongerThanTheFileTakeNoMemory) {
    ExrWriteSpec spec = small_spec();
    spec.attributes = {{"comment", std::string("abc")}};
    ExrWriter(in_folder("a.exr"), spec).close();
    EXPECT_EQ(std::get<std::string>(read_exr(in_folder("a.exr")).attributes.at("comment")), "abc");
    std::string bad = bytes_of(in_folder("a.exr"));
    const std::string head("comment\0string\0", 15);
    bad[bad.rfind(head) + head.size() + 3] = 0x70;  // the last part's
    write_bytes(in_folder("a.exr"), bad);
    try {
        (void)read_exr_header(in_folder("a.exr"));
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(e.errors()[0].message.find("\"comment\" is longer than the file"),
                  std::string::npos);
    }
}

TEST_F(ExrTest, FlippedBytesAreReadOrRefused) {
    ExrWriteSpec spec = one_part(small_spec());
    spec.width = spec.data_width = spec.height = spec.data_height = 8;
    ExrWriter writer(in_folder("a.exr"), spec);
    write_buckets(writer, spec, 8);
    writer.close();
    const std::string good = bytes_of(in_folder("a.exr"));
    std::size_t n_refused = 0;
    for (std::size_t i = 0; i < good.size(); i += 3) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x55);
        write_bytes(in_folder("bad.exr"), bad);
        try {
            (void)read_exr(in_folder("bad.exr"), std::size_t{1} << 20);
        } catch (const InputError&) {
            ++n_refused;
        }
    }
    EXPECT_GT(n_refused, good.size() / 12);
}

}  // namespace
}  // namespace lightsieve
