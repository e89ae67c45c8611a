#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/player/renderers/player_frame.h"
#include "content/timeline/timeline.h"
#include "render/eyes/eye_disparity.h"
#include "render/frame/show_renderer.h"
#include "render/output/stereo_layout.h"
#include "render/present/presenter.h"

namespace ergodome {

//! A picture that the player wants to show.
struct PictureRequest {
  std::shared_ptr<ShowRenderer> renderer;  //!< of the show that is on
  PlayerFrame frame;
  std::vector<Caption> captions;  //!< that do not come from the show
  double captions_opacity = 0.0;
  int size_px = 0;  //!< width of one eye's image
  //! Of the window that the picture is for, where captions are laid over it there; none: they are drawn in the picture.
  std::optional<ImageSize> window;
  int projectors_px = 0;  //!< width of a domemaster as fine as the projectors that it is for [px]; 0: it is for none
  bool disparity_asked = false;
  std::optional<FrameQuality>
      quality;  //!< in place of the show's; its budget counts in pixels of a picture `whole_px` wide
  int whole_px = 0;
  double patience_s = 0.02;  //!< how long the picture waits for its lens before it takes an older one
  bool errors_asked = false;
  std::uint64_t error_seed = 0;         //!< of the pixels that are looked at
  std::optional<double> light_asked_s;  //!< asks for the lit part of the view, at this time; none: does not
};

//! How the pictures of eyes fill a window: as one picture, or each by itself, in the buffer of each or in every other row.
enum class EyesInWindow { as_one, in_buffers, in_rows };

//! How much of a view is lit.
struct ViewLight {
  double asked_s = 0.0;   //!< PictureRequest::light_asked_s
  double lit_part = 0.0;  //!< of the image's pixels, without words over it
};

//! A finished picture and what it took.
struct PictureAnswer {
  Picture picture;                           //!< or the left eye's
  std::optional<Picture> right_eye;          //!< where both eyes are shown whole
  bool eyes_above = false;                   //!< the left one above the right, not beside it
  EyesInWindow eyes = EyesInWindow::as_one;  //!< each by itself: side by side until then
  EyeGrid eye_grid;                          //!< how the eyes share the picture that is shown
  LaidCaptions captions;                     //!< of each eye, at the window's resolution; none where there are none
  std::optional<DevicePicture> on_device;    //!< in place of the picture's pixels, until the next request
  double time_ms = 0.0;
  int size_px = 0;
  std::optional<Disparity> disparity;            //!< where it was asked for, of two eyes
  std::optional<std::vector<double>> errors_px;  //!< where they were asked for (app/player/picture_error.h)
  std::optional<ViewLight> light;                //!< where it was asked for
  std::optional<NarrowedEyes> narrowed;          //!< where eyes stand closer than the request has them
  double measuring_ms = 0.0;                     //!< what they took; not in time_ms
  std::string problem;                           //!< why there is none; the last good one stays on the screen
};

//! One picture as the request's stereo layout has it on a window: eyes that it keeps apart come side by side, and so do those of which each
//! fills the window. Throws Error.
PictureAnswer render_for_window(const PictureRequest& request);

//! Renders in a thread of its own, so that the window answers at once whatever a picture costs. Only the latest request counts.
class FrameSource {
 public:
  using Render = std::function<PictureAnswer(const PictureRequest&)>;

  explicit FrameSource(Render render = render_for_window);

  //! Waits for the picture that is being rendered; not for those that were abandoned.
  ~FrameSource();
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  //! Whether nothing is being rendered or waiting.
  [[nodiscard]] bool idle();
  void ask(const PictureRequest& request);
  std::optional<PictureAnswer> take();

  //! How long the picture in work has been so; zero where there is none.
  [[nodiscard]] std::chrono::duration<double> working_for();

  //! Leaves the picture in work to itself, whose thread may never end, and goes on with a new thread. What it renders with must not be
  //! used again.
  void abandon();

 private:
  struct Worker;

  Render render_;
  std::shared_ptr<Worker> worker_;
};

}  // namespace ergodome
