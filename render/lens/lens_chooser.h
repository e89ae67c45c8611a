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

// Chooses and caches the lens of each frame.

namespace ergodome {

//! Accuracy of a lens, as a displacement on the screen.
struct LensAccuracy {
  double budget_px = 0.25;     //!< for lenses read from a grid
  double tolerance_px = 0.05;  //!< for traced rays
};

//! Show time of a frame, for lenses that may be streamed.
struct ShowMoment {
  std::optional<double> time_s;  //!< empty: the camera is not on the show's path
  //! Maximum wait for stations that are not yet read, and for live grids.
  double patience_s = forever_s;

  static constexpr double forever_s = 1e6;
};

//! Input of LensChooser::choose.
struct LensRequest {
  LensChoice choice = LensChoice::automatic;
  EyeCamera eye{};
  Projection projection{};
  ViewMode mode = ViewMode::sky;
  LensAccuracy accuracy{};
  ShowMoment moment{};
  GridScheme scheme = GridScheme::conforming;
};

//! Returns whether an eye is beside the path of a show's camera, as each of two eyes is. A single
//! eye is on the path up to rounding.
inline bool is_beside(const EyeCamera& eye) {
  return std::abs(eye.r - eye.head_r) > 1e-12 * eye.head_r || std::abs(eye.theta - eye.head_theta) > 1e-12;
}

//! Returns whether baked stations are accurate to `error` [rad].
bool holds_budget(const TrajectoryProvenance& baked, double error);

//! Returns whether baked stations may serve an eye's frames with accuracy `error` [rad].
bool may_stream(const TrajectoryProvenance& baked, LensChoice choice, const EyeCamera& eye, double error);

//! Returns the accepted error [px] where the bake measured none: for an eye beside the path, or
//! between stations that are not neighbors. `pixel` is the angle of a pixel [rad].
double allowed_unmeasured_px(const TrajectoryProvenance& baked, double budget_px, double pixel);

//! Creates the lens of each frame, from a stream of baked stations if there is one. Caches the last
//! live grids: a camera that turns, changes its motion or circles the hole's axis reuses them.
class LensChooser {
 public:
  explicit LensChooser(Backend backend, std::shared_ptr<StationStream> stream = nullptr)
      : backend_(backend), stream_(std::move(stream)), tracer_(backend) {}

  //! Replaces the stream of baked stations; nullptr stops streaming.
  void set_stream(std::shared_ptr<StationStream> stream) { stream_ = std::move(stream); }

  //! Creates the lens for an eye's frame. View modes that show ray properties (steps, error, order)
  //! always trace rays.
  //!
  //! LensChoice::automatic streams where the camera is on a baked path and the bake is accurate
  //! enough. Otherwise it traces small frames, all frames on a GPU, and frames for which a grid
  //! would leave most pixels to rays. LensChoice::streamed falls back to a live grid where the
  //! stream has no stations: off the path, or while they are being read. If a grid would misplace
  //! the shadow's edge by more than the budget (EdgeMiss), rays are traced, whatever the choice.
  //!
  //! On a GPU, live grids are traced there as part of the frame. On the CPU a thread builds them.
  //! If a grid does not arrive within the moment's patience, the frame shows the view from the
  //! position of the last grid (LensSource::behind), and the next frame gets the new one. Two eyes
  //! always wait, as both must see the same moment.
  //!
  //! GridScheme::quadtree uses the published quadtree grid for the eye's own position and motion,
  //! except for direct rays.
  //!
  //! Gaps between stations that miss the budget get live grids. The stations' derivatives serve an
  //! eye beside the path as long as traced rays confirm them; the same holds for a frame between
  //! stations some of which could not be read. Otherwise such frames get a live grid.
  std::unique_ptr<LensSource> choose(const LensRequest& request);

  //! Returns the number of grids built so far.
  [[nodiscard]] int built() const { return built_; }

 private:
  //! A grid and what it was built for.
  struct Grid {
    Spacetime spacetime;
    double r;
    double theta;
    double error;  //!< budget [rad]
    ObserverMotion motion;
    Vector3<double> velocity;
    double traced_px;  //!< pixels of the frame that the grid leaves to rays
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
  std::unique_ptr<GridWorker> worker_;    //!< created on first use
  std::optional<EyeCamera> ordered_eye_;  //!< eye whose grid the worker last started
  std::list<Grid> grids_;                 //!< the latest first
  //! First station of a pair beside a damaged one, if their blend missed the budget.
  std::weak_ptr<const StationBuffers> refused_;
  std::optional<EyeCamera> quadtree_eye_;
  std::shared_ptr<const QuadtreeLens> quadtree_;
};

}  // namespace ergodome
