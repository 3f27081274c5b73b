// A live view and its viewer: rendering never waits, whatever the viewer does, and people are told.
#include "render/live_view.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/testing/listening_socket.h"

namespace lightsieve {
namespace {

constexpr int kSide = 64, kBuckets = 1000;

/// Reads when it is told to, and counts.
class Viewer {
  public:
    ~Viewer() {
        if (reader_.joinable()) reader_.join();
    }
    void read() {
        reader_ = std::thread([this] {
            const int connection = socket_.accept();
            std::vector<char> part(1U << 16U);
            for (ssize_t n = 0; (n = ::recv(connection, part.data(), part.size(), 0)) > 0;)
                n_bytes_ += static_cast<std::size_t>(n);
            ::close(connection);
        });
    }
    /// All that was sent has come.
    [[nodiscard]] std::size_t count() {
        reader_.join();
        return n_bytes_;
    }
    [[nodiscard]] std::string address() const { return socket_.host() + ":" + socket_.port(); }

  private:
    testing::ListeningSocket socket_;
    std::thread reader_;
    std::size_t n_bytes_ = 0;
};

ImageLayer beauty() {
    ImageLayer layer;
    layer.name = "RGBA";
    layer.aov_type = "RGBA";
    layer.n_channels = 4;
    return layer;
}

/// Shows many buckets in one place.
void show_all(LiveView& view) {
    const std::vector<float> pixels(std::size_t{kSide} * kSide * 4, 0.5F);
    const std::vector<std::span<const float>> values{pixels};
    for (int i = 0; i < kBuckets; ++i)
        view.show(0, 0, kSide, kSide, values);
}

TEST(LiveView, ASlowViewerMissesPartsAndTheRenderDoesNotWait) {
    Viewer viewer;
    Diagnostics diagnostics;
    {
        LiveView view(viewer.address(), "a.exr", {0, 0, kSide - 1, kSide - 1}, {beauty()},
                      kRenderingSpace, diagnostics, std::size_t{1} << 20U);
        // Returns though nobody reads: more than the system and we keep for the viewer.
        show_all(view);
        viewer.read();
        view.finish();
    }
    EXPECT_LT(viewer.count(), std::size_t{kBuckets} * kSide * kSide * 16);
    ASSERT_EQ(diagnostics.n_warnings(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::ViewerLost);
    EXPECT_NE(diagnostics.items()[0].message.find("parts of the picture were not shown"),
              std::string::npos);
}

TEST(LiveView, AViewerThatReadsGetsAll) {
    Viewer viewer;
    viewer.read();
    Diagnostics diagnostics;
    {
        LiveView view(viewer.address(), "a.exr", {0, 0, kSide - 1, kSide - 1}, {beauty()},
                      kRenderingSpace, diagnostics);
        show_all(view);
    }
    EXPECT_GT(viewer.count(), std::size_t{kBuckets} * kSide * kSide * 16);
    EXPECT_TRUE(diagnostics.items().empty()) << diagnostics.render();
}

}  // namespace
}  // namespace lightsieve
