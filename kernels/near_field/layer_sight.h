#pragma once

#include "kernels/core/lanes.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/objects/lay_objects.h"

namespace ergodome::inline ERGO_TARGET {

//! Objects as a register of pixels sees them: looked at before (kernels/mesh), one light and one depth a pixel.
template <class T, bool Objects>
class LayerSight {
 public:
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  //! For pixels first, first + 1, ... of a block of `count`. Without a layer, none wait.
  ERGO_HD LayerSight(const ObjectLayer& layer, int first, int count) : layer_(layer), first_(first), waiting_(S(0)) {
    for (int i = 0; layer.rgba != nullptr && i < RealTraits<T>::lane_count && first + i < count; ++i) {
      set_lane(waiting_, i, layer.rgba[4 * static_cast<long>(first + i) + 3] > 0.0F ? S(1) : S(0));
    }
  }

  //! Lanes whose object is not drawn yet.
  [[nodiscard]] ERGO_HD Mask waiting() const { return waiting_ > T(S(0)); }

  //! Draws lane i's object if it is nearer than a Mino time (or what stands for it in the layer), and what is nearer than that before it:
  //! nearer(lane, time).
  template <class Nearer>
  ERGO_HD void until(int i, S time, const Nearer& nearer, SeenLanes<T>& seen) {
    if (!(lane(waiting_, i) > S(0))) {
      return;
    }
    const S own = layer_.time[first_ + i];
    if (!(own < time)) {
      return;
    }
    nearer(i, own);
    set_lane(waiting_, i, S(0));
    const float* const rgba = layer_.rgba + 4 * static_cast<long>(first_ + i);
    put_behind({rgba[0], rgba[1], rgba[2]}, rgba[3], i, seen);
  }

 private:
  const ObjectLayer& layer_;
  int first_;
  T waiting_;
};

//! The same where there are none.
template <class T>
class LayerSight<T, false> {
 public:
  ERGO_HD LayerSight(const ObjectLayer&, int, int) {}
  template <class Nearer>
  ERGO_HD void until(int, ScalarOf<T>, const Nearer&, SeenLanes<T>&) {}
};

}  // namespace ergodome::inline ERGO_TARGET
