#include "app/remote/remote_control.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/cli/usage_error.h"
#include "app/remote/osc/osc_server.h"
#include "app/remote/web/web_server.h"
#include "app/remote/web/web_token.h"
#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

NetAddress address_of(const std::string& host, int port, const std::string& option) {
  const std::string digits = host == "localhost" ? "127.0.0.1" : host;
  const std::optional<NetAddress> address = NetAddress::parse(digits, port);
  if (!address) {
    throw UsageError(option, fmt::format("'{}' is not a numeric address", host),
                     "give one such as 127.0.0.1, 192.168.1.20 or ::1, or 0.0.0.0 for all addresses of this machine");
  }
  return *address;
}

//! Returns the addresses of --osc-subscriber, for a socket bound to `bound`. Throws UsageError if
//! they are malformed or unreachable.
std::vector<NetAddress> subscribers_of(const RemoteOptions& options, const NetAddress& bound) {
  std::vector<NetAddress> subscribers;
  for (const std::string& text : options.osc_subscribers) {
    const std::optional<NetAddress> address = NetAddress::parse(text);
    if (!address || address->port() == 0) {
      throw UsageError("--osc-subscriber", fmt::format("'{}' is not a numeric address with a port", text),
                       "give one such as 192.168.1.20:9001 or [fd00::7]:9001");
    }
    if (address->family() != bound.family() || (bound.is_loopback() && !address->is_loopback())) {
      throw UsageError("--osc-subscriber", fmt::format("packets from {} cannot reach {}", bound.host(), text),
                       "listen on 0.0.0.0, or on an address of this machine in the same network (--osc-bind)");
    }
    subscribers.push_back(*address);
  }
  return subscribers;
}

//! Returns the token saved by earlier runs, or a new one if it cannot be saved; `warning` gives the
//! reason. Never throws, because a show must start.
std::string saved_token(const std::filesystem::path& file, std::string& warning) {
  if (file.empty()) {
    return new_web_token();
  }
  try {
    make_folder(file.parent_path());
    std::string token = web_token_in(file);
    warning = web_token_exposure(file);
    return token;
  } catch (const std::exception& problem) {
    warning =
        fmt::format("the saved token cannot be used, so a new one is valid until the player ends: {}", problem.what());
    return new_web_token();
  }
}

//! Returns the token that other machines have to send: the one given by the options, otherwise a
//! saved one; empty if none is given and no other machine can reach the page.
std::string token_of(const RemoteOptions& options, const NetAddress& address, std::string& warning) {
  if (!options.web_token.empty()) {
    return checked_web_token(options.web_token, "--web-token");
  }
  if (!options.web_token_file.empty()) {
    std::string token = web_token_in(options.web_token_file);
    warning = web_token_exposure(options.web_token_file);
    return token;
  }
  return address.is_loopback() ? "" : saved_token(options.saved_token_file, warning);
}

//! Returns addresses that a user can type: all of the machine's if the server listens on any.
std::vector<NetAddress> reachable(const NetAddress& bound) {
  if (!bound.is_any()) {
    return {bound};
  }
  std::vector<NetAddress> result;
  for (const NetAddress& address : outward_addresses()) {
    if (address.family() == bound.family()) {
      result.push_back(address.with_port(bound.port()));
    }
  }
  return result;
}

}  // namespace

void add_remote_options(CLI::App& command, RemoteOptions& options) {
  const auto port = CLI::Range(0, 65'535);
  CLI::Option* const web =
      command
          .add_option("--web", options.web_port, "serve the status page for browsers on this port (0: any free port)")
          ->check(port);
  command
      .add_option("--web-bind", options.web_bind, "address to serve the page on; all except loopback require a token")
      ->needs(web)
      ->capture_default_str();
  command
      .add_option("--web-token", options.web_token,
                  "token that other machines must send (default: generated once, saved, printed at each start)")
      ->needs(web);
  command
      .add_option("--web-token-file", options.web_token_file,
                  "file with the token; created with a new token if missing")
      ->needs(web);
  CLI::Option* const osc =
      command.add_option("--osc", options.osc_port, "listen for OSC on this UDP port (0: any free port)")->check(port);
  command
      .add_option("--osc-bind", options.osc_bind,
                  "address to listen for OSC on; anyone who can reach it controls the show")
      ->needs(osc)
      ->capture_default_str();
  command
      .add_option("--osc-subscriber", options.osc_subscribers,
                  "HOST:PORT that always receives OSC feedback; may be repeated")
      ->needs(osc)
      ->allow_extra_args(false);
}

RemoteControl::RemoteControl(const RemoteOptions& options, CommandQueue& commands, const StatusBoard& board,
                             std::shared_ptr<LogRing> log, OscListeners listeners) {
  if (options.web_port) {
    const NetAddress address = address_of(options.web_bind, *options.web_port, "--web-bind");
    token_ = token_of(options, address, warning_);
    web_ = std::make_unique<WebServer>(address, token_, commands, board, std::move(log));
  }
  if (options.osc_port) {
    const NetAddress address = address_of(options.osc_bind, *options.osc_port, "--osc-bind");
    osc_ =
        std::make_unique<OscServer>(address, commands, board, std::move(listeners), subscribers_of(options, address));
  }
}

RemoteControl::~RemoteControl() = default;

std::vector<std::string> RemoteControl::greeting() const {
  std::vector<std::string> lines;
  if (web_) {
    const NetAddress bound = web_->address();
    if (bound.is_any()) {
      lines.push_back(fmt::format("status page: http://localhost:{}/", bound.port()));
    } else if (bound.is_loopback()) {
      lines.push_back(fmt::format("status page: http://{}/", bound.text()));
    }
    for (const NetAddress& address : reachable(bound)) {
      if (!address.is_loopback()) {
        lines.push_back(fmt::format("status page: http://{}/?token={}", address.text(), token_));
      }
    }
  }
  if (osc_) {
    const bool outside = !osc_->address().is_loopback();
    lines.push_back(fmt::format("OSC: {}{}", osc_->address().text(),
                                outside ? " (anyone who can reach this port controls the show)" : ""));
  }
  return lines;
}

std::optional<NetAddress> RemoteControl::web_address() const {
  return web_ ? std::optional(web_->address()) : std::nullopt;
}

std::optional<NetAddress> RemoteControl::osc_address() const {
  return osc_ ? std::optional(osc_->address()) : std::nullopt;
}

}  // namespace ergodome
