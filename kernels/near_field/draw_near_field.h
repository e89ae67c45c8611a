#pragma once

#include "kernels/disk/disk_look.h"
#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/objects/lay_objects.h"
#include "kernels/shells/shell_look.h"
#include "kernels/spacetime/trace/trace_pixels.h"

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
  ObjectLayer objects;  //!< put between them, where there are any
  bool objects_alone;   //!< only pixels that show objects are drawn: the others are by the disk's grid
  //! What sees them in place of the pixels' camera, where it has coefficients: that is the head's then, for spin and azimuth, and the frame the
  //! view's.
  OmniCameraOf<float> turning;
};

//! The same with objects between them. A disk is drawn as one with a pattern, whether it has one or not: few scenes have all this.
template <template <class, DiskDrawing, bool, bool> class Functor, class T, class Action>
inline void dispatch_near_field_with_objects(const NearFieldBatch& batch, const Action& action) {
  const bool shells = batch.shells.count > 0;
  if (batch.drawing != DiskDrawing::none) {
    return shells ? action(Functor<T, DiskDrawing::pattern, true, true>{batch})
                  : action(Functor<T, DiskDrawing::pattern, false, true>{batch});
  }
  if (shells) {
    action(Functor<T, DiskDrawing::none, true, true>{batch});
  }
}

//! Calls action(functor) with Functor<T, DiskDrawing, whether there are shells, whether there are objects> for a batch; with neither disk nor shells, does
//! nothing.
template <template <class, DiskDrawing, bool, bool> class Functor, class T, class Action>
inline void dispatch_near_field(const NearFieldBatch& batch, const Action& action) {
  if (batch.objects.rgba != nullptr) {
    return dispatch_near_field_with_objects<Functor, T>(batch, action);
  }
  const bool shells = batch.shells.count > 0;
  switch (batch.drawing) {
    case DiskDrawing::none:
      if (shells) {
        action(Functor<T, DiskDrawing::none, true, false>{batch});
      }
      return;
    case DiskDrawing::plain:
      return shells ? action(Functor<T, DiskDrawing::plain, true, false>{batch})
                    : action(Functor<T, DiskDrawing::plain, false, false>{batch});
    case DiskDrawing::pattern:
      return shells ? action(Functor<T, DiskDrawing::pattern, true, false>{batch})
                    : action(Functor<T, DiskDrawing::pattern, false, false>{batch});
  }
}

}  // namespace ergodome
