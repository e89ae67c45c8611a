#include "app/playback/playback.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

using Kind = TransportCommand::Kind;

std::string wider(const std::string& language) { return language.substr(0, language.find('-')); }

bool has_language(const std::vector<std::string>& languages, const std::string& language) {
  return std::ranges::find(languages, language) != languages.end();
}

//! Returns the status word of a chase state.
const char* name_of(ChaseState state) {
  switch (state) {
    case ChaseState::waiting:
      return "waiting";
    case ChaseState::following:
      return "following";
    case ChaseState::freewheeling:
      return "running_on";
    case ChaseState::held:
      return "stopped";
  }
  return "";
}

//! Returns the fallback language when the requested one is unavailable.
std::string fallback_language(const std::vector<std::string>& languages) {
  return has_language(languages, "en") ? "en" : languages.front();
}

}  // namespace

Soundtrack soundtrack_of(const Show& show) { return {show.timeline.audio, show.folder, show.duration_s}; }

std::string language_note(const std::string& show, const Timeline& heard, const std::string& language) {
  const std::vector<std::string> spoken = languages(heard);
  if (language.empty() || spoken.empty() || has_language(spoken, language) || has_language(spoken, wider(language))) {
    return "";
  }
  return fmt::format("{} has no captions or sound in \"{}\"; available: {}; using {}", show, language,
                     fmt::join(spoken, ", "), fallback_language(spoken));
}

Playback::Playback(const Show& show, PlaybackSettings settings)
    : source_(settings.source),
      clock_(show.duration_s, show.frame_rate_hz, settings.source),
      fader_(settings.blackout_fade),
      language_(std::move(settings.language)) {
  set_show(show);
  clock_.play();
  advance();
}

void Playback::set_show(const Show& show) {
  title_ = show.title;
  show_baseline_ = show.stereo.baseline;
  stereo_ = eye_count(show.stereo) > 1;
  chapters_ = show.timeline.chapters;
  languages_ = languages(show);
  if (!has_language(languages_, language_) && !languages_.empty()) {
    language_ = has_language(languages_, wider(language_)) ? wider(language_) : fallback_language(languages_);
  }
  clock_.set_show(show.duration_s, show.frame_rate_hz);
}

void Playback::follow(std::shared_ptr<ExternalClock> clock) {
  external_ = std::move(clock);
  chase_state_ = ChaseState::waiting;
  if (!external_) {
    clock_.set_speed(1.0);
  }
}

void Playback::darken() {
  fader_ = Fader(fader_.whole(), 0.0);
  light_ = 0.0;
}

const ShowInstant& Playback::advance() {
  if (external_) {
    chase_state_ = chaser_.follow(clock_, external_->latest(), external_->patience());
  }
  instant_ = clock_.read();
  light_ = fader_.value(instant_.now);
  return instant_;
}

CommandOutcome Playback::refuse(std::string english, std::string german) {
  refusal_ = std::move(language_ == "de" ? german : english);
  return CommandOutcome::refused;
}

CommandOutcome Playback::refuse_chapter(std::string english, std::string german) {
  return chapters_.empty() ? refuse("the show has no chapters", "die Vorführung hat keine Kapitel")
                           : refuse(std::move(english), std::move(german));
}

CommandOutcome Playback::apply(const TransportCommand& command) {
  if (!std::isfinite(command.value)) {
    return refuse("the value is not a number", "der Wert ist keine Zahl");
  }
  if (moves_time(command.kind)) {
    if (external_) {
      return refuse(fmt::format("the show follows {}", external_->name()),
                    fmt::format("die Vorführung folgt {}", external_->name()));
    }
    return move(command);
  }
  if (command.kind == Kind::language) {
    return choose_language(command.text);
  }
  return adjust(command) ? CommandOutcome::done : CommandOutcome::elsewhere;
}

CommandOutcome Playback::move(const TransportCommand& command) {
  switch (command.kind) {
    case Kind::play:
      clock_.play();
      break;
    case Kind::pause:
      clock_.pause();
      break;
    case Kind::toggle_pause:
      clock_.read().playing ? clock_.pause() : clock_.play();
      break;
    case Kind::seek:
      clock_.seek(show_time(command.value));
      break;
    case Kind::seek_by:
      clock_.seek_by(show_time(command.value));
      break;
    case Kind::step:
      clock_.step(std::llround(std::clamp(command.value, -1e9, 1e9)));
      break;
    case Kind::speed:
      clock_.set_speed(command.value);
      break;
    case Kind::chapter:
      return go_to_chapter(static_cast<int>(std::lround(std::clamp(command.value, -1e6, 1e6))));
    case Kind::next_chapter:
      return go_to_next_chapter();
    default:
      return go_to_previous_chapter();
  }
  return CommandOutcome::done;
}

CommandOutcome Playback::go_to_chapter(int index) {
  if (index < 0 || index >= static_cast<int>(chapters_.size())) {
    return refuse_chapter(fmt::format("the show has chapters 0 to {}", chapters_.size() - 1),
                          fmt::format("die Vorführung hat die Kapitel 0 bis {}", chapters_.size() - 1));
  }
  clock_.seek(show_time(chapters_[static_cast<std::size_t>(index)].time_s));
  return CommandOutcome::done;
}

