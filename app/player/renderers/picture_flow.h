#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/budget/deadline.h"
#include "app/budget/rate_keeper.h"
#include "app/player/renderers/frame_source.h"
#include "app/player/renderers/picture_gate.h"

namespace ergodome {

//! Statistics of the pictures so far.
struct PictureReport {
  double frame_time_ms = 0.0;
  int size_px = 0;        //!< width of one eye's image in the last picture; 0: none yet
  const char* lens = "";  //!< source of the last picture's lens
  std::optional<Disparity> disparity;
  std::optional<ViewLight> light;          //!< lit part of the last view for which it was requested
  std::optional<ReducedBaseline> reduced;  //!< present if the last picture's baseline was reduced
  std::string problem;                     //!< why the last request produced no picture
  long pictures = 0;
  //! Time since the previous picture, if something moved in both.
  std::optional<double> interval_ms;
  //! Errors of some pixels of the last picture, if requested.
  std::optional<std::vector<double>> errors_px;
  //! Number of pictures abandoned because they did not finish.
  long hangs = 0;
};

//! Fixed size and pace of pictures while something moves, instead of those that PictureFlow
//! chooses.
struct PictureHold {
  int size_px = 0;       //!< width of one eye's image
  double frame_s = 0.0;  //!< interval between the starts of pictures

  bool operator==(const PictureHold&) const = default;
};

//! Result of PictureFlow::advance.
enum class PictureNews { none, picture, problem, hang };

//! Brings pictures to a screen; they are rendered on another thread.
//!
//! On the CPU, pictures are as wide as ten or more per second allow while something moves, and get
//! finer when nothing moves. On a GPU, each picture is rendered at full size, unless the output has a
//! rate of its own (OutputWish::frame_s).
class PictureFlow {
 public:
  //! `show` passes a finished picture to the screen, on the caller's thread. `finest_px` is the
  //! width of one eye's image when nothing moves.
  PictureFlow(std::function<void(PictureAnswer&)> show, int finest_px, FrameSource::Render render = render_for_output,
              SecondsSource now = steady_seconds)
      : show_(std::move(show)), finest_px_(finest_px), source_(std::move(render)), now_(std::move(now)) {}

  //! Fixes the size and pace of moving pictures.
  void hold(const PictureHold& hold);

  //! Lets a gate decide when pictures are shown. It must outlive this; nullptr: at once.
  void set_gate(PictureGate* gate) { gate_ = gate; }

  //! Takes a finished picture and requests the next one; call it for every frame of the window. The
  //! size in `wish` is chosen here.
  //!
  //! `changed`: the request differs from the last. `moving`: the request will change again at once,
  //! so nothing is refined. After a `hang`, the request's renderer is lost and must be rebuilt
  //! before the next call; the last good picture stays on the screen.
  PictureNews advance(const PictureRequest& wish, bool changed, bool moving);

  [[nodiscard]] const PictureReport& report() const { return report_; }

 private:
  PictureNews receive();
  void ask(PictureRequest wish, int size_px, bool moving);
  void note_interval();
  [[nodiscard]] bool hangs();

  std::function<void(PictureAnswer&)> show_;
  int finest_px_;
  FrameSource source_;
  PictureGate* gate_ = nullptr;
  std::optional<PictureAnswer> held_;  //!< finished picture that the gate holds back
  bool pending_ = true;                //!< a change was not requested yet
  bool refining_ = false;              //!< the last picture is current but may become finer
  int moving_size_px_ = 256;           //!< width at which a picture takes about `budget_ms_`
  int asked_size_px_ = 0;
  std::optional<LensPosition> asked_position_;  //!< camera of the last request
  int smallest_px_ = 0;                         //!< OutputWish::smallest_px of the current request
  double budget_ms_ = 0.0;                      //!< time of a moving picture that determines the size of the next one
  SecondsSource now_;
  std::optional<PictureHold> hold_;
  std::optional<FramePace> pace_;        //!< the pace to hold, if any
  bool asked_moving_ = false;            //!< something moved when the current picture was requested
  std::optional<double> last_moving_s_;  //!< when the last picture came, if something moved in it
  PictureReport report_;
};

}  // namespace ergodome
