#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "app/remote/web/http_stream.h"
#include "app/remote/web/web_guard.h"

struct pollfd;

namespace ergodome {

//! Connections whose first request has not arrived yet. They wait without a thread: only requests
//! from this machine, or with the token, are passed to the answering threads. So clients that send
//! nothing, or have no token, cannot occupy the threads that an operator needs. Not thread-safe.
class WebLobby {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  static constexpr std::size_t max_waiting = 64;
  //! Time limit for requests from other machines (`outside_time`), and for requests from this
  //! machine (`loopback_time`), which may take as long as an idle connection.
  static constexpr std::chrono::milliseconds outside_time{1000};
  static constexpr std::chrono::milliseconds loopback_time{5000};
  //! Delay of the answer to a request without the token, which limits guesses.
  static constexpr std::chrono::milliseconds refusal_delay{200};

  explicit WebLobby(const WebGuard& guard) : guard_(guard) {}

  //! Adds a connection. If the lobby is full, closes the oldest connection of the host with the
  //! most connections.
  void enter(std::unique_ptr<HttpStream> stream, Instant now);

  //! Reads what has arrived. Returns the connections whose request may be answered; answers or
  //! closes the others when due.
  std::vector<std::unique_ptr<HttpStream>> admit(Instant now);

  //! Adds the sockets whose input admit() reads, so that the caller can wait for them.
  void add_sockets(std::vector<pollfd>& sockets) const;
  //! Returns when admit() is due at the latest, or `otherwise` if that is sooner.
  [[nodiscard]] Instant next_deadline(Instant otherwise) const;

 private:
  struct Waiting {
    std::unique_ptr<HttpStream> stream;
    std::string host;
    Instant until;
    bool refused = false;  //!< the request is refused, and the answer is due at `until`
  };
  enum class Step { wait, admit, close };

  Step step(Waiting& waiting, Instant now) const;
  void make_room();

  const WebGuard& guard_;
  std::vector<Waiting> waiting_;  // oldest first
};

}  // namespace ergodome
