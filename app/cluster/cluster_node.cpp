#include "app/cluster/cluster_node.h"

#include <cmath>
#include <utility>

#include "app/cluster/cluster_codec.h"

namespace ergodome {

namespace {

//! Intervals between requests to join [s].
constexpr double ask_again_s = 0.25;
constexpr double ask_again_refused_s = 2.0;

//! Maximum number of messages that one call of poll() handles.
constexpr int max_node_messages_at_once = 1000;

}  // namespace

ClusterNode::ClusterNode(NodeChannel& channel, Settings settings, ClusterClock clock)
    : channel_(channel), settings_(std::move(settings)), clock_(std::move(clock)) {}

void ClusterNode::poll() {
  for (int i = 0; i < max_node_messages_at_once; ++i) {
    const auto bytes = channel_.receive();
    if (!bytes) {
      break;
    }
    if (const auto message = decode_cluster(*bytes)) {
      take(*message, clock_());
    } else {
      ++malformed_;
    }
  }
  const double now_s = clock_();
  if (!reported_silence_ && now_s - heard_s_ > master_gone_s) {
    reported_silence_ = true;
    news_.push_back({true, "the master is silent; the last picture stays until it is back"});
  }
  if (state_ != State::joined && state_ != State::fetching && !show_wanted_ &&
      now_s - asked_s_ >= (state_ == State::refused ? ask_again_refused_s : ask_again_s)) {
    ask_to_join(now_s);
  }
  if (now_s - beat_s_ >= cluster_heartbeat_s) {
    beat_s_ = now_s;
    send(ClusterHeartbeat{session_, light_, grouped_});
  }
}

void ClusterNode::ask_to_join(double now_s) {
  asked_s_ = now_s;
  send(ClusterHello{settings_.name, settings_.identity});
}

void ClusterNode::take(const ClusterMessage& message, double now_s) {
  heard_s_ = now_s;
  if (std::exchange(reported_silence_, false) && frame_) {
    news_.push_back({false, "the master is back"});
  }
  if (const auto* const frame = std::get_if<ClusterFrame>(&message)) {
    take_frame(*frame, now_s);
  } else if (const auto* const swap = std::get_if<ClusterSwap>(&message)) {
    released_ = swap->number;
  } else if (const auto* const heartbeat = std::get_if<ClusterHeartbeat>(&message)) {
    light_ = heartbeat->light;
    group_wanted_ = heartbeat->grouped;
    const std::uint64_t before = std::exchange(heard_session_, heartbeat->session);
    const bool another = before != 0 && before != heartbeat->session;
    if ((state_ == State::joined && heartbeat->session != session_) || (state_ == State::fetching && another)) {
      // The master was started again.
      state_ = State::connecting;
      ask_to_join(now_s);
    }
  } else if (const auto* const welcome = std::get_if<ClusterWelcome>(&message)) {
    if (state_ != State::joined || session_ != welcome->session) {
      news_.push_back({false, "joined the master"});
    }
    if (session_ != welcome->session) {
      // Numbers of frames start again.
      released_ = 0;
      taken_ = true;
    }
    state_ = State::joined;
    // An offer that answers an earlier request is out of date.
    offer_.reset();
    session_ = welcome->session;
    epoch_.reset();
    sync_ = welcome->sync;
    refusal_.clear();
  } else if (const auto* const texts = std::get_if<ClusterTexts>(&message)) {
    texts_ = *texts;
  } else if (const auto* const calibration = std::get_if<ClusterCalibration>(&message)) {
    calibration_ = *calibration;
  } else if (const auto* const offer = std::get_if<ClusterOffer>(&message)) {
    if (state_ != State::fetching) {
      state_ = State::fetching;
      offer_ = *offer;
    }
  } else if (const auto* const chunk = std::get_if<ClusterChunk>(&message)) {
    chunks_.push_back(*chunk);
  } else if (const auto* const refused = std::get_if<ClusterRefused>(&message)) {
    state_ = State::refused;
    if (std::exchange(refusal_, refused->reason) != refused->reason) {
      news_.push_back({true, "the master refuses this node: " + refused->reason});
    }
  } else {
    ++malformed_;
  }
}

void ClusterNode::take_frame(const ClusterFrame& frame, double now_s) {
  if (state_ != State::joined) {
    return;
  }
  if (epoch_.value_or(frame.epoch) != frame.epoch) {
    // This node has an older version of the show.
    show_wanted_ = true;
    state_ = State::connecting;
    return;
  }
  epoch_ = frame.epoch;
  frame_ = frame;
  frame_s_ = now_s;
  taken_ = false;
}

std::optional<ClusterNode::Work> ClusterNode::take_work() {
  if (!frame_) {
    return std::nullopt;
  }
  if (!taken_) {
    taken_ = true;
    return Work{*frame_, false};
  }
  const double silence_s = clock_() - heard_s_;
  if (silence_s <= master_silent_s || silence_s > master_gone_s || !frame_->on_path || frame_->rate == 0.0) {
    return std::nullopt;
  }
  Work work{*frame_, true};
  work.frame.time_ns += std::llround(1e9 * frame_->rate * (clock_() - frame_s_));
  return work;
}

std::vector<Caption> ClusterNode::captions_of(const ClusterFrame& frame) const {
  return frame.texts != 0 && frame.texts == texts_.version ? texts_.captions : std::vector<Caption>();
}

void ClusterNode::stop_fetching(const std::string& why) {
  state_ = State::refused;
  asked_s_ = clock_();
  chunks_.clear();
  if (std::exchange(refusal_, why) != why) {
    news_.push_back({true, why});
  }
}

void ClusterNode::report_ready(std::uint64_t number, double frame_ms) { send(ClusterReady{number, frame_ms}); }

bool ClusterNode::may_show(std::uint64_t number) const {
  return sync_ == SwapSync::none || released_ >= number || !frame_ || frame_->number > number || master_silent() ||
         state_ != State::joined;
}

bool ClusterNode::master_silent() const { return clock_() - heard_s_ > master_silent_s; }

void ClusterNode::set_show(const std::string& show, const std::string& content) {
  settings_.identity.show = show;
  settings_.identity.content = content;
  show_wanted_ = false;
  state_ = State::connecting;
  ask_to_join(clock_());
}

std::vector<ClusterNews> ClusterNode::take_news() { return std::exchange(news_, {}); }

void ClusterNode::send(const ClusterMessage& message) { channel_.send(encode_cluster(message)); }

}  // namespace ergodome
