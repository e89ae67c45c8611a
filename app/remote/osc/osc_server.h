#pragma once

#include <thread>

#include "app/remote/common/stop_signal.h"
#include "app/remote/osc/osc_handler.h"

namespace ergodome {

//! OSC over UDP, on a separate thread.
//!
//! liblo reads and writes the messages. The socket is ours, because liblo 0.31 always listens on
//! all addresses of the machine.
class OscServer {
 public:
  //! `subscribers` receive feedback without subscribing. Throws Error if the address cannot be
  //! bound.
  OscServer(const NetAddress& address, CommandQueue& commands, const StatusBoard& board, OscListeners listeners,
            std::vector<NetAddress> subscribers = {});
  ~OscServer();
  OscServer(const OscServer&) = delete;
  OscServer& operator=(const OscServer&) = delete;

  [[nodiscard]] NetAddress address() const { return local_address(socket_.get()); }

 private:
  void serve();
  void receive_some();
  void send(const std::vector<OscDatagram>& datagrams);

  OscHandler handler_;
  Descriptor socket_;
  StopSignal stop_;
  std::thread thread_;
};

}  // namespace ergodome
