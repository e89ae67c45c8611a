#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <zmq.hpp>

#include "app/cluster/cluster_library.h"
#include "app/cluster/cluster_messages.h"

namespace ergodome {

namespace {

//! Sets what both kinds of sockets have in common. Messages wait in short queues only: older ones
//! are of no use.
void set_socket_limits(zmq::socket_t& socket) {
  constexpr int queue = 200;
  socket.set(zmq::sockopt::linger, 0);
  socket.set(zmq::sockopt::sndhwm, queue);
  socket.set(zmq::sockopt::rcvhwm, queue);
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(max_cluster_message));
  socket.set(zmq::sockopt::handshake_ivl, 2000);
  // Closes connections whose packets are not acknowledged [ms]. Heartbeats of ZeroMQ would do that
  // too, but end the program if they meet a connection that has just failed (libzmq issue 4364).
  socket.set(zmq::sockopt::tcp_maxrt, 1000);
}

std::vector<std::byte> bytes_of(const zmq::message_t& message) {
  const auto* const data = static_cast<const std::byte*>(message.data());
  return {data, data + message.size()};
}

std::string endpoint(const std::string& host, int port) { return "tcp://" + host + ":" + std::to_string(port); }

//! Answers ZeroMQ's questions whether a peer with a public key may connect (ZAP, RFC 27).
class PeerCheck {
 public:
  PeerCheck(zmq::context_t& context, const std::string& node_public) : socket_(context, zmq::socket_type::rep) {
    zmq_z85_decode(allowed_.data(), node_public.c_str());
    socket_.set(zmq::sockopt::linger, 0);
    socket_.bind("inproc://zeromq.zap.01");
  }

  //! Answers all questions that wait.
  void answer() {
    std::vector<zmq::message_t> request;
    while (true) {
      zmq::message_t part;
      if (!socket_.recv(part, zmq::recv_flags::dontwait)) {
        return;
      }
      const bool more = part.more();
      request.push_back(std::move(part));
      if (!more) {
        reply(request);
        request.clear();
      }
    }
  }

 private:
  void reply(const std::vector<zmq::message_t>& request) {
    // Version, request id, domain, address, identity, mechanism, credentials.
    constexpr std::size_t parts = 7;
    const bool known = request.size() == parts && request[5].to_string() == "CURVE" &&
                       request[6].size() == allowed_.size() &&
                       std::memcmp(request[6].data(), allowed_.data(), allowed_.size()) == 0;
    const std::string id = request.size() > 1 ? request[1].to_string() : std::string();
    for (const std::string& part : {std::string("1.0"), id, std::string(known ? "200" : "400"),
                                    std::string(known ? "" : "unknown key"), std::string()}) {
      socket_.send(zmq::buffer(part), zmq::send_flags::sndmore);
    }
    socket_.send(zmq::message_t(), zmq::send_flags::none);
  }

  zmq::socket_t socket_;
  std::array<std::uint8_t, 32> allowed_{};
};

class ZeroMqMaster : public MasterChannel {
 public:
  ZeroMqMaster(const std::string& address, int port, const ClusterKeys& keys)
      : check_(context_, keys.node_public), socket_(context_, zmq::socket_type::router) {
    set_socket_limits(socket_);
    socket_.set(zmq::sockopt::curve_server, true);
    socket_.set(zmq::sockopt::curve_secretkey, keys.master_secret);
    socket_.set(zmq::sockopt::zap_domain, "ergodome");
    // A node that was started again takes the place of the one before.
    socket_.set(zmq::sockopt::router_handover, true);
    socket_.bind(endpoint(address, port));
  }

  void send(const std::string& peer, std::span<const std::byte> bytes) override {
    try {
      socket_.send(zmq::buffer(peer), zmq::send_flags::sndmore | zmq::send_flags::dontwait);
      socket_.send(zmq::buffer(bytes.data(), bytes.size()), zmq::send_flags::dontwait);
    } catch (const zmq::error_t&) {
      // The peer is gone; ClusterMaster notices its silence.
    }
  }

