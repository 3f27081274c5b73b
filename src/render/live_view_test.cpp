// A live view and its viewer: rendering never waits, whatever the viewer does, and people are told.
#include "render/live_view.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.h"

namespace lightsieve {
namespace {

constexpr int kSide = 64, kBuckets = 1000;

/// Listens at a port of its own; reads when it is told to, and counts.
class Viewer {
  public:
    Viewer() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        ::sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        ::socklen_t size = sizeof(at);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<::sockaddr*>(&at), size), 0);
        EXPECT_EQ(::listen(socket_, 1), 0);
        ::getsockname(socket_, reinterpret_cast<::sockaddr*>(&at), &size);
        address = "127.0.0.1:" + std::to_string(ntohs(at.sin_port));
    }
    ~Viewer() {
        if (reader_.joinable()) reader_.join();
        ::close(socket_);
    }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;
    void read() {
        reader_ = std::thread([this] {
            const int connection = ::accept(socket_, nullptr, nullptr);
            std::vector<char> part(1U << 16U);
            for (ssize_t n = 0; (n = ::recv(connection, part.data(), part.size(), 0)) > 0;)
                n_bytes += static_cast<std::size_t>(n);
            ::close(connection);
        });
    }
    /// All that was sent has come.
    [[nodiscard]] std::size_t count() {
        reader_.join();
        return n_bytes;
    }
    std::string address;

  private:
    int socket_;
    std::thread reader_;
    std::size_t n_bytes = 0;
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
        LiveView view(viewer.address, "a.exr", {0, 0, kSide - 1, kSide - 1}, {beauty()},
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
        LiveView view(viewer.address, "a.exr", {0, 0, kSide - 1, kSide - 1}, {beauty()},
                      kRenderingSpace, diagnostics);
        show_all(view);
    }
    EXPECT_GT(viewer.count(), std::size_t{kBuckets} * kSide * kSide * 16);
    EXPECT_TRUE(diagnostics.items().empty()) << diagnostics.render();
}

}  // namespace
}  // namespace lightsieve
