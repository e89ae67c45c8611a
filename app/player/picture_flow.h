#pragma once

#include <optional>
#include <string>

#include "app/player/frame_source.h"
#include "render/present/presenter.h"

namespace ergodome {

//! What became of the pictures so far.
struct PictureReport {
  double frame_time_ms = 0.0;
  int size_px = 0;        //!< width of one eye's image in the last picture; 0: none yet
  const char* lens = "";  //!< where the last picture's lens came from
  std::optional<Disparity> disparity;
  std::string problem;  //!< why the last request made none
  int pictures = 0;
};

//! Brings pictures to a presenter.
//!
//! On the CPU they are rendered beside the caller's thread: as wide as the time allows while something moves (10 pictures a second or
//! more), then finer and finer while all stands still. On a GPU each picture is rendered whole and shown without a way through the host.
class PictureFlow {
 public:
  //! `finest_px`: width of one eye's image when the picture stands still.
  PictureFlow(Presenter& presenter, int finest_px) : presenter_(presenter), finest_px_(finest_px) {}

  //! Call it for every frame of the window: takes what is finished, and asks for what is wished (whose size it chooses itself).
  //!
  //! `changed`: the wish is another one than the last; `moving`: it will change again at once, so nothing is refined. Returns whether an
  //! answer came: a picture, or a problem.
  bool advance(const PictureRequest& wish, bool changed, bool moving);

  [[nodiscard]] const PictureReport& report() const { return report_; }

 private:
  bool advance_on_device(PictureRequest wish);
  bool receive();
  void ask(PictureRequest wish, int size_px);

  Presenter& presenter_;
  int finest_px_;
  std::unique_ptr<FrameSource> source_;  //!< on the CPU alone
  bool pending_ = true;                  //!< something changed that no picture has been asked for
  bool refining_ = false;                //!< the last picture is of what is wished, but may be finer
  int moving_size_px_ = 256;             //!< what keeps ten pictures a second
  PictureReport report_;
};

}  // namespace ergodome
