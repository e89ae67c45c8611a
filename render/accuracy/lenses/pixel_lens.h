#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/spacetime/trace/trace_rays.h"
#include "render/accuracy/scene.h"
#include "render/lens/lens_source.h"

// Common interface of the methods that are measured.

namespace ergodome {

//! The rays of the pixels inside a picture: their view directions, and the sky directions where
//! their light comes from. For methods that trace single rays.
template <class S>
struct RayPicture {
  std::vector<std::int64_t> pixels;  //!< indices of the pixels, in ascending order
  std::vector<S> n[3], sky[3], status;
};

//! The quantities that a method computes for each pixel: only the sky direction of its light, or
//! also its footprint on the sky.
enum class PixelNeed { sky, footprint };

//! Selects the measured moment itself, or the frame after it.
enum class FrameOfMoment { now, next };

//! An eye, its projection, and memory for the results of methods. All methods share this memory, so
//! results are valid until the next draw.
class LensScene {
 public:
  LensScene(const AccuracyMoment& moment, FrameOfMoment frame, PixelNeed need);

  [[nodiscard]] const AccuracyMoment& moment() const { return moment_; }
  [[nodiscard]] const EyeCamera& eye() const { return frame_ == FrameOfMoment::now ? moment_.eye : moment_.next; }
  //! Returns the pose of the head to which the eye belongs.
  [[nodiscard]] const CameraPose& pose() const {
    return frame_ == FrameOfMoment::now ? moment_.pose : moment_.next_pose;
  }
  [[nodiscard]] const Projection& projection() const { return moment_.projection; }

  //! Returns the rays of all pixels; computes their view directions at the first call.
  template <class S>
  RayPicture<S>& rays();

  //! Returns the channels of the whole picture: coverage, sky, and footprints if needed.
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

//! A method that finds where the light of a picture's pixels comes from, prepared for one eye.
//! Methods are measured by calling draw() and comparing sky() with a reference.
class PixelLens {
 public:
  PixelLens() = default;
  virtual ~PixelLens() = default;
  PixelLens(const PixelLens&) = delete;
  PixelLens& operator=(const PixelLens&) = delete;

  //! Computes all pixels: the work of one frame.
  virtual void draw() = 0;

  //! Returns the sky direction that a pixel saw in the last draw(); nothing if the pixel is dark.
  [[nodiscard]] virtual std::optional<Vector3<double>> sky(std::int64_t pixel) const = 0;

  //! Returns the memory of the prepared data [bytes].
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }

  //! Returns the size of the prepared data in a trajectory [bytes]; nothing if it cannot be stored
  //! there.
  [[nodiscard]] virtual std::optional<std::size_t> disk_bytes() const { return std::nullopt; }
};

//! A method to measure, with the texts that describe it in the report. `make` prepares it for an
//! eye; the time of `make` is the cost of a new camera position.
struct LensChoiceToMeasure {
  std::string method;
  std::string setting;
  std::string precision;
  std::string published;
  std::function<std::unique_ptr<PixelLens>(LensScene&)> make;
};

//! Returns the method that traces one ray per pixel with an integrator, in float if `narrow`,
//! otherwise in double. `tolerance`: accepted displacement on the camera's sky [rad]; unused by the
//! closed form.
LensChoiceToMeasure ray_choice(TraceMethod method, bool narrow, double tolerance);

//! Returns the method of the renderer without a grid: one ray per pixel in float, with an
//! antialiased shadow edge. `tolerance_px`: accepted error on the screen [px].
LensChoiceToMeasure direct_choice(double tolerance_px);

//! Returns the method that builds the conforming grid for the camera position, in float where the
//! renderer would use float.
LensChoiceToMeasure grid_choice(double budget_px);

//! Returns the method that reads the quadtree grid of Verbraeck & Eisemann (2021) once per pixel,
//! with splines if `spline`.
LensChoiceToMeasure quadtree_choice(int finest_level, bool spline);

//! Returns the method that reads the quadtree grid of Verbraeck & Eisemann (2021) with splines as
//! the renderer does: five times per pixel, with a footprint from the midpoints of the pixel's
//! sides.
LensChoiceToMeasure quadtree_pixel_choice(int finest_level);

}  // namespace ergodome
