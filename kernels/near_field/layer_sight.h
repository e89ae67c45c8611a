#pragma once

#include "kernels/core/lanes.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/objects/lay_objects.h"

namespace ergodome::inline ERGO_TARGET {

//! Objects as a pack of pixels sees them. They have already been drawn (kernels/objects), with one
//! color and one depth per pixel.
template <class T, bool Objects>
class LayerSight {
 public:
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  //! Reads the objects of the pixels first, first + 1, ... of a block of `count`. Without a layer,
  //! no lane has an object.
  ERGO_HD LayerSight(const ObjectLayer& layer, int first, int count) : layer_(layer), first_(first), waiting_(S(0)) {
    for (int i = 0; layer.rgba != nullptr && i < RealTraits<T>::lane_count && first + i < count; ++i) {
      set_lane(waiting_, i, layer.rgba[4 * static_cast<long>(first + i) + 3] > 0.0F ? S(1) : S(0));
    }
  }

  //! Returns the lanes whose object has not been added yet.
  [[nodiscard]] ERGO_HD Mask waiting() const { return waiting_ > T(S(0)); }

  //! Adds the object of lane `i` if it is nearer than `time`: if its Mino time is less. Does
  //! nothing if the object has already been added. (For `flat` eyes, the times are minus the
  //! nearness.) Before adding it, calls nearer(lane, time) to add what is nearer than the object.
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

//! Does nothing; replaces the class above in scenes without objects.
template <class T>
class LayerSight<T, false> {
 public:
  ERGO_HD LayerSight(const ObjectLayer&, int, int) {}
  template <class Nearer>
  ERGO_HD void until(int, ScalarOf<T>, const Nearer&, SeenLanes<T>&) {}
};

}  // namespace ergodome::inline ERGO_TARGET
