#include "app/commands/calibrate/calibration_window.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/cli/setup_show.h"
#include "app/commands/calibrate/calibration_keys.h"
#include "app/commands/calibrate/saved_calibration.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "kernels/core/error.h"
#include "render/output/image_writer.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

namespace {

//! Returns the number of patterns: those of the domemaster, and one that shows each projector's
//! number.
int pattern_count() { return static_cast<int>(test_pattern_names().size()) + 1; }

constexpr int key_font_px = 14;
constexpr int first_master_px = 512;

//! Returns the indices of the projectors of this computer: all, or those without a node.
std::vector<std::size_t> own_projectors(const DomeSetup& setup, bool cluster) {
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < setup.projectors.size(); ++i) {
    if (!cluster || setup.projectors[i].node.empty()) {
      own.push_back(i);
    }
  }
  return own;
}

DomeSetup own_setup(const DomeSetup& setup, bool cluster) { return cluster ? part_of_setup(setup, "") : setup; }

}  // namespace

CalibrationWindow::CalibrationWindow(const LiveOptions& options)
    : options_(options),
      state_(read_dome_setup(options.setup), pattern_count()),
      pictures_(state_.setup(), MaskDetail::preview),
      own_(own_projectors(state_.setup(), options.cluster)),
      window_(700, 700, "Ergodome calibrate", false),
      projectors_(window_, own_setup(state_.setup(), options.cluster), own_pictures(), options.hide_control,
                  WarpUse::adjusted) {
  if (options_.cluster) {
    host_ = open_cluster(state_.setup());
  }
  if (options_.master_px <= 0) {
    options_.master_px = enough_master_px(pictures_.pictures());
  }
  // Shows a small pattern at once; run() draws the full-size one.
  drawn_px_ = std::min(options_.master_px, first_master_px);
  renewal_ = Renewal::master;
  try {
    require_writable(options_.setup);
  } catch (const Error& problem) {
    // Patterns can still be shown, but the operator has to know now that nothing can be saved.
    message_ = std::string("cannot save: ") + problem.what();
    report_refusal(problem.what());
  }
  renew_master();
  renew_text();
}

void CalibrationWindow::run() {
  const auto start = Clock::now();
  draw();
  drawn_px_ = options_.master_px;
  while (!window_.closed() && !projectors_.closed() && !interrupted()) {
    for (const WindowEvent& event : window_.events(0.02)) {
      handle(event);
    }
    for (const WindowEvent& event : projectors_.events()) {
      handle(event);
    }
    repeat_held_key();
    renew();
    advance_cluster();
    draw();
    refine();
    if (options_.for_seconds > 0.0 &&
        std::chrono::duration<double>(Clock::now() - start).count() >= options_.for_seconds) {
      break;
    }
  }
  if (!options_.screenshot.empty()) {
    while (refine()) {
    }
    projectors_.save_screenshots(options_.screenshot, plain_names(own_setup(state_.setup(), options_.cluster)));
  }
  if (state_.unsaved()) {
    print_out("changes were not saved\n");
  }
}

void CalibrationWindow::handle(const WindowEvent& event) {
  if (event.kind == WindowEvent::Kind::key_down) {
    act(calibration_action_of(event.key));
    keys_.press(event.key, Clock::now());
  } else if (event.kind == WindowEvent::Kind::key_up) {
    keys_.release(event.key);
  }
}

void CalibrationWindow::repeat_held_key() {
  const std::optional<int> key = keys_.due(Clock::now());
  const CalibrationAction action = key ? calibration_action_of(*key) : CalibrationAction::none;
  if (action >= CalibrationAction::left && action <= CalibrationAction::downwards) {
    act(action);
    keys_.repeated(Clock::now());
  }
}

void CalibrationWindow::act(CalibrationAction action) {
  if (action == CalibrationAction::quit) {
    window_.close();
  } else if (action == CalibrationAction::save) {
    renew();
    save();
  } else if (needs_nodes(action)) {
    message_ = "copy " + options_.setup + " and its warps to the nodes, and start this program again";
    renewal_ = std::min(renewal_, Renewal::text);
  } else {
    message_.clear();
    renewal_ = std::min(renewal_, state_.press(action));
  }
}

void CalibrationWindow::save() {
  try {
    const DomeSetup& setup = state_.setup();
    // Throws if the setup cannot be shown: once saved, it could not be opened again.
    pictures_.follow(setup, state_.offsets());
    const bool behind = pictures_.leaves_behind(setup);
    state_.note_saved(save_calibration(options_.setup, pictures_.without_outdated(setup), state_.offsets(),
                                       pictures_.outdated(setup)));
    message_ = "saved to " + options_.setup;
    message_ +=
        behind ? "; patterns use the new tilt, but some warp files still contain the old one:\nrecompute them with the "
                 "program that made them"
               : "";
    // From here on, the window shows the contents of the saved files.
    pictures_ = DomePictures(state_.setup());
    saved_ = true;
    for (std::size_t window = 0; window < own_.size(); ++window) {
      projectors_.replace(window, pictures_.pictures()[own_[window]]);
    }
    reported_refusal_.clear();
    print_out("{}\n", message_);
  } catch (const Error& problem) {
    // The adjustments are kept and can be saved once the cause is removed.
    message_ = std::string("cannot save: ") + problem.what();
    report_refusal(problem.what());
  }
  renew_text();
}

void CalibrationWindow::report_refusal(const std::string& problem) {
  if (std::exchange(reported_refusal_, problem) != problem) {
    print_note("cannot save: {}", problem);
  }
}

void CalibrationWindow::renew() {
  const Renewal renewal = std::exchange(renewal_, Renewal::nothing);
  if (renewal == Renewal::nothing) {
    return;
  }
  const bool shown = renewal > Renewal::colours || renew_projectors();
  if (renewal <= Renewal::master && shown) {
    renew_master();
  }
  renew_text();
  publish();
}

