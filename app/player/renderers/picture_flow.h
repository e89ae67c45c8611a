#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/budget/deadline.h"
#include "app/budget/frame_pace.h"
#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! What became of the pictures so far.
struct PictureReport {
  double frame_time_ms = 0.0;
  int size_px = 0;        //!< width of one eye's image in the last picture; 0: none yet
  const char* lens = "";  //!< where the last picture's lens came from
  std::optional<Disparity> disparity;
  std::optional<ViewLight> light;        //!< of the last view for which it was asked
  std::optional<NarrowedEyes> narrowed;  //!< where the last picture's eyes stand closer than was asked
  std::string problem;                   //!< why the last request made none
  long pictures = 0;
  //! Since the picture before, where something moved in both; none where nothing did.
  std::optional<double> interval_ms;
  std::optional<std::vector<double>> errors_px;  //!< of some of the last picture's pixels, where they were asked for
  long hangs = 0;                                //!< pictures that were given up because they did not come to an end
};

//! How pictures come while something moves, where that is not for PictureFlow to find.
struct PictureHold {
  int size_px = 0;       //!< width of one eye's image
  double frame_s = 0.0;  //!< a picture is begun when so much time has passed since the one before was to begin

  bool operator==(const PictureHold&) const = default;
};

//! What a call of PictureFlow::advance brought.
enum class PictureNews { none, picture, problem, hang };

//! Brings pictures to a screen: they are rendered beside the caller's thread.
//!
//! On the CPU they are as wide as the time allows while something moves (10 pictures a second or more), then finer and finer while all
//! stands still. On a GPU each picture is rendered whole.
class PictureFlow {
 public:
  //! `show`: hands a finished picture to the screen, on the caller's thread. `finest_px`: width of one eye's image when the picture
  //! stands still.
  PictureFlow(std::function<void(const PictureAnswer&)> show, int finest_px,
              FrameSource::Render render = render_for_window, SecondsSource now = steady_seconds)
      : show_(std::move(show)), finest_px_(finest_px), source_(std::move(render)), now_(std::move(now)) {}

  //! Moving pictures come in this size and at this pace from now on.
  void hold(const PictureHold& hold);

  //! Call it for every frame of the window: takes what is finished, and asks for what is wished (whose size it chooses itself).
  //!
  //! `changed`: the wish is another one than the last; `moving`: it will change again at once, so nothing is refined. After a `hang` the
  //! wish's renderer is lost and must be made anew before the next call; the last good picture stays on the screen.
  PictureNews advance(const PictureRequest& wish, bool changed, bool moving);

  [[nodiscard]] const PictureReport& report() const { return report_; }

 private:
  PictureNews receive();
  void ask(PictureRequest wish, int size_px, bool moving);
  void note_interval();
  [[nodiscard]] bool hangs();

  std::function<void(const PictureAnswer&)> show_;
  int finest_px_;
  FrameSource source_;
  bool pending_ = true;       //!< something changed that no picture has been asked for
  bool refining_ = false;     //!< the last picture is of what is wished, but may be finer
  int moving_size_px_ = 256;  //!< what keeps ten pictures a second
  int asked_size_px_ = 0;
  SecondsSource now_;
  std::optional<PictureHold> hold_;
  std::optional<FramePace> pace_;        //!< where there is one to hold
  bool asked_moving_ = false;            //!< something moved when the picture in work was asked for
  std::optional<double> last_moving_s_;  //!< when the last such picture came, if the last one was such
  PictureReport report_;
};

}  // namespace ergodome
