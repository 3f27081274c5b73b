// Drivers: what is in the file for known pixels, channel names, headers, and files that cannot be written.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/color.h"
#include "io/exr_tools.h"
#include "io/image_read.h"
#include "io/testing/test_folder.h"
#include "nodes/common/node_test_support.h"
#include "scene/driver.h"

namespace lightsieve {

NodeType node_driver_exr();
NodeType node_driver_png();
NodeType node_driver_tiff();

namespace {

constexpr int kWidth = 40, kHeight = 30, kBucket = 16;

ImageLayer layer(const std::string& name, const std::string& type, std::size_t n_channels) {
    ImageLayer out;
    out.name = out.aov = name;
    out.aov_type = type;
    out.n_channels = n_channels;
    out.filter = "gaussian_filter";
    out.filter_width = 2;
    return out;
}

ImageHeader header_of(std::vector<ImageLayer> layers) {
    ImageHeader header;
    header.width = header.data_width = kWidth;
    header.height = header.data_height = kHeight;
    header.bucket_size = kBucket;
    header.layers = std::move(layers);
    return header;
}

class DriverTest : public FolderTest {
  protected:
    [[nodiscard]] std::unique_ptr<Driver> make(TestNode& node, const std::string& file) {
        node.set("filename", Name(in_folder(file)));
        return node.type().make_driver(node.block(), context_);
    }

    /// Renders a constant in each layer; `values` has n_channels numbers a layer.
    void render(Driver& driver, const ImageHeader& header,
                const std::vector<std::vector<float>>& values) {
        Diagnostics diagnostics;
        ASSERT_TRUE(driver.open(header, diagnostics)) << diagnostics.render();
        for (int y = header.data_y; y < header.data_y + header.data_height; y += kBucket) {
            for (int x = header.data_x; x < header.data_x + header.data_width; x += kBucket) {
                Bucket bucket{x,
                              y,
                              std::min(kBucket, header.data_x + header.data_width - x),
                              std::min(kBucket, header.data_y + header.data_height - y),
                              {}};
                std::vector<std::vector<float>> pixels;
                for (const std::vector<float>& value : values) {
                    std::vector<float>& run = pixels.emplace_back();
                    for (int i = 0; i < bucket.width * bucket.height; ++i)
                        run.insert(run.end(), value.begin(), value.end());
                }
                for (const std::vector<float>& run : pixels)
                    bucket.layers.emplace_back(run);
                driver.write(bucket);
            }
        }
        ASSERT_TRUE(driver.close(diagnostics)) << diagnostics.render();
        EXPECT_EQ(diagnostics.items().size(), 0U);
    }

    /// The picture's first pixel as stored.
    [[nodiscard]] Color stored(const std::string& file) const {
        Diagnostics diagnostics;
        return read_color_image(in_folder(file), "", diagnostics).at(0, 0);
    }
    [[nodiscard]] std::vector<std::string> channels(const std::string& file) const {
        std::vector<std::string> names;
        for (const ExrReadChannel& c : read_exr_header(in_folder(file)).channels)
            names.push_back(c.name);
        return names;
    }

    TestContext context_;
};

using Names = std::vector<std::string>;

TEST_F(DriverTest, ExrKeepsRenderingSpaceValues) {
    TestNode node(node_driver_exr());
    const auto driver = make(node, "a.exr");
    EXPECT_EQ(driver->path(), in_folder("a.exr"));
    render(*driver, header_of({layer("RGBA", "RGBA", 4), layer("Z", "FLOAT", 1)}),
           {{0.5F, -1, 30, 0.25F}, {7}});
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_TRUE(file.tiled);
    EXPECT_EQ(file.compression, ExrCompression::Zip);
    EXPECT_EQ(file.find("R")->pixels.back(), 0.5F);
    EXPECT_EQ(file.find("G")->pixels.back(), -1);
    EXPECT_EQ(file.find("B")->pixels.back(), 30);
    EXPECT_EQ(file.find("A")->pixels.back(), 0.25F);
    EXPECT_EQ(file.find("Z")->pixels.back(), 7);
}

TEST_F(DriverTest, ExrChannelNamesFollowArnold) {
    TestNode node(node_driver_exr());
    ImageLayer renamed = layer("RGBA", "RGBA", 4);
    renamed.name = "beauty";
    ImageLayer id = layer("ID", "UINT", 1);
    render(
        *make(node, "a.exr"),
        header_of({layer("RGBA", "RGBA", 4), layer("diffuse", "RGB", 3), layer("N", "VECTOR", 3),
                   layer("motionvector", "VECTOR2", 2), layer("Z", "FLOAT", 1), id}),
        {{0, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0}, {0}, {std::bit_cast<float>(3000000001U)}});
    EXPECT_EQ(channels("a.exr"),
              (Names{"A", "B", "G", "ID", "N.X", "N.Y", "N.Z", "R", "Z", "diffuse.B", "diffuse.G",
                     "diffuse.R", "motionvector.X", "motionvector.Y"}));
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_EQ(file.find("ID")->type, ExrPixelType::UInt);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(file.find("ID")->pixels[9]), 3000000001U);

