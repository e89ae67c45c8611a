#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/playback/external_clock.h"
#include "app/playback/transport.h"
#include "app/remote/common/command_rules.h"
#include "app/remote/common/net_address.h"
#include "app/remote/common/rate_limit.h"
#include "app/remote/osc/osc_message.h"
#include "app/remote/osc/osc_subscribers.h"

namespace ergodome {

//! Receivers of OSC input other than commands; called on the remote control's thread.
struct OscListeners {
  //! Receives the time of a master clock; empty: clock messages are refused.
  std::function<void(const ClockFix&)> clock;
  std::function<void(const std::string&)> warning;  //!< receives a line for the log; may be empty
};

//! An instant by the steady clock and by the time of day.
struct OscInstant {
  std::chrono::steady_clock::time_point steady;
  OscTime of_day = osc_at_once;
};

//! A message to send.
struct OscDatagram {
  NetAddress to;
  std::vector<char> bytes;
};

//! Executes OSC messages (see reference/osc.md). Uses no socket and reads no clock: callers pass
//! packets and times.
//!
//! Limits the number of scheduled commands, of subscribers and of answers per second.
class OscHandler {
 public:
  static constexpr std::size_t max_waiting = 256;
  static constexpr double longest_wait_s = 60.0;
  static constexpr std::chrono::milliseconds feedback_interval{100};

  //! The addresses in `listed` receive feedback without subscribing.
  OscHandler(CommandQueue& commands, const StatusBoard& board, OscListeners listeners,
             std::vector<NetAddress> listed = {})
      : commands_(commands), board_(board), listeners_(std::move(listeners)), subscribers_(std::move(listed)) {}

  //! Executes a packet and returns the answers. If its sender is not trusted, they are together at
  //! most as long as the packet. Never throws because of a packet.
  std::vector<OscDatagram> receive(std::span<const std::byte> packet, const NetAddress& from, const OscInstant& now);

  //! Executes scheduled commands that are due and returns feedback that is due.
  std::vector<OscDatagram> tick(std::chrono::steady_clock::time_point now);

  //! Returns when `tick` has to be called next; empty if nothing is pending.
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
  std::vector<Waiting> waiting_;  // in order of the times at which they are due
  OscSubscribers subscribers_;
  std::chrono::steady_clock::time_point next_feedback_;
  RateLimit complaints_{10.0, 10.0};
  RateLimit warnings_{1.0, 10.0};  // a lower rate, so that other log lines stay visible
};

//! Returns the feedback that a subscriber receives ten times a second.
std::vector<OscOutput> osc_status(const PlayerStatus& status);

}  // namespace ergodome
