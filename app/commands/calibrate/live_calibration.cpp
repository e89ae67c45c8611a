#include "app/commands/calibrate/live_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ergodome {

namespace {

constexpr double max_tilt_deg = 90.0;
constexpr double min_gamma = 0.1;
constexpr double max_gamma = 10.0;
constexpr double max_lift = 0.5;
//! Limit of the viewer's distance from the center, as a fraction of the dome's radius: beyond it, a
//! domemaster has no direction for much of the dome.
constexpr double farthest_viewer = 0.95;

//! Range of gains that keys can set. Setups allow gains from 0 to max_gain.
constexpr double min_gain = 0.05;
constexpr double max_gain = 10.0;

//! Names, units and default steps, in the order of Adjustable. Grid points move in pixels of the
//! raster.
struct Quantity {
  const char* name;
  const char* unit;
  double step;
};

constexpr Quantity quantities[] = {
    {"tilt of the dome", " deg", 0.5},
    {"rotation of the picture", " deg", 0.5},
    {"viewer position", " m", 0.1},
    {"point", " px", 5.0},
    {"gamma", "", 0.05},
    {"black level", "", 0.002},
    {"gain", "", 0.02},
};

const Quantity& quantity_of(Adjustable adjustable) { return quantities[static_cast<std::size_t>(adjustable)]; }

//! Rounds a value to a multiple of a thousandth of a step, so that steps back and forth leave no
//! rounding errors.
double tidy(double value, double step) {
  const double crumb = 1e-3 * step;
  return std::round(value / crumb) * crumb;
}

double turned(double angle_deg) {
  const double within = std::remainder(angle_deg, 360.0);
  return within == -180.0 ? 180.0 : within;
}

bool same_values(const Vector3<double>& a, const Vector3<double>& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

LiveCalibration::LiveCalibration(DomeSetup setup, int patterns)
    : setup_(std::move(setup)), saved_(setup_), offsets_(setup_.projectors.size()), patterns_(patterns) {}

Renewal LiveCalibration::press(CalibrationAction action) {
  const int count = static_cast<int>(setup_.projectors.size());
  const auto next = [](int at, int by, int of) { return (at + by + of) % of; };
  switch (action) {
    case CalibrationAction::next_pattern:
    case CalibrationAction::previous_pattern:
      pattern_ = next(pattern_, action == CalibrationAction::next_pattern ? 1 : -1, patterns_);
      return Renewal::master;
    case CalibrationAction::next_projector:
    case CalibrationAction::previous_projector:
      projector_ = static_cast<std::size_t>(
          next(static_cast<int>(projector_), action == CalibrationAction::next_projector ? 1 : -1, count));
      // The new projector's grid may have fewer points.
      point_ = std::min(point_, offsets_[projector_].right.size() - 1);
      return Renewal::text;
    case CalibrationAction::finer:
      step_size_ = std::max(step_size_ - 1, 0);
      return Renewal::text;
    case CalibrationAction::coarser:
      step_size_ = std::min(step_size_ + 1, 2);
      return Renewal::text;
    case CalibrationAction::hide_text:
      text_shown_ = !text_shown_;
      return Renewal::text;
    case CalibrationAction::show_keys:
      keys_shown_ = !keys_shown_;
      return Renewal::text;
    case CalibrationAction::next_point:
      return step_point(1);
    case CalibrationAction::previous_point:
      return step_point(-1);
    case CalibrationAction::finer_grid:
      return refine_grid();
    case CalibrationAction::undo:
      return undo();
    case CalibrationAction::left:
      return adjust({-1, 0, 0});
    case CalibrationAction::right:
      return adjust({1, 0, 0});
    case CalibrationAction::up:
      return adjust({0, 1, 0});
    case CalibrationAction::down:
      return adjust({0, -1, 0});
    case CalibrationAction::upwards:
      return adjust({0, 0, 1});
    case CalibrationAction::downwards:
      return adjust({0, 0, -1});
    case CalibrationAction::none:
    case CalibrationAction::quit:
    case CalibrationAction::save:
      return Renewal::nothing;
    default:
      return choose(action);
  }
}

Renewal LiveCalibration::choose(CalibrationAction action) {
  switch (action) {
    case CalibrationAction::choose_top_left:
      return choose_corner(false, false);
    case CalibrationAction::choose_top_right:
      return choose_corner(true, false);
    case CalibrationAction::choose_bottom_right:
      return choose_corner(true, true);
    case CalibrationAction::choose_bottom_left:
      return choose_corner(false, true);
    case CalibrationAction::choose_gain:
      // Pressing the key again selects red, green or blue alone, and after blue all colors again.
      gain_color_ = adjustable_ != Adjustable::gain || gain_color_ == 2 ? all_colors : gain_color_ + 1;
      adjustable_ = Adjustable::gain;
      break;
    case CalibrationAction::choose_rotation:
      adjustable_ = Adjustable::rotation;
      break;
    case CalibrationAction::choose_viewer:
      adjustable_ = Adjustable::viewer;
      break;
    case CalibrationAction::choose_gamma:
      adjustable_ = Adjustable::gamma;
      break;
    case CalibrationAction::choose_black_level:
      adjustable_ = Adjustable::black_level;
      break;
    default:
      adjustable_ = Adjustable::tilt;
  }
  return Renewal::text;
}

Renewal LiveCalibration::choose_corner(bool right, bool bottom) {
  const auto last = static_cast<std::size_t>(offsets_[projector_].points - 1);
  adjustable_ = Adjustable::point;
  point_ = (bottom ? last * (last + 1) : 0) + (right ? last : 0);
  return Renewal::text;
}

Renewal LiveCalibration::step_point(int by) {
  const int count = static_cast<int>(offsets_[projector_].right.size());
  // If another quantity was selected, this press only selects the current point of the grid.
  const int step = adjustable_ == Adjustable::point ? by : 0;
  adjustable_ = Adjustable::point;
  point_ = static_cast<std::size_t>((static_cast<int>(point_) + step + count) % count);
  return Renewal::text;
}

Renewal LiveCalibration::refine_grid() {
  GridOffsets& grid = offsets_[projector_];
  const auto* const now = std::ranges::find(GridOffsets::sizes, grid.points);
  const bool finest = std::next(now) == GridOffsets::sizes.end();
  const GridOffsets coarse = grid.resized(GridOffsets::sizes.front());
  // From the finest grid, returns to the coarsest one, which has points only at the corners, unless
  // that would lose offsets.
  if (finest && !(grid.none() || coarse.resized(grid.points) == grid)) {
    return Renewal::nothing;
  }
  const int before = grid.points;
  grid = finest ? coarse : grid.resized(*std::next(now));
  // Keeps the position of the selected point, or selects the point nearest to it.
  const auto along = [&](std::size_t at) {
    return static_cast<std::size_t>(
        std::lround(static_cast<double>(at) / (before - 1) * static_cast<double>(grid.points - 1)));
  };
  const auto side = static_cast<std::size_t>(before);
  point_ = along(point_ / side) * static_cast<std::size_t>(grid.points) + along(point_ % side);
  adjustable_ = Adjustable::point;
  return Renewal::warps;
}

double LiveCalibration::step() const {
  constexpr double factors[] = {0.1, 1.0, 10.0};
  return quantity_of(adjustable_).step * factors[step_size_];
}

Renewal LiveCalibration::adjust(const Way& way) {
  ProjectorSetup& projector = setup_.projectors[projector_];
  // A single value increases with both the up and the right arrow.
  const double more = step() * (way.up != 0 ? way.up : way.right);
  switch (adjustable_) {
    case Adjustable::tilt:
      setup_.tilt_known = true;
      setup_.tilt_deg = std::clamp(tidy(setup_.tilt_deg + more, step()), -max_tilt_deg, max_tilt_deg);
      return Renewal::master;
    case Adjustable::rotation:
      setup_.rotation_deg = turned(tidy(setup_.rotation_deg + more, step()));
      // Patterns stay level in a tilted dome, so a new rotation requires a new domemaster.
      return Renewal::master;
    case Adjustable::viewer:
      return adjust_viewer(way, step());
    case Adjustable::gamma:
      projector.gamma = std::clamp(tidy(projector.gamma + more, step()), min_gamma, max_gamma);
      return Renewal::colours;
    case Adjustable::black_level:
      for (double* const lift :
           {&projector.black_level_lift.x, &projector.black_level_lift.y, &projector.black_level_lift.z}) {
        *lift = std::clamp(tidy(*lift + more, step()), 0.0, max_lift);
      }
      return Renewal::colours;
    case Adjustable::gain:
      return adjust_gain(more);
    case Adjustable::point:
      break;
  }
  return adjust_point(way, step());
}

Renewal LiveCalibration::adjust_gain(double more) {
  Vector3<double>& gain = setup_.projectors[projector_].gain;
  double* const colors[] = {&gain.x, &gain.y, &gain.z};
  for (int color = 0; color < 3; ++color) {
    if (gain_color_ == all_colors || gain_color_ == color) {
      *colors[color] = std::clamp(tidy(*colors[color] + more, step()), min_gain, max_gain);
    }
  }
  return Renewal::colours;
}

Renewal LiveCalibration::adjust_viewer(const Way& way, double step_m) {
  const Vector3<double>& at = setup_.viewer_m;
  // Up on the screen is toward the front of the dome.
  const Vector3<double> to = {tidy(at.x + step_m * way.right, step_m), tidy(at.y + step_m * way.upwards, step_m),
                              tidy(at.z - step_m * way.up, step_m)};
  if (!(std::sqrt(dot(to, to)) <= farthest_viewer * setup_.radius_m)) {
    return Renewal::nothing;
  }
  setup_.viewer_m = to;
  return Renewal::master;
}

Renewal LiveCalibration::adjust_point(const Way& way, double step_px) {
  GridOffsets& grid = offsets_[projector_];
  const ProjectorSetup& projector = setup_.projectors[projector_];
  const auto moved = [&](double offset, int by, int side_px) {
    return by == 0 ? offset : tidy(offset * side_px + step_px * by, step_px) / side_px;
  };
  grid.move(point_, moved(grid.right[point_], way.right, projector.width_px),
            moved(grid.down[point_], -way.up, projector.height_px));
  return Renewal::warps;
}

Renewal LiveCalibration::undo() {
  ProjectorSetup& projector = setup_.projectors[projector_];
  const ProjectorSetup& before = saved_.projectors[projector_];
  switch (adjustable_) {
    case Adjustable::tilt:
      setup_.tilt_known = saved_.tilt_known;
      setup_.tilt_deg = saved_.tilt_deg;
      break;
    case Adjustable::rotation:
      setup_.rotation_deg = saved_.rotation_deg;
      break;
    case Adjustable::viewer:
      setup_.viewer_m = saved_.viewer_m;
      break;
    case Adjustable::gamma:
      projector.gamma = before.gamma;
      break;
    case Adjustable::black_level:
      projector.black_level_lift = before.black_level_lift;
      break;
    case Adjustable::gain:
      projector.gain = before.gain;
      break;
    case Adjustable::point:
      offsets_[projector_].move(point_, 0.0, 0.0);
      break;
  }
  return Renewal::master;
}

void LiveCalibration::note_saved(DomeSetup setup) {
  setup_ = std::move(setup);
  saved_ = setup_;
  offsets_.assign(setup_.projectors.size(), {});
  point_ = std::min<std::size_t>(point_, 3);
}

bool LiveCalibration::unsaved() const {
  const bool moved = std::ranges::any_of(offsets_, [](const GridOffsets& grid) { return !grid.none(); });
  bool coloured = false;
  for (std::size_t i = 0; i < setup_.projectors.size(); ++i) {
    const ProjectorSetup& now = setup_.projectors[i];
    const ProjectorSetup& before = saved_.projectors[i];
    coloured = coloured || now.gamma != before.gamma || !same_values(now.gain, before.gain) ||
               !same_values(now.black_level_lift, before.black_level_lift);
  }
  return moved || coloured || setup_.tilt_deg != saved_.tilt_deg || setup_.rotation_deg != saved_.rotation_deg ||
         !same_values(setup_.viewer_m, saved_.viewer_m);
}

std::string LiveCalibration::value() const {
  const ProjectorSetup& projector = setup_.projectors[projector_];
  switch (adjustable_) {
    case Adjustable::tilt:
      return fmt::format("{:.2f} deg", setup_.tilt_deg);
    case Adjustable::rotation:
      return fmt::format("{:.2f} deg to the right", setup_.rotation_deg);
    case Adjustable::viewer:
      return fmt::format("{:.2f} m right, {:.2f} m up, {:.2f} m back", setup_.viewer_m.x, setup_.viewer_m.y,
                         setup_.viewer_m.z);
    case Adjustable::gamma:
      return fmt::format("{:.3f}", projector.gamma);
    case Adjustable::black_level:
      return fmt::format("{:.4f}, {:.4f}, {:.4f} of full light", projector.black_level_lift.x,
                         projector.black_level_lift.y, projector.black_level_lift.z);
    case Adjustable::gain:
      return fmt::format("{:.3f} red, {:.3f} green, {:.3f} blue", projector.gain.x, projector.gain.y, projector.gain.z);
    case Adjustable::point:
      break;
  }
  const GridOffsets& grid = offsets_[projector_];
  return fmt::format("{:.1f} px right, {:.1f} px down", grid.right[point_] * projector.width_px,
                     grid.down[point_] * projector.height_px);
}

std::string LiveCalibration::name() const {
  constexpr const char* corner_names[] = {"top left corner", "top right corner", "bottom left corner",
                                          "bottom right corner"};
  constexpr const char* gain_names[] = {"gain", "gain of red", "gain of green", "gain of blue"};
  if (adjustable_ == Adjustable::gain) {
    return gain_names[gain_color_ + 1];
  }
  if (adjustable_ != Adjustable::point) {
    return quantity_of(adjustable_).name;
  }
  const auto points = static_cast<std::size_t>(offsets_[projector_].points);
  if (points == 2) {
    return corner_names[point_];
  }
  return fmt::format("point in column {}, row {} of {} x {}", point_ % points + 1, point_ / points + 1, points, points);
}

std::string LiveCalibration::text() const {
  const Quantity& quantity = quantity_of(adjustable_);
  return fmt::format("projector {} of {}: {}\n{}: {}\nstep {:g}{}{}", projector_ + 1, setup_.projectors.size(),
                     setup_.projectors[projector_].name, name(), value(), step(), quantity.unit,
                     unsaved() ? "   not saved" : "");
}

}  // namespace ergodome
