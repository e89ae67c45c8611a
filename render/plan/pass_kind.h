#pragma once

#include <memory>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"

namespace ergodome {

class Pass;
class PlanWriter;
class StationStream;

//! The input from which a pass is created.
struct PassInput {
  const Show& show;
  Backend backend = Backend::cpu;
  std::shared_ptr<StationStream> stream{};  //!< the show's baked stations, if there are any
  const Show* previous_show = nullptr;      //!< the previous show, if there was one
  //! The previous show's pass, whose tables may be shared.
  const Pass* previous = nullptr;
};

//! The stage of a picture in which a pass draws.
enum class PassStage {
  distant,   //!< things that are infinitely far away: the same for all eyes that share a lens
  near,      //!< things near the hole: seen by each eye from its own position
  finished,  //!< changes to a whole picture
  frame      //!< changes the pictures of all eyes of a frame
};

//! Describes a kind of pass: when pictures need it, which work it does, and how it is created.
struct PassKind {
  const char* name;
  PassStage stage;

  //! Returns whether a picture with the show's current numbers needs the pass. Passes of
  //! PassStage::frame decide that themselves when they finish a frame.
  bool (*draws)(const Show& show, ViewMode mode);

  //! Adds the work, memory and channels that the pass needs for a show to a plan, each with the
  //! show's keys that require it. Adds nothing for a show that never needs the pass.
  void (*plan)(PlanWriter& plan);

  //! Makes the pass, or returns nullptr if the show has nothing for it at any time. Throws Error if
  //! something cannot be read. Null only for the sky: every picture starts with the sky, and the
  //! other passes draw over it (EyeRenderer).
  std::unique_ptr<Pass> (*make)(const PassInput& input) = nullptr;

  //! True if the pass keeps what it has prepared for one picture only; then the rows of two eyes
  //! cannot be rendered alternately.
  bool serves_one_picture = false;

  //! True if the pass draws over whole pictures in host memory (PassDrawing::finish()). Pictures
  //! that stay on a GPU are copied to the host and back for passes of the stage `near`; other such
  //! passes prevent pictures from staying on the GPU.
  bool in_host_memory = false;
};

}  // namespace ergodome
