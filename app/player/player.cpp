#include "app/player/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/cli/show_loading.h"
#include "app/exhibit/supervisor.h"
#include "app/pads/hid/hid_fixture.h"
#include "app/pads/pad_settings.h"
#include "app/player/player_texts.h"
#include "content/files/reading_stop.h"
#include "kernels/core/angles.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

//! Number of consecutive failed frames after which the renderer is rebuilt.
constexpr int most_failures = 5;

//! Returns the options of the window for a show. Eyes that layouts store separately are side by
//! side in the window; those of quad_buffer and rows each fill it.
ScreenOptions screen_options(const Show& show, const PlayOptions& options) {
  const Projection projection = make_projection(show.view, options.size_px, 0.0);
  const StereoLayout layout = show.stereo.layout;
  const ImageSize size = window_picture_size(layout, {projection.width_px, projection.height_px});
  return {size.width,
          size.height,
          options.full_screen || options.exhibit,
          layout == StereoLayout::quad_buffer,
          options.setup,
          options.projectors,
          options.hide_control};
}

SessionOptions session_options(const PlayOptions& options, bool free_flight, WindowBuffers buffers) {
  return {.free_flight = free_flight,
          .language = options.language,
          .one_eye = options.setup.has_value(),
          .plain_window = buffers == WindowBuffers::plain};
}

std::unique_ptr<HidApi> hid_api(const PlayOptions& options) {
  return options.pad_fixture.empty() ? make_hid_library() : play_hid_fixture(options.pad_fixture);
}

//! Returns the result of `load`. An exhibit has to start, so there an error is added to `damage`
//! and the default is returned.
template <class Load>
auto read_or_usual(bool exhibit, std::vector<std::string>& damage, const Load& load) -> decltype(load()) {
  try {
    return load();
  } catch (const std::exception& problem) {
    if (!exhibit) {
      throw;
    }
    damage.push_back(fmt::format("{}; the defaults apply until then", problem.what()));
    return {};
  }
}

PadSettings pad_settings(const PlayOptions& options) {
  const std::filesystem::path own = default_pad_settings_path();
  std::error_code problem;
  return !options.pad_settings.empty()                                    ? load_pad_settings(options.pad_settings)
         : !own.empty() && std::filesystem::is_regular_file(own, problem) ? load_pad_settings(own)
                                                                          : PadSettings();
}

}  // namespace

Player::Player(const Show& show, const RendererLoader::Make& make, const PlayOptions& options)
    : options_(options),
      screen_(screen_options(show, options)),
      renderers_(make),
      inputs_(read_or_usual(options.exhibit.has_value(), damage_, [&] { return load_controls(options.controls); })),
      pads_(hid_api(options),
            read_or_usual(options.exhibit.has_value(), damage_, [&] { return pad_settings(options); })),
      pictures_([this](const PictureAnswer& answer) { screen_.show(answer); }, options.size_px),
      services_(options.services, show),
      recording_(options.record, options.exhibit ? RecordingFile::Names::numbered : RecordingFile::Names::one) {
  if (options_.budget) {
    budget_.emplace(*options_.budget);
  }
  Show first = show;
  if (options_.exhibit) {
    exhibit_.emplace(*options_.exhibit, show, options_.load(options_.exhibit->attract));
    first = exhibit_->show();
    renderers_.prepare(ExhibitScene::visitor, show);
    services_.watch(show, options_.read_at, options_.load);
    inputs_.set_lock(InputLock::visitors);
    services_.tell(spdlog::level::warn, exhibit_->damage());
    services_.tell(spdlog::level::warn, attract_mismatch(show, exhibit_->show()));
    for (const std::string& damage : damage_) {
      services_.tell(spdlog::level::warn, damage);
    }
  }
  if (options_.full_screen || exhibit_) {
    screen_.window().hide_cursor();
  }
  renderers_.prepare(ExhibitScene::attract, first);
  renderers_.enter(ExhibitScene::attract, first);
  begin(first, options_.free_flight && !exhibit_);
  if (first.stereo.layout == StereoLayout::quad_buffer && screen_.window().buffers() == WindowBuffers::plain) {
    services_.tell(spdlog::level::warn,
                   "the graphics driver does not support quad-buffer stereo; the eyes are shown side by side");
  }
  pads_.start();
  if (exhibit_) {
    services_.tell(spdlog::level::info, start_text());
  }
}

