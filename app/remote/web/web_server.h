#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <thread>

#include "app/playback/transport.h"
#include "app/remote/common/log_ring.h"
#include "app/remote/common/net_address.h"
#include "app/remote/common/stop_signal.h"
#include "app/remote/web/web_guard.h"
#include "app/remote/web/web_lobby.h"

namespace ergodome {

class WebPages;

//! The status page's server: one thread accepts connections and waits for their first requests, and
//! other threads answer.
//!
//! Half of the answering threads are for this machine, the other half for clients with the token,
//! so neither can block the other.
class WebServer {
 public:
  static constexpr std::size_t max_local_connections = 16;
  static constexpr std::size_t max_outside_connections = 16;

  //! With an empty token, only loopback is allowed. Throws Error if the address cannot be bound.
  WebServer(const NetAddress& address, const std::string& token, CommandQueue& commands, const StatusBoard& board,
            std::shared_ptr<const LogRing> log);
  //! Ends open connections, whatever their clients do.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  [[nodiscard]] NetAddress address() const { return local_address(socket_.get()); }

 private:
  //! A thread that answers one connection; it can be reused when done.
  struct Connection {
    std::thread thread;
    std::atomic<bool> done = true;
  };

  void accept_all();
  void accept_some();
  void begin_to_serve(std::unique_ptr<HttpStream> stream);
  static Connection* free_connection(std::span<Connection> connections);

  StopSignal stop_;
  WebGuard guard_;
  std::unique_ptr<WebPages> pages_;
  Descriptor socket_;
  WebLobby lobby_;
  std::array<Connection, max_local_connections> local_connections_;
  std::array<Connection, max_outside_connections> outside_connections_;
  std::thread thread_;
};

}  // namespace ergodome
