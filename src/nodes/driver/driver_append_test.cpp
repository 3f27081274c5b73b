// Files that are gone on with, cut to what is in them, and JPEG.
#include <bit>
#include <filesystem>

#include "nodes/driver/driver_test_support.h"

namespace lightsieve {

NodeType node_driver_exr();
NodeType node_driver_jpeg();
NodeType node_driver_png();
NodeType node_driver_tiff();

namespace {

/// A header whose region is part of the frame.
ImageHeader region(std::vector<ImageLayer> layers, int x, int y, int width, int height) {
    ImageHeader header = header_of(std::move(layers));
    header.data_x = x;
    header.data_y = y;
    header.data_width = width;
    header.data_height = height;
    return header;
}

float pixel(const ExrFile& file, const std::string& channel, int x, int y) {
    return file.find(channel)
        ->pixels[static_cast<std::size_t>((y - file.data_y) * file.data_width + x - file.data_x)];
}

using DriverAppendTest = DriverTest;

TEST_F(DriverAppendTest, ExrKeepsWhatIsNotRendered) {
    for (const bool tiled : {true, false}) {
        for (const bool multipart : {true, false}) {
            TestNode node(node_driver_exr());
            node.set("tiled", tiled).set("multipart", multipart);
            const std::vector<ImageLayer> layers{layer("RGBA", "RGBA", 4), layer("ID", "UINT", 1)};
            const float first = std::bit_cast<float>(3U), second = std::bit_cast<float>(4U);
            render(*make(node, "a.exr"), region(layers, 2, 3, 20, 10), {{1, 2, 3, 4}, {first}});
            node.set("append", true);
            render(*make(node, "a.exr"), region(layers, 10, 8, 25, 12), {{5, 6, 7, 8}, {second}});
            const ExrFile file = read_exr(in_folder("a.exr"));
            EXPECT_EQ(file.data_x, 2);
            EXPECT_EQ(file.data_y, 3);
            EXPECT_EQ(file.data_width, 33);
            EXPECT_EQ(file.data_height, 17);
            EXPECT_EQ(pixel(file, "G", 2, 3), 2) << "above";
            EXPECT_EQ(pixel(file, "G", 9, 12), 2) << "left";
            EXPECT_EQ(pixel(file, "G", 10, 8), 6) << "in both";
            EXPECT_EQ(pixel(file, "G", 34, 19), 6);
            EXPECT_EQ(pixel(file, "G", 2, 19), 0) << "in neither";
            EXPECT_EQ(pixel(file, "ID", 2, 3), first);
            EXPECT_EQ(pixel(file, "ID", 10, 8), second);
        }
    }
}

TEST_F(DriverAppendTest, ExrStartsAnewWhereLayersAreOthers) {
    TestNode node(node_driver_exr());
    render(*make(node, "a.exr"), header_of({layer("RGBA", "RGBA", 4)}), {{1, 1, 1, 1}});
    node.set("append", true);
    const auto driver = make(node, "a.exr");
    Diagnostics diagnostics;
    ASSERT_TRUE(driver->open(region({layer("RGB", "RGB", 3)}, 0, 0, 4, 4), diagnostics));
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::InvalidValue);
    ASSERT_TRUE(driver->close(diagnostics));
    EXPECT_EQ(read_exr(in_folder("a.exr")).data_width, 4);
    // Nothing to go on with is no reason to say anything.
    render(*make(node, "new.exr"), header_of({layer("RGBA", "RGBA", 4)}), {{1, 1, 1, 1}});
}

TEST_F(DriverAppendTest, ExrIsCutToWhatIsNotBlack) {
    TestNode node(node_driver_exr());
    node.set("autocrop", true);
    const ImageHeader header = header_of({layer("RGBA", "RGBA", 4), layer("ID", "UINT", 1)});
    const auto driver = make(node, "a.exr");
    Diagnostics diagnostics;
    ASSERT_TRUE(driver->open(header, diagnostics));
    std::vector<float> beauty(kWidth * kHeight * 4, 0.0F), ids(kWidth * kHeight, 0.0F);
    beauty[(7 * kWidth + 5) * 4 + 3] = 0.5F;
    ids[20 * kWidth + 12] = std::bit_cast<float>(1U);
    driver->write({0, 0, kWidth, kHeight, {beauty, ids}});
    ASSERT_TRUE(driver->close(diagnostics));
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_EQ(file.width, kWidth);
    EXPECT_EQ(file.data_x, 5);
    EXPECT_EQ(file.data_y, 7);
    EXPECT_EQ(file.data_width, 8);
    EXPECT_EQ(file.data_height, 14);
    EXPECT_EQ(pixel(file, "A", 5, 7), 0.5F);
    EXPECT_EQ(pixel(file, "ID", 12, 20), std::bit_cast<float>(1U));
    // An empty picture has one pixel: files without any are not possible.
    render(*make(node, "b.exr"), header_of({layer("RGBA", "RGBA", 4)}), {{0, 0, 0, 0}});
    EXPECT_EQ(read_exr(in_folder("b.exr")).data_width, 1);
}

TEST_F(DriverAppendTest, ExrMayBeCutAndGoneOnWith) {
    TestNode node(node_driver_exr());
    node.set("autocrop", true).set("append", true);
    const std::vector<ImageLayer> layers{layer("RGBA", "RGBA", 4)};
    render(*make(node, "a.exr"), region(layers, 2, 3, 4, 4), {{1, 1, 1, 1}});
    render(*make(node, "a.exr"), region(layers, 20, 3, 4, 4), {{2, 2, 2, 2}});
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_EQ(file.data_x, 2);
    EXPECT_EQ(file.data_width, 22);
    EXPECT_EQ(pixel(file, "R", 2, 3), 1);
    EXPECT_EQ(pixel(file, "R", 20, 3), 2);
}

TEST_F(DriverAppendTest, TiffKeepsWhatIsNotRendered) {
    TestNode node(node_driver_tiff());
    node.set("output_padded", true).set("color_space", Name(""));
    const std::vector<ImageLayer> layers{layer("RGB", "RGB", 3)};
    const ImageHeader all = header_of(layers);
    // Every integer of eight bits, exactly.
    const auto ramp = make(node, "a.tif");
    Diagnostics diagnostics;
    ASSERT_TRUE(ramp->open(all, diagnostics));
    std::vector<float> values(kWidth * kHeight * 3);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(i % 256) / 255;
    ramp->write({0, 0, kWidth, kHeight, {values}});
    ASSERT_TRUE(ramp->close(diagnostics));
    const StoredImage before = read_stored_image(in_folder("a.tif"));
    node.set("append", true);
    render(*make(node, "a.tif"), region(layers, 30, 20, 5, 5), {{1, 0, 1}});
    const StoredImage after = read_stored_image(in_folder("a.tif"));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < before.values.size(); ++i)
        changed += before.values[i] != after.values[i] ? 1 : 0;
    EXPECT_LE(changed, 75U) << "dither must not act twice";
    EXPECT_GT(changed, 60U);
    // A region by itself has another size than the frame.
    node.set("output_padded", false);
    const auto driver = make(node, "a.tif");
    ASSERT_TRUE(driver->open(region(layers, 0, 0, 5, 5), diagnostics));
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::InvalidValue);
}