  std::optional<Received> receive() override {
    check_.answer();
    zmq::message_t peer;
    if (!socket_.recv(peer, zmq::recv_flags::dontwait)) {
      return std::nullopt;
    }
    Received received{peer.to_string(), {}};
    bool more = peer.more();
    for (zmq::message_t part; more && socket_.recv(part); more = part.more()) {
      // A message in several parts is malformed: what is left of it is an empty message.
      received.bytes = part.more() || !received.bytes.empty() ? std::vector<std::byte>() : bytes_of(part);
    }
    return received;
  }

 private:
  zmq::context_t context_;
  PeerCheck check_;
  zmq::socket_t socket_;
};

class ZeroMqNode : public NodeChannel {
 public:
  ZeroMqNode(const std::string& host, int port, const ClusterKeys& keys, const std::string& name)
      : socket_(context_, zmq::socket_type::dealer) {
    set_socket_limits(socket_);
    socket_.set(zmq::sockopt::routing_id, name);
    socket_.set(zmq::sockopt::curve_serverkey, keys.master_public);
    socket_.set(zmq::sockopt::curve_publickey, keys.node_public);
    socket_.set(zmq::sockopt::curve_secretkey, keys.node_secret);
    socket_.set(zmq::sockopt::reconnect_ivl, 20);
    socket_.set(zmq::sockopt::reconnect_ivl_max, 100);
    socket_.set(zmq::sockopt::connect_timeout, 1000);
    // Without a connection, messages are dropped instead of being sent later.
    socket_.set(zmq::sockopt::immediate, true);
    socket_.connect(endpoint(host, port));
  }

  void send(std::span<const std::byte> bytes) override {
    try {
      socket_.send(zmq::buffer(bytes.data(), bytes.size()), zmq::send_flags::dontwait);
    } catch (const zmq::error_t&) {
      // ClusterNode notices the silence.
    }
  }

  std::optional<std::vector<std::byte>> receive() override {
    zmq::message_t message;
    if (!socket_.recv(message, zmq::recv_flags::dontwait)) {
      return std::nullopt;
    }
    return bytes_of(message);
  }

  void wait(double seconds) override {
    zmq_pollitem_t item = {socket_.handle(), 0, ZMQ_POLLIN, 0};
    zmq_poll(&item, 1, static_cast<long>(1000.0 * seconds));
  }

 private:
  zmq::context_t context_;
  zmq::socket_t socket_;
};

//! Calls `make` and returns what it makes; on an exception of ZeroMQ returns null and sets
//! `problem`.
template <class Make>
auto made_or_problem(std::string& problem, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const zmq::error_t& error) {
    problem = error.what();
    return nullptr;
  }
}

class ZeroMqLibrary : public ClusterLibrary {
 public:
  std::unique_ptr<MasterChannel> listen(const std::string& address, int port, const ClusterKeys& keys,
                                        std::string& problem) const override {
    return made_or_problem(problem, [&]() -> std::unique_ptr<MasterChannel> {
      return std::make_unique<ZeroMqMaster>(address, port, keys);
    });
  }

  std::unique_ptr<NodeChannel> connect(const std::string& host, int port, const ClusterKeys& keys,
                                       const std::string& name, std::string& problem) const override {
    return made_or_problem(problem, [&]() -> std::unique_ptr<NodeChannel> {
      return std::make_unique<ZeroMqNode>(host, port, keys, name);
    });
  }

  bool make_keys(ClusterKeys& keys, std::string& problem) const override {
    constexpr std::size_t size = 41;
    const auto make_pair = [&problem](std::string& public_key, std::string& secret_key) {
      std::array<char, size> open{};
      std::array<char, size> secret{};
      if (zmq_curve_keypair(open.data(), secret.data()) != 0) {
        problem = zmq_strerror(errno);
        return false;
      }
      public_key = open.data();
      secret_key = secret.data();
      return true;
    };
    return make_pair(keys.master_public, keys.master_secret) && make_pair(keys.node_public, keys.node_secret);
  }
};

}  // namespace

}  // namespace ergodome

//! Returns the library of this module, or null if the program was built with another interface.
extern "C" const ergodome::ClusterLibrary* ergodome_zeromq(std::uint64_t interface) {
  static const ergodome::ZeroMqLibrary library;
  return interface == ergodome::cluster_interface ? &library : nullptr;
}