Player::~Player() = default;

void Player::begin(const Show& show, bool free_flight) {
  // A blackout was set by an operator, so visitors cannot end it.
  const bool dark = exhibit_ && session_ && session_->playback().dark();
  session_.emplace(show, session_options(options_, free_flight, screen_.window().buffers()));
  eye_notice_.begin();
  session_->show_times(options_.times_shown);
  // The attract show is not a visitor's flight.
  if (recording_.wanted() && (!exhibit_ || exhibit_->scene() == ExhibitScene::visitor)) {
    recording_.begin();
    session_->record();
  }
  services_.drive(session_->playback());
  services_.set_show(show, options_.read_at, options_.load);
  if (exhibit_) {
    for (const TransportCommand& command : exhibit_->kept_commands()) {
      session_->playback().apply(command);
    }
  }
  if (dark) {
    session_->playback().darken();
  }
}

void Player::run() {
  while (!screen_.closed() && !interrupted()) {
    advance();
    if (draws_now()) {
      screen_.draw();
    }
    end_in_time();
    tell_supervisor_alive(session_->now_s());
  }
  if (exhibit_) {
    // Logs the end even if the disk is full.
    keep_recording(RecordingMoment::end);
    exhibit_->keep_last();
    services_.log_changes(operator_log_.take_all());
  } else {
    recording_.save(*session_);
  }
  if (options_.for_seconds) {
    print_statistics();
  }
  if (!options_.screenshot.empty()) {
    screen_.save_screenshot(options_.screenshot);
  }
  if (exhibit_) {
    services_.tell(spdlog::level::info, end_text());
  }
  // Does not wait for other threads that are still loading.
  stop_reading();
}

bool Player::draws_now() {
  constexpr double longest_s = 0.04;
  const double now_s = session_->now_s();
  // Drawing the window takes time from the next frame.
  const bool rate = budget_ && budget_->plan().budget.frame_rate_hz;
  if (rate && drawn_pictures_ == pictures_.report().pictures && now_s < drawn_s_ + longest_s) {
    return false;
  }
  drawn_pictures_ = pictures_.report().pictures;
  drawn_s_ = now_s;
  return true;
}

void Player::advance() {
  const std::vector<WindowEvent> events = screen_.events();
  pad_snapshot_ = pads_.snapshot();
  int width = 0;
  int height = 0;
  screen_.window().framebuffer_size(width, height);
  const double radians_per_px = session_->frame().field_of_view_deg * one_degree / std::max(width, 1);
  PlayerInput input = inputs_.gather(events, pad_snapshot_, radians_per_px);
  input.commands = services_.commands();
  advance_exhibit(input);
  session_->advance(input);
  answer_requests();
  reload(false);
  services_.look_at_waiting_shows();
  take_renderer();
  tell_notes();
  update_picture();
  screen_.set_light(session_->frame().light);
  services_.follow(session_->playback());
  update_texts();
  post_status();
  keep_recording(RecordingMoment::frame);
}

void Player::answer_requests() {
  for (const KeyAction request : session_->take_requests()) {
    switch (request) {
      case KeyAction::quit:
        end("a key was pressed to quit");
        break;
      case KeyAction::full_screen:
        screen_.window().toggle_full_screen();
        break;
      case KeyAction::reload:
        reload(true);
        break;
      default:
        break;
    }
  }
}

void Player::tell_notes() {
  for (const std::string& note : options_.notes->take()) {
    services_.tell(spdlog::level::warn, note);
  }
}