    // A colour layer that is alone has bare channels, unless its name is to be kept; other types keep their name.
    render(*make(node, "a.exr"), header_of({renamed}), {{0, 0, 0, 0}});
    EXPECT_EQ(channels("a.exr"), (Names{"A", "B", "G", "R"}));
    render(*make(node, "a.exr"), header_of({layer("N", "VECTOR", 3)}), {{0, 0, 0}});
    EXPECT_EQ(channels("a.exr"), (Names{"N.X", "N.Y", "N.Z"}));
    node.set("preserve_layer_name", true);
    render(*make(node, "a.exr"), header_of({renamed}), {{0, 0, 0, 0}});
    EXPECT_EQ(channels("a.exr"), (Names{"beauty.A", "beauty.B", "beauty.G", "beauty.R"}));
    render(*make(node, "a.exr"), header_of({renamed, layer("Z", "FLOAT", 1)}),
           {{0, 0, 0, 0}, {0}});
    EXPECT_EQ(channels("a.exr"), (Names{"Z", "beauty.A", "beauty.B", "beauty.G", "beauty.R"}));
}

TEST_F(DriverTest, ExrHalfPrecisionScanlinesPartsAndCompression) {
    TestNode node(node_driver_exr());
    ImageLayer half = layer("diffuse", "RGB", 3);
    half.half = true;
    node.set("tiled", false).set("multipart", true).set_enum("compression", 4);
    render(*make(node, "a.exr"), header_of({layer("RGBA", "RGBA", 4), half}),
           {{1, 1, 1, 1}, {0.1F, 2, 3}});
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_FALSE(file.tiled);
    EXPECT_EQ(file.n_parts, 2);
    EXPECT_EQ(file.compression, ExrCompression::Piz);
    EXPECT_EQ(file.find("R")->type, ExrPixelType::Float);
    EXPECT_EQ(file.find("diffuse.R")->type, ExrPixelType::Half);
    node.set("half_precision", true);
    render(*make(node, "a.exr"), header_of({layer("RGBA", "RGBA", 4), layer("ID", "UINT", 1)}),
           {{1, 1, 1, 1}, {0}});
    EXPECT_EQ(read_exr(in_folder("a.exr")).find("R")->type, ExrPixelType::Half);
    EXPECT_EQ(read_exr(in_folder("a.exr")).find("ID")->type, ExrPixelType::UInt);
}

TEST_F(DriverTest, ExrHeaderTellsWhatLayersAre) {
    TestNode node(node_driver_exr());
    node.set_array<Name>("custom_attributes", {"STRING shot a b c", "INT take 3", "FLOAT gain 1.5",
                                               "VECTOR2 size 2 3", "nonsense", "INT take x"});
    ImageLayer key = layer("diffuse_key", "RGB", 3);
    key.aov = "diffuse";
    key.expression = "C<RD>.*<L.'key'>";
    key.light_group = "key";
    ImageHeader header = header_of({layer("RGBA", "RGBA", 4), key});
    header.metadata = {{"lightsieve/samples", 16},
                       {"lightsieve/partitions", std::string("RGBA = a + b")}};
    header.pixel_aspect_ratio = 2;
    render(*make(node, "a.exr"), header, {{0, 0, 0, 0}, {0, 0, 0}});
    const ExrInfo info = exr_info(in_folder("a.exr"));
    EXPECT_EQ(info.file.pixel_aspect_ratio, 2);
    ASSERT_EQ(info.layers.size(), 2U);
    EXPECT_EQ(info.layers[0].name, "RGBA");
    EXPECT_EQ(info.layers[1].source, "diffuse");
    EXPECT_EQ(info.layers[1].expression, "C<RD>.*<L.'key'>");
    EXPECT_EQ(info.layers[1].light_group, "key");
    EXPECT_EQ(info.layers[1].filter, "gaussian_filter");
    EXPECT_EQ(info.layers[1].filter_width, 2);
    const auto& attributes = info.file.attributes;
    EXPECT_EQ(attributes.at("arnold/aovs/diffuse_key/lpe"), ExrAttribute(1));
    EXPECT_FALSE(attributes.contains("arnold/aovs/RGBA/lpe"));
    EXPECT_EQ(attributes.at("lightsieve/samples"), ExrAttribute(16));
    EXPECT_EQ(attributes.at("lightsieve/partitions"), ExrAttribute(std::string("RGBA = a + b")));
    EXPECT_EQ(attributes.at("shot"), ExrAttribute(std::string("a b c")));
    EXPECT_EQ(attributes.at("take"), ExrAttribute(3));
    EXPECT_EQ(attributes.at("gain"), ExrAttribute(1.5F));
    EXPECT_EQ(attributes.at("size"), ExrAttribute(std::vector<float>{2, 3}));
    EXPECT_EQ(context_.count(Code::InvalidValue), 2U);
}

TEST_F(DriverTest, ExrConvertsColorsButNotDataIfAsked) {
    TestNode node(node_driver_exr());
    node.set("color_space", Name("lin_rec709"));
    ImageLayer normal = layer("P", "RGB", 3);
    normal.is_color = false;
    render(*make(node, "a.exr"), header_of({layer("RGBA", "RGBA", 4), normal}),
           {{0, 1, 0, 0.5F}, {0, 1, 0}});
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_NEAR(file.find("R")->pixels[0], -0.6217921F, 1e-5F);
    EXPECT_NEAR(file.find("G")->pixels[0], 1.1408047F, 1e-5F);
    EXPECT_EQ(file.find("A")->pixels[0], 0.5F);
    EXPECT_EQ(file.find("P.R")->pixels[0], 0);
    EXPECT_EQ(file.find("P.G")->pixels[0], 1);
}

TEST_F(DriverTest, ExrRegionsBecomeDataWindows) {
    TestNode node(node_driver_exr());
    ImageHeader header = header_of({layer("RGBA", "RGBA", 4)});
    header.data_x = 5;
    header.data_y = -3;  // overscan
    header.data_width = 20;
    header.data_height = 10;
    render(*make(node, "a.exr"), header, {{1, 2, 3, 1}});
    const ExrFile file = read_exr(in_folder("a.exr"));
    EXPECT_EQ(file.width, kWidth);
    EXPECT_EQ(file.data_x, 5);
    EXPECT_EQ(file.data_y, -3);
    EXPECT_EQ(file.find("G")->pixels, std::vector<float>(200, 2));
}

TEST_F(DriverTest, ChannelsOfOneNameAreRefused) {
    TestNode node(node_driver_exr());
    Diagnostics diagnostics;
    EXPECT_FALSE(
        make(node, "a.exr")
            ->open(header_of({layer("RGBA", "RGBA", 4), layer("RGB", "RGB", 3)}), diagnostics));
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::OutputLayers);
    EXPECT_TRUE(diagnostics.items()[0].where.known());
}

