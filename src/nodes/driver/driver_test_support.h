// For tests of drivers: layers, headers, and buckets of one value.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/color.h"
#include "io/exr_read.h"
#include "io/image_read.h"
#include "io/testing/test_folder.h"
#include "nodes/common/node_test_support.h"
#include "scene/driver.h"

namespace lightsieve {

inline constexpr int kWidth = 40, kHeight = 30, kBucket = 16;

inline ImageLayer layer(const std::string& name, const std::string& type, std::size_t n_channels) {
    ImageLayer out;
    out.name = out.aov = name;
    out.aov_type = type;
    out.n_channels = n_channels;
    out.filter = "gaussian_filter";
    out.filter_width = 2;
    return out;
}

inline ImageHeader header_of(std::vector<ImageLayer> layers) {
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

}  // namespace lightsieve
