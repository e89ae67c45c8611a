#include "app/cluster/cluster_master.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/cluster/cluster_codec.h"

namespace ergodome {

namespace {

//! Time without an answer after which a node is lost [s].
constexpr double lost_after_s = 2.0;

//! Weight of the last frame in a node's usual frame time.
constexpr double newest_weight = 0.2;

//! Maximum number of messages that one call of poll() handles, so that a peer that floods the port
//! does not stop the show.
constexpr int max_messages_at_once = 1000;

//! Maximum number of lines for the log that wait to be taken.
constexpr std::size_t max_news = 100;

}  // namespace

std::string cluster_difference(const ClusterIdentity& here, const ClusterIdentity& there) {
  if (here.version != there.version) {
    return fmt::format("version {} instead of {}; install the same version on both computers", there.version,
                       here.version);
  }
  if (here.setup != there.setup) {
    return "another dome setup; copy the setup file of the master";
  }
  if (here.show.empty()) {
    return {};
  }
  if (here.show != there.show) {
    return "another show; copy the show file of the master, and use the same --set options";
  }
  if (here.content != there.content) {
    return "other contents in files of the show; copy the sky, images and catalogs of the master";
  }
  return {};
}

const char* node_state_name(NodeState state) {
  constexpr const char* names[] = {"absent", "refused", "fetching", "joining", "joined", "behind", "lost"};
  return names[static_cast<int>(state)];
}

ClusterMaster::ClusterMaster(MasterChannel& channel, Settings settings, ClusterClock clock)
    : channel_(channel), settings_(std::move(settings)), clock_(std::move(clock)) {
  for (const std::string& name : settings_.nodes) {
    nodes_[name].report.name = name;
  }
}

void ClusterMaster::poll() {
  for (int i = 0; i < max_messages_at_once; ++i) {
    const auto received = channel_.receive();
    if (!received) {
      break;
    }
    take(*received);
  }
  const double now_s = clock_();
  for (auto& [name, node] : nodes_) {
    if (node.report.state == NodeState::lost) {
      probe(node);
    }
    if (!takes_part(node)) {
      continue;
    }
    if (now_s - node.heard_s > lost_after_s) {
      lose(node, true, "is silent");
    } else if (node.owes && node.report.state != NodeState::joining && now_s - node.asked_s > lost_after_s) {
      lose(node, false, "has rendered nothing for two seconds");
    }
  }
  form_group();
  if (now_s - beat_s_ >= cluster_heartbeat_s) {
    beat();
  }
}

void ClusterMaster::probe(Node& node) {
  constexpr double heard_lately_s = 0.5;
  constexpr double probe_again_s = 0.25;
  const double now_s = clock_();
  // The node answers a frame when it can render again. Frames that it was sent before may be lost.
  if (frame_ && now_s - node.heard_s < heard_lately_s && now_s - node.asked_s > probe_again_s) {
    node.asked_s = now_s;
    send(node.peer, *frame_);
  }
}

void ClusterMaster::beat() {
  beat_s_ = clock_();
  for (auto& [name, node] : nodes_) {
    if (!node.peer.empty()) {
      send(node.peer, ClusterHeartbeat{settings_.session, light_, group_});
    }
  }
}

void ClusterMaster::take(const MasterChannel::Received& received) {
  const std::optional<ClusterMessage> message = decode_cluster(received.bytes);
  if (!message) {
    ++malformed_;
    return;
  }
  if (const auto* const hello = std::get_if<ClusterHello>(&*message)) {
    greet(*hello, received.peer);
    return;
  }
  Node* const node = node_of(received.peer);
  if (node == nullptr) {
    // A node of an earlier run of the master: the session in this message makes it ask to join.
    send(received.peer, ClusterHeartbeat{settings_.session, light_, false});
    return;
  }
  node->heard_s = clock_();
  if (const auto* const wanted = std::get_if<ClusterWanted>(&*message)) {
    if (const auto chunk = read_content_ ? read_content_(*wanted) : std::nullopt) {
      send(received.peer, *chunk);
    }
  } else if (const auto* const ready = std::get_if<ClusterReady>(&*message)) {
    note_ready(*node, *ready);
  } else if (const auto* const heartbeat = std::get_if<ClusterHeartbeat>(&*message)) {
    node->grouped = heartbeat->grouped;
    // A node that was started again has not yet proved that it has the same show.
    if (node->report.state == NodeState::lost && node->silent && heartbeat->session == settings_.session) {
      rejoin(*node);
    }
  } else {
    ++malformed_;
  }
}

void ClusterMaster::greet(const ClusterHello& hello, const std::string& peer) {
  const auto found = nodes_.find(hello.node);
  if (found == nodes_.end()) {
    send(peer, ClusterRefused{fmt::format("the setup has no projector with node = \"{}\"; use the name in the setup, "
                                          "or give it with --name",
                                          hello.node)});
    return;
  }
  Node& node = found->second;
  const bool new_peer = node.peer != peer;
  const bool known = node.report.state == NodeState::lost || (!new_peer && takes_part(node));
  node.peer = peer;
  node.heard_s = clock_();
  if (const std::string difference = cluster_difference(settings_.identity, hello.identity); !difference.empty()) {
    const std::string before = std::exchange(node.report.problem, difference);
    if (before != difference) {
      news_.push_back({true, may_fetch(hello.identity)
                                 ? fmt::format("node {} gets the files of the show: it has {}", hello.node, difference)
                                 : fmt::format("node {} was refused: it has {}", hello.node, difference)});
    }
    node.report.state = NodeState::refused;
    node.awaited = false;
    if (may_fetch(hello.identity)) {
      node.report.state = NodeState::fetching;
      send(peer, *offer_);
      return;
    }
    send(peer, ClusterRefused{fmt::format("this node has {}", difference)});
    return;
  }
  node.report.problem.clear();
  if (known || node.report.lost > node.report.rejoined) {
    rejoin(node);
    return;
  }
  news_.push_back({false, fmt::format("node {} joins", hello.node)});
  welcome(node);
}

void ClusterMaster::welcome(Node& node) {
  node.report.state = NodeState::joining;
  node.awaited = false;
  node.frames = 0;
  node.ready = 0;
  node.owes = false;
  node.grouped = false;
  send(node.peer, ClusterWelcome{settings_.session, settings_.sync});
  if (texts_) {
    send(node.peer, *texts_);
  }
  if (calibration_) {
    send(node.peer, *calibration_);
  }
  if (frame_) {
    // The snapshot: the node shows the frame that the others already show.
    node.owes = true;
    node.asked_s = clock_();
    send(node.peer, *frame_);
    if (released_) {
      send(node.peer, ClusterSwap{number_});
    }
  }
}

void ClusterMaster::rejoin(Node& node) {
  if (node.report.lost > node.report.rejoined) {
    ++node.report.rejoined;
    news_.push_back({false, fmt::format("node {} is back", node.report.name)});
  }
  welcome(node);
}

bool ClusterMaster::may_fetch(const ClusterIdentity& identity) const {
  return offer_ && identity.version == settings_.identity.version && identity.setup == settings_.identity.setup;
}

void ClusterMaster::note_ready(Node& node, const ClusterReady& ready) {
  if (!takes_part(node) && node.report.state != NodeState::lost) {
    return;
  }
  double& usual_ms = node.report.frame_ms;
  usual_ms = usual_ms > 0.0 ? (1.0 - newest_weight) * usual_ms + newest_weight * ready.frame_ms : ready.frame_ms;
  node.ready = std::max(node.ready, std::min(ready.number, number_));
  ++node.frames;
  if (node.ready == number_) {
    node.owes = false;
  } else {
    node.asked_s = clock_();
  }
  if (node.report.state == NodeState::lost) {
    rejoin(node);
  } else if (node.report.state == NodeState::joining || (node.report.state == NodeState::behind && !node.owes)) {
    if (node.report.state == NodeState::joining) {
      news_.push_back({false, fmt::format("node {} has joined", node.report.name)});
    }
    node.report.state = NodeState::joined;
  }
}

void ClusterMaster::lose(Node& node, bool silent, const std::string& why) {
  node.report.state = NodeState::lost;
  node.silent = silent;
  node.awaited = false;
  node.grouped = false;
  ++node.report.lost;
  news_.push_back({true, fmt::format("node {} {}; the others go on without it", node.report.name, why)});
}

std::uint64_t ClusterMaster::publish(ClusterFrame frame) {
  frame.number = ++number_;
  frame.epoch = epoch_;
  frame.texts = texts_ ? texts_->version : 0;
  frame.calibration = calibration_ ? calibration_->version : 0;
  frame_ = std::move(frame);
  released_ = false;
  published_s_ = clock_();
  for (auto& [name, node] : nodes_) {
    node.awaited = node.report.state == NodeState::joined && settings_.sync != SwapSync::none;
    if (takes_part(node)) {
      if (!node.owes) {
        node.owes = true;
        node.asked_s = published_s_;
      }
      send(node.peer, *frame_);
    }
  }
  return number_;
}

double ClusterMaster::patience_s(const Node& node) const {
  // A frame takes up to twice as long as usual without a fault. The minimum covers the jitter of
  // networks and schedulers.
  constexpr double minimum_s = 0.1;
  return node.report.frame_ms > 0.0 ? std::clamp(2e-3 * node.report.frame_ms + 0.02, minimum_s, lost_after_s)
                                    : lost_after_s;
}

bool ClusterMaster::release() {
  poll();
  if (released_) {
    return true;
  }
  const double waited_s = clock_() - published_s_;
  for (auto& [name, node] : nodes_) {
    if (!node.awaited || node.ready >= number_) {
      continue;
    }
    if (waited_s < patience_s(node)) {
      return false;
    }
    node.awaited = false;
    node.report.state = NodeState::behind;
    ++node.report.late_frames;
  }
  slowest_ms_ = 0.0;
  released_ = true;
  for (auto& [name, node] : nodes_) {
    if (node.awaited) {
      slowest_ms_ = std::max(slowest_ms_, node.report.frame_ms);
    }
    if (takes_part(node)) {
      send(node.peer, ClusterSwap{number_});
    }
  }
  return true;
}

void ClusterMaster::set_light(double light) {
  if (std::exchange(light_, light) != light) {
    beat();
  }
}

void ClusterMaster::form_group() {
  // Drivers need some frames before swaps are regular, and until then a swap barrier may block.
  constexpr long first_frames = 60;
  if (settings_.sync != SwapSync::nv_swap_group || nodes_.empty()) {
    return;
  }
  const bool ready = std::ranges::all_of(nodes_, [](const auto& each) {
    return each.second.report.state == NodeState::joined && each.second.frames >= first_frames;
  });
  // A node that is late stays in the group: leaving and joining it would delay all.
  const bool complete = std::ranges::all_of(nodes_, [](const auto& each) {
    return each.second.report.state == NodeState::joined || each.second.report.state == NodeState::behind;
  });
  const bool wanted = ready || (group_ && complete);
  if (std::exchange(group_, wanted) != wanted) {
    beat();
  }
  const bool formed = group_ && std::ranges::all_of(nodes_, [](const auto& each) { return each.second.grouped; });
  if (std::exchange(group_formed_, formed) != formed) {
    news_.push_back(
        {!formed, formed ? "all nodes have joined the swap group" : "the swap group ends until all nodes are back"});
  }
}

void ClusterMaster::set_texts(std::vector<Caption> captions) {
  ClusterTexts texts{texts_ ? texts_->version : 0, std::move(captions)};
  if (texts_ ? encode_cluster(texts) == encode_cluster(*texts_) : texts.captions.empty()) {
    return;
  }
  ++texts.version;
  texts_ = std::move(texts);
  send_to_all(*texts_);
}

void ClusterMaster::set_calibration(ClusterCalibration calibration) {
  calibration.version = calibration_ ? calibration_->version + 1 : 1;
  calibration_ = std::move(calibration);
  send_to_all(*calibration_);
}

void ClusterMaster::set_offer(std::optional<ClusterOffer> offer, ReadContent read) {
  offer_ = std::move(offer);
  read_content_ = std::move(read);
}

void ClusterMaster::set_show(const std::string& show, const std::string& content) {
  if (show == settings_.identity.show && content == settings_.identity.content) {
    return;
  }
  settings_.identity.show = show;
  settings_.identity.content = content;
  ++epoch_;
}

std::vector<NodeReport> ClusterMaster::nodes() const {
  std::vector<NodeReport> all;
  all.reserve(settings_.nodes.size());
  for (const std::string& name : settings_.nodes) {
    all.push_back(nodes_.at(name).report);
  }
  return all;
}

std::vector<ClusterNews> ClusterMaster::take_news() {
  if (news_.size() > max_news) {
    news_.resize(max_news);
  }
  return std::exchange(news_, {});
}

void ClusterMaster::send(const std::string& peer, const ClusterMessage& message) {
  channel_.send(peer, encode_cluster(message));
}

void ClusterMaster::send_to_all(const ClusterMessage& message) {
  for (const auto& [name, node] : nodes_) {
    if (takes_part(node)) {
      send(node.peer, message);
    }
  }
}

ClusterMaster::Node* ClusterMaster::node_of(const std::string& peer) {
  for (auto& [name, node] : nodes_) {
    if (!node.peer.empty() && node.peer == peer && node.report.state != NodeState::refused) {
      return &node;
    }
  }
  return nullptr;
}

bool ClusterMaster::takes_part(const Node& node) {
  return node.report.state == NodeState::joining || node.report.state == NodeState::joined ||
         node.report.state == NodeState::behind;
}

}  // namespace ergodome
