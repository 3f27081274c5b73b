// A port of this machine that a test listens at.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <utility>

namespace lightsieve::testing {

class ListeningSocket {
  public:
    ListeningSocket() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        ::sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        ::socklen_t size = sizeof(at);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<::sockaddr*>(&at), size), 0);
        EXPECT_EQ(::listen(socket_, 1), 0);
        ::getsockname(socket_, reinterpret_cast<::sockaddr*>(&at), &size);
        port_ = std::to_string(ntohs(at.sin_port));
    }
    ~ListeningSocket() { stop(); }
    ListeningSocket(const ListeningSocket&) = delete;
    ListeningSocket& operator=(const ListeningSocket&) = delete;

    [[nodiscard]] std::string host() const { return "127.0.0.1"; }
    /// One that nobody else listens at.
    [[nodiscard]] std::string port() const { return port_; }
    /// Waits for somebody to connect; the caller closes what it gets.
    [[nodiscard]] int accept() const { return ::accept(socket_, nullptr, nullptr); }
    /// Nobody can connect any more.
    void stop() {
        if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    }

  private:
    int socket_;
    std::string port_;
};

}  // namespace lightsieve::testing
