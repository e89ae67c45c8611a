#pragma once

#include <memory>
#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/animatable_number.h"
#include "render/passes/eye_picture.h"
#include "render/picture/picture.h"
#include "render/picture/picture_rows.h"
#include "render/plan/pass_kind.h"

// The interface of passes: everything that draws into an eye's picture.

namespace ergodome {

//! The work of a pass on one picture.
class PassDrawing {
 public:
  PassDrawing() = default;
  virtual ~PassDrawing() = default;
  PassDrawing(const PassDrawing&) = delete;
  PassDrawing& operator=(const PassDrawing&) = delete;

  //! Draws over rows of the picture in the backend's memory: four floats per pixel. Called for all
  //! rows, block by block.
  virtual void draw(const RowBlock& rows, float* rgba) {
    static_cast<void>(rows);
    static_cast<void>(rgba);
  }

  //! Draws over the whole picture in host memory, once all rows are drawn.
  virtual void finish(Picture& picture) { static_cast<void>(picture); }
};

//! The finished picture of one eye of a frame.
struct FinishedEye {
  float* rgba;             //!< light and coverage, in the memory of FinishedFrame::backend
  double offset;           //!< distance of the eye to the right of the head [M]
  const Picture* picture;  //!< the picture in host memory; nullptr if it is only in the backend's memory
};

//! The finished pictures of a frame's eyes.
struct FinishedFrame {
  Backend backend;
  const Show& show;  //!< the show with its numbers at the time of the frame
  ViewMode mode;
  const CameraPose& pose;
  const Projection& projection;
  std::optional<double> time_s;  //!< show time; none in free flight
  double clock_s;                //!< time by the clock of automatic exposure: the show's or the wall clock
  Tone tone;                     //!< tone with which all eyes' pictures are displayed
  std::vector<FinishedEye> eyes;
};

//! A pass: draws one kind of thing into a show's pictures. Owns the tables and buffers that all
//! these pictures need.
class Pass {
 public:
  Pass() = default;
  virtual ~Pass() = default;
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  [[nodiscard]] virtual const PassKind& kind() const = 0;

  //! Starts work for a picture, which may go on in other threads, and returns what draws it.
  //! `picture` must outlive the drawing. Not called for passes of PassStage::frame.
  virtual std::unique_ptr<PassDrawing> prepare(const EyePicture& picture) {
    static_cast<void>(picture);
    return std::make_unique<PassDrawing>();
  }

  //! Draws over the finished pictures of all eyes, or changes their tone; only passes of
  //! PassStage::frame do.
  virtual void finish_frame(FinishedFrame& frame) { static_cast<void>(frame); }

  //! Applies the show's numbers at another time. `change`: what the changed numbers invalidate.
  virtual void apply(const Show& show, const NumberChange& change) {
    static_cast<void>(show);
    static_cast<void>(change);
  }

  //! Returns whether this pass, made for the show `now`, can also draw the show `next` after
  //! apply().
  [[nodiscard]] virtual bool serves(const Show& now, const Show& next) const {
    static_cast<void>(now);
    static_cast<void>(next);
    return true;
  }

  //! Takes over what `next`, a pass made for another show, has read, so that this pass can draw
  //! that show and keep its own state. Returns false if `next` must replace this pass instead.
  virtual bool take(Pass& next) {
    static_cast<void>(next);
    return false;
  }

  //! Returns warnings about parts of the show that will not be visible.
  [[nodiscard]] virtual std::vector<std::string> notes(const Show& show) const {
    static_cast<void>(show);
    return {};
  }
};

}  // namespace ergodome
