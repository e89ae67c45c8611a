#pragma once

#include <thread>

#include "app/remote/osc/osc_handler.h"
#include "app/remote/stop_signal.h"

namespace ergodome {

//! OSC over UDP, on a thread of its own.
//!
//! liblo reads and writes the messages; the socket is ours, because liblo 0.31 listens at every address of the machine, whatever it is told.
class OscServer {
 public:
  //! `subscribers` receive feedback without asking. Throws Error where the address cannot be had.
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
