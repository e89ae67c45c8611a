#include "app/remote/osc/osc_server.h"

#include <poll.h>

#include <array>

namespace ergodome {

namespace {

//! Packets to read before the clock is checked again, so that a flood cannot block feedback.
constexpr int packets_at_once = 64;

OscInstant now() { return {std::chrono::steady_clock::now(), osc_now()}; }

}  // namespace

OscServer::OscServer(const NetAddress& address, CommandQueue& commands, const StatusBoard& board,
                     OscListeners listeners, std::vector<NetAddress> subscribers)
    : handler_(commands, board, std::move(listeners), std::move(subscribers)),
      socket_(bound_socket(SOCK_DGRAM, address, "OSC", "--osc")) {
  thread_ = std::thread([this] { serve(); });
}

OscServer::~OscServer() {
  stop_.raise();
  thread_.join();
}

void OscServer::serve() {
  while (true) {
    const auto far_away = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    switch (stop_.wait(socket_.get(), POLLIN, handler_.next_tick().value_or(far_away))) {
      case StopSignal::Wake::stopped:
        return;
      case StopSignal::Wake::ready:
        receive_some();
        break;
      case StopSignal::Wake::timeout:
        break;
    }
    send(handler_.tick(std::chrono::steady_clock::now()));
  }
}

void OscServer::receive_some() {
  // One byte more than the limit, to detect longer packets.
  std::array<std::byte, largest_osc_packet + 1> packet;
  for (int i = 0; i < packets_at_once; ++i) {
    sockaddr_storage from = {};
    socklen_t from_size = sizeof from;
    const ssize_t size = ::recvfrom(socket_.get(), packet.data(), packet.size(), MSG_DONTWAIT,
                                    reinterpret_cast<sockaddr*>(&from), &from_size);
    if (size < 0) {
      // No more packets, or a subscriber's port is closed (reported here by ICMP).
      return;
    }
    send(handler_.receive({packet.data(), static_cast<std::size_t>(size)}, NetAddress::of(from, from_size), now()));
  }
}

void OscServer::send(const std::vector<OscDatagram>& datagrams) {
  for (const OscDatagram& datagram : datagrams) {
    // If the network is congested, the packet is lost; the next feedback repeats it.
    ::sendto(socket_.get(), datagram.bytes.data(), datagram.bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
             datagram.to.get(), datagram.to.size());
  }
}

}  // namespace ergodome
