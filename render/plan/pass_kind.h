#pragma once

#include <memory>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"

namespace ergodome {

class Pass;
class PlanWriter;
class StationStream;

//! What a pass is made from.
struct PassInput {
  const Show& show;
  Backend backend = Backend::cpu;
  std::shared_ptr<StationStream> stream{};  //!< the show's baked stations, if there are any
  const Show* previous_show = nullptr;      //!< the show before, if there was one
  const Pass* previous = nullptr;           //!< the pass of that show, whose tables may be shared
};

//! Part of a picture to which a pass belongs.
enum class PassStage {
  distant,   //!< infinitely far away: the same for all eyes that share a lens
  near,      //!< near the hole: seen by each eye from its own position
  finished,  //!< changes the whole picture
  frame      //!< changes the pictures of all eyes of a frame
};

//! Describes a pass: when pictures need it, what it does then, and how it is made.
struct PassKind {
  const char* name;
  PassStage stage;

  //! Returns whether a picture with the show's present numbers needs the pass.
  bool (*draws)(const Show& show, ViewMode mode);

  //! Adds the work, memory and channels that the pass takes for a show to a plan, with the keys
  //! that require them. Adds nothing for a show that never needs the pass.
  void (*plan)(PlanWriter& plan);

  //! Makes the pass, or returns nullptr if the show has nothing for it at any time. Throws Error if
  //! something cannot be read. Null for the sky alone: every picture starts with it, and the other
  //! passes draw over it (EyeRenderer).
  std::unique_ptr<Pass> (*make)(const PassInput& input) = nullptr;

  //! The pass keeps what it has prepared for one picture only, so that the rows of two eyes cannot
  //! alternate.
  bool serves_one_picture = false;

  //! The pass draws over whole pictures in host memory (PassDrawing::finish). Pictures that stay on
  //! a GPU are copied for those near the hole; the others keep pictures from staying there.
  bool in_host_memory = false;
};

}  // namespace ergodome
