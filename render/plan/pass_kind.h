#pragma once

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"

namespace ergodome {

class PlanWriter;

//! Describes a pass: when pictures need it, and what it does then.
struct PassKind {
  const char* name;

  //! Returns whether a picture with the show's present numbers needs the pass.
  bool (*draws)(const Show& show, ViewMode mode);

  //! Adds the work, memory and channels that the pass takes for a show to a plan, with the keys that
  //! require them. Adds nothing for a show that never needs the pass.
  void (*plan)(PlanWriter& plan);

  //! The pass keeps what it has prepared for one picture only, so that the rows of two eyes cannot
  //! alternate.
  bool serves_one_picture = false;
};

}  // namespace ergodome
