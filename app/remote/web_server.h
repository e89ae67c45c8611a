#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "app/playback/transport.h"
#include "app/remote/log_ring.h"
#include "app/remote/net_address.h"
#include "app/remote/stop_signal.h"

namespace ergodome {

class WebPages;

//! The status page's server: a thread that accepts connections, and one for each of them, of which there are few.
class WebServer {
 public:
  static constexpr std::size_t most_connections = 32;
  static constexpr int most_connections_of_one = 12;  //!< host

  //! An empty token lets nobody in but from loopback. Throws Error where the address cannot be had.
  WebServer(const NetAddress& address, const std::string& token, CommandQueue& commands, const StatusBoard& board,
            std::shared_ptr<const LogRing> log);
  //! Ends open connections, whatever their clients do.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  [[nodiscard]] NetAddress address() const { return local_address(socket_.get()); }

 private:
  //! A connection's thread; its place is free again when it is done.
  struct Connection {
    std::thread thread;
    std::atomic<bool> done = true;
    std::string host;
  };

  void accept_all();
  void accept_one();
  void serve(Connection& connection, Descriptor socket, const NetAddress& peer);
  Connection* free_place(const std::string& host);

  StopSignal stop_;
  std::unique_ptr<WebPages> pages_;
  Descriptor socket_;
  std::array<Connection, most_connections> connections_;
  std::thread thread_;
};

}  // namespace ergodome
