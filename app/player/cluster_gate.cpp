#include "app/player/cluster_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>
#include <utility>

#include "app/cluster/cluster_library.h"
#include "app/player/cluster_frames.h"
#include "app/player/content_push.h"
#include "content/files/fingerprint.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

std::unique_ptr<MasterChannel> listen_for_nodes(const DomeSetup& setup) {
  const ClusterKeys keys = read_cluster_keys(cluster_key_file(setup, "--setup"));
  const ClusterSetup& cluster = *setup.cluster;
  std::string problem;
  auto channel = cluster_library().listen(cluster.address, cluster.port, keys, problem);
  // A master that has just crashed may still hold the port for a moment.
  constexpr int most_attempts = 20;
  for (int i = 0; i < most_attempts && !channel && problem.find("in use") != std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    channel = cluster_library().listen(cluster.address, cluster.port, keys, problem);
  }
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

ClusterHost open_cluster(const DomeSetup& setup) {
  ClusterHost host;
  host.channel = listen_for_nodes(setup);
  host.master = std::make_unique<ClusterMaster>(
      *host.channel,
      ClusterMaster::Settings{cluster_identity(setup), setup.cluster->sync, node_names(setup), random_session()},
      cluster_seconds);
  return host;
}

ClusterGate::ClusterGate(const DomeSetup& setup, int projectors_px, const std::string& frame_log)
    : host_(open_cluster(setup)), log_(frame_log), projectors_px_(projectors_px) {}

void ClusterGate::set_shows(const std::vector<Show>& shows) {
  host_.master->set_show(fingerprint_of_shows(shows), fingerprint_of_contents(shows));
  if (pushes_) {
    host_.master->set_offer(std::nullopt, {});
    const auto source = std::make_shared<const ContentSource>(shows);
    host_.master->set_offer(source->offer(), [source](const ClusterWanted& wanted) { return source->read(wanted); });
  }
}

void ClusterGate::set_attract(bool attract) {
  if (std::exchange(attract_, attract) != attract) {
    // The exposure of another show does not suit.
    stops_.reset();
  }
}

void ClusterGate::advance(double rate, double light) {
  rate_ = rate;
  host_.master->set_light(light);
  host_.master->poll();
}

void ClusterGate::publish(PictureRequest& request) {
  host_.master->set_texts(in_language(request.captions, request.frame.language));
  frame_ = cluster_frame(request, rate_);
  frame_.projectors_px = projectors_px_;
  frame_.attract = attract_;
  // The exposure of this picture is known only after it was rendered, so all computers show it with
  // that of the picture before.
  frame_.followed_stops = stops_;
  // The master renders what it has sent, rounded times included.
  apply(frame_, request);
  frame_.number = host_.master->publish(frame_);
}

bool ClusterGate::release(PictureAnswer& answer) {
  const double now_s = cluster_seconds();
  finished_s_ = finished_s_.value_or(now_s);
  if (!host_.master->release()) {
    return false;
  }
  const double waited_ms = 1e3 * (now_s - *std::exchange(finished_s_, std::nullopt));
  answer.time_ms = std::max(answer.time_ms, host_.master->slowest_ms());
  if (frame_.attract == attract_) {
    stops_ = answer.followed_stops;
  }
  if (frame_.followed_stops) {
    show_with_stops(*frame_.followed_stops, answer);
  }
  log_.add(frame_, answer.picture, "", waited_ms);
  return true;
}

void ClusterGate::fill(PlayerStatus& status) const {
  std::string others;
  std::size_t joined = 0;
  for (const NodeReport& node : host_.master->nodes()) {
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
