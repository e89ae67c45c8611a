#include "app/live_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ergodome {

namespace {

constexpr double most_tilt_deg = 90.0;
constexpr double least_gamma = 0.1;
constexpr double most_gamma = 10.0;
constexpr double most_lift = 0.5;
//! Part of the dome's radius within which the viewer stays: beyond it a master has no direction for much of the dome.
constexpr double farthest_viewer = 0.95;

//! Names and usual steps, in the order of Adjustable. Corners move by pixels of the raster.
struct Quantity {
  const char* name;
  const char* unit;
  double step;
};

constexpr Quantity quantities[] = {
    {"tilt of the dome", " deg", 0.5},
    {"rotation of the picture", " deg", 0.5},
    {"viewer", " m", 0.1},
    {"top left corner", " px", 5.0},
    {"top right corner", " px", 5.0},
    {"bottom right corner", " px", 5.0},
    {"bottom left corner", " px", 5.0},
    {"gamma", "", 0.05},
    {"black level", "", 0.002},
};

const Quantity& quantity_of(Adjustable adjustable) { return quantities[static_cast<std::size_t>(adjustable)]; }

//! To the nearest thousandth of a step, so that many steps there and back leave no crumbs.
double tidy(double value, double step) {
  const double crumb = 1e-3 * step;
  return std::round(value / crumb) * crumb;
}

double turned(double angle_deg) {
  const double within = std::remainder(angle_deg, 360.0);
  return within == -180.0 ? 180.0 : within;
}

bool same_place(const Vector3<double>& a, const Vector3<double>& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

LiveCalibration::LiveCalibration(DomeSetup setup, int patterns)
    : setup_(std::move(setup)), saved_(setup_), corners_(setup_.projectors.size()), patterns_(patterns) {}

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
      adjustable_ =
          static_cast<Adjustable>(static_cast<int>(action) - static_cast<int>(CalibrationAction::choose_tilt));
      return Renewal::text;
  }
}

double LiveCalibration::step() const {
  constexpr double factors[] = {0.1, 1.0, 10.0};
  return quantity_of(adjustable_).step * factors[step_size_];
}

Corner LiveCalibration::corner() const {
  return static_cast<Corner>(static_cast<int>(adjustable_) - static_cast<int>(Adjustable::top_left));
}

Renewal LiveCalibration::adjust(const Way& way) {
  ProjectorSetup& projector = setup_.projectors[projector_];
  // Numbers alone go up with either arrow.
  const double more = step() * (way.up != 0 ? way.up : way.right);
  switch (adjustable_) {
    case Adjustable::tilt:
      setup_.tilt_deg = std::clamp(tidy(setup_.tilt_deg + more, step()), -most_tilt_deg, most_tilt_deg);
      return Renewal::master;
    case Adjustable::rotation:
      setup_.rotation_deg = turned(tidy(setup_.rotation_deg + more, step()));
      // In a dome that leans, patterns stay level.
      return Renewal::master;
    case Adjustable::viewer:
      return adjust_viewer(way, step());
    case Adjustable::gamma:
      projector.gamma = std::clamp(tidy(projector.gamma + more, step()), least_gamma, most_gamma);
      return Renewal::colours;
    case Adjustable::black_level:
      for (double* const lift :
           {&projector.black_level_lift.x, &projector.black_level_lift.y, &projector.black_level_lift.z}) {
        *lift = std::clamp(tidy(*lift + more, step()), 0.0, most_lift);
      }
      return Renewal::colours;
    default:
      return adjust_corner(way, step());
  }
}

Renewal LiveCalibration::adjust_viewer(const Way& way, double step_m) {
  const Vector3<double>& at = setup_.viewer_m;
  // Up on the screen is to the front of the dome.
  const Vector3<double> to = {tidy(at.x + step_m * way.right, step_m), tidy(at.y + step_m * way.upwards, step_m),
                              tidy(at.z - step_m * way.up, step_m)};
  if (!(std::sqrt(dot(to, to)) <= farthest_viewer * setup_.radius_m)) {
    return Renewal::nothing;
  }
  setup_.viewer_m = to;
  return Renewal::master;
}

Renewal LiveCalibration::adjust_corner(const Way& way, double step_px) {
  CornerOffsets& corners = corners_[projector_];
  const ProjectorSetup& projector = setup_.projectors[projector_];
  const auto index = static_cast<std::size_t>(corner());
  const auto moved = [&](double offset, int by, int side_px) {
    const double px = tidy(offset * side_px + step_px * by, step_px);
    return std::clamp(px / side_px, -CornerOffsets::farthest, CornerOffsets::farthest);
  };
  corners.right[index] = moved(corners.right[index], way.right, projector.width_px);
  corners.down[index] = moved(corners.down[index], -way.up, projector.height_px);
  return Renewal::warps;
}

Renewal LiveCalibration::undo() {
  ProjectorSetup& projector = setup_.projectors[projector_];
  const ProjectorSetup& before = saved_.projectors[projector_];
  switch (adjustable_) {
    case Adjustable::tilt:
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
    default:
      corners_[projector_].right[static_cast<std::size_t>(corner())] = 0.0;
      corners_[projector_].down[static_cast<std::size_t>(corner())] = 0.0;
      break;
  }
  return Renewal::master;
}

void LiveCalibration::note_saved(DomeSetup setup) {
  setup_ = std::move(setup);
  saved_ = setup_;
  corners_.assign(setup_.projectors.size(), {});
}

bool LiveCalibration::unsaved() const {
  const bool moved = std::ranges::any_of(corners_, [](const CornerOffsets& corners) { return !corners.none(); });
  bool coloured = false;
  for (std::size_t i = 0; i < setup_.projectors.size(); ++i) {
    const ProjectorSetup& now = setup_.projectors[i];
    const ProjectorSetup& before = saved_.projectors[i];
    coloured = coloured || now.gamma != before.gamma || !same_place(now.black_level_lift, before.black_level_lift);
  }
  return moved || coloured || setup_.tilt_deg != saved_.tilt_deg || setup_.rotation_deg != saved_.rotation_deg ||
         !same_place(setup_.viewer_m, saved_.viewer_m);
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
    default: {
      const auto index = static_cast<std::size_t>(corner());
      return fmt::format("{:.1f} px right, {:.1f} px down", corners_[projector_].right[index] * projector.width_px,
                         corners_[projector_].down[index] * projector.height_px);
    }
  }
}

std::string LiveCalibration::text() const {
  const Quantity& quantity = quantity_of(adjustable_);
  return fmt::format("projector {} of {}: {}\n{}: {}\nstep {:g}{}{}", projector_ + 1, setup_.projectors.size(),
                     setup_.projectors[projector_].name, quantity.name, value(), step(), quantity.unit,
                     unsaved() ? "   not saved yet" : "");
}

}  // namespace ergodome
