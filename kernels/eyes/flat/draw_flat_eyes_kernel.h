#pragma once

#include "kernels/eyes/flat/flat_disk.h"
#include "kernels/eyes/flat/flat_eye_pixels.h"
#include "kernels/eyes/flat/flat_shells.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws disk and shells, with objects between them, as one eye of the stereo model `flat` sees
//! them. Each index draws one register of pixels. Edges and supersampling are as in DrawNearField.
template <class T, bool HasDisk, bool HasShells>
struct DrawFlatEyes {
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  FlatEyeBatch batch;

  using Pixels = FlatEyePixels<T, DrawFlatEyes>;
  using Objects = typename Pixels::Objects;
  static constexpr bool leaves_objects = false;

  ERGO_HD void operator()(int index) const { Pixels{batch, *this}.draw(index); }

  ERGO_HD bool draw_middle(int index) const { return Pixels{batch, *this}.draw_middle(index); }
  [[nodiscard]] ERGO_HD SeenLanes<T> see_sample(int index, int sample) const {
    return Pixels{batch, *this}.see_sample(index, sample);
  }
  ERGO_HD void lay_mean(int index, const SeenLanes<T>& sum) const { Pixels{batch, *this}.lay_mean(index, sum); }

  ERGO_HD void average(const Pixels& pixels, const typename Pixels::PixelGroup& group, const Mask& lanes,
                       SeenLanes<T>& sum) const {
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<S> at = near_sample<S>(i);
      Mask wanted = lanes;
      sum = sum + pixels.seen_at(group.x_px + at.along, group.y_px + at.down, at.width, group.objects, wanted);
    }
  }

  ERGO_HD Mask draw_near(const EyeLine<T>& line, const LayerSearch<S>& search, S pixel, const Mask& wanted,
                         Objects& objects, SeenLanes<T>& seen) const {
    if constexpr (HasDisk) {
      RayLayers<T> layers(batch);
      FlatDisk<T, RayLayers<T>> disk(batch, layers, line, search, pixel);
      disk.meet(wanted);
      int next[RealTraits<T>::lane_count] = {};
      const auto disk_until = [&](int i, S minus_nearness) { disk.compose_before(-minus_nearness, i, next[i], seen); };
      const auto before = [&](int i, S minus_nearness) {
        objects.until(i, minus_nearness, disk_until, seen);
        disk_until(i, minus_nearness);
      };
      Mask fine = wanted & !wanted;
      if constexpr (HasShells) {
        fine = draw_shells(line, search, pixel, wanted, before, seen);
      }
      T fine_disk(S(0));
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        if (mask_lane(wanted, i)) {
          before(i, S(0));
          set_lane(fine_disk, i, disk.is_fine(i) ? S(1) : S(0));
        }
      }
      return wanted & (fine | (fine_disk > T(S(0))));
    } else {
      const auto before = [&](int i, S minus_nearness) {
        objects.until(
            i, minus_nearness, [](int, S) {}, seen);
      };
      return draw_shells(line, search, pixel, wanted, before, seen);
    }
  }

 private:
  template <class Before>
  ERGO_HD Mask draw_shells(const EyeLine<T>& line, const LayerSearch<S>& search, S pixel, const Mask& wanted,
                           const Before& before, SeenLanes<T>& seen) const {
    return FlatShells<T, Before>(batch, line, search, pixel, before, seen).draw(wanted);
  }
};

//! Calls action(functor) with the variant for a batch; does nothing without disk and shells.
template <class T, class Action>
void dispatch(const FlatEyeBatch& batch, const Action& action) {
  const bool shells = batch.near_field.shells.count > 0;
  if (batch.near_field.drawing != DiskDrawing::none) {
    return shells ? action(DrawFlatEyes<T, true, true>{batch}) : action(DrawFlatEyes<T, true, false>{batch});
  }
  if (shells) {
    action(DrawFlatEyes<T, false, true>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
