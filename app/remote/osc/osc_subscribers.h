#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "app/remote/net_address.h"

namespace ergodome {

//! Who receives feedback over OSC.
//!
//! UDP packets can carry a forged sender, so a single message must not start a stream to its supposed sender. Addresses on
//! this machine and those that the command line lists are trusted. Any other address first receives a number, and has to send
//! it back: only who receives packets there can do that. The numbers are computed from the address and a secret, so that
//! unanswered requests take no memory.
class OscSubscribers {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  static constexpr std::size_t most_subscribers = 16;
  static constexpr std::chrono::seconds subscription{30};
  static constexpr std::chrono::seconds nonce_lifetime{60};

  //! `listed` receive feedback as long as the player runs.
  explicit OscSubscribers(std::vector<NetAddress> listed = {});

  //! Whether answers may go to a host that are longer than its messages.
  [[nodiscard]] bool is_trusted(const NetAddress& host) const;

  //! Returns the number that an address has to send back within a minute: from 1 to 2^24 - 1, which a float holds exactly.
  [[nodiscard]] std::int32_t nonce(const NetAddress& to, Instant now) const;
  [[nodiscard]] bool is_nonce(double number, const NetAddress& to, Instant now) const;

  //! Adds an address or renews its time. Throws Error where there are too many.
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
