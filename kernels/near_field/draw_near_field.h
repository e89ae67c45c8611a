#pragma once

#include "kernels/disk/disk_appearance.h"
#include "kernels/launch/kernel.h"
#include "kernels/objects/lay_objects.h"
#include "kernels/shells/shell_appearance.h"
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
  PixelBatch pixels;  //!< pixels to draw over; the members for outputs and the edge are not used
  DiskDrawing drawing;
  DiskAppearance disk;  //!< how the disk looks; only used if the disk is drawn
  ShellTable shells;    //!< shells to draw; none if the table is empty
  float* rgba;
  //! Objects to composite with disk and shells in the order of distance; without objects if its
  //! `rgba` is nullptr.
  ObjectLayer objects;
  //! Whether to draw only the pixels that show objects. The others are then drawn from the disk's
  //! grid (DiskLookUpBatch).
  bool objects_alone;
  //! Camera of an omnidirectional eye, used if it has coefficients. It then replaces the camera of
  //! `pixels`, which is the head's and only supplies spin and azimuth. Directions are then in the
  //! view's axes.
  OmniCameraOf<float> omni;
};

//! Calls action(functor) for a batch with objects. The disk is always drawn by the variant with a
//! pattern: scenes with both disk and objects are too few for a variant of their own.
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

//! Returns the work counter's name for a variant of drawing the near field; each variant is
//! compiled separately. Returns nullptr if there is nothing to draw.
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
