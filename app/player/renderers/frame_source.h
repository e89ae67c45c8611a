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
#include "render/frame/show_renderer.h"
#include "render/present/output.h"
#include "render/stereo/eye_disparity.h"

namespace ergodome {

//! A request for a picture to show.
struct PictureRequest {
  std::shared_ptr<ShowRenderer> renderer;  //!< renderer of the current show
  PlayerFrame frame;
  std::vector<Caption> captions;  //!< captions that are not part of the show
  double captions_opacity = 0.0;
  int size_px = 0;    //!< width of one eye's image
  OutputWish output;  //!< where the picture will be shown
  //! Length in the scene of a meter in front of the output [M]; for ViewerHead.
  double scale_per_m = 0.0;
  bool disparity_asked = false;
  //! Quality settings that replace the show's. Their error budget is in pixels of a picture that is
  //! `whole_px` wide.
  std::optional<FrameQuality> quality;
  int whole_px = 0;
  //! How long the picture waits for its lens before it uses an older one.
  double patience_s = 0.02;
  //! ShowMoment::before and ShowMoment::alike.
  std::optional<LensPosition> before{};
  bool alike = false;
  bool errors_asked = false;
  std::uint64_t error_seed = 0;  //!< selects the pixels to measure
  //! Requests the lit part of the view; the value is the time of the request, which the answer
  //! repeats. Absent: not requested.
  std::optional<double> light_asked_s;
  //! Stops that automatic exposure keeps in this picture, because another computer follows the
  //! light; absent: it follows the light of the pictures.
  std::optional<double> followed_stops;
  //! Automatic exposure adapts to this picture at once.
  bool adapts_at_once = false;
  //! Draws the picture of a width [px] in place of the show's; empty: the show's picture.
  std::function<Picture(int)> pattern;
};

//! The part of a view's pixels that is brighter than black.
struct ViewLight {
  double asked_s = 0.0;   //!< PictureRequest::light_asked_s of the request that this answers
  double lit_part = 0.0;  //!< fraction of the image's pixels, without captions
};

//! A finished frame, with its cost and measurements.
struct PictureAnswer : OutputFrame {
  double time_ms = 0.0;
  int size_px = 0;
  std::optional<Disparity> disparity;  //!< disparity of the two eyes, if requested
  //! Errors of some pixels, if requested (app/player/renderers/picture_error.h).
  std::optional<std::vector<double>> errors_px;
  std::optional<ViewLight> light;          //!< lit part of the view, if requested
  std::optional<ReducedBaseline> reduced;  //!< present if the requested baseline had to be reduced
  std::optional<double> followed_stops;    //!< stops of automatic exposure in the picture, if the show has it
  double measuring_ms = 0.0;               //!< time of the measurements; not part of time_ms
  //! Why there is no picture; the last good one stays on the screen.
  std::string problem;
};

//! Renders the picture that an output needs: its own eyes, or the request's stereo layout. Eyes
//! that the layout stores separately, or that each fill the window, are side by side. Throws Error
//! if rendering fails.
PictureAnswer render_for_output(const PictureRequest& request);

//! Renders on a separate thread, so that the window stays responsive. Only the latest request
//! counts.
class FrameSource {
 public:
  using Render = std::function<PictureAnswer(const PictureRequest&)>;

  explicit FrameSource(Render render = render_for_output);

  //! Waits for the current picture, but not for abandoned ones.
  ~FrameSource();
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  //! Returns whether no request is waiting or being rendered, and no answer waits for take(). A caller
  //! that calls ask() only when idle receives each answer before its next request.
  [[nodiscard]] bool idle();
  void ask(const PictureRequest& request);
  //! Returns the finished answer and forgets it; nothing if none has finished since the last call.
  std::optional<PictureAnswer> take();

  //! Returns how long the current picture has been rendering; zero if there is none.
  [[nodiscard]] std::chrono::duration<double> working_for();

  //! Abandons the current picture and its thread, which may never end, and continues with a new
  //! thread. The renderer of that picture must not be used again.
  void abandon();

 private:
  struct Worker;

  Render render_;
  std::shared_ptr<Worker> worker_;
};

}  // namespace ergodome