bool CalibrationWindow::refine() {
  const std::optional<std::size_t> projector = pictures_.refine_mask();
  if (projector && window_of(*projector)) {
    projectors_.replace(*window_of(*projector), pictures_.pictures()[*projector]);
  }
  return projector.has_value();
}

std::optional<std::size_t> CalibrationWindow::window_of(std::size_t projector) const {
  const auto found = std::ranges::find(own_, projector);
  return found == own_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - own_.begin()));
}

std::vector<ProjectorPicture> CalibrationWindow::own_pictures() const {
  std::vector<ProjectorPicture> own;
  own.reserve(own_.size());
  for (const std::size_t i : own_) {
    own.push_back(pictures_.pictures()[i]);
  }
  return own;
}

bool CalibrationWindow::needs_nodes(CalibrationAction action) const {
  switch (action) {
    case CalibrationAction::none:
    case CalibrationAction::next_pattern:
    case CalibrationAction::previous_pattern:
    case CalibrationAction::next_projector:
    case CalibrationAction::previous_projector:
    case CalibrationAction::hide_text:
    case CalibrationAction::show_keys:
      return false;
    default:
      // Nodes add changes to their own files, which lack those that were saved.
      return host_ && saved_;
  }
}

void CalibrationWindow::publish() {
  if (!host_) {
    return;
  }
  if (!saved_) {
    const std::string setup = to_toml(state_.setup());
    if (setup.size() > max_cluster_setup) {
      throw Error(options_.setup, "is too long for nodes", "calibrate each computer by itself, without --cluster");
    }
    host_->master->set_calibration({0, setup, state_.offsets(), texts()});
  }
  ClusterFrame frame;
  frame.pose.r = 1.0;
  frame.pose.orientation = glm::dquat(1.0, 0.0, 0.0, 0.0);
  frame.size_px = options_.master_px;
  frame.projectors_px = options_.master_px;
  const bool numbers = state_.pattern() + 1 == pattern_count();
  frame.pattern = numbers ? ClusterPattern::projector_numbers : ClusterPattern::test_pattern;
  frame.pattern_kind = state_.pattern();
  host_->master->publish(std::move(frame));
}

void CalibrationWindow::advance_cluster() {
  if (!host_) {
    return;
  }
  // The windows here need not wait for the nodes: patterns stand still.
  (void)host_->master->release();
  for (const ClusterNews& news : host_->master->take_news()) {
    print_note("{}", news.text);
  }
}

std::string CalibrationWindow::pattern_name() const {
  const auto& names = test_pattern_names();
  const auto pattern = static_cast<std::size_t>(state_.pattern());
  return pattern < names.size() ? names[pattern] : "projector numbers";
}

void CalibrationWindow::renew_master() {
  const bool numbers = state_.pattern() + 1 == pattern_count();
  for (std::size_t window = 0; window < own_.size(); ++window) {
    if (numbers) {
      const ProjectorPicture& raster = pictures_.pictures()[own_[window]];
      const Picture page =
          draw_projector_number(static_cast<int>(own_[window]) + 1, raster.name, raster.width_px, raster.height_px);
      projectors_.set_raster(window, &page);
    } else {
      projectors_.set_raster(window, nullptr);
    }
  }
  if (!numbers) {
    presenter_.upload(
        draw_test_pattern(static_cast<TestPattern>(state_.pattern()), upright_master(state_.setup(), drawn_px_)));
  }
}

bool CalibrationWindow::renew_projectors() {
  try {
    const bool masks = pictures_.follow(state_.setup(), state_.offsets());
    for (std::size_t window = 0; window < own_.size(); ++window) {
      const ProjectorPicture& picture = pictures_.pictures()[own_[window]];
      masks ? projectors_.replace(window, picture) : projectors_.change(window, picture);
    }
    return true;
  } catch (const Error& problem) {
    // Keeps the last valid pictures until another key makes the setup valid again.
    message_ = problem.what();
    return false;
  }
}

std::vector<std::string> CalibrationWindow::texts() const {
  const std::string adjusted =
      state_.text() + "\npattern: " + pattern_name() + "   F1: keys" + (message_.empty() ? "" : "\n" + message_) +
      (state_.keys_shown() && !projectors_.control_shown() ? "\n\n" + calibration_key_lines("") : "");
  std::vector<std::string> texts;
  texts.reserve(pictures_.pictures().size());
  for (std::size_t i = 0; i < pictures_.pictures().size(); ++i) {
    const std::string other = fmt::format("{}: {}", i + 1, pictures_.pictures()[i].name);
    texts.push_back(!state_.text_shown() ? "" : i == state_.projector() ? adjusted : other);
  }
  return texts;
}

void CalibrationWindow::renew_text() {
  const std::vector<std::string> all = texts();
  for (std::size_t window = 0; window < own_.size(); ++window) {
    projectors_.set_text(window, all[own_[window]]);
  }
  const bool on_control = projectors_.control_shown();
  window_.make_current();
  keys_panel_.set(state_.keys_shown() && on_control ? calibration_key_lines("") : "", key_font_px,
                  TextFace::monospaced);
  std::string title = "Ergodome calibrate  " + state_.text();
  for (char& c : title) {
    c = c == '\n' ? ' ' : c;
  }
  window_.set_title(title);
}

void CalibrationWindow::draw() {
  projectors_.show(presenter_.shown());
  if (projectors_.control_shown()) {
    int width = 0;
    int height = 0;
    window_.framebuffer_size(width, height);
    presenter_.draw(width, height);
    keys_panel_.draw(width, height, PanelPosition::top_left);
    window_.swap();
  }
}

}  // namespace ergodome
