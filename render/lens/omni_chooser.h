#pragma once

#include <memory>
#include <vector>

#include "render/lens/lens_chooser.h"
#include "render/lens/omni_lens.h"

namespace ergodome {

//! Creates the lenses of ODS eyes and caches the last two grids: frames of a camera that stands
//! still or circles the axis reuse them.
class OmniChooser {
 public:
  explicit OmniChooser(Backend backend) : backend_(backend) {}

  //! Creates the lens of an eye: one ray per pixel where LensChooser does so too, on a GPU, and for
  //! budgets too fine for float; otherwise a grid, whose cells are split for omni_budget_px. Never
  //! streams.
  std::unique_ptr<LensSource> choose(const std::shared_ptr<const OmniEye>& eye, const Projection& projection,
                                     ViewMode mode, LensChoice choice, const LensAccuracy& accuracy);

 private:
  struct Grid {
    std::shared_ptr<const OmniEye> eye;
    double error;      //!< for which it was built [rad]
    double traced_px;  //!< area left to traced rays [px²]
    std::shared_ptr<const StationBuffers> station;
  };

  const Grid& grid_for(const std::shared_ptr<const OmniEye>& eye, const GridSettings& settings);

  Backend backend_;
  std::vector<Grid> grids_;
};

//! Error budget for splitting the cells of an ODS eye's grid, as far as float rays allow. With it,
//! positions between the checks and the short pixels at the poles of a whole sky are accurate to a
//! fifth of a pixel, except for one in a thousand. It adds a tenth to the cost of a frame.
inline constexpr double omni_budget_px = 0.025;

}  // namespace ergodome
