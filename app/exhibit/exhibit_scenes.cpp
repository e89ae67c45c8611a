#include "app/exhibit/exhibit_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>

#include "app/navigation/flight_space.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr double chord_s = 3.0;
constexpr double between_writes_s = 1.0;
constexpr double retry_s = 10.0;
const std::string saved_settings_file = "settings.toml";

Caption caption_at(double elevation_deg, double letter_deg, LocalText text) {
  Caption caption;
  caption.position.elevation_deg = elevation_deg;
  caption.letter_deg = letter_deg;
  caption.width_deg = 70.0;
  caption.text = std::move(text);
  return caption;
}

//! Copies the settings that a command changes from `status` to `settings`. After a refused command,
//! `status` still has the old value. `baseline_set`: the baseline is not the show's.
void take_over(const TransportCommand& command, const PlayerStatus& status, bool baseline_set,
               SavedSettings& settings) {
  using Kind = TransportCommand::Kind;
  const bool any = command.kind == Kind::reset;
  if (any || command.kind == Kind::exposure) {
    settings.exposure_stops = status.exposure_stops;
  }
  if (any || command.kind == Kind::baseline) {
    settings.baseline = baseline_set ? status.baseline : -1.0;
  }
  if (command.kind == Kind::volume) {
    settings.volume = status.volume;
  }
  if (command.kind == Kind::captions) {
    settings.captions = status.captions;
  }
  // A show with one language always reports that one, so the operator's choice is kept.
  const bool chosen =
      command.kind == Kind::next_language || (command.kind == Kind::language && command.text == status.language);
  if (chosen && status.languages.size() > 1) {
    settings.language = status.language;
  }
}

}  // namespace

std::string usual_attract_show(const Show& visitor) {
  return visitor.view.projection == ViewProjection::pinhole ? "attract" : "once-around";
}

std::string attract_mismatch(const Show& visitor, const Show& attract) {
  const bool flat = visitor.view.projection == ViewProjection::pinhole;
  if (flat == (attract.view.projection == ViewProjection::pinhole)) {
    return "";
  }
  return flat ? Error(attract.name, "is not made for flat screens: it would appear as a disk or a strip",
                      "leave out --attract, or add --projection pinhole")
                    .what()
              : Error(attract.name, "is made for flat screens, but the visitors' show is for a dome",
                      "leave out --attract, or add --projection dome")
                    .what();
}

ExhibitScenes::ExhibitScenes(ExhibitOptions options, Show visitor, Show attract)
    : options_(std::move(options)),
      visitor_(std::move(visitor)),
      attract_(std::move(attract)),
      exhibit_(options_.times),
      chord_(chord_s) {
  if (!options_.state.empty()) {
    saved_ = read_saved_settings(options_.state / saved_settings_file, damage_);
  }
  noted_ = saved_;
}

bool ExhibitScenes::advance(double now_s, bool touched, bool chord_held) {
  now_s_ = now_s;
  left_ = left_ || chord_.advance(now_s, chord_held);
  const bool another = exhibit_.advance(now_s, touched);
  if (another) {
    black_view_.begin();
  }
  return another;
}

void ExhibitScenes::note_light(double lit_part) {
  if (scene() == ExhibitScene::visitor) {
    black_view_.note(now_s_, lit_part);
  }
}

bool ExhibitScenes::take_return() { return scene() == ExhibitScene::visitor && black_view_.take_return(now_s_); }

void ExhibitScenes::renew(const Show& show) {
  for (Show* const own : {&visitor_, &attract_}) {
    if (own->name == show.name && own->folder == show.folder) {
      *own = show;
    }
  }
}

std::vector<Caption> ExhibitScenes::captions(bool pad) const {
  if (const auto left_s = exhibit_.ending_in_s()) {
    const int seconds = static_cast<int>(std::ceil(*left_s));
    return {caption_at(12.0, 3.0,
                       {{"en", fmt::format("Your flight ends in {} s", seconds)},
                        {"de", fmt::format("Ihr Flug endet in {} s", seconds)}})};
  }
  if (const auto back_in_s = black_view_.back_in_s(now_s_)) {
    return black_view_captions(*back_in_s, pad);
  }
  if (exhibit_.welcome() <= 0.0) {
    return {};
  }
  // Each line is a separate caption, 4.5 degrees below the one before: letters are 2.4 degrees
  // high, for domes of 512 pixels, and lines of one caption would touch.
  std::vector<LocalText> lines =
      pad ? std::vector{LocalText{{"en", "Left stick: around the hole and toward it"},
                                  {"de", "Linker Stick: um das Loch herum und darauf zu"}},
                        LocalText{{"en", "Right stick: look around"}, {"de", "Rechter Stick: umsehen"}}}
          : std::vector{
                LocalText{{"en", "W A S D: around the hole and toward it"},
                          {"de", "W A S D: um das Loch herum und darauf zu"}},
                LocalText{{"en", "Mouse: look around   F1: more keys"}, {"de", "Maus: umsehen   F1: weitere Tasten"}}};
  if (may_fall_through_horizon(visitor_)) {
    lines.push_back(pad ? LocalText{{"en", "Left trigger: fall into the hole"}, {"de", "Linker Abzug: ins Loch fallen"}}
                        : LocalText{{"en", "K: fall into the hole"}, {"de", "K: ins Loch fallen"}});
  }
  std::vector<Caption> all = {
      caption_at(22.0, 3.0, {{"en", "Welcome! You are flying."}, {"de", "Willkommen! Sie fliegen."}})};
  double elevation_deg = 9.0 + 2.5 * static_cast<double>(lines.size());
  for (const LocalText& line : lines) {
    all.push_back(caption_at(elevation_deg, 2.4, line));
    elevation_deg -= 4.5;
  }
  return all;
}

