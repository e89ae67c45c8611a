#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "app/remote/web/http_stream.h"
#include "app/remote/web/web_guard.h"

struct pollfd;

namespace ergodome {

//! Connections whose first request has not arrived yet. They wait without a thread: only a request from this machine, or one
//! that carries the token, goes on to the threads that answer. So clients who send nothing, or have no token, cannot take
//! those threads from an operator. Used by one thread.
class WebLobby {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  static constexpr std::size_t most_waiting = 64;
  //! For a request from another machine; one from this machine may take as long as an idle connection.
  static constexpr std::chrono::milliseconds outside_time{1000};
  static constexpr std::chrono::milliseconds loopback_time{5000};
  //! Delay of the answer to a request without the token, which limits guesses.
  static constexpr std::chrono::milliseconds refusal_delay{200};

  explicit WebLobby(const WebGuard& guard) : guard_(guard) {}

  //! Takes a new connection. Where the lobby is full, the oldest connection of the host that has most here is closed.
  void enter(std::unique_ptr<HttpStream> stream, Instant now);

  //! Reads what has arrived. Returns the connections whose request may be answered; answers or closes the others in time.
  std::vector<std::unique_ptr<HttpStream>> admit(Instant now);

  //! Adds the sockets that admit() waits for.
  void add_sockets(std::vector<pollfd>& sockets) const;
  //! Returns when admit() is due at the latest, or `otherwise` if that is sooner.
  [[nodiscard]] Instant next_deadline(Instant otherwise) const;

 private:
  struct Waiting {
    std::unique_ptr<HttpStream> stream;
    std::string host;
    Instant until;
    bool refused = false;  //!< its answer is due at `until`
  };
  enum class Step { wait, admit, close };

  Step step(Waiting& waiting, Instant now) const;
  void make_room();

  const WebGuard& guard_;
  std::vector<Waiting> waiting_;  // oldest first
};

}  // namespace ergodome
