#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/cluster/cluster_channel.h"
#include "app/cluster/cluster_keys.h"

namespace ergodome {

//! Connections between master and nodes by ZeroMQ, encrypted and authenticated by CurveZMQ. The
//! implementation is a shared library, which only a dome of several computers loads.
class ClusterLibrary {
 public:
  ClusterLibrary() = default;
  virtual ~ClusterLibrary() = default;
  ClusterLibrary(const ClusterLibrary&) = delete;
  ClusterLibrary& operator=(const ClusterLibrary&) = delete;

  //! Listens for nodes on an address or network interface of this computer. Only nodes that have
  //! the node's secret key are let in. Returns null and sets `problem` if that fails.
  virtual std::unique_ptr<MasterChannel> listen(const std::string& address, int port, const ClusterKeys& keys,
                                                std::string& problem) const = 0;

  //! Connects to the master, now or when it appears, as the peer `name`. Returns null and sets
  //! `problem` if the host's name is invalid.
  virtual std::unique_ptr<NodeChannel> connect(const std::string& host, int port, const ClusterKeys& keys,
                                               const std::string& name, std::string& problem) const = 0;

  //! Makes new keys. Returns false and sets `problem` if that fails.
  virtual bool make_keys(ClusterKeys& keys, std::string& problem) const = 0;
};

//! Version of the interface between program and module.
inline constexpr std::uint64_t cluster_interface = (std::uint64_t{1} << 32U) | std::uint64_t{sizeof(ClusterKeys)};

//! Returns the library; loads it at the first call. Throws Error if it cannot be loaded or belongs
//! to another build.
const ClusterLibrary& cluster_library();

}  // namespace ergodome
