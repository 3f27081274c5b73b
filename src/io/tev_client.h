// Sends pictures to the viewer tev (github.com/Tom94/tev) while they are made, by its network protocol.
//
// A packet is its length in bytes (uint32, itself included), a type (one byte), and the type's fields. Numbers are
// little-endian, texts end with a zero byte. Used here: CreateImage (4) and UpdateImage with offsets and strides (6).
// tev answers nothing. A viewer that goes away, or takes nothing for some seconds, is an error of `send` and no more.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lightsieve {

/// HOST:PORT in parts.
struct NetworkAddress {
    std::string host, port;
};
/// "localhost:14158", "[::1]:14158".
/// throws  InputError (invalid-value)
[[nodiscard]] NetworkAddress parse_network_address(const std::string& text);

/// A packet that makes an empty picture, or replaces the one of that name.
///
/// channels  full names; those with a common "layer." are one layer to tev
[[nodiscard]] std::vector<std::byte> tev_create_image(const std::string& name, int width,
                                                      int height,
                                                      std::span<const std::string> channels);
/// A packet that fills a rectangle, from the upper left corner of the picture.
///
/// values  width * height * channels.size(), row by row, the channels of a pixel side by side
[[nodiscard]] std::vector<std::byte> tev_update_image(const std::string& name, int x, int y,
                                                      int width, int height,
                                                      std::span<const std::string> channels,
                                                      std::span<const float> values);

class TevConnection {
  public:
    /// throws  InputError (viewer-lost): nobody listens there, or the name is not known
    explicit TevConnection(const NetworkAddress& address);
    ~TevConnection();
    TevConnection(const TevConnection&) = delete;
    TevConnection& operator=(const TevConnection&) = delete;

    /// Sends a packet; waits while the viewer reads slowly.
    ///
    /// patience_s  how long it may take nothing at all [s]; asked again and again
    /// throws  InputError (viewer-lost)
    void send(std::span<const std::byte> packet, const std::function<double()>& patience_s);

  private:
    int socket_ = -1;
    std::string name_;
};

}  // namespace lightsieve
