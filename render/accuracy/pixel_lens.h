#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/spacetime/trace/trace_rays.h"
#include "render/accuracy/scene.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! Directions of the pixels inside a picture, and where their light comes from: what methods that trace single rays work on.
template <class S>
struct RayPicture {
  std::vector<std::int64_t> pixels;  //!< in ascending order
  std::vector<S> n[3], sky[3], status;
};

//! What is asked of a pixel: where its light comes from, or also the footprint that it has on the sky there.
enum class PixelNeed { sky, footprint };

//! The instant of a moment that is looked at, or the frame after it.
enum class FrameOfMoment { now, next };

//! An eye, its picture, and room for what methods find there. Methods share the room: what one has found is there until the next draws.
class LensScene {
 public:
  LensScene(const AccuracyMoment& moment, FrameOfMoment frame, PixelNeed need);

  [[nodiscard]] const AccuracyMoment& moment() const { return moment_; }
  [[nodiscard]] const EyeCamera& eye() const { return frame_ == FrameOfMoment::now ? moment_.eye : moment_.next; }
  //! Of the head whose eye that is.
  [[nodiscard]] const CameraPose& pose() const {
    return frame_ == FrameOfMoment::now ? moment_.pose : moment_.next_pose;
  }
  [[nodiscard]] const Projection& projection() const { return moment_.projection; }

  //! Made at the first call.
  template <class S>
  RayPicture<S>& rays();

  //! Channels of the whole picture: coverage, sky, and footprints where they are needed.
  LensPixels& pixels();

 private:
  const AccuracyMoment& moment_;
  FrameOfMoment frame_;
  PixelNeed need_;
  std::unique_ptr<RayPicture<float>> narrow_;
  std::unique_ptr<RayPicture<double>> wide_;
  std::vector<float> channels_;
  LensPixels pixels_{};
};

//! A way to find where the light of a picture's pixels comes from, ready for one eye.
class PixelLens {
 public:
  PixelLens() = default;
  virtual ~PixelLens() = default;
  PixelLens(const PixelLens&) = delete;
  PixelLens& operator=(const PixelLens&) = delete;

  //! Finds it for all pixels: a frame's work.
  virtual void draw() = 0;

  //! What a pixel saw in the last draw(): nothing where it is dark.
  [[nodiscard]] virtual std::optional<Vector3<double>> sky(std::int64_t pixel) const = 0;

  //! Memory that what is ready takes.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }

  //! The same in a trajectory; nothing where it has no place there.
  [[nodiscard]] virtual std::optional<std::size_t> disk_bytes() const { return std::nullopt; }
};

//! A PixelLens for a choice of method and settings, with what the report says of it. `make` is timed as what a new place of the camera takes.
struct LensChoiceToMeasure {
  std::string method;
  std::string setting;
  std::string precision;
  std::string published;
  std::function<std::unique_ptr<PixelLens>(LensScene&)> make;
};

//! A ray a pixel. `step_limit`: after which a ray counts as lost.
LensChoiceToMeasure ray_choice(TraceMethod method, bool narrow, double tolerance);

//! The renderer's own: a ray a pixel in float, with the shadow's soft edge, to an error on the screen [px].
LensChoiceToMeasure direct_choice(double tolerance_px);

//! The conforming grid of the place. Float where the renderer would take it, too.
LensChoiceToMeasure grid_choice(double budget_px);

//! VE's grid (2021), read once a pixel.
LensChoiceToMeasure quadtree_choice(int finest_level, bool spline);

//! The same with splines as the renderer reads it: five times a pixel, whose footprint the middles of its sides span.
LensChoiceToMeasure quadtree_pixel_choice(int finest_level);

}  // namespace ergodome
