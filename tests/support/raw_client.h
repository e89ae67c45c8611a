#pragma once

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <string>

#include "app/remote/common/net_address.h"

namespace ergodome::test {

//! A TCP client that can send malformed requests.
class RawClient {
 public:
  explicit RawClient(const NetAddress& server) : socket_(::socket(server.family(), SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    is_connected_ = ::connect(socket_.get(), server.get(), server.size()) == 0;
  }

  [[nodiscard]] bool is_connected() const { return is_connected_; }

  void send(const std::string& bytes) { ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL); }

  //! Returns the data received until `text` has appeared, the server has closed the connection or
  //! the time has run out.
  std::string receive_until(const std::string& text, std::chrono::milliseconds maximum = std::chrono::seconds(10)) {
    const auto deadline = std::chrono::steady_clock::now() + maximum;
    std::string received;
    while ((text.empty() || received.find(text) == std::string::npos) && std::chrono::steady_clock::now() < deadline) {
      pollfd polled = {socket_.get(), POLLIN, 0};
      if (::poll(&polled, 1, 50) <= 0) {
        continue;
      }
      std::array<char, 4096> part = {};
      const ssize_t size = ::recv(socket_.get(), part.data(), part.size(), 0);
      if (size <= 0) {
        is_closed_ = true;
        break;
      }
      received.append(part.data(), static_cast<std::size_t>(size));
    }
    return received;
  }
  std::string receive_all() { return receive_until(""); }

  [[nodiscard]] bool is_closed() const { return is_closed_; }

 private:
  Descriptor socket_;
  bool is_connected_ = false;
  bool is_closed_ = false;
};

}  // namespace ergodome::test
