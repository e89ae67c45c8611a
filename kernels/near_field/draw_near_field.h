#pragma once

#include "kernels/disk/disk_look.h"
#include "kernels/shells/shell_look.h"
#include "kernels/trace/trace_pixels.h"

namespace ergodome {

//! What is drawn of the disk: each is compiled apart.
enum class DiskDrawing { none, plain, pattern };

//! A block of rows of one image, with what stands near the hole to draw over what is there: linear light, four floats a pixel (the fourth is
//! the coverage).
struct NearFieldBatch {
  PixelBatch pixels;  //!< without outputs or an edge
  DiskDrawing drawing;
  DiskLook disk;      //!< where it is drawn
  ShellTable shells;  //!< without any, none are looked for
  float* rgba;
};

//! Calls action(functor) with Functor<T, DiskDrawing, whether there are shells> for a batch; with nothing to draw, does nothing.
template <template <class, DiskDrawing, bool> class Functor, class T, class Action>
inline void dispatch_near_field(const NearFieldBatch& batch, const Action& action) {
  const bool shells = batch.shells.count > 0;
  switch (batch.drawing) {
    case DiskDrawing::none:
      if (shells) {
        action(Functor<T, DiskDrawing::none, true>{batch});
      }
      return;
    case DiskDrawing::plain:
      return shells ? action(Functor<T, DiskDrawing::plain, true>{batch})
                    : action(Functor<T, DiskDrawing::plain, false>{batch});
    case DiskDrawing::pattern:
      return shells ? action(Functor<T, DiskDrawing::pattern, true>{batch})
                    : action(Functor<T, DiskDrawing::pattern, false>{batch});
  }
}

}  // namespace ergodome
