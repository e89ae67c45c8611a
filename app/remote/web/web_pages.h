#pragma once

#include <httplib.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "app/playback/transport.h"
#include "app/remote/common/log_ring.h"
#include "app/remote/common/rate_limit.h"
#include "app/remote/web/http_stream.h"
#include "app/remote/web/web_guard.h"

namespace ergodome {

//! Answers the requests of the status page (see reference/http.md). httplib parses and writes; the
//! caller supplies connections.
class WebPages : private httplib::Server {
 public:
  //! Maximum number of event streams to clients on this machine; the same maximum applies to all
  //! other clients together.
  static constexpr int max_event_streams = 12;
  static constexpr std::chrono::milliseconds event_interval{100};

  //! `guard` and `stop` must outlive this.
  WebPages(const WebGuard& guard, CommandQueue& commands, const StatusBoard& board, std::shared_ptr<const LogRing> log,
           const StopSignal& stop);

  //! Answers the requests of a connection until it ends or the stop signal is raised.
  void serve(HttpStream& stream);

 private:
  HandlerResponse let_in(const httplib::Request& request, httplib::Response& response);
  void add_files();
  void take_command(const httplib::Request& request, httplib::Response& response);
  void send_log(const httplib::Request& request, httplib::Response& response) const;
  void send_events(const httplib::Request& request, httplib::Response& response);

  const WebGuard& guard_;
  CommandQueue& commands_;
  const StatusBoard& board_;
  std::shared_ptr<const LogRing> log_;
  const StopSignal& stop_;
  std::atomic<int> local_streams_ = 0;
  std::atomic<int> outside_streams_ = 0;
  std::mutex rate_mutex_;
  RateLimit command_rate_{100.0, 200.0};
};

}  // namespace ergodome
