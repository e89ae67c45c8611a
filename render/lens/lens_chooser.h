#pragma once

#include <list>
#include <memory>

#include "kernels/image/shade_pixels.h"
#include "render/lens/grid_lens.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! How exact a lens has to be, as a displacement on the screen.
struct LensAccuracy {
  double budget_px = 0.25;     //!< for what is read from a grid
  double tolerance_px = 0.05;  //!< for a traced ray
};

//! Makes the lens of each picture, and keeps the last grids: a camera that turns, changes its motion or goes round the hole's axis
//! needs no new one.
class LensChooser {
 public:
  explicit LensChooser(Backend backend) : backend_(backend) {}

  //! The lens for an eye's image. Views that show what rays do (steps, error, order) trace them, whatever is asked. With
  //! LensChoice::automatic small pictures, all pictures on a GPU, and places where most of a grid would be left to rays, are traced.
  std::unique_ptr<LensSource> choose(LensChoice choice, const EyeCamera& eye, const Projection& projection,
                                     ViewMode mode, const LensAccuracy& accuracy);

  //! Number of grids built so far.
  [[nodiscard]] int built() const { return built_; }

 private:
  //! What a grid was built for.
  struct Grid {
    double spin;
    double r;
    double theta;
    double error;  //!< budget in radians
    ObserverMotion motion;
    Vector3<double> velocity;
    double traced_px;  //!< pixels of the image that the grid leaves to rays
    std::shared_ptr<const StationBuffers> station;
  };

  const Grid& grid_for(const EyeCamera& eye, const Projection& projection, double budget_px);

  Backend backend_;
  int built_ = 0;
  std::list<Grid> grids_;  //!< the latest first
};

}  // namespace ergodome
