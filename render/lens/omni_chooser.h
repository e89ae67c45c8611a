#pragma once

#include <memory>
#include <vector>

#include "render/lens/lens_chooser.h"
#include "render/lens/omni_lens.h"

namespace ergodome {

//! Creates the lenses of ODS eyes. Caches the last two grids, which frames of a camera that stands
//! still or circles the spin axis use again.
class OmniChooser {
 public:
  explicit OmniChooser(Backend backend) : backend_(backend) {}

  //! Creates the lens of an eye. Traces one ray per pixel on a GPU, for LensChoice::direct, and in
  //! view modes that show rays (shows_rays()). LensChoice::automatic also does so for small frames,
  //! for budgets too small for float, and if a grid would leave a quarter of the pixels or more to
  //! rays. Otherwise builds a grid with the error budget omni_budget_px, or a smaller
  //! `accuracy.budget_px`. Never uses baked stations.
  std::unique_ptr<LensSource> choose(const std::shared_ptr<const OmniEye>& eye, const Projection& projection,
                                     ViewMode mode, LensChoice choice, const LensAccuracy& accuracy);

 private:
  struct Grid {
    std::shared_ptr<const OmniEye> eye;
    double error;      //!< budget of displacements on the screen for which the grid was built [rad]
    double traced_px;  //!< area of the screen whose pixels are left to traced rays [px²]
    std::shared_ptr<const StationBuffers> station;
  };

  const Grid& grid_for(const std::shared_ptr<const OmniEye>& eye, const GridSettings& settings);

  Backend backend_;
  std::vector<Grid> grids_;
};

//! Error budget of an ODS eye's grid when its cells are split; limited by the accuracy of float
//! rays. It is smaller than the accepted error, because positions between the check points and the
//! narrow pixels at the poles of a full-sky picture are less accurate: with it, all but one in a
//! thousand of them are accurate to a fifth of a pixel. It adds a tenth to the cost of a frame.
inline constexpr double omni_budget_px = 0.025;

}  // namespace ergodome
