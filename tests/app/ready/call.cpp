#include "tests/app/ready/call.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ergodome::test {

namespace {

constexpr std::uint32_t max_bytes = 4U << 20U;

struct Head {
  std::uint32_t words;
  std::uint32_t bytes;
};

//! An abstract socket address: it has no file, and is released when the server ends.
struct Address {
  sockaddr_un name{};
  socklen_t size = 0;
};

Address address_of(const std::string& name) {
  Address address;
  address.name.sun_family = AF_UNIX;
  const std::size_t count = name.copy(&address.name.sun_path[1], sizeof address.name.sun_path - 1);
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + count);
  return address;
}

bool send_all(int socket, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = ::send(socket, bytes, count, MSG_NOSIGNAL);
    if (sent <= 0) {
      return false;
    }
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(socket, bytes, count, 0);
    if (got <= 0) {
      return false;
    }
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

//! A socket message with the header of a call; its ancillary data passes three file descriptors.
struct HeadMessage {
  Head head{};
  iovec part = {&head, sizeof head};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int) * 3)] = {};
  msghdr message{};

  HeadMessage() {
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
  }
};

}  // namespace

int connect_to(const std::string& name) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const Address address = address_of(name);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address.name), address.size) != 0) {
    ::close(socket);
    return -1;
  }
  return socket;
}

int listen_as(const std::string& name) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const Address address = address_of(name);
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&address.name), address.size) != 0 ||
      ::listen(socket, SOMAXCONN) != 0) {
    ::close(socket);
    return -1;
  }
  return socket;
}

bool send_call(int socket, const Call& call) {
  std::string texts = call.folder + '\0';
  for (const std::vector<std::string>* list : {&call.words, &call.environment}) {
    for (const std::string& text : *list) {
      texts += text;
      texts += '\0';
    }
  }
  HeadMessage head;
  head.head = {static_cast<std::uint32_t>(call.words.size()), static_cast<std::uint32_t>(texts.size())};
  cmsghdr* const streams = CMSG_FIRSTHDR(&head.message);
  streams->cmsg_level = SOL_SOCKET;
  streams->cmsg_type = SCM_RIGHTS;
  streams->cmsg_len = CMSG_LEN(sizeof call.streams);
  std::memcpy(CMSG_DATA(streams), call.streams.data(), sizeof call.streams);
  return texts.size() <= max_bytes && ::sendmsg(socket, &head.message, MSG_NOSIGNAL) == sizeof(Head) &&
         send_all(socket, texts.data(), texts.size());
}

std::optional<Call> receive_call(int socket) {
  HeadMessage head;
  if (::recvmsg(socket, &head.message, MSG_WAITALL) != sizeof(Head) || head.head.bytes > max_bytes) {
    return std::nullopt;
  }
  const cmsghdr* const streams = CMSG_FIRSTHDR(&head.message);
  Call call;
  if (streams == nullptr || streams->cmsg_len != CMSG_LEN(sizeof call.streams)) {
    return std::nullopt;
  }
  std::memcpy(call.streams.data(), CMSG_DATA(streams), sizeof call.streams);
  std::string texts(head.head.bytes, '\0');
  if (!receive_all(socket, texts.data(), texts.size())) {
    return std::nullopt;
  }
  std::vector<std::string> all;
  for (std::size_t at = 0; at < texts.size(); at += all.back().size() + 1) {
    all.emplace_back(&texts[at]);
  }
  if (head.head.words == 0 || head.head.words >= all.size()) {
    return std::nullopt;
  }
  const auto words_end = all.begin() + 1 + static_cast<std::ptrdiff_t>(head.head.words);
  call.folder = all.front();
  call.words.assign(all.begin() + 1, words_end);
  call.environment.assign(words_end, all.end());
  return call;
}

bool send_status(int socket, int status) {
  return send_all(socket, reinterpret_cast<const char*>(&status), sizeof status);
}

std::optional<int> receive_status(int socket) {
  int status = 0;
  return receive_all(socket, reinterpret_cast<char*>(&status), sizeof status) ? std::optional(status) : std::nullopt;
}

}  // namespace ergodome::test