CommandOutcome Playback::go_to_next_chapter() {
  instant_ = clock_.read();
  if (chapter() + 1 >= static_cast<int>(chapters_.size())) {
    return refuse_chapter("this is the last chapter", "dies ist das letzte Kapitel");
  }
  return go_to_chapter(chapter() + 1);
}

CommandOutcome Playback::go_to_previous_chapter() {
  // Within this time after the start of a chapter, the command goes to the chapter before; later,
  // it goes to the start of the current one.
  constexpr auto soon = std::chrono::seconds(2);
  instant_ = clock_.read();
  const int now = chapter();
  if (now < 0) {
    clock_.seek(ShowTime{});
    return CommandOutcome::done;
  }
  const ShowTime since = instant_.time - show_time(chapters_[static_cast<std::size_t>(now)].time_s);
  return go_to_chapter(since > soon ? now : std::max(now - 1, 0));
}

CommandOutcome Playback::choose_language(const std::string& tag) {
  if (!has_language(languages_, tag)) {
    return languages_.empty() ? refuse("the show has only one language", "die Vorführung hat nur eine Sprache")
                              : refuse(fmt::format("available languages: {}", fmt::join(languages_, ", ")),
                                       fmt::format("verfügbare Sprachen: {}", fmt::join(languages_, ", ")));
  }
  language_ = tag;
  return CommandOutcome::done;
}

void Playback::choose_next_language() {
  if (languages_.empty()) {
    return;
  }
  const auto found = std::ranges::find(languages_, language_);
  const bool last = found == languages_.end() || found + 1 == languages_.end();
  language_ = last ? languages_.front() : *(found + 1);
}

bool Playback::adjust(const TransportCommand& command) {
  constexpr double most_stops = 20.0;
  constexpr double widest_baseline = 1e6;
  const bool on = command.value > 0.5;
  switch (command.kind) {
    case Kind::loop:
      clock_.set_loop(on);
      return true;
    case Kind::blackout:
      fader_.go(on ? 0.0 : 1.0, source_());
      return true;
    case Kind::toggle_blackout:
      fader_.go(1.0 - fader_.target(), source_());
      return true;
    case Kind::exposure:
      exposure_stops_ = std::clamp(command.value, -most_stops, most_stops);
      return true;
    case Kind::baseline:
      baseline_ = std::clamp(command.value, 0.0, widest_baseline);
      return true;
    case Kind::next_language:
      choose_next_language();
      return true;
    case Kind::captions:
      captions_ = on;
      return true;
    case Kind::volume:
      volume_ = std::clamp(command.value, 0.0, 1.0);
      return true;
    case Kind::reset:
      exposure_stops_ = 0.0;
      baseline_.reset();
      return false;
    default:
      return false;
  }
}

int Playback::chapter() const {
  const auto later = std::ranges::upper_bound(chapters_, instant_.time, {},
                                              [](const Chapter& chapter) { return show_time(chapter.time_s); });
  return static_cast<int>(later - chapters_.begin()) - 1;
}

std::string Playback::clock_text() const {
  if (!external_) {
    return "own";
  }
  switch (chase_state_) {
    case ChaseState::waiting:
      return external_->name() + ", not heard yet";
    case ChaseState::freewheeling:
      return external_->name() + ", lost, runs on";
    case ChaseState::held:
      return external_->name() + ", lost, stopped";
    default:
      return external_->name();
  }
}

void Playback::fill_clock(PlayerStatus& status) const {
  status.clock = clock_text();
  status.follows = external_ ? external_->name() : "";
  status.clock_state = external_ ? name_of(chase_state_) : "own";
  status.clock_silence_s.reset();
  if (const std::optional<ClockFix> fix = external_ ? external_->latest() : std::nullopt) {
    // Another thread may have received the fix after this frame began.
    status.clock_silence_s = std::max(0.0, seconds_of(instant_.now - fix->heard));
  }
}

void Playback::fill(PlayerStatus& status) const {
  status.title = text_in(title_, language_);
  status.time_s = seconds_of(instant_.time);
  status.duration_s = seconds_of(clock_.duration());
  status.playing = instant_.playing;
  status.speed = clock_.speed();
  status.loop = clock_.loop();
  status.blackout = dark();
  status.exposure_stops = exposure_stops_;
  status.baseline = baseline_.value_or(show_baseline_);
  status.stereo = stereo_;
  status.volume = volume_;
  status.language = language_;
  status.languages = languages_;
  status.captions = captions_;
  status.chapter = chapter();
  status.chapters.clear();
  for (const Chapter& chapter : chapters_) {
    ChapterStatus& added = status.chapters.emplace_back();
    added.time_s = chapter.time_s;
    added.title = text_in(chapter.title, language_);
    for (const auto& [tag, title] : chapter.title) {
      added.titles.push_back(title);
    }
  }
  fill_clock(status);
  status.dropped_frames = clock_.dropped_frames();
}

}  // namespace ergodome
