#pragma once

#include <memory>
#include <vector>

#include "render/lens/lens_chooser.h"
#include "render/lens/omni_lens.h"

namespace ergodome {

//! Makes the lenses of eyes that turn with the direction one looks at, and keeps the last two grids: a picture of a camera that stands still,
//! or goes round the axis, needs no new ones.
class OmniChooser {
 public:
  explicit OmniChooser(Backend backend) : backend_(backend) {}

  //! A ray a pixel where LensChooser takes it too, and on every GPU, and for budgets finer than rays in float; else a grid, whatever stream is
  //! asked for. A grid's cells are split for omni_budget_px.
  std::unique_ptr<LensSource> choose(const std::shared_ptr<const OmniEye>& eye, const Projection& projection,
                                     ViewMode mode, LensChoice choice, const LensAccuracy& accuracy);

 private:
  struct Grid {
    std::shared_ptr<const OmniEye> eye;
    double error;      //!< that it was built for [rad]
    double traced_px;  //!< area of what is left to rays [px²]
    std::shared_ptr<const StationBuffers> station;
  };

  const Grid& grid_for(const std::shared_ptr<const OmniEye>& eye, const GridSettings& settings);

  Backend backend_;
  std::vector<Grid> grids_;
};

//! What cells of such an eye's grid are split for, as far as rays in float go: then what lies between the places where cells are checked, and
//! the short pixels at the poles of a whole sky, are right to a fifth of a pixel but for one in a thousand. It costs a tenth of a picture.
inline constexpr double omni_budget_px = 0.025;

}  // namespace ergodome