void Player::update_picture() {
  if (!renderers_.current()) {
    return;
  }
  PictureRequest wish;
  wish.renderer = renderers_.current();
  wish.frame = session_->frame();
  wish.disparity_asked = session_->times_shown();
  add_budget(wish);
  const bool words_changed = add_words(wish);
  const bool light_asked = add_light(wish);
  const bool resized = add_window(wish);
  note(pictures_.advance(wish, words_changed || light_asked || resized || session_->changed(), session_->moving()));
}

bool Player::add_window(PictureRequest& wish) {
  if (options_.setup) {
    wish.projectors_px = options_.projectors_px;
    return false;
  }
  ImageSize size = {0, 0};
  screen_.window().framebuffer_size(size.width, size.height);
  if (size.width > 0 && size.height > 0) {
    wish.window = size;
    return std::exchange(window_, size) != size;
  }
  wish.window = window_;
  return false;
}

void Player::add_budget(PictureRequest& wish) {
  if (!budget_) {
    return;
  }
  const PlayPlan& plan = budget_->plan();
  const Rung rung = budget_->rung();
  wish.quality = rung.quality;
  wish.whole_px = plan.whole_px;
  wish.patience_s = 1e-3 * plan.patience_ms;
  wish.errors_asked = budget_->wants_errors(session_->now_s());
  wish.error_seed = static_cast<std::uint64_t>(pictures_.report().pictures);
  if (plan.budget.frame_rate_hz) {
    pictures_.hold({rung.size_px, 1e-3 * plan.budget.frame_ms()});
  }
}

void Player::note_budget() {
  const PictureReport& report = pictures_.report();
  budget_->note_picture(report.frame_time_ms, report.interval_ms);
  if (report.errors_px) {
    budget_->note_errors(*report.errors_px);
    budget_->ask_errors(session_->now_s());
  }
}

void Player::note(PictureNews news) {
  if (news == PictureNews::none) {
    return;
  }
  failures_ = news == PictureNews::problem ? failures_ + 1 : 0;
  if (news == PictureNews::hang || failures_ >= most_failures) {
    failures_ = 0;
    renderers_.lose(session_->show());
  }
  if (news == PictureNews::picture) {
    session_->playback().note_shown(session_->playback().instant());
    note_light();
    tell_narrowed_eyes();
    if (budget_) {
      note_budget();
    }
  }
  if (!first_answer_) {
    first_answer_ = Clock::now();
    tell_supervisor_ready();
  }
  services_.tell(spdlog::level::err, pictures_.report().problem);
  screen_.window().set_title(title_text(pictures_.report(), *session_, renderers_.backend()));
}

void Player::tell_narrowed_eyes() {
  const std::optional<NarrowedEyes>& eyes = pictures_.report().narrowed;
  const std::optional<double> chosen = session_->playback().baseline();
  if (!eye_notice_.tells(eyes, chosen)) {
    return;
  }
  // Visitors cannot do anything about it.
  if (!exhibit_) {
    session_->say(line_of(*eyes, session_->playback().language()));
  }
  services_.tell(spdlog::level::warn, note_of(session_->show(), session_->frame().time_s, *eyes, chosen));
}

void Player::keep_recording(RecordingMoment moment) {
  bool written = false;
  std::string problem;
  try {
    written = moment == RecordingMoment::end ? recording_.save(*session_) : recording_.keep(*session_);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  // Logs each problem once, because saving is retried. Only a written flight proves that it works
  // again.
  if (!problem.empty() && problem != recording_problem_) {
    services_.tell(spdlog::level::err, problem);
    recording_problem_ = problem;
  } else if (written && !recording_problem_.empty()) {
    services_.tell(spdlog::level::info, "recording of flights works again");
    recording_problem_.clear();
  }
}

void Player::end_in_time() {
  if (options_.for_seconds && first_answer_ &&
      std::chrono::duration<double>(Clock::now() - *first_answer_).count() >= *options_.for_seconds) {
    end(fmt::format("the time limit of --for ({:g} s) was reached", *options_.for_seconds));
  }
}

void Player::end(std::string why) {
  screen_.window().close();
  why_ended_ = std::move(why);
}

}  // namespace ergodome
