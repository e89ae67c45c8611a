#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "render/frame/eye_disparity.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! A picture that the player wants to show.
struct PictureRequest {
  std::shared_ptr<ShowRenderer> renderer;  //!< of the show that is on
  CameraPose pose;
  ViewMode mode = ViewMode::sky;
  double field_of_view_deg = 0.0;
  int size_px = 0;      //!< width of one eye's image
  ShowMoment moment{};  //!< of a camera on the show's path
  StereoSettings stereo{};
  bool disparity_asked = false;
};

//! A finished picture and what it took.
struct PictureAnswer {
  Picture picture;
  double time_ms = 0.0;
  int size_px = 0;
  std::optional<Disparity> disparity;  //!< where it was asked for, of two eyes
  std::string problem;                 //!< why there is none; the last good one stays on the screen
};

//! Renders in a thread of its own, so that the window answers at once whatever a picture costs. Only the latest request counts.
class FrameSource {
 public:
  FrameSource();
  ~FrameSource();
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  //! Whether nothing is being rendered or waiting.
  [[nodiscard]] bool idle();
  void ask(const PictureRequest& request);
  std::optional<PictureAnswer> take();

 private:
  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<PictureRequest> request_;
  std::optional<PictureAnswer> answer_;
  bool busy_ = false;
  std::jthread thread_;
};

//! One picture as the request's stereo layout has it; eyes that it keeps apart come side by side on a window.
Picture render_for_window(const PictureRequest& request);

}  // namespace ergodome
