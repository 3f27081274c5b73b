#include "io/tev_client.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

#include "core/bytes.h"
#include "core/error.h"

namespace lightsieve {

namespace {

static_assert(std::endian::native == std::endian::little, "packets are made as memory holds them");

constexpr char kCreateImage = 4, kUpdateImage = 6;
/// For a host that does not answer at all [ms].
constexpr int kConnectTimeout = 2000;
/// Between two looks at whether there is still time [ms].
constexpr int kWait = 100;

/// A packet's fields, one after the other.
class Packet {
  public:
    explicit Packet(char type) {
        out_.put(std::uint32_t{0});  // the length, known at the end
        out_.put(type);
    }
    template <class T>
    Packet& add(T value) {
        out_.put(value);
        return *this;
    }
    Packet& add(const std::string& text) {
        for (const char c : text)
            out_.put(c);
        out_.put('\0');
        return *this;
    }
    [[nodiscard]] std::vector<std::byte> take() {
        std::vector<std::byte> bytes = out_.take();
        const auto size = static_cast<std::uint32_t>(bytes.size());
        std::memcpy(bytes.data(), &size, sizeof(size));
        return bytes;
    }

  private:
    ByteWriter out_;
};

[[noreturn]] void lose(const std::string& name, const std::string& why, const char* hint) {
    throw InputError({Code::ViewerLost, "the viewer at " + name + " " + why, {}, hint});
}

struct AddressDelete {
    void operator()(::addrinfo* list) const { ::freeaddrinfo(list); }
};

/// A connected socket, or -1 with errno set.
int connect_to(const ::addrinfo& address) {
    const int s = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (s < 0) return -1;
    int error = 0;
    if (::connect(s, address.ai_addr, address.ai_addrlen) != 0) {
        error = errno;
        if (error == EINPROGRESS) {
            ::pollfd wait{s, POLLOUT, 0};
            ::socklen_t size = sizeof(error);
            if (::poll(&wait, 1, kConnectTimeout) != 1)
                error = ETIMEDOUT;
            else if (::getsockopt(s, SOL_SOCKET, SO_ERROR, &error, &size) != 0)
                error = errno;
        }
    }
    if (error == 0) return s;
    ::close(s);
    errno = error;
    return -1;
}

}  // namespace

NetworkAddress parse_network_address(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    NetworkAddress out;
    if (colon != std::string::npos) out = {text.substr(0, colon), text.substr(colon + 1)};
    if (out.host.size() > 2 && out.host.front() == '[' && out.host.back() == ']')
        out.host = out.host.substr(1, out.host.size() - 2);
    const bool is_number = !out.port.empty() && out.port.size() <= 5 &&
                           out.port.find_first_not_of("0123456789") == std::string::npos &&
                           std::stoi(out.port) > 0 && std::stoi(out.port) <= 65535;
    if (out.host.empty() || !is_number)
        throw InputError({Code::InvalidValue,
                          '"' + text + "\" is no address of a viewer",
                          {},
                          "write HOST:PORT; tev listens at port 14158: localhost:14158"});
    return out;
}

std::vector<std::byte> tev_create_image(const std::string& name, int width, int height,
                                        std::span<const std::string> channels) {
    Packet packet(kCreateImage);
    packet.add(char{1}).add(name).add(width).add(height).add(static_cast<int>(channels.size()));
    for (const std::string& channel : channels)
        packet.add(channel);
    return packet.take();
}

std::vector<std::byte> tev_update_image(const std::string& name, int x, int y, int width,
                                        int height, std::span<const std::string> channels,
                                        std::span<const float> values) {
    Packet packet(kUpdateImage);
    packet.add(char{0}).add(name).add(static_cast<int>(channels.size()));
    for (const std::string& channel : channels)
        packet.add(channel);
    packet.add(x).add(y).add(width).add(height);
    for (std::size_t c = 0; c < channels.size(); ++c)
        packet.add(static_cast<std::int64_t>(c));  // where a channel begins
    for (std::size_t c = 0; c < channels.size(); ++c)
        packet.add(static_cast<std::int64_t>(channels.size()));  // from a pixel to the next one
    std::vector<std::byte> bytes = packet.take();
    const std::size_t head = bytes.size();
    bytes.resize(head + values.size_bytes());
    std::memcpy(bytes.data() + head, values.data(), values.size_bytes());
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(bytes.data(), &size, sizeof(size));
    return bytes;
}

TevConnection::TevConnection(const NetworkAddress& address)
    : name_(address.host + ":" + address.port) {
    ::addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    ::addrinfo* found = nullptr;
    constexpr const char* kHint = "start tev, or check host and port";
    if (const int e = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
        e != 0)
        lose(name_, std::string("cannot be found: ") + ::gai_strerror(e), kHint);
    const std::unique_ptr<::addrinfo, AddressDelete> all(found);
    for (const ::addrinfo* a = found; a != nullptr && socket_ < 0; a = a->ai_next)
        socket_ = connect_to(*a);
    if (socket_ < 0) lose(name_, std::string("cannot be reached: ") + std::strerror(errno), kHint);
}

TevConnection::~TevConnection() {
    if (socket_ >= 0) ::close(socket_);
}

void TevConnection::send(std::span<const std::byte> packet,
                         const std::function<double()>& patience_s) {
    constexpr const char* kHint = "open the file when it is done";
    double waited_s = 0;
    while (!packet.empty()) {
        const ssize_t n = ::send(socket_, packet.data(), packet.size(), MSG_NOSIGNAL);
        if (n > 0) {
            packet = packet.subspan(static_cast<std::size_t>(n));
            waited_s = 0;
            continue;
        }
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK)
            lose(name_, std::string("went away: ") + std::strerror(errno), kHint);
        if (waited_s >= patience_s()) lose(name_, "does not take the picture any more", kHint);
        ::pollfd wait{socket_, POLLOUT, 0};
        ::poll(&wait, 1, kWait);
        waited_s += kWait / 1e3;
    }
}

}  // namespace lightsieve
