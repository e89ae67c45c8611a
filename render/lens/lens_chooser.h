#pragma once

#include <cmath>
#include <list>
#include <memory>
#include <optional>
#include <utility>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/grid_lens.h"
#include "render/lens/grid/grid_worker.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_stream.h"
#include "render/published/quadtree_builder.h"

namespace ergodome {

//! How exact a lens has to be, as a displacement on the screen.
struct LensAccuracy {
  double budget_px = 0.25;     //!< for what is read from a grid
  double tolerance_px = 0.05;  //!< for a traced ray
};

//! When in a show a picture is taken, where a lens may be streamed.
struct ShowMoment {
  std::optional<double> time_s;   //!< nothing: the camera is not on the show's path
  double patience_s = forever_s;  //!< how long to wait for stations that are not there yet, and for live grids

  static constexpr double forever_s = 1e6;
};

//! What a lens is asked for.
struct LensRequest {
  LensChoice choice = LensChoice::automatic;
  EyeCamera eye{};
  Projection projection{};
  ViewMode mode = ViewMode::sky;
  LensAccuracy accuracy{};
  ShowMoment moment{};
  GridScheme scheme = GridScheme::conforming;
};

//! Whether an eye is beside the path of a show's camera: one of two. A single eye is on it but for rounding.
inline bool is_beside(const EyeCamera& eye) {
  return std::abs(eye.r - eye.head_r) > 1e-12 * eye.head_r || std::abs(eye.theta - eye.head_theta) > 1e-12;
}

//! Whether baked stations are exact to `error` [rad].
bool holds_budget(const TrajectoryProvenance& baked, double error);

//! Whether baked stations may serve an eye's pictures that have to be exact to `error` [rad].
bool may_stream(const TrajectoryProvenance& baked, LensChoice choice, const EyeCamera& eye, double error);

//! What an eye beside the path, or between stations that are not neighbours, may be shown wrong by, in a picture with a budget and a pixel [rad].
double allowed_unmeasured_px(const TrajectoryProvenance& baked, double budget_px, double pixel);

//! Makes the lens of each picture, from a stream of baked stations where there is one, and keeps the last grids of its own: a camera
//! that turns, changes its motion or goes round the hole's axis needs no new one.
class LensChooser {
 public:
  explicit LensChooser(Backend backend, std::shared_ptr<StationStream> stream = nullptr)
      : backend_(backend), stream_(std::move(stream)), tracer_(backend) {}

  //! Streams from other stations from now on, or from none.
  void set_stream(std::shared_ptr<StationStream> stream) { stream_ = std::move(stream); }

  //! The lens for an eye's image. Views that show what rays do (steps, error, order) trace them, whatever is asked.
  //!
  //! LensChoice::automatic streams where the camera is on a baked path and the bake is fine enough. Else small pictures, all pictures on a
  //! GPU, and places where most of a grid would be left to rays, are traced. LensChoice::streamed takes a live grid where the stream has
  //! nothing: off the path, or while it reads. Where grids have the shadow's edge farther off than the budget (EdgeMiss) there are rays, whatever is
  //! asked.
  //!
  //! On a GPU live grids are traced there, within the picture. On the processor they are built on a thread of their own; one that does
  //! not come within the moment's patience is for the next picture, and this one is the view from where the last grid was built
  //! (LensSource::behind). Two eyes wait: they must see from one moment.
  //!
  //! GridScheme::quadtree takes the published quadtree grid of the eye's own place and motion for all but direct rays.
  //!
  //! Gaps between stations that miss the budget all the same have live grids. An eye beside the path is served by the stations' derivatives as long as traced rays confirm it, and so is a picture between stations of which some
  //! could not be read; beyond, it gets a live grid.
  std::unique_ptr<LensSource> choose(const LensRequest& request);

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

  std::unique_ptr<LensSource> published(const LensRequest& request);
  std::unique_ptr<LensSource> streamed(const LensRequest& request);
  std::unique_ptr<LensSource> live(const LensRequest& request);
  const Grid& grid_for(const LensRequest& request);
  const Grid* find(const GridOrder& order, const EyeCamera& eye);
  const Grid* find_near(const GridOrder& order, const EyeCamera& eye);
  const Grid& keep(const GridOrder& order, const EyeCamera& eye, LensStation station, const GridStatistics& statistics);

  Backend backend_;
  std::shared_ptr<StationStream> stream_;
  int built_ = 0;
  GridTracer<float> tracer_;
  EdgeMiss edge_miss_;
  std::unique_ptr<GridWorker> worker_;    //!< made when first needed
  std::optional<EyeCamera> ordered_eye_;  //!< whose grid the worker has or had in hand
  std::list<Grid> grids_;                 //!< the latest first
  std::weak_ptr<const StationBuffers>
      refused_;  //!< the first of two stations beside a damaged one whose blend missed the budget
  std::optional<EyeCamera> quadtree_eye_;
  std::shared_ptr<const QuadtreeLens> quadtree_;
};

}  // namespace ergodome
