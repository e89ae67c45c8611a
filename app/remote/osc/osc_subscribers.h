#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "app/remote/common/net_address.h"

namespace ergodome {

//! The receivers of OSC feedback.
//!
//! UDP packets can have a forged sender, so a single message must not start a stream to its
//! supposed sender. Addresses on this machine and those listed on the command line are trusted. Any
//! other address first receives a nonce and has to send it back, which proves that it receives
//! packets. Nonces are computed from the address and a secret, so that unanswered requests need no
//! memory.
class OscSubscribers {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  static constexpr std::size_t max_subscribers = 16;
  static constexpr std::chrono::seconds subscription{30};
  static constexpr std::chrono::seconds nonce_lifetime{60};

  //! The addresses in `listed` receive feedback as long as the player runs.
  explicit OscSubscribers(std::vector<NetAddress> listed = {});

  //! Returns whether answers to a host may be longer than its messages.
  [[nodiscard]] bool is_trusted(const NetAddress& host) const;

  //! Returns the nonce that an address has to send back: from 1 to 2^24 - 1, exact as a float. It
  //! is valid for at least half a minute and at most a minute.
  [[nodiscard]] std::int32_t nonce(const NetAddress& to, Instant now) const;
  [[nodiscard]] bool is_nonce(double number, const NetAddress& to, Instant now) const;

  //! Adds an address or renews its subscription. Throws Error if there are too many.
  void add(const NetAddress& to, Instant now);
  void remove(const NetAddress& to);
  void remove_expired(Instant now);

  [[nodiscard]] std::vector<NetAddress> addresses() const;
  [[nodiscard]] bool empty() const { return listed_.empty() && subscribers_.empty(); }

 private:
  struct Subscriber {
    NetAddress to;
    Instant until;
  };

  [[nodiscard]] std::int32_t nonce_of(const NetAddress& to, std::int64_t period) const;

  std::vector<NetAddress> listed_;
  std::vector<Subscriber> subscribers_;
  std::string secret_;
};

}  // namespace ergodome
