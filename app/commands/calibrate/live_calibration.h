#pragma once

#include <array>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/grid_offsets.h"

namespace ergodome {

//! Actions of keys during the calibration of a dome; calibration_keys.cpp describes each.
enum class CalibrationAction {
  none,
  quit,
  save,
  next_pattern,
  previous_pattern,
  next_projector,
  previous_projector,
  finer,
  coarser,
  undo,
  hide_text,
  show_keys,
  next_point,
  previous_point,
  finer_grid,
  left,
  right,
  up,
  down,
  upwards,
  downwards,
  choose_tilt,
  choose_rotation,
  choose_viewer,
  choose_top_left,
  choose_top_right,
  choose_bottom_right,
  choose_bottom_left,
  choose_gamma,
  choose_black_level,
  choose_gain,
};

//! Quantities that keys can change. The first three belong to the dome, the others to a projector.
enum class Adjustable {
  tilt,
  rotation,
  viewer,
  point,
  gamma,
  black_level,
  gain,
};

//! The update that an action requires: of the pattern on the domemaster, the warps, the projectors'
//! colors (gamma, black level, gain) or the texts. Each value includes all that follow it.
enum class Renewal { master, warps, colours, text, nothing };

//! The state of a live calibration: the setup, the selected projector and quantity, and the steps
//! and limits of changes. It does not depend on windows or files.
class LiveCalibration {
 public:
  //! `patterns` is the number of test patterns.
  LiveCalibration(DomeSetup setup, int patterns);

  //! Performs an action and returns what has to be updated. Quitting and saving change nothing
  //! here: the caller does them.
  Renewal press(CalibrationAction action);

  //! Takes over the saved setup, whose warps contain the offsets, and replaces all grids of offsets
  //! by grids of 2 x 2 points without offsets.
  void note_saved(DomeSetup setup);

  [[nodiscard]] const DomeSetup& setup() const { return setup_; }
  [[nodiscard]] const std::vector<GridOffsets>& offsets() const { return offsets_; }
  [[nodiscard]] std::size_t projector() const { return projector_; }
  [[nodiscard]] int pattern() const { return pattern_; }
  [[nodiscard]] Adjustable adjustable() const { return adjustable_; }
  [[nodiscard]] bool text_shown() const { return text_shown_; }
  [[nodiscard]] bool keys_shown() const { return keys_shown_; }

  //! Returns whether keys have changed a quantity since the setup was last read or saved; an offset
  //! counts as changed if it is not zero.
  [[nodiscard]] bool unsaved() const;

  //! Returns three lines: the selected projector, the selected quantity with its value, and the
  //! step of changes, with "not saved" if unsaved().
  [[nodiscard]] std::string text() const;

 private:
  static constexpr int all_colors = -1;

  //! Steps to the right (left and right arrow), up (up and down arrow) and upwards (page up and
  //! page down, which only raise or lower the viewer); each -1, 0 or 1.
  struct Way {
    int right = 0;
    int up = 0;
    int upwards = 0;
  };

  Renewal adjust(const Way& way);
  Renewal adjust_viewer(const Way& way, double step_m);
  Renewal adjust_point(const Way& way, double step_px);
  Renewal adjust_gain(double more);
  Renewal choose(CalibrationAction action);
  Renewal choose_corner(bool right, bool bottom);
  Renewal step_point(int by);
  Renewal refine_grid();
  [[nodiscard]] double step() const;
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string value() const;
  Renewal undo();

  DomeSetup setup_;
  DomeSetup saved_;
  std::vector<GridOffsets> offsets_;
  std::size_t point_ = 0;        //!< index in the projector's grid, row by row
  int gain_color_ = all_colors;  //!< 0 red, 1 green, 2 blue, or all_colors
  int patterns_;
  std::size_t projector_ = 0;
  int pattern_ = 0;
  Adjustable adjustable_ = Adjustable::tilt;
  int step_size_ = 1;  //!< 0 fine, 1 default, 2 coarse
  bool text_shown_ = true;
  bool keys_shown_ = true;
};

}  // namespace ergodome
