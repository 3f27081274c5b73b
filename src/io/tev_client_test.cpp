// Packets for tev, byte by byte, and what becomes of a viewer that is not there, goes away or sleeps.
#include "io/tev_client.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "io/testing/listening_socket.h"

namespace lightsieve {
namespace {

std::string text(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Code code_of(const std::string& address) {
    try {
        (void)parse_network_address(address);
    } catch (const InputError& e) {
        return e.errors()[0].code;
    }
    ADD_FAILURE() << address;
    return Code::FileFormat;
}

/// Listens and never reads.
struct Listener : testing::ListeningSocket {
    NetworkAddress address{host(), port()};
};

TEST(Tev, Addresses) {
    EXPECT_EQ(parse_network_address("localhost:14158").host, "localhost");
    EXPECT_EQ(parse_network_address("[::1]:80").host, "::1");
    EXPECT_EQ(parse_network_address("[::1]:80").port, "80");
    for (const char* bad : {"", "localhost", ":1", "host:", "host:0", "host:65536", "host:-1",
                            "host:99999999999", "host:1x"})
        EXPECT_EQ(code_of(bad), Code::InvalidValue);
}

// github.com/Tom94/tev, Ipc.h: a length that counts itself, a type, fields.
TEST(Tev, APacketThatMakesAPicture) {
    using namespace std::string_literals;
    const std::vector<std::string> channels{"R", "coat.G"};
    EXPECT_EQ(text(tev_create_image("a.exr", 258, 3, channels)),
              "\x21\0\0\0\4\1a.exr\0\2\1\0\0\3\0\0\0\2\0\0\0R\0coat.G\0"s);
}

TEST(Tev, APacketThatFillsARectangle) {
    using namespace std::string_literals;
    const std::vector<std::string> channels{"R", "G"};
    const std::vector<float> values{1, 2, 3, 4};
    const std::string packet = text(tev_update_image("a", 5, 6, 2, 1, channels, values));
    const std::string head =
        "\x50\0\0\0\6\0a\0\2\0\0\0R\0G\0\5\0\0\0\6\0\0\0\2\0\0\0\1\0\0\0"s  //
        "\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\2\0\0\0\0\0\0\0\2\0\0\0\0\0\0\0"s;
    ASSERT_EQ(packet.size(), 0x50U);
    EXPECT_EQ(packet.substr(0, head.size()), head);
    std::vector<float> sent(4);
    std::memcpy(sent.data(), packet.data() + head.size(), 16);
    EXPECT_EQ(sent, values);
}

TEST(Tev, NobodyThere) {
    Listener listener;
    const NetworkAddress address = listener.address;
    listener.stop();
    try {
        const TevConnection connection(address);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_EQ(e.errors()[0].code, Code::ViewerLost);
        EXPECT_NE(e.errors()[0].message.find("cannot be reached"), std::string::npos);
    }
    EXPECT_THROW(TevConnection({"no such host", "1"}), InputError);
}

TEST(Tev, AViewerThatTakesNothingIsGivenUp) {
    const Listener listener;
    TevConnection connection(listener.address);
    // More than the system keeps for a reader that does not read.
    const std::vector<std::byte> packet(std::size_t{32} << 20U);
    int asked = 0;
    try {
        connection.send(packet, [&] { return ++asked > 2 ? 0.0 : 1.0; });
        FAIL();
    } catch (const InputError& e) {
        EXPECT_EQ(e.errors()[0].code, Code::ViewerLost);
        EXPECT_NE(e.errors()[0].message.find("any more"), std::string::npos);
    }
}

TEST(Tev, AViewerThatGoesAway) {
    Listener listener;
    TevConnection connection(listener.address);
    listener.stop();  // resets what was not accepted
    const std::vector<std::byte> packet(std::size_t{32} << 20U);
    EXPECT_THROW(connection.send(packet, [] { return 5.0; }), InputError);
}

}  // namespace
}  // namespace lightsieve