TEST_F(DriverAppendTest, JpegHoldsColorsWithoutAlpha) {
    TestNode node(node_driver_jpeg());
    node.set("dither", false);
    render(*make(node, "a.jpg"), header_of({layer("RGBA", "RGBA", 4)}),
           {{0.5F, 0.5F, 0.5F, 0.5F}});
    const StoredImage grey = read_stored_image(in_folder("a.jpg"));
    EXPECT_EQ(grey.width, kWidth);
    EXPECT_EQ(grey.n_channels, 3);
    EXPECT_NEAR(grey.values[0], 188 / 255.0F, 1.01F / 255);
    render(*make(node, "b.jpg"), header_of({layer("RGB", "RGB", 3)}), {{1, 0, 0}});
    node.set("color_space", Name("raw"));
    render(*make(node, "b.jpg"), header_of({layer("RGB", "RGB", 3)}), {{0.5F, 0, 0}});
    EXPECT_NEAR(read_stored_image(in_folder("b.jpg")).values[0], 128 / 255.0F, 2.01F / 255);
}

TEST_F(DriverAppendTest, JpegTradesSizeForQuality) {
    const auto size_at = [&](std::int32_t quality) {
        TestNode node(node_driver_jpeg());
        node.set("quality", quality);
        const auto driver = make(node, "a.jpg");
        Diagnostics diagnostics;
        EXPECT_TRUE(driver->open(header_of({layer("RGB", "RGB", 3)}), diagnostics));
        std::vector<float> values(kWidth * kHeight * 3);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(i * 7919 % 101) / 100;
        driver->write({0, 0, kWidth, kHeight, {values}});
        EXPECT_TRUE(driver->close(diagnostics));
        return std::filesystem::file_size(in_folder("a.jpg"));
    };
    EXPECT_GT(size_at(100), 2 * size_at(30));
}

}  // namespace
}  // namespace lightsieve
