#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/playback/external_clock.h"
#include "app/playback/transport.h"
#include "app/remote/command_rules.h"
#include "app/remote/net_address.h"
#include "app/remote/osc/osc_message.h"
#include "app/remote/osc/osc_subscribers.h"
#include "app/remote/web/rate_limit.h"

namespace ergodome {

//! Who hears what OSC has beside commands; called on the remote control's thread.
struct OscListeners {
  std::function<void(const ClockFix&)> clock;       //!< a master clock's word; empty: it is refused
  std::function<void(const std::string&)> warning;  //!< a line for the log; may be empty
};

//! The same instant by the clock that never jumps and by the time of day.
struct OscInstant {
  std::chrono::steady_clock::time_point steady;
  OscTime of_day = osc_at_once;
};

//! Something to be sent.
struct OscDatagram {
  NetAddress to;
  std::vector<char> bytes;
};

//! What OSC messages do (OSC.md lists their addresses): without a socket or a clock of its own.
//!
//! Everything that it keeps is bounded: commands of bundles that wait for their time, subscribers, answers a second.
class OscHandler {
 public:
  static constexpr std::size_t most_waiting = 256;
  static constexpr double longest_wait_s = 60.0;
  static constexpr std::chrono::milliseconds feedback_interval{100};

  //! `listed` receive feedback without asking.
  OscHandler(CommandQueue& commands, const StatusBoard& board, OscListeners listeners,
             std::vector<NetAddress> listed = {})
      : commands_(commands), board_(board), listeners_(std::move(listeners)), subscribers_(std::move(listed)) {}

  //! Does what a packet says and returns the answers. To hosts that are not trusted, these are never longer than the packet.
  //! Never throws because of a packet.
  std::vector<OscDatagram> receive(std::span<const std::byte> packet, const NetAddress& from, const OscInstant& now);

  //! Does what has come due: commands of bundles, feedback for subscribers.
  std::vector<OscDatagram> tick(std::chrono::steady_clock::time_point now);

  //! When `tick` is to be called next; empty where nothing waits.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> next_tick() const;

 private:
  struct Waiting {
    std::chrono::steady_clock::time_point due;
    TransportCommand command;
  };
  struct Answer {
    NetAddress to;
    OscOutput message;
  };

  std::optional<Answer> heed(const OscMessage& message, const NetAddress& from, const OscInstant& now);
  void warn(const NetAddress& from, const std::string& problem, std::chrono::steady_clock::time_point now);
  void command(const OscMessage& message, const NetAddress& from, const OscInstant& now);
  void command(const CommandRule& rule, const OscMessage& message, const NetAddress& from, const OscInstant& now);
  void follow_clock(const OscMessage& message, const OscInstant& now);
  std::optional<Answer> subscribe(const OscMessage& message, const NetAddress& from, const OscInstant& now);
  void confirm(const OscMessage& message, const NetAddress& from, const OscInstant& now);
  void unsubscribe(const OscMessage& message, const NetAddress& from);

  CommandQueue& commands_;
  const StatusBoard& board_;
  OscListeners listeners_;
  std::vector<Waiting> waiting_;  // in order of time
  OscSubscribers subscribers_;
  std::chrono::steady_clock::time_point next_feedback_;
  RateLimit complaints_{10.0, 10.0};
  RateLimit warnings_{1.0, 10.0};  // fewer: the log's other lines are to stay in sight
};

//! What a subscriber is told, ten times a second.
std::vector<OscOutput> osc_status(const PlayerStatus& status);

}  // namespace ergodome