std::vector<Caption> ExhibitScenes::black_view_captions(double back_in_s, bool pad) const {
  const int seconds = static_cast<int>(std::ceil(back_in_s));
  return {
      caption_at(
          14.0, 2.4,
          {{"en", "Nothing but black in view. Turn around,"}, {"de", "Hier ist nur Schwarz. Drehen Sie sich um,"}}),
      caption_at(9.5, 2.4,
                 pad ? LocalText{{"en", "or press the right stick to start again."},
                                 {"de", "oder starten Sie neu: rechten Stick drücken."}}
                     : LocalText{{"en", "or press Delete to start again."}, {"de", "oder starten Sie mit Entf neu."}}),
      caption_at(5.0, 2.4,
                 {{"en", fmt::format("You will be back at the start in {} s.", seconds)},
                  {"de", fmt::format("In {} s sind Sie wieder am Start.", seconds)}})};
}

double ExhibitScenes::opacity() const {
  return exhibit_.ending_in_s() || black_view_.back_in_s(now_s_) ? 1.0 : exhibit_.welcome();
}

std::vector<TransportCommand> ExhibitScenes::saved_commands() const {
  using Kind = TransportCommand::Kind;
  std::vector<TransportCommand> commands = {{Kind::exposure, noted_.exposure_stops, {}},
                                            {Kind::volume, noted_.volume, {}},
                                            {Kind::captions, noted_.captions ? 1.0 : 0.0, {}}};
  if (noted_.baseline >= 0.0) {
    commands.push_back({Kind::baseline, noted_.baseline, {}});
  }
  if (!noted_.language.empty()) {
    commands.push_back({Kind::language, 0.0, noted_.language});
  }
  return commands;
}

void ExhibitScenes::note(const std::vector<TransportCommand>& commands) {
  asked_.insert(asked_.end(), commands.begin(), commands.end());
}

std::vector<TransportCommand> ExhibitScenes::reset_commands() const {
  using Kind = TransportCommand::Kind;
  std::vector<TransportCommand> commands = {{Kind::reset, 0.0, {}}, {Kind::exposure, noted_.exposure_stops, {}}};
  if (noted_.baseline >= 0.0) {
    commands.push_back({Kind::baseline, noted_.baseline, {}});
  }
  return commands;
}

std::string ExhibitScenes::state_text(const PlayerStatus& status) const {
  return fmt::format("{} {}{}{}", scene() == ExhibitScene::visitor ? "A visitor is flying in" : "No visitor; showing",
                     text_in(show().title, status.language), status.blackout ? ", blacked out by an operator" : "",
                     status.problem.empty() ? "" : ". Problem: " + status.problem);
}

void ExhibitScenes::keep(const PlayerStatus& status, bool baseline_set) {
  SavedSettings now = noted_;
  for (const TransportCommand& command : std::exchange(asked_, {})) {
    take_over(command, status, baseline_set, now);
  }
  if (now != noted_) {
    noted_ = now;
  }
  if (noted_ == saved_ || options_.state.empty()) {
    problem_.clear();
  } else if (now_s_ - wrote_s_ >= between_writes_s && now_s_ - refused_s_ >= retry_s) {
    write_settings();
  }
}

void ExhibitScenes::keep_last() {
  if (noted_ != saved_ && !options_.state.empty()) {
    write_settings();
  }
}

void ExhibitScenes::write_settings() {
  const std::filesystem::path file = options_.state / saved_settings_file;
  try {
    write_saved_settings(file, noted_);
    saved_ = noted_;
    wrote_s_ = now_s_;
    problem_.clear();
  } catch (const std::exception& error) {
    refused_s_ = now_s_;
    // Uses only the error's problem: its remedy, to choose another name, does not apply to this
    // file, whose name is fixed.
    const Error* const own = dynamic_cast<const Error*>(&error);
    problem_ =
        Error(file.string(), fmt::format("the settings cannot be saved ({})", own ? own->problem() : error.what()),
              "free disk space or make the folder writable; until then a restart loses them")
            .what();
  }
}

std::string ExhibitScenes::shows_text() const {
  return fmt::format("visitors' show {}, attract show {}", visitor_.name, attract_.name);
}

}  // namespace ergodome
