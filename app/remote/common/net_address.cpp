#include "app/remote/common/net_address.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

const sockaddr_in& ipv4(const sockaddr* address) { return *reinterpret_cast<const sockaddr_in*>(address); }
const sockaddr_in6& ipv6(const sockaddr* address) { return *reinterpret_cast<const sockaddr_in6*>(address); }

std::string advice(int problem, const std::string& option) {
  switch (problem) {
    case EADDRINUSE:
      return "choose another port with " + option + ", or stop the program that uses this one";
    case EADDRNOTAVAIL:
      return "give " + option + "-bind an address of this machine, or 0.0.0.0 for all of them";
    case EACCES:
      return "choose a port above 1023 with " + option;
    default:
      return "choose another port or address with " + option + " and " + option + "-bind";
  }
}

}  // namespace

std::optional<NetAddress> NetAddress::parse(const std::string& host, int port) {
  if (port < 0 || port > 65'535) {
    return std::nullopt;
  }
  addrinfo wanted = {};
  wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0 || found == nullptr) {
    return std::nullopt;
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  NetAddress address;
  std::memcpy(&address.storage_, found->ai_addr, found->ai_addrlen);
  address.size_ = found->ai_addrlen;
  return address;
}

std::optional<NetAddress> NetAddress::parse(const std::string& host_and_port) {
  const std::size_t colon = host_and_port.rfind(':');
  std::string host = host_and_port.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string::npos) {
    return std::nullopt;
  }
  const std::string digits = colon == std::string::npos ? "" : host_and_port.substr(colon + 1);
  int port = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  const bool whole = problem == std::errc() && end == digits.data() + digits.size();
  return whole ? parse(host, port) : std::nullopt;
}

NetAddress NetAddress::of(const sockaddr_storage& address, socklen_t size) {
  NetAddress result;
  result.storage_ = address;
  result.size_ = size;
  return result;
}

std::string NetAddress::host() const {
  std::array<char, NI_MAXHOST> text = {};
  if (::getnameinfo(get(), size_, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0) {
    return "?";
  }
  return text.data();
}

int NetAddress::port() const {
  return family() == AF_INET6 ? ntohs(ipv6(get()).sin6_port) : family() == AF_INET ? ntohs(ipv4(get()).sin_port) : 0;
}

NetAddress NetAddress::with_port(int port) const {
  NetAddress result = *this;
  const auto number = htons(static_cast<std::uint16_t>(port));
  if (family() == AF_INET6) {
    reinterpret_cast<sockaddr_in6*>(&result.storage_)->sin6_port = number;
  } else {
    reinterpret_cast<sockaddr_in*>(&result.storage_)->sin_port = number;
  }
  return result;
}

bool NetAddress::is_loopback() const {
  if (family() == AF_INET) {
    return (ntohl(ipv4(get()).sin_addr.s_addr) >> 24U) == 127;
  }
  if (family() != AF_INET6) {
    return false;
  }
  const in6_addr& address = ipv6(get()).sin6_addr;
  return IN6_IS_ADDR_LOOPBACK(&address) || (IN6_IS_ADDR_V4MAPPED(&address) && address.s6_addr[12] == 127);
}

bool NetAddress::is_any() const {
  if (family() == AF_INET) {
    return ipv4(get()).sin_addr.s_addr == htonl(INADDR_ANY);
  }
  return family() == AF_INET6 && IN6_IS_ADDR_UNSPECIFIED(&ipv6(get()).sin6_addr);
}

std::string NetAddress::text() const {
  return family() == AF_INET6 ? fmt::format("[{}]:{}", host(), port()) : fmt::format("{}:{}", host(), port());
}

Descriptor bound_socket(int type, const NetAddress& address, const std::string& what, const std::string& option) {
  Descriptor socket(::socket(address.family(), type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.is_open() && type == SOCK_STREAM) {
    // Allows reuse of a TCP port whose connections have just ended. With UDP, two programs could
    // share the port.
    const int on = 1;
    ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  }
  if (!socket.is_open() || ::bind(socket.get(), address.get(), address.size()) != 0) {
    const int problem = errno;
    throw Error(what, fmt::format("cannot listen on {}: {}", address.text(), std::strerror(problem)),
                advice(problem, option));
  }
  return socket;
}

NetAddress local_address(int socket) {
  sockaddr_storage storage = {};
  socklen_t size = sizeof storage;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&storage), &size);
  return NetAddress::of(storage, size);
}

std::vector<NetAddress> outward_addresses() {
  std::vector<NetAddress> result;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) {
    return result;
  }
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> owner(first, &::freeifaddrs);
  for (const ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || (each->ifa_flags & IFF_UP) == 0) {
      continue;
    }
    const int family = each->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) {
      continue;
    }
    sockaddr_storage storage = {};
    const socklen_t size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    std::memcpy(&storage, each->ifa_addr, size);
    const NetAddress address = NetAddress::of(storage, size);
    const bool link_local = family == AF_INET6 && IN6_IS_ADDR_LINKLOCAL(&ipv6(address.get()).sin6_addr);
    if (!address.is_loopback() && !link_local) {
      result.push_back(address);
    }
  }
  return result;
}

}  // namespace ergodome