TEST_F(DriverTest, PicturesAreSrgbOfEightBitsAndRawIfAsked) {
    for (NodeType (*type)() : {&node_driver_png, &node_driver_tiff}) {
        const std::string file = type == &node_driver_png ? "a.png" : "a.tif";
        TestNode node(type());
        node.set("dither", false);
        // Green of the rendering space lies outside of sRGB: 0 255 0 after clipping.
        render(*make(node, file), header_of({layer("RGBA", "RGBA", 4)}), {{0, 1, 0, 1}});
        EXPECT_EQ(stored(file), Color(0, 1, 0));
        render(*make(node, file), header_of({layer("RGBA", "RGBA", 4)}), {{0.5F, 0.5F, 0.5F, 1}});
        EXPECT_NEAR(stored(file).g, 188 / 255.0F, 1e-6F);
        node.set("color_space", Name(""));
        render(*make(node, file), header_of({layer("RGBA", "RGBA", 4)}),
               {{0.5F, -3, std::nanf(""), 1}});
        EXPECT_NEAR(stored(file).r, 128 / 255.0F, 1e-6F);
        EXPECT_EQ(stored(file).g, 0);
        EXPECT_EQ(stored(file).b, 0);
        // Layers that are no colours are never converted.
        node.set("color_space", Name("sRGB"));
        ImageLayer normal = layer("N", "VECTOR", 3);
        normal.is_color = false;
        render(*make(node, file), header_of({normal}), {{0.5F, 0.25F, 1}});
        EXPECT_NEAR(stored(file).r, 128 / 255.0F, 1e-6F);
    }
}

