#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/playback/transport.h"
#include "app/remote/common/log_ring.h"
#include "app/remote/osc/osc_handler.h"

namespace CLI {
class App;
}

namespace ergodome {

class OscServer;
class WebServer;

//! Options for controlling a running show from outside. Nothing listens unless a port is given.
struct RemoteOptions {
  std::optional<int> web_port;  //!< port of the status page; 0: any free port
  std::string web_bind = "127.0.0.1";
  std::string web_token;
  std::string web_token_file;
  //! File that keeps the token between runs, used if `web_token` and `web_token_file` are empty. If
  //! this is empty too, each run makes a new token.
  std::filesystem::path saved_token_file;
  std::optional<int> osc_port;
  std::string osc_bind = "127.0.0.1";
  std::vector<std::string> osc_subscribers;  //!< addresses that receive OSC feedback, HOST:PORT
};

//! Adds --web, --web-bind, --web-token, --web-token-file, --osc, --osc-bind and --osc-subscriber to
//! a command.
void add_remote_options(CLI::App& command, RemoteOptions& options);

//! The status page and the OSC server of a running show: they push commands into the queue and read
//! the status from the board. Both use separate threads and never block the player. The destructor
//! ends them promptly, whatever clients do.
class RemoteControl {
 public:
  //! Starts the services that the options request. `listeners` receive OSC input other than
  //! commands. Queue and board must outlive this. Throws Error if a port is in use, an address is
  //! not this machine's, or a token is invalid.
  RemoteControl(const RemoteOptions& options, CommandQueue& commands, const StatusBoard& board,
                std::shared_ptr<LogRing> log, OscListeners listeners);
  ~RemoteControl();
  RemoteControl(const RemoteControl&) = delete;
  RemoteControl& operator=(const RemoteControl&) = delete;

  //! Returns lines for the operator: the addresses of the page, with its token where other machines
  //! can reach it, and that of OSC. Print them once and never log them.
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
