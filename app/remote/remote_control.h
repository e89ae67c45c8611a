#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/playback/transport.h"
#include "app/remote/log_ring.h"
#include "app/remote/osc/osc_handler.h"

namespace CLI {
class App;
}

namespace ergodome {

class OscServer;
class WebServer;

//! How a running show may be controlled from outside; nothing listens unless a port is given.
struct RemoteOptions {
  std::optional<int> web_port;  //!< 0: any free one
  std::string web_bind = "127.0.0.1";
  std::string web_token;
  std::string web_token_file;
  //! Keeps the token from start to start where the other two are empty; empty: each start makes a new one.
  std::filesystem::path kept_token_file;
  std::optional<int> osc_port;
  std::string osc_bind = "127.0.0.1";
  std::vector<std::string> osc_subscribers;  //!< HOST:PORT
};

//! Adds --web, --web-bind, --web-token, --web-token-file, --osc, --osc-bind and --osc-subscriber to a command.
void add_remote_options(CLI::App& command, RemoteOptions& options);

//! The status page and the OSC server of a running show: commands go into the queue, the status is read from the board. Both have threads of
//! their own and never hold up the player; the destructor ends them within a moment, whatever clients do.
class RemoteControl {
 public:
  //! Starts what the options ask for. `listeners` hear what OSC has beside commands. Queue and board must outlive this. Throws
  //! Error if a port is in use, an address is not this machine's, or a token is not valid.
  RemoteControl(const RemoteOptions& options, CommandQueue& commands, const StatusBoard& board,
                std::shared_ptr<LogRing> log, OscListeners listeners);
  ~RemoteControl();
  RemoteControl(const RemoteControl&) = delete;
  RemoteControl& operator=(const RemoteControl&) = delete;

  //! Returns lines for the operator: the address of the page and, if other machines can reach it, its token. They are to be printed
  //! once and never logged.
  [[nodiscard]] std::vector<std::string> greeting() const;

  //! Returns a warning about unsafe options with its remedy; empty if there is none.
  [[nodiscard]] const std::string& warning() const { return warning_; }

  [[nodiscard]] std::optional<NetAddress> web_address() const;
  [[nodiscard]] std::optional<NetAddress> osc_address() const;

 private:
  std::string token_;
  std::string warning_;
  std::unique_ptr<WebServer> web_;
  std::unique_ptr<OscServer> osc_;
};

}  // namespace ergodome
