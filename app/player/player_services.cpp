#include "app/player/player_services.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cstdio>
#include <utility>

#include "content/files/console.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::chrono::seconds osc_patience{2};

//! Formats log lines on the terminal like the program's other messages.
spdlog::sink_ptr terminal_sink() {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_pattern("ergodome: %v");
  return sink;
}

std::vector<spdlog::sink_ptr> sinks_of(const ServiceOptions& options, const std::shared_ptr<LogRing>& ring) {
  std::vector<spdlog::sink_ptr> sinks = {log_ring_sink(ring)};
  if (options.log_on_terminal) {
    sinks.push_back(terminal_sink());
  }
  return sinks;
}

}  // namespace

PlayerServices::PlayerServices(const ServiceOptions& options, const Show& show)
    : ring_(std::make_shared<LogRing>()), log_(open_log(options.log_file, sinks_of(options, ring_))) {
  if (options.clock == "osc") {
    clock_ = std::make_shared<ExternalClock>("OSC", osc_patience);
  } else if (options.clock.starts_with("mtc")) {
    clock_ = make_midi_clock();
    const std::string port = options.clock.size() > 4 ? options.clock.substr(4) : "";
    // The rate of the time code is not known yet, so frames are parsed at the highest rate.
    const std::optional<TimeCode> start = parse_time_code(options.clock_start, CodeRate::fps30);
    midi_ = std::make_unique<MidiClockInput>(clock_, port, start);
    report(spdlog::level::info, fmt::format("the show follows MIDI time code on {}", midi_->port()));
  }
  if (options.sound) {
    sound_ = std::make_unique<AudioPlayer>(options.sound_later_s);
    sound_->set_soundtrack(soundtrack_of(show));
  }
  report_show(show);
  OscListeners listeners;
  listeners.warning = [log = log_](const std::string& line) { log->warn("{}", line); };
  if (options.clock == "osc") {
    listeners.clock = [clock = clock_](const ClockFix& fix) { clock->post(fix); };
  }
  remote_ = std::make_unique<RemoteControl>(options.remote, queue_, board_, ring_, std::move(listeners));
  report(spdlog::level::warn, remote_->warning());
  for (const std::string& line : remote_->greeting()) {
    // Printed only for the user who started the show: the line may contain the token, so it must
    // not be logged.
    print_out("{}\n", line);
  }
  std::fflush(stdout);
}

void PlayerServices::report_show(const Show& show) {
  Playback playback(show);
  drive(playback);
  PlayerStatus status;
  playback.fill(status);
  fill(status);
  post(std::move(status));
}

void PlayerServices::set_show(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load) {
  shows_.run(show, read_at, std::move(load));
  take_version(show);
}

void PlayerServices::take_version(const Show& show) {
  if (sound_) {
    sound_->set_soundtrack(soundtrack_of(show));
  }
}

std::vector<TransportCommand> PlayerServices::commands() {
  const std::deque<TransportCommand> all = queue_.take_all();
  return {all.begin(), all.end()};
}

void PlayerServices::follow(const Playback& playback) {
  if (!sound_) {
    return;
  }
  sound_->follow(playback.audio_cue());
  for (const std::string& problem : sound_->take_problems()) {
    report(spdlog::level::warn, problem);
  }
}

void PlayerServices::fill(PlayerStatus& status) const {
  status.sound = sound_ ? sound_->state() : "off";
  if (status.problem.empty()) {
    status.problem = shows_.problem();
  }
  if (status.problem.empty() && sound_) {
    status.problem = sound_->problem();
  }
}

std::optional<ShowReload::Result> PlayerServices::reloaded(bool now) {
  if (now) {
    shows_.request();
  }
  return shows_.poll(steady_time());
}

void PlayerServices::report_waiting_shows() {
  const auto waiting = shows_.poll_waiting(steady_time());
  if (!waiting) {
    return;
  }
  if (waiting->problem.empty()) {
    report(spdlog::level::info, waiting->file + " was saved; it will be reloaded when its scene starts");
  } else {
    report(spdlog::level::err, waiting->problem);
  }
}

std::string PlayerServices::remote_text() const {
  const auto web = remote_->web_address();
  const auto osc = remote_->osc_address();
  return (web ? "status page at " + web->text() : "no status page") + (osc ? ", OSC at " + osc->text() : "");
}

void PlayerServices::log_changes(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    log_->info("{}", line);
    reported_ = line;
  }
}

void PlayerServices::report(spdlog::level::level_enum level, const std::string& message) {
  if (!message.empty() && message != reported_) {
    log_->log(level, "{}", message);
  }
  reported_ = message;
}

}  // namespace ergodome
