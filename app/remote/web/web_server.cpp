#include "app/remote/web/web_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "app/remote/web/web_pages.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

using std::chrono::steady_clock;

//! Number of connections that the system queues: more than many clients open between two iterations
//! of the accepting thread.
constexpr int backlog = 512;
//! Number of connections to accept before waiting ones are handled.
constexpr int accepted_at_once = 32;

}  // namespace

WebServer::WebServer(const NetAddress& address, const std::string& token, CommandQueue& commands,
                     const StatusBoard& board, std::shared_ptr<const LogRing> log)
    : guard_(token),
      pages_(std::make_unique<WebPages>(guard_, commands, board, std::move(log), stop_)),
      socket_(bound_socket(SOCK_STREAM, address, "status page", "--web")),
      lobby_(guard_) {
  // Two sockets may be bound to one port as long as neither listens.
  if (::listen(socket_.get(), backlog) != 0) {
    throw Error("status page", "cannot listen on " + address.text() + ": " + std::strerror(errno),
                "choose another port with --web, or stop the program that uses this one");
  }
  thread_ = std::thread([this] { accept_all(); });
}

WebServer::~WebServer() {
  stop_.raise();
  thread_.join();
  for (const std::span<Connection> connections : {std::span(local_connections_), std::span(outside_connections_)}) {
    for (Connection& connection : connections) {
      if (connection.thread.joinable()) {
        connection.thread.join();
      }
    }
  }
}

void WebServer::accept_all() {
  while (true) {
    std::vector<pollfd> sockets = {{socket_.get(), POLLIN, 0}};
    lobby_.add_sockets(sockets);
    const auto deadline = lobby_.next_deadline(steady_clock::now() + std::chrono::seconds(30));
    if (stop_.wait(std::move(sockets), deadline) == StopSignal::Wake::stopped) {
      return;
    }
    accept_some();
    for (std::unique_ptr<HttpStream>& stream : lobby_.admit(steady_clock::now())) {
      begin_to_serve(std::move(stream));
    }
  }
}

void WebServer::accept_some() {
  for (int i = 0; i < accepted_at_once; ++i) {
    sockaddr_storage from = {};
    socklen_t size = sizeof from;
    Descriptor socket(
        ::accept4(socket_.get(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!socket.is_open()) {
      if (errno != EAGAIN && errno != EWOULDBLOCK) {
        // Possibly out of descriptors; without a pause this thread would spin.
        static_cast<void>(stop_.sleep_until(steady_clock::now() + std::chrono::milliseconds(10)));
      }
      return;
    }
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    lobby_.enter(std::make_unique<HttpStream>(std::move(socket), NetAddress::of(from, size), stop_),
                 steady_clock::now());
  }
}

void WebServer::begin_to_serve(std::unique_ptr<HttpStream> stream) {
  Connection* const connection =
      free_connection(stream->peer().is_loopback() ? std::span(local_connections_) : std::span(outside_connections_));
  if (connection == nullptr) {
    stream->refuse(busy_answer());
    return;
  }
  connection->done = false;
  try {
    connection->thread = std::thread([this, connection, stream = std::move(stream)] {
      pages_->serve(*stream);
      stream->close();
      connection->done = true;
    });
  } catch (const std::system_error&) {
    // The system has no thread left; the client may retry.
    connection->done = true;
  }
}

WebServer::Connection* WebServer::free_connection(std::span<Connection> connections) {
  const auto free = std::ranges::find_if(connections, [](const Connection& each) { return each.done.load(); });
  if (free == connections.end()) {
    return nullptr;
  }
  if (free->thread.joinable()) {
    free->thread.join();
  }
  return &*free;
}

}  // namespace ergodome
