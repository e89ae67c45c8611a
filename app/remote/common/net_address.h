#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! An owned file descriptor, closed by the destructor; -1: none.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) {
      reset();
      number_ = std::exchange(other.number_, -1);
    }
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { reset(); }

  [[nodiscard]] int get() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }

  void reset() {
    if (number_ >= 0) {
      ::close(number_);
    }
    number_ = -1;
  }

 private:
  int number_ = -1;
};

//! A host's address (IPv4 or IPv6) and a port.
class NetAddress {
 public:
  //! Parses a numeric address ("127.0.0.1", "::1"). Names are not resolved, because that waits for
  //! other machines. Returns nothing for other text.
  static std::optional<NetAddress> parse(const std::string& host, int port);
  //! Parses HOST:PORT, with an IPv6 host in brackets.
  static std::optional<NetAddress> parse(const std::string& host_and_port);
  static NetAddress of(const sockaddr_storage& address, socklen_t size);

  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage_); }
  [[nodiscard]] socklen_t size() const { return size_; }
  [[nodiscard]] int family() const { return storage_.ss_family; }

  [[nodiscard]] std::string host() const;
  [[nodiscard]] int port() const;
  [[nodiscard]] NetAddress with_port(int port) const;

  //! Returns whether the host is in 127.0.0.0/8, ::1, or the former mapped to IPv6.
  [[nodiscard]] bool is_loopback() const;
  //! Returns whether the host is 0.0.0.0 or ::, which means all of the machine's addresses.
  [[nodiscard]] bool is_any() const;

  //! Returns HOST:PORT, with an IPv6 host in brackets.
  [[nodiscard]] std::string text() const;

  bool operator==(const NetAddress& other) const { return port() == other.port() && host() == other.host(); }

 private:
  sockaddr_storage storage_ = {};
  socklen_t size_ = 0;
};

//! Returns a non-blocking socket of a type (SOCK_DGRAM, SOCK_STREAM) bound to an address. `what`
//! and `option` are for messages ("OSC", "--osc"). Throws Error if the port is in use or the
//! machine does not have the address.
Descriptor bound_socket(int type, const NetAddress& address, const std::string& what, const std::string& option);

//! Returns the address of a bound socket, with its actual port after binding to port 0.
NetAddress local_address(int socket);

//! Returns the addresses at which other machines can reach this one, without IPv6 link-local ones.
//! Their ports are 0.
std::vector<NetAddress> outward_addresses();

}  // namespace ergodome
