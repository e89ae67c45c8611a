#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/remote/descriptor.h"

namespace ergodome {

//! A host's address (IPv4 or IPv6) and a port.
class NetAddress {
 public:
  //! From digits alone ("127.0.0.1", "::1"): names are not looked up, because that waits for other machines. Empty where the
  //! text is none.
  static std::optional<NetAddress> parse(const std::string& host, int port);
  //! The same from HOST:PORT, an IPv6 host in brackets.
  static std::optional<NetAddress> parse(const std::string& host_and_port);
  static NetAddress of(const sockaddr_storage& address, socklen_t size);

  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage_); }
  [[nodiscard]] socklen_t size() const { return size_; }
  [[nodiscard]] int family() const { return storage_.ss_family; }

  [[nodiscard]] std::string host() const;
  [[nodiscard]] int port() const;
  [[nodiscard]] NetAddress with_port(int port) const;

  //! 127.0.0.0/8, ::1, or the former within IPv6.
  [[nodiscard]] bool is_loopback() const;
  //! 0.0.0.0 or ::, all of the machine's addresses.
  [[nodiscard]] bool is_any() const;

  //! HOST:PORT, an IPv6 host in brackets.
  [[nodiscard]] std::string text() const;

  bool operator==(const NetAddress& other) const { return port() == other.port() && host() == other.host(); }

 private:
  sockaddr_storage storage_ = {};
  socklen_t size_ = 0;
};

//! A socket of a type (SOCK_DGRAM, SOCK_STREAM) bound to an address; non-blocking. `what` and `option` are words for messages ("OSC",
//! "--osc"). Throws Error where the port is in use or the machine has no such address.
Descriptor bound_socket(int type, const NetAddress& address, const std::string& what, const std::string& option);

//! Where a bound socket is: its port is known after binding port 0.
NetAddress local_address(int socket);

//! The machine's addresses that others reach it at, without link-local ones.
std::vector<NetAddress> outward_addresses();

}  // namespace ergodome
