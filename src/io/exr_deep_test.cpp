// Deep files, read by OpenEXR's own reader.
#include "io/exr_deep.h"

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <ImfDeepTiledInputFile.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

namespace exr = OPENEXR_IMF_NAMESPACE;

constexpr int kX = 3, kY = -2, kWidth = 5, kHeight = 4;

ExrWriteSpec spec_of(bool tiled) {
    ExrWriteSpec spec;
    spec.width = 16;
    spec.height = 12;
    spec.data_x = kX;
    spec.data_y = kY;
    spec.data_width = kWidth;
    spec.data_height = kHeight;
    spec.tiled = tiled;
    spec.tile_size = 2;
    spec.compression = ExrCompression::Zips;
    spec.parts = {{"deep", {{"A", ExrPixelType::Half}, {"Z", ExrPixelType::Float}}}};
    spec.attributes["note"] = std::string("deep");
    return spec;
}

/// Pixel i has i % 3 samples: alpha is 1 / (i + 1), depth i + sample.
DeepPixels pixels_of() {
    DeepPixels out;
    out.channels.resize(2);
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        out.counts.push_back(i % 3);
        for (std::uint32_t s = 0; s < i % 3; ++s) {
            out.channels[0].push_back(1 / static_cast<float>(i + 1));
            out.channels[1].push_back(static_cast<float>(i + s));
        }
    }
    return out;
}

using DeepExrTest = FolderTest;

template <class File, class Read>
void check(const std::string& path, const Read& read) {
    File file(path.c_str());
    const auto& data = file.header().dataWindow();
    EXPECT_EQ(data.min.x, kX);
    EXPECT_EQ(data.min.y, kY);
    EXPECT_EQ(data.max.x, kX + kWidth - 1);
    std::vector<unsigned> counts(kWidth * kHeight);
    std::vector<float*> alphas(counts.size()), depths(counts.size());
    const auto base = [](auto* first) {
        return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(first) -
                                       static_cast<std::intptr_t>(sizeof(*first)) *
                                           (kY * kWidth + kX));
    };
    exr::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        exr::Slice(exr::UINT, base(counts.data()), sizeof(unsigned), sizeof(unsigned) * kWidth));
    buffer.insert("A", exr::DeepSlice(exr::FLOAT, base(alphas.data()), sizeof(float*),
                                      sizeof(float*) * kWidth, sizeof(float)));
    buffer.insert("Z", exr::DeepSlice(exr::FLOAT, base(depths.data()), sizeof(float*),
                                      sizeof(float*) * kWidth, sizeof(float)));
    file.setFrameBuffer(buffer);
    std::vector<std::vector<float>> memory;
    read(file, [&] {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            alphas[i] = memory.emplace_back(counts[i] + 1).data();
            depths[i] = memory.emplace_back(counts[i] + 1).data();
        }
    });
    for (std::size_t i = 0; i < counts.size(); ++i) {
        ASSERT_EQ(counts[i], i % 3);
        for (unsigned s = 0; s < counts[i]; ++s) {
            EXPECT_NEAR(alphas[i][s], 1 / static_cast<float>(i + 1), 1e-3F) << "half";
            EXPECT_EQ(depths[i][s], static_cast<float>(i + s));
        }
    }
}

TEST_F(DeepExrTest, ScanlinesComeBack) {
    write_deep_exr(in_folder("a.exr"), spec_of(false), pixels_of());
    check<exr::DeepScanLineInputFile>(in_folder("a.exr"), [](auto& file, const auto& allocate) {
        EXPECT_EQ(file.header().type(), exr::DEEPSCANLINE);
        file.readPixelSampleCounts(kY, kY + kHeight - 1);
        allocate();
        file.readPixels(kY, kY + kHeight - 1);
    });
}

TEST_F(DeepExrTest, TilesComeBack) {
    write_deep_exr(in_folder("a.exr"), spec_of(true), pixels_of());
    check<exr::DeepTiledInputFile>(in_folder("a.exr"), [](auto& file, const auto& allocate) {
        EXPECT_EQ(file.header().type(), exr::DEEPTILE);
        file.readPixelSampleCounts(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
        allocate();
        file.readTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    });
}

TEST_F(DeepExrTest, UnwritablePlacesAreErrors) {
    EXPECT_THROW(write_deep_exr(in_folder("none/a.exr"), spec_of(false), pixels_of()), InputError);
    ExrWriteSpec bad = spec_of(false);
    bad.compression = ExrCompression::Piz;  // not for deep files
    EXPECT_THROW(write_deep_exr(in_folder("a.exr"), bad, pixels_of()), InputError);
}

}  // namespace
}  // namespace lightsieve
