#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

//! Returns the time of a steady clock [s].
using ClusterClock = std::function<double()>;

//! Carries messages between the master and its nodes. None of the functions waits, and messages to
//! peers that are not reachable are dropped.
class MasterChannel {
 public:
  struct Received {
    std::string peer;  //!< identifies a node's connection
    std::vector<std::byte> bytes;
  };

  MasterChannel() = default;
  virtual ~MasterChannel() = default;
  MasterChannel(const MasterChannel&) = delete;
  MasterChannel& operator=(const MasterChannel&) = delete;

  virtual void send(const std::string& peer, std::span<const std::byte> bytes) = 0;
  [[nodiscard]] virtual std::optional<Received> receive() = 0;
};

//! Carries messages between a node and the master. Reconnects by itself.
class NodeChannel {
 public:
  NodeChannel() = default;
  virtual ~NodeChannel() = default;
  NodeChannel(const NodeChannel&) = delete;
  NodeChannel& operator=(const NodeChannel&) = delete;

  virtual void send(std::span<const std::byte> bytes) = 0;
  [[nodiscard]] virtual std::optional<std::vector<std::byte>> receive() = 0;
  //! Waits until a message arrives, at most this long [s].
  virtual void wait(double seconds) = 0;
};

//! A line for the log.
struct ClusterNews {
  bool warning = false;
  std::string text;
};

//! Interval between heartbeats, without which peers are considered silent [s].
inline constexpr double cluster_heartbeat_s = 0.05;

}  // namespace ergodome