TEST_F(DriverTest, OtherDepthsKeepTheRenderingSpace) {
    TestNode tiff(node_driver_tiff());
    tiff.set_enum("format", 3);
    render(*make(tiff, "a.tif"), header_of({layer("RGB", "RGB", 3)}), {{-1, 0.5F, 7}});
    EXPECT_EQ(stored("a.tif"), Color(-1, 0.5F, 7));
    TestNode png(node_driver_png());
    png.set_enum("format", 1);
    render(*make(png, "a.png"), header_of({layer("RGB", "RGB", 3)}), {{0, 0.5F, 7}});
    EXPECT_NEAR(stored("a.png").g, 32768 / 65535.0F, 1e-6F);
    EXPECT_EQ(stored("a.png").b, 1);
}

TEST_F(DriverTest, AlphaMayBeDividedOutOrLeftOut) {
    TestNode node(node_driver_png());
    node.set("dither", false).set("color_space", Name("")).set("skip_alpha", true);
    render(*make(node, "a.png"), header_of({layer("RGBA", "RGBA", 4)}), {{0.2F, 0.4F, 0, 0.5F}});
    EXPECT_NEAR(stored("a.png").g, 102 / 255.0F, 1e-6F);
    node.set("unpremult_alpha", true);
    render(*make(node, "a.png"), header_of({layer("RGBA", "RGBA", 4)}), {{0.2F, 0.4F, 0, 0.5F}});
    EXPECT_NEAR(stored("a.png").g, 204 / 255.0F, 1e-6F);
}

TEST_F(DriverTest, RegionsAreThePictureUnlessPadded) {
    TestNode node(node_driver_tiff());
    node.set("dither", false).set("color_space", Name(""));
    ImageHeader header = header_of({layer("RGB", "RGB", 3)});
    header.data_x = 5;
    header.data_y = 6;
    header.data_width = 20;
    header.data_height = 10;
    Diagnostics diagnostics;
    render(*make(node, "a.tif"), header, {{1, 1, 1}});
    EXPECT_EQ(read_color_image(in_folder("a.tif"), "", diagnostics).width, 20);
    node.set("output_padded", true);
    render(*make(node, "a.tif"), header, {{1, 1, 1}});
    const ColorImage padded = read_color_image(in_folder("a.tif"), "", diagnostics);
    EXPECT_EQ(padded.width, kWidth);
    EXPECT_EQ(padded.at(4, 6).r, 0);
    EXPECT_EQ(padded.at(5, 6).r, 1);
    EXPECT_EQ(padded.at(24, 15).r, 1);
    EXPECT_EQ(padded.at(24, 16).r, 0);
}

TEST_F(DriverTest, PicturesHoldOneLayerOfNumbersInZeroToOne) {
    for (NodeType (*type)() : {&node_driver_png, &node_driver_tiff}) {
        TestNode node(type());
        Diagnostics diagnostics;
        EXPECT_FALSE(make(node, "a.x")
                         ->open(header_of({layer("RGBA", "RGBA", 4), layer("diffuse", "RGB", 3)}),
                                diagnostics));
        EXPECT_FALSE(make(node, "a.x")->open(header_of({layer("ID", "UINT", 1)}), diagnostics));
        ASSERT_EQ(diagnostics.items().size(), 2U);
        for (const Error& e : diagnostics.items())
            EXPECT_EQ(e.code, Code::OutputLayers);
    }
}

TEST_F(DriverTest, PicturesThatDoNotFitIntoMemoryAreRefusedBeforeTheFirstRay) {
    TestNode node(node_driver_png());
    ImageHeader header = header_of({layer("RGBA", "RGBA", 4)});
    header.data_width = header.data_height = 2'000'000;
    Diagnostics diagnostics;
    EXPECT_FALSE(make(node, "large.png")->open(header, diagnostics));
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LimitMemory);
    EXPECT_EQ(n_files(), 0U);
}

TEST_F(DriverTest, UnwritableFoldersAreFoundBeforeTheFirstRay) {
    for (NodeType (*type)() : {&node_driver_exr, &node_driver_png, &node_driver_tiff}) {
        TestNode node(type());
        Diagnostics diagnostics;
        EXPECT_FALSE(
            make(node, "none/a.exr")->open(header_of({layer("RGBA", "RGBA", 4)}), diagnostics));
        ASSERT_EQ(diagnostics.items().size(), 1U);
        EXPECT_EQ(diagnostics.items()[0].code, Code::FileUnwritable);
        EXPECT_EQ(diagnostics.items()[0].where.text(), "filename");
    }
}

TEST_F(DriverTest, UnknownColorSpacesWarn) {
    for (NodeType (*type)() : {&node_driver_exr, &node_driver_png, &node_driver_tiff}) {
        TestNode node(type());
        node.set("color_space", Name("my space"));
        (void)make(node, "a.x");
    }
    EXPECT_EQ(context_.count(Code::UnknownColorSpace), 3U);
}

}  // namespace
}  // namespace lightsieve
