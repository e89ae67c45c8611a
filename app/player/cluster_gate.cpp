#include "app/player/cluster_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "app/cluster/cluster_library.h"
#include "app/player/cluster_frames.h"
#include "content/files/fingerprint.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

std::unique_ptr<MasterChannel> listen_for_nodes(const DomeSetup& setup) {
  const ClusterKeys keys = read_cluster_keys(cluster_key_file(setup, "--setup"));
  const ClusterSetup& cluster = *setup.cluster;
  std::string problem;
  auto channel = cluster_library().listen(cluster.address, cluster.port, keys, problem);
  if (!channel) {
    throw Error("--cluster", fmt::format("cannot listen on {}:{}: {}", cluster.address, cluster.port, problem),
                "correct address and port in [cluster] of the setup, or end the program that uses the port");
  }
  return channel;
}

std::uint64_t random_session() {
  std::random_device random;
  return (static_cast<std::uint64_t>(random()) << 32U | random()) | 1U;
}

}  // namespace

ClusterIdentity cluster_identity(const DomeSetup& setup) {
  return {ERGODOME_VERSION, {}, {}, fingerprint(to_toml(setup))};
}

std::filesystem::path cluster_key_file(const DomeSetup& setup, const std::string& name) {
  if (!setup.cluster) {
    throw Error(name, "the setup has no [cluster]", "write [cluster] with address and key into the setup");
  }
  return setup.folder / setup.cluster->key;
}

double cluster_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ClusterGate::ClusterGate(const DomeSetup& setup, int projectors_px, const std::string& frame_log)
    : channel_(listen_for_nodes(setup)), log_(frame_log), projectors_px_(projectors_px) {
  master_.emplace(
      *channel_,
      ClusterMaster::Settings{cluster_identity(setup), setup.cluster->sync, node_names(setup), random_session()},
      cluster_seconds);
}

void ClusterGate::set_show(const Show& show) { master_->set_show(show_fingerprint(show), content_fingerprint(show)); }

void ClusterGate::advance(double rate, double light) {
  rate_ = rate;
  master_->set_light(light);
  master_->poll();
}

void ClusterGate::publish(PictureRequest& request) {
  frame_ = cluster_frame(request, rate_);
  frame_.projectors_px = projectors_px_;
  // The master renders what it has sent, rounded times included.
  apply(frame_, request);
  frame_.number = master_->publish(frame_);
}

bool ClusterGate::release(PictureAnswer& answer) {
  if (!master_->release()) {
    return false;
  }
  answer.time_ms = std::max(answer.time_ms, master_->slowest_ms());
  log_.add(frame_, answer.picture);
  return true;
}

void ClusterGate::fill(PlayerStatus& status) const {
  std::string others;
  std::size_t joined = 0;
  for (const NodeReport& node : master_->nodes()) {
    status.nodes.push_back({node.name, node_state_name(node.state), node.frame_ms, node.late_frames, node.lost,
                            node.rejoined, node.problem});
    if (node.state == NodeState::joined) {
      ++joined;
    } else {
      others += fmt::format(", {} {}", node.name, node_state_name(node.state));
    }
  }
  status.display = fmt::format("{} of {} nodes joined{}", joined, status.nodes.size(), others);
}

}  // namespace ergodome
