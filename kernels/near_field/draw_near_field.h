#pragma once

#include "kernels/disk/disk_look.h"
#include "kernels/launch/kernel.h"
#include "kernels/objects/lay_objects.h"
#include "kernels/shells/shell_look.h"
#include "kernels/spacetime/trace/omni_camera.h"
#include "kernels/spacetime/trace/trace_pixels.h"

// The batch that draws disk, shells and objects over a picture, and the choice of its kernel
// variant.
namespace ergodome {

//! How the disk is drawn. Kernels are compiled for each case.
enum class DiskDrawing { none, plain, pattern };

//! A block of rows of one image over which disk, shells and objects are drawn: linear light, four
//! floats per pixel (the fourth is the coverage).
struct NearFieldBatch {
  PixelBatch pixels;  //!< without outputs or an edge
  DiskDrawing drawing;
  DiskLook disk;      //!< used if it is drawn
  ShellTable shells;  //!< none are drawn if it is empty
  float* rgba;
  ObjectLayer objects;  //!< composed between disk and shells, if there are any
  //! Only pixels that show objects are drawn; the disk's grid draws the others.
  bool objects_alone;
  //! Omnidirectional stereo, if it has coefficients: it then replaces the camera of `pixels`, which
  //! is that of the head, for spin and azimuth. The frame is that of the view.
  OmniCameraOf<float> turning;
};

//! Calls action(functor) for a batch with objects. A disk is always drawn by the variant with a
//! pattern, since few scenes have all of these.
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

//! Calls action(functor) with Functor<T, DiskDrawing, whether there are shells, whether there are
//! objects> for a batch. Does nothing without disk and shells.
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

//! Returns the counter's name for a variant of drawing the near field; each variant is compiled
//! separately. Returns nullptr if there is nothing to draw.
constexpr const char* near_field_name(DiskDrawing disk, bool shells) {
  constexpr const char* names[3][2] = {{nullptr, "draw_shells"},
                                       {"draw_disk", "draw_shells, disk"},
                                       {"draw_disk, pattern", "draw_shells, disk, pattern"}};
  return names[static_cast<int>(disk)][shells ? 1 : 0];
}

template <>
struct Kernel<NearFieldBatch> : KernelDefaults {
  static const char* name(const NearFieldBatch& batch) {
    return near_field_name(batch.drawing, batch.shells.count > 0);
  }
  static PixelRows rows(const NearFieldBatch& batch) { return Kernel<PixelBatch>::rows(batch.pixels); }

  template <class Visit>
  static void visit_outputs(const NearFieldBatch& batch, const Visit& visit) {
    visit("rgba", batch.rgba, 4L * element_count(batch));
  }
};

}  // namespace ergodome
