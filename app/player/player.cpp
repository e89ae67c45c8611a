#include "app/player/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/cli/lens_options.h"
#include "app/cli/show_loading.h"
#include "app/exhibit/supervisor.h"
#include "app/pads/hid/hid_fixture.h"
#include "app/pads/pad_settings.h"
#include "app/player/player_texts.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "kernels/core/angles.h"
#include "render/output/stereo_layout.h"
#include "render/passes/overlay/camera_readout.h"
#include "render/present/headset/head_motion.h"

namespace ergodome {

namespace {

SessionOptions session_options(const PlayOptions& options, bool free_flight, const DisplayOutput& output) {
  return {.free_flight = free_flight,
          .language = options.language,
          .one_eye = output.is_dome(),
          .plain_window = !output.has_eye_buffers()};
}

//! Removes turns, which a viewer's head makes instead.
void stop_turns(Steering& steering) { steering.yaw = steering.pitch = steering.roll = 0.0; }

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

Player::Player(const Show& show, const RendererLoader::Make& make, std::unique_ptr<DisplayOutput> output,
               const PlayOptions& options)
    : options_(options),
      output_(std::move(output)),
      inputs_(read_or_usual(options.exhibit.has_value(), damage_, [&] { return load_controls(options.controls); })),
      pads_(hid_api(options),
            read_or_usual(options.exhibit.has_value(), damage_, [&] { return pad_settings(options); })),
      pictures_(make, *output_, options.size_px, options.budget),
      services_(options.services, show),
      recording_(options.record, options.exhibit ? RecordingFile::Names::numbered : RecordingFile::Names::one) {
  Show first = show;
  if (options_.exhibit) {
    exhibit_.emplace(*options_.exhibit, show, options_.load(options_.exhibit->attract));
    first = exhibit_->show();
    pictures_.renderers().prepare(ExhibitScene::visitor, show);
    services_.watch(show, options_.read_at, options_.load);
    inputs_.set_lock(InputLock::visitors);
    services_.report(spdlog::level::warn, exhibit_->damage());
    services_.report(spdlog::level::warn, attract_mismatch(show, exhibit_->show()));
    for (const std::string& damage : damage_) {
      services_.report(spdlog::level::warn, damage);
    }
  }
  if (options_.guide) {
    inputs_.set_lock(InputLock::guide);
  }
  if (options_.cluster) {
    set_cluster_shows(show);
    pictures_.set_gate(options_.cluster.get());
  }
  pictures_.renderers().prepare(ExhibitScene::attract, first);
  pictures_.renderers().enter(ExhibitScene::attract, first);
  begin(first, options_.free_flight && !exhibit_);
  if (first.stereo.layout == StereoLayout::quad_buffer && !output_->has_eye_buffers()) {
    services_.report(spdlog::level::warn,
                     "the graphics driver does not support quad-buffer stereo; the eyes are shown side by side");
  }
  pads_.start();
  if (exhibit_) {
    services_.report(spdlog::level::info, start_text());
  }
}

Player::~Player() = default;

void Player::begin(const Show& show, bool free_flight) {
  // A blackout was set by an operator, so the session of the next scene stays dark: visitors cannot
  // end it.
  const bool dark = exhibit_ && session_ && session_->playback().dark();
  session_.emplace(show, session_options(options_, free_flight, *output_));
  if (options_.cluster) {
    options_.cluster->set_attract(exhibit_ && exhibit_->scene() == ExhibitScene::attract);
  }
  eye_notice_.begin();
  disparity_limit_.begin();
  output_->set_headset(show.headset);
  pulses_.begin();
  session_->show_times(options_.times_shown);
  // The attract show is not a visitor's flight.
  if (recording_.wanted() && (!exhibit_ || exhibit_->scene() == ExhibitScene::visitor)) {
    recording_.begin();
    session_->record();
  }
  services_.drive(session_->playback());
  services_.set_show(show, options_.read_at, options_.load);
  if (exhibit_) {
    for (const TransportCommand& command : exhibit_->saved_commands()) {
      session_->playback().apply(command);
    }
  }
  if (dark) {
    session_->playback().darken();
  }
}

void Player::run() {
  while (!output_->closed() && !interrupted()) {
    advance();
    if (output_->sets_pace() || pictures_.shows_now(session_->now_s(), session_->frame().light)) {
      output_->show();
    }
    end_in_time();
    notify_supervisor_alive(session_->now_s());
  }
  if (exhibit_) {
    // Saves the recording without throwing, so that the log gets its last lines even if the disk is
    // full.
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
    output_->save_screenshot(options_.screenshot);
  }
  if (exhibit_) {
    services_.report(spdlog::level::info, end_text());
  }
}

void Player::advance() {
  const std::vector<WindowEvent> events = output_->events();
  pad_snapshot_ = pads_.snapshot();
  if (const std::optional<HeadsetHands> hands = output_->hands()) {
    headset_pad_.add_to(pad_snapshot_, *hands);
  }
  output_wish_ = output_->wish();
  const double radians_per_px = session_->frame().field_of_view_deg * one_degree / std::max(output_->size().width, 1);
  PlayerInput input = inputs_.gather(events, pad_snapshot_, radians_per_px);
  input.commands = services_.commands();
  input.display_delay_s = output_wish_.display_delay_s;
  if (output_wish_.head) {
    input.look = output_wish_.head->look;
    output_->turn_viewer(input.steering.rates.yaw);
    stop_turns(input.steering.rates);
    stop_turns(input.steering.amounts);
  }
  const bool arrived = follow_attention(input);
  advance_exhibit(input, arrived);
  session_->advance(input);
  pulse_at_thresholds();
  answer_requests();
  reload(false);
  services_.report_waiting_shows();
  take_renderer();
  report_notes();
  update_picture();
  output_->set_light(session_->frame().light);
  advance_cluster();
  services_.follow(session_->playback());
  update_texts();
  post_status();
  keep_recording(RecordingMoment::frame);
}

bool Player::follow_attention(PlayerInput& input) {
  const bool attended = output_->attended();
  if (std::exchange(attended_, attended) == attended) {
    return false;
  }
  if (!attended && session_->playback().instant().playing && !exhibit_) {
    pauses_alone_ = true;
    input.commands.push_back({TransportCommand::Kind::pause, 0.0, {}});
  } else if (attended && std::exchange(pauses_alone_, false)) {
    input.commands.push_back({TransportCommand::Kind::play, 0.0, {}});
  }
  return attended;
}

void Player::pulse_at_thresholds() {
  const std::optional<ThresholdPulse> pulse = pulses_.advance(session_->spacetime(), session_->frame().pose.r);
  if (pulse && options_.haptics) {
    output_->pulse(pulse->duration_s, pulse->strength);
  }
}

void Player::answer_requests() {
  for (const KeyAction request : session_->take_requests()) {
    switch (request) {
      case KeyAction::quit:
        end("a key was pressed to quit");
        break;
      case KeyAction::full_screen:
        output_->toggle_full_screen();
        break;
      case KeyAction::reload:
        reload(true);
        break;
      default:
        break;
    }
  }
}

void Player::report_notes() {
  for (const std::string& note : options_.notes->take()) {
    services_.report(spdlog::level::warn, note);
  }
}

void Player::update_picture() {
  if (!pictures_.renderers().current()) {
    return;
  }
  PictureRequest wish;
  wish.frame = session_->frame();
  wish.output = output_wish_;
  add_head(wish);
  const bool words_changed = add_words(wish);
  const bool light_asked = add_light(wish);
  note(pictures_.advance(*session_, std::move(wish), words_changed || light_asked));
}

void Player::add_head(PictureRequest& wish) {
  if (!wish.output.head) {
    return;
  }
  // A motion of the head that changes directions by less than this needs no new picture [rad].
  constexpr double invisible = 2e-4;
  ViewerHead& head = *wish.output.head;
  const double r = wish.frame.pose.r;
  wish.scale_per_m = scale_per_meter(session_->show().headset, r, horizon_radius(session_->spacetime()));
  if (wish.scale_per_m * glm::length(head.offset_m - head_offset_m_) > invisible * r) {
    head_offset_m_ = head.offset_m;
  }
  head.offset_m = head_offset_m_;
  if (!session_->playback().baseline()) {
    wish.frame.stereo.baseline = wish.scale_per_m * head.eye_distance_m;
  }
  wish.frame.stereo.baseline *= disparity_limit_.factor();
  wish.disparity_asked = eye_count(wish.frame.stereo) > 1 && disparity_limit_.is_due(session_->now_s());
  head_baseline_ = wish.frame.stereo.baseline;
}

void Player::note(PictureNews news) {
  if (news == PictureNews::none) {
    return;
  }
  if (news == PictureNews::picture) {
    session_->playback().note_shown(session_->playback().instant());
    note_light();
    report_reduced_baseline();
    limit_disparity();
  }
  if (!first_answer_) {
    first_answer_ = Clock::now();
    notify_supervisor_ready();
  }
  services_.report(spdlog::level::err, pictures_.report().problem);
  output_->set_title(title_text(pictures_.report(), *session_, pictures_.renderers().backend()));
}

void Player::report_reduced_baseline() {
  const std::optional<ReducedBaseline>& eyes = pictures_.report().reduced;
  const std::optional<double> chosen = session_->playback().baseline();
  if (!eye_notice_.is_news(eyes, chosen)) {
    return;
  }
  // Visitors of an exhibit do not see this notice, because they cannot change the baseline.
  if (!exhibit_) {
    session_->say(line_of(*eyes, session_->playback().language()));
  }
  services_.report(spdlog::level::warn, note_of(session_->show(), session_->frame().time_s, *eyes, chosen));
}

void Player::limit_disparity() {
  const std::optional<Disparity>& disparity = pictures_.report().disparity;
  if (!output_wish_.head || !disparity) {
    return;
  }
  const double comfort_deg = session_->frame().stereo.comfort_deg;
  disparity_limit_.note(session_->now_s(), disparity->range_deg(), comfort_deg);
  if (disparity_limit_.take_news()) {
    services_.report(spdlog::level::warn,
                     fmt::format("the disparities of {:.3g}° exceed stereo.comfort_deg ({:.3g}°); the distance between "
                                 "the eyes is reduced until they are smaller",
                                 disparity->range_deg(), comfort_deg));
  }
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
    services_.report(spdlog::level::err, problem);
    recording_problem_ = problem;
  } else if (written && !recording_problem_.empty()) {
    services_.report(spdlog::level::info, "recording of flights works again");
    recording_problem_.clear();
  }
}

void Player::advance_cluster() {
  if (!options_.cluster) {
    return;
  }
  const ShowInstant& instant = session_->playback().instant();
  const bool runs = instant.playing && !session_->flying();
  options_.cluster->advance(runs ? instant.speed : 0.0, session_->frame().light);
  for (const ClusterNews& news : options_.cluster->take_news()) {
    services_.report(news.warning ? spdlog::level::warn : spdlog::level::info, news.text);
  }
  const bool wanted = options_.cluster->group_wanted();
  if (std::exchange(in_swap_group_, wanted) != wanted) {
    services_.report(spdlog::level::warn, output_->join_swap_group(wanted));
  }
}

void Player::set_cluster_shows(const Show& show) {
  options_.cluster->set_shows(exhibit_ ? exhibit_->shows() : std::vector<Show>{show});
}

void Player::end_in_time() {
  if (options_.for_seconds && first_answer_ &&
      std::chrono::duration<double>(Clock::now() - *first_answer_).count() >= *options_.for_seconds) {
    end(fmt::format("the time limit of --for ({:g} s) was reached", *options_.for_seconds));
  }
}

void Player::end(std::string why) {
  output_->close();
  why_ended_ = std::move(why);
}

void Player::reload(bool now) {
  const auto result = services_.reloaded(now);
  if (!result) {
    return;
  }
  if (result->show) {
    // The current version runs until the new one is loaded completely.
    pictures_.renderers().renew(*result->show);
  } else {
    services_.report(spdlog::level::err, result->problem);
    refuse_version(result->problem);
  }
}

void Player::take_version(const Show& show) {
  session_->set_show(show);
  output_->set_headset(show.headset);
  services_.take_version(show);
  if (exhibit_) {
    exhibit_->renew(show);
  }
  if (options_.cluster) {
    try {
      set_cluster_shows(show);
    } catch (const std::exception& problem) {
      // The nodes that lack files of the new version are refused.
      services_.report(spdlog::level::err, problem.what());
    }
  }
  services_.report(spdlog::level::info, fmt::format("{} was reloaded", show.name));
}

void Player::refuse_version(const std::string& problem) {
  services_.refuse_version(problem);
  if (!exhibit_) {
    session_->say(problem);
  }
}

void Player::take_renderer() {
  const SceneRenderers::News news = pictures_.take_renderer(session_->show());
  services_.report(spdlog::level::err, news.problem);
  if (news.another) {
    if (news.version) {
      take_version(*news.version);
    }
    session_->show_again();
  } else if (news.version) {
    refuse_version(news.problem);
  }
}

bool Player::add_words(PictureRequest& wish) {
  if (!exhibit_) {
    return false;
  }
  if (output_->is_dome() && session_->help_shown()) {
    wish.captions = {help_caption(help_text(HelpForm::words))};
    wish.captions_opacity = 1.0;
    wish.frame.captions = false;
  } else if (!session_->help_shown() || exhibit_->is_ending()) {
    // Help in the window covers the welcome caption and contains more, so the caption is omitted
    // while help is shown.
    wish.captions = exhibit_->captions(!pad_snapshot_.pads.empty());
    wish.captions_opacity = exhibit_->opacity();
  }
  std::vector<LocalText> words;
  words.reserve(wish.captions.size());
  for (const Caption& caption : wish.captions) {
    words.push_back(caption.text);
  }
  const bool faded = std::exchange(words_opacity_, wish.captions_opacity) != wish.captions_opacity;
  return std::exchange(words_, words) != words || faded;
}

std::string Player::help_text(HelpForm form) const {
  HelpChoice choice;
  choice.pads = !pad_snapshot_.pads.empty();
  choice.reader = exhibit_ ? ActionUser::visitor : ActionUser::presenter;
  choice.language = session_->playback().language();
  choice.form = form;
  return ergodome::help_text(inputs_.controls(), choice);
}

void Player::update_texts() {
  if (session_->playback().dark()) {
    // A blackout hides all text.
    for (const PanelPosition position :
         {PanelPosition::top_left, PanelPosition::bottom_middle, PanelPosition::middle}) {
      output_->set_text(position, "");
    }
    return;
  }
  std::string times;
  if (session_->times_shown()) {
    StereoSettings stereo = session_->frame().stereo;
    stereo.baseline = output_wish_.head ? head_baseline_ : stereo.baseline;
    times = times_text(pictures_.report(), stereo, pictures_.renderers().backend(), session_->playback().language());
    const CameraPose& pose = session_->frame().pose;
    times += '\n';
    times += text_in(readout_text(session_->spacetime(), pose.r, pose.theta), session_->playback().language());
    times += pictures_.budget() ? fmt::format("\n{}", pictures_.budget()->display_text()) : "";
  }
  output_->set_text(PanelPosition::top_left, times);
  // Captions for visitors use the same location as the session's caption, and replace it. It is
  // also hidden in the attract show, and while there is no renderer, because the attract show's
  // last picture may remain until then.
  const bool quiet = options_.quiet || !words_.empty() ||
                     (exhibit_ && (exhibit_->scene() == ExhibitScene::attract || !pictures_.renderers().current()));
  output_->set_text(PanelPosition::bottom_middle, quiet ? "" : session_->caption());
  output_->set_text(PanelPosition::middle, session_->help_shown() ? help_text(HelpForm::cells) : "");
}

void Player::post_status() {
  PlayerStatus status;
  session_->fill(status);
  status.baseline = output_wish_.head ? head_baseline_ : status.baseline;
  const PictureReport& report = pictures_.report();
  status.lens = report.lens;
  status.backend = pictures_.renderers().backend();
  status.display = output_->state_text();
  status.frame_ms = report.frame_time_ms;
  status.frames = report.pictures;
  status.problem = report.problem;
  frame_times_.note(session_->now_s(), report.frame_time_ms);
  status.baseline_used = report.reduced ? report.reduced->baseline : status.baseline;
  status.worst_frame_ms = frame_times_.worst_ms();
  for (const PadView& pad : pad_snapshot_.pads) {
    status.pads.push_back(
        {pad.identity->name, pad.identity->connection, pad_snapshot_.time_s - pad.last_input_s < 1.0});
  }
  if (status.problem.empty()) {
    status.problem = recording_problem_;
  }
  services_.fill(status);
  if (options_.cluster) {
    options_.cluster->fill(status);
  }
  if (exhibit_) {
    keep_settings(status);
    notify_supervisor(exhibit_->state_text(status));
  }
  services_.post(std::move(status));
}

void Player::print_statistics() const {
  if (pictures_.report().pictures > 0) {
    print_out("{} in {:.1f} s, not counting the first\n", counted(pictures_.report().pictures - 1, "frame"),
              std::chrono::duration<double>(Clock::now() - *first_answer_).count());
    if (pictures_.budget()) {
      print_out("{}\n", pictures_.budget()->summary_text());
    }
  }
  if (const auto streamed =
          pictures_.renderers().current() ? pictures_.renderers().current()->stream_statistics() : std::nullopt) {
    ergodome::print_statistics(*streamed);
  }
}

void Player::advance_exhibit(PlayerInput& input, bool arrived) {
  if (!exhibit_) {
    return;
  }
  const bool another = exhibit_->advance(session_->now_s(), arrived || inputs_.touched(), inputs_.chord_held());
  if (exhibit_->left()) {
    end("an operator ended it with keys or buttons");
  }
  if (exhibit_->scene() == ExhibitScene::attract) {
    input.actions.clear();  // visitors cannot control the attract show
    input.steering = {};
  }
  exhibit_->note(input.commands);
  operator_log_.note(input.commands, session_->now_s());
  services_.log_changes(operator_log_.take(session_->now_s()));
  if (exhibit_->take_return()) {
    input.actions.push_back(KeyAction::reset);
    services_.report(spdlog::level::info, "the view was completely black; the camera was reset to the start");
  }
  if (std::erase(input.actions, KeyAction::reset) > 0) {
    const std::vector<TransportCommand> reset = exhibit_->reset_commands();
    input.commands.insert(input.commands.end(), reset.begin(), reset.end());
  }
  if (another) {
    change_scene();
  }
}

bool Player::add_light(PictureRequest& wish) {
  const double now_s = session_->now_s();
  if (!exhibit_ || exhibit_->scene() != ExhibitScene::visitor || !light_watch_.is_due(now_s, session_->changed())) {
    return false;
  }
  wish.light_asked_s = now_s;
  return true;
}

void Player::note_light() {
  const std::optional<ViewLight>& light = pictures_.report().light;
  if (exhibit_ && light && light_watch_.take(light->asked_s)) {
    exhibit_->note_light(light->lit_part);
  }
}

void Player::change_scene() {
  const bool visitor = exhibit_->scene() == ExhibitScene::visitor;
  keep_recording(RecordingMoment::end);
  if (pictures_.renderers().renews()) {
    // The version that is being loaded will be discarded; it is read again when its scene returns.
    services_.forget_version();
  }
  pictures_.renderers().enter(exhibit_->scene(), exhibit_->show());
  begin(exhibit_->show(), visitor);
  light_watch_.begin(session_->now_s());
  services_.report(spdlog::level::info, visitor ? "a visitor arrived: free flight starts" : "the attract show starts");
}

void Player::keep_settings(PlayerStatus& status) {
  const std::string before = exhibit_->problem();
  exhibit_->keep(status, session_->playback().baseline().has_value());
  const std::string& now = exhibit_->problem();
  if (now != before) {
    const bool kept = now.empty();
    services_.report(kept ? spdlog::level::info : spdlog::level::err, kept ? "settings are saved again" : now);
  }
  if (status.problem.empty()) {
    status.problem = now;
  }
}

std::string Player::start_text() const {
  return fmt::format("exhibit started: ergodome {}, {}, {}, {}", ERGODOME_VERSION, exhibit_->shows_text(),
                     pictures_.renderers().backend(), services_.remote_text());
}

std::string Player::end_text() const {
  const std::string closed = why_ended_.empty() ? "the window was closed" : why_ended_;
  return "exhibit ended: " + (interrupted() ? "a signal was received" : closed);
}

}  // namespace ergodome
