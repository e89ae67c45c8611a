#include "app/remote/web_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <system_error>

#include "app/remote/web_pages.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

using std::chrono::steady_clock;

constexpr int backlog = 16;

}  // namespace

WebServer::WebServer(const NetAddress& address, const std::string& token, CommandQueue& commands,
                     const StatusBoard& board, std::shared_ptr<const LogRing> log)
    : pages_(std::make_unique<WebPages>(WebGuard(token), commands, board, std::move(log), stop_)),
      socket_(bound_socket(SOCK_STREAM, address, "status page", "--web")) {
  // Two sockets may be bound to one port as long as neither listens.
  if (::listen(socket_.get(), backlog) != 0) {
    throw Error("status page", "cannot listen at " + address.text() + ": " + std::strerror(errno),
                "choose another port with --web, or end the program that has it");
  }
  thread_ = std::thread([this] { accept_all(); });
}

WebServer::~WebServer() {
  stop_.raise();
  thread_.join();
  for (Connection& connection : connections_) {
    if (connection.thread.joinable()) {
      connection.thread.join();
    }
  }
}

void WebServer::accept_all() {
  while (true) {
    switch (stop_.wait(socket_.get(), POLLIN, steady_clock::now() + std::chrono::seconds(30))) {
      case StopSignal::Wake::stopped:
        return;
      case StopSignal::Wake::ready:
        accept_one();
        break;
      case StopSignal::Wake::timeout:
        break;
    }
  }
}

void WebServer::accept_one() {
  sockaddr_storage from = {};
  socklen_t size = sizeof from;
  Descriptor socket(::accept4(socket_.get(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!socket.is_open()) {
    // Out of descriptors, perhaps: without a pause this thread would spin.
    static_cast<void>(stop_.sleep_until(steady_clock::now() + std::chrono::milliseconds(10)));
    return;
  }
  const int on = 1;
  ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  const NetAddress peer = NetAddress::of(from, size);
  Connection* const place = free_place(peer.host());
  if (place == nullptr) {
    return;
  }
  place->host = peer.host();
  place->done = false;
  try {
    place->thread = std::thread(&WebServer::serve, this, std::ref(*place), std::move(socket), peer);
  } catch (const std::system_error&) {
    // The system has no thread left: the client may try again.
    place->done = true;
  }
}

void WebServer::serve(Connection& connection, Descriptor socket, const NetAddress& peer) {
  {
    HttpStream stream(std::move(socket), peer, stop_);
    pages_->serve(stream);
  }
  connection.done = true;
}

WebServer::Connection* WebServer::free_place(const std::string& host) {
  Connection* place = nullptr;
  int of_this_host = 0;
  for (Connection& connection : connections_) {
    if (!connection.done) {
      of_this_host += connection.host == host ? 1 : 0;
      continue;
    }
    if (connection.thread.joinable()) {
      connection.thread.join();
    }
    place = &connection;
  }
  return of_this_host < most_connections_of_one ? place : nullptr;
}

}  // namespace ergodome
