#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cluster/cluster_channel.h"
#include "app/cluster/cluster_messages.h"

namespace ergodome {

//! A node of a dome of several computers: joins the master, receives frames to render, and knows
//! when each may be shown. Without sockets, threads and pictures.
//!
//! If the master is silent, a show runs on by the node's clock for a second in all. Then, and in
//! flights at once, the last picture stays. The node asks to join until the master is back.
class ClusterNode {
 public:
  struct Settings {
    std::string name;
    ClusterIdentity identity;
  };

  enum class State { connecting, refused, fetching, joined };

  //! The channel must outlive this.
  ClusterNode(NodeChannel& channel, Settings settings, ClusterClock clock);

  //! Handles messages, sends heartbeats, and asks to join if necessary. Call it often.
  void poll();

  //! A frame to render.
  struct Work {
    ClusterFrame frame;
    bool runs_on = false;  //!< true: only the time is new, because the master is silent
  };

  //! Returns the newest frame that was not returned before, or the next one while the show runs on
  //! without the master; nothing if there is none.
  [[nodiscard]] std::optional<Work> take_work();

  //! Returns the captions of a frame that are not part of the show.
  [[nodiscard]] std::vector<Caption> captions_of(const ClusterFrame& frame) const;
  //! Returns the state of the dome's calibration; nothing if there was none.
  [[nodiscard]] const std::optional<ClusterCalibration>& calibration() const { return calibration_; }

  //! Returns the offer of the master's files that came since the last call. Until set_show(), the node
  //! does not ask to join, unless it calls stop_fetching().
  [[nodiscard]] std::optional<ClusterOffer> take_offer() { return std::exchange(offer_, std::nullopt); }
  void ask_for(const ClusterWanted& wanted) { send(wanted); }
  //! Returns the bytes of files that came since the last call.
  [[nodiscard]] std::vector<ClusterChunk> take_chunks() { return std::exchange(chunks_, {}); }
  //! Asks to join again some seconds later. `why`: for the log.
  void stop_fetching(const std::string& why);

  //! Reports that a frame from the master was rendered.
  void report_ready(std::uint64_t number, double frame_ms);

  //! Returns whether a rendered frame may be shown: it was released, the master has gone on, or the
  //! master is silent.
  [[nodiscard]] bool may_show(std::uint64_t number) const;

  //! Continues with another version of the show or its files, and asks to join again.
  void set_show(const std::string& show, const std::string& content);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool master_silent() const;
  //! Returns the factor on the display's light; the last one if the master is silent.
  [[nodiscard]] double light() const { return light_; }
  [[nodiscard]] SwapSync sync() const { return sync_; }
  //! Returns whether the master wants the node to be in the swap group.
  [[nodiscard]] bool group_wanted() const { return group_wanted_; }
  void set_grouped(bool grouped) { grouped_ = grouped; }
  //! Returns whether the master has read its show again: the node must do the same, and call
  //! set_show().
  [[nodiscard]] bool show_wanted() const { return show_wanted_; }
  [[nodiscard]] long malformed() const { return malformed_; }
  //! Returns the lines for the log since the last call.
  [[nodiscard]] std::vector<ClusterNews> take_news();

 private:
  void take(const ClusterMessage& message, double now_s);
  void take_frame(const ClusterFrame& frame, double now_s);
  void ask_to_join(double now_s);
  void send(const ClusterMessage& message);

  NodeChannel& channel_;
  Settings settings_;
  ClusterClock clock_;
  State state_ = State::connecting;
  std::uint64_t session_ = 0;        //!< the master's run in which the node has joined; 0: none
  std::uint64_t heard_session_ = 0;  //!< of the last heartbeat
  SwapSync sync_ = SwapSync::barrier;
  std::optional<ClusterFrame> frame_;  //!< last frame from the master
  ClusterTexts texts_;
  std::optional<ClusterOffer> offer_;
  std::vector<ClusterChunk> chunks_;
  std::optional<ClusterCalibration> calibration_;
  double frame_s_ = 0.0;  //!< when it came
  bool taken_ = true;     //!< take_work() has returned it
  std::uint64_t released_ = 0;
  std::optional<std::uint32_t> epoch_;  //!< version of the show with which the node has joined
  bool show_wanted_ = false;
  double light_ = 1.0;
  bool group_wanted_ = false;
  bool grouped_ = false;
  double heard_s_ = -1e9;
  double asked_s_ = -1e9;
  double beat_s_ = -1e9;
  bool reported_silence_ = true;
  std::string refusal_;
  long malformed_ = 0;
  std::vector<ClusterNews> news_;
};

//! Silence of the master after which nodes run on by themselves [s], and after which they keep the
//! last picture.
inline constexpr double master_silent_s = 0.25;
inline constexpr double master_gone_s = 1.0;

}  // namespace ergodome
