#pragma once

#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! Decides when the pictures of a PictureFlow are shown: together with those of other computers.
class PictureGate {
 public:
  PictureGate() = default;
  virtual ~PictureGate() = default;
  PictureGate(const PictureGate&) = delete;
  PictureGate& operator=(const PictureGate&) = delete;

  //! Announces a request before it is rendered, and may change it.
  virtual void publish(PictureRequest& request) = 0;
  //! Returns whether a rendered picture may be shown now; called until it returns true. May raise
  //! the picture's time, from which the size of the next picture is chosen.
  virtual bool release(PictureAnswer& answer) = 0;
};

}  // namespace ergodome
