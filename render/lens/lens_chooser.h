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

//! Accuracy of a lens: maximum displacement of directions on the screen [px].
struct LensAccuracy {
  double budget_px = 0.25;     //!< maximum displacement in lenses that are interpolated in a grid
  double tolerance_px = 0.05;  //!< maximum displacement in lenses that are traced
};

//! Show time of a frame, for lenses that may be streamed from baked stations.
struct ShowMoment {
  std::optional<double> time_s;  //!< empty: the camera is not on the show's path
  //! Maximum time to wait for stations that are not yet read, and for live grids.
  double patience_s = forever_s;

  //! Position of the player's camera in the previous picture; absent for the first picture and for
  //! films.
  std::optional<LensPosition> before{};
  //! The picture must equal that of another computer, whatever pictures each has rendered before.
  bool alike = false;

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

//! Returns whether an eye's (r, θ) differs from its head's by more than rounding. Both eyes of a
//! stereo pair are beside the head's path; a single eye is on it.
inline bool is_beside(const EyeCamera& eye) {
  return std::abs(eye.r - eye.head_r) > 1e-12 * eye.head_r || std::abs(eye.theta - eye.head_theta) > 1e-12;
}

//! Returns whether baked stations are accurate to `error`, an angle on the screen [rad].
bool holds_budget(const TrajectoryProvenance& baked, double error);

//! Returns whether baked stations may be used for an eye's frames: if `choice` is `streamed`, or if
//! it is `automatic` and they are accurate to `error` [rad]. An eye beside the path also requires
//! that they have derivatives along the camera's r and θ.
bool may_stream(const TrajectoryProvenance& baked, LensChoice choice, const EyeCamera& eye, double error);

//! Returns the accepted blending error [px] where the bake did not measure it: for an eye beside
//! the path, or between stations that are not neighbors. `pixel` is the angle of a pixel [rad].
double allowed_unmeasured_px(const TrajectoryProvenance& baked, double budget_px, double pixel);

//! Creates the lens of each frame, from a stream of baked stations if there is one. Caches the last
//! live grids, which a camera that turns, changes its velocity slightly or circles the hole's axis
//! can use again.
class LensChooser {
 public:
  explicit LensChooser(Backend backend, std::shared_ptr<StationStream> stream = nullptr)
      : backend_(backend), stream_(std::move(stream)), tracer_(backend) {}

  //! Replaces the stream of baked stations; nullptr stops streaming.
  void set_stream(std::shared_ptr<StationStream> stream) { stream_ = std::move(stream); }

  //! Creates the lens for an eye's frame. View modes that show properties of the rays (steps,
  //! error, order) always trace rays.
  //!
  //! LensChoice::automatic uses the stream where the camera is on a baked path and the bake is
  //! accurate enough. Otherwise it traces one ray per pixel for small frames, for all frames on a
  //! GPU, and if a grid would leave a quarter of the pixels or more to rays; it builds a live grid
  //! for other frames.
  //! LensChoice::streamed uses a live grid where the stream has no stations: off the path, or while
  //! they are being read. If a grid would displace the shadow's edge by more than the budget
  //! (EdgeMiss), rays are traced, whatever the choice.
  //!
  //! On a GPU, the rays of live grids are traced there as part of the frame. On the CPU a separate
  //! thread builds live grids. If a grid is not finished within ShowMoment::patience_s, the frame
  //! shows the view from the position of the last grid (LensSource::behind()), and the next frame
  //! gets the new grid. A stereo pair always waits, because both eyes must show the same moment.
  //!
  //! On the CPU, GridScheme::quadtree uses the published quadtree grid for the eye's own position
  //! and motion, unless direct rays are requested. On a GPU it has no effect.
  //!
  //! The stream is not used between two stations whose blend exceeds the budget. Two cases are only
  //! possible on the CPU, as long as traced rays confirm the accuracy: an eye beside the path, for
  //! which the stations need derivatives along the camera's r and θ, and a blend of stations that
  //! are not neighbors, because those between them could not be read. Other frames are drawn as
  //! without a stream.
  std::unique_ptr<LensSource> choose(const LensRequest& request);

  //! Returns the number of grids built so far.
  [[nodiscard]] int built() const { return built_; }

 private:
  //! A live grid and the parameters for which it was built.
  struct Grid {
    Spacetime spacetime;
    double r;
    double theta;
    double error;  //!< budget of displacements on the screen for which the grid was built [rad]
    ObserverMotion motion;
    Vector3<double> velocity;
    double traced_px;  //!< area of the leaves that are left to rays, in the whole sky [px²]
    std::shared_ptr<const StationBuffers> station;
  };

  std::unique_ptr<LensSource> published(const LensRequest& request);
  std::unique_ptr<LensSource> streamed(const LensRequest& request);
  std::unique_ptr<LensSource> live(const LensRequest& request);
  const Grid& grid_for(const LensRequest& request);
  //! Returns a cached grid for the order. `alike`: only one of exactly that error (ShowMoment::alike).
  const Grid* find(const GridOrder& order, const EyeCamera& eye, bool alike);
  const Grid* find_near(const GridOrder& order, const EyeCamera& eye);
  const Grid& keep(const GridOrder& order, const EyeCamera& eye, LensStation station, const GridStatistics& statistics);

  Backend backend_;
  std::shared_ptr<StationStream> stream_;
  int built_ = 0;
  GridTracer<float> tracer_;
  EdgeMiss edge_miss_;
  std::unique_ptr<GridWorker> worker_;    //!< created on first use
  std::optional<EyeCamera> ordered_eye_;  //!< eye of the last frame that asked the worker for a grid
  std::list<Grid> grids_;                 //!< cached live grids, the latest one first
  //! The first station of the last pair that was rejected because a station between them could not
  //! be read and their blend exceeded the budget.
  std::weak_ptr<const StationBuffers> refused_;
  std::optional<EyeCamera> quadtree_eye_;
  std::shared_ptr<const QuadtreeLens> quadtree_;
};

}  // namespace ergodome
