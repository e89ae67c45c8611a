#pragma once

#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/shells/shell_crossings.h"
#include "kernels/shells/shell_sight.h"

// Shells as an eye's lines of sight meet them. Each shell has two layers: where light crosses it on
// its way in, and on its way out. If light turns before it reaches the shell, both layers continue
// at the turning point, which makes their distances continuous; no shell is visible there.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! A visitor of trace_shells() that stores where light crosses one shell, on its way in or on its
//! way out.
template <class T>
class ShellLayer {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  ERGO_HD explicit ShellLayer(bool inwards) : inwards_(inwards), found_(S(0)), turned_(S(0)), position_{} {}

  ERGO_HD void cross(int, const Mask& lanes, const NearPosition<D>& position) {
    const T one(S(1));
    const Mask own = lanes & (inwards_ ? position.u_rate.value > T(S(0)) : !(position.u_rate.value > T(S(0))));
    keep(own, position);
    found_ = select(own, one, found_);
  }

  ERGO_HD void turn(const Mask& lanes, const NearPosition<D>& position) {
    const Mask own = lanes & !(found_ > T(S(0)));
    keep(own, position);
    turned_ = select(own, T(S(1)), turned_);
  }

  [[nodiscard]] ERGO_HD Mask done() const { return found_ > T(S(0)); }

  //! Returns the lanes whose light neither crosses the shell in this sense (in or out) nor turns.
  [[nodiscard]] ERGO_HD Mask fallen() const { return (!(found_ > T(S(0)))) & !(turned_ > T(S(0))); }

  //! Copies the results in the lanes outside the mask `own` from another visitor.
  ERGO_HD void keep_others(const Mask& own, const ShellLayer& other) {
    keep(!own, other.position_);
    found_ = select(own, found_, other.found_);
    turned_ = select(own, turned_, other.turned_);
  }

  //! Returns the lanes whose light crosses the shell in this sense (in or out).
  [[nodiscard]] ERGO_HD Mask found() const { return found_ > T(S(0)); }

  [[nodiscard]] ERGO_HD const NearPosition<D>& position() const { return position_; }

  //! Returns q = 1 / affine distance of the layer. Light that neither crosses the shell nor turns
  //! moves away from it: the inward layer is then nearer than everything, and the outward layer
  //! infinitely far.
  [[nodiscard]] ERGO_HD D nearness(S max_w) const {
    const Mask there = (found_ > T(S(0))) | (turned_ > T(S(0)));
    const D none(T(inwards_ ? S(2) * max_w : S(0)));
    return select(there, D(T(S(1))) / select(there, position_.distance, D(T(S(1)))), none);
  }

 private:
  ERGO_HD void keep(const Mask& mask, const NearPosition<D>& from) {
    position_ = {select(mask, from.u, position_.u),
                 select(mask, from.u_rate, position_.u_rate),
                 {select(mask, from.m.x, position_.m.x), select(mask, from.m.y, position_.m.y),
                  select(mask, from.m.z, position_.m.z)},
                 select(mask, from.drag, position_.drag),
                 position_.delay,
                 select(mask, from.distance, position_.distance),
                 position_.time};
  }

  bool inwards_;
  T found_;
  T turned_;
  NearPosition<D> position_;
};

}  // namespace detail

//! Draws shells behind everything that a register of an eye's lines of sight has seen. Before each
//! shell, before(lane, time) is called to compose nearer things; the time is minus the nearness.
template <class T, class Before>
class FlatShells {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  ERGO_HD FlatShells(const FlatEyeBatch& batch, const EyeLine<T>& line, const LayerSearch<S>& search, S pixel,
                     const Before& before, SeenLanes<T>& seen)
      : batch_(batch), line_(line), search_(search), pixel_(pixel), before_(before), seen_(seen) {}

  //! Draws all shells: outermost first on the way in, last on the way out. Returns the lanes with
  //! detail finer than a pixel.
  ERGO_HD Mask draw(const Mask& lanes) const {
    const int count = batch_.near_field.shells.count;
    Mask fine = lanes & !lanes;
    for (int i = 0; i < 2 * count; ++i) {
      const bool inwards = i < count;
      fine = fine | meet(inwards ? i : 2 * count - 1 - i, inwards, lanes);
    }
    return fine;
  }

 private:
  ERGO_HD Mask meet(int shell, bool inwards, const Mask& lanes) const {
    const NearFieldBatch& scene = batch_.near_field;
    const CameraStationOf<S>& camera = scene.pixels.camera;
    const S u = scene.shells.u[shell];
    // From inside a shell, light does not cross it inwards.
    if (inwards && !(camera.u < u)) {
      return lanes & !lanes;
    }
    const NearLimits<S> limits = {static_cast<S>(scene.pixels.settings.tolerance), scene.pixels.settings.step_limit};
    detail::ShellLayer<T> layer(inwards);
    const auto trace = [&](const EyePoint<T>& point, const Mask& wanted) {
      layer = detail::ShellLayer<T>(inwards);
      const S own[1] = {u};
      trace_shells<near_order, NearParts::azimuth_and_distance>(camera.spin, start_near_ray(camera, point.n), {own, 1},
                                                                limits, wanted, layer);
      return layer.nearness(search_.max_w);
    };
    MetLayer<T> met = meet_layer(line_, T(S(0)), search_, lanes, trace);
    const Mask fallen = lanes & layer.fallen();
    if (any(fallen)) {
      // Light from the far side may pass the shadow's edge nearer to the eye, so the search is
      // repeated from the near end.
      const detail::ShellLayer<T> far_layer = layer;
      const MetLayer<T> again = meet_layer(line_, T(search_.max_w), search_, fallen, trace);
      const Mask other = again.met & layer.found();
      keep_layer(other, far_layer, met, layer, again);
    }
    Mask seen = met.met & layer.found() & (met.nearness() > T(S(0)));
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(seen, i) && is_behind_horizon(batch_.horizon, line_.direction(i), lane(met.nearness(), i))) {
        T flags = select(seen, T(S(1)), T(S(0)));
        set_lane(flags, i, S(0));
        seen = flags > T(S(0));
      }
    }
    return compose(shell, met, layer, seen);
  }

  //! Selects the result of the second search in the lanes of the mask, and that of the first search
  //! in the others.
  ERGO_HD static void keep_layer(const Mask& last, const detail::ShellLayer<T>& before, MetLayer<T>& met,
                                 detail::ShellLayer<T>& layer, const MetLayer<T>& again) {
    layer.keep_others(last, before);
    met = chosen(last, again, met);
  }

  ERGO_HD Mask compose(int shell, const MetLayer<T>& met, const detail::ShellLayer<T>& layer, const Mask& seen) const {
    const NearFieldBatch& scene = batch_.near_field;
    const NearPosition<D>& at = layer.position();
    const NearPosition<D> position = {
        met.carried(at.u),    at.u_rate, {met.carried(at.m.x), met.carried(at.m.y), met.carried(at.m.z)},
        met.carried(at.drag), at.delay,  at.distance,
        -met.nearness()};
    const NearRay<D> ray = start_near_ray(scene.pixels.camera, met.direction());
    ShellSight<T, Before> sight(scene.pixels.camera, scene.shells, ray, pixel_, before_, seen_);
    sight.cross(shell, seen & !sight.done(), position);
    // In lanes that do not meet the shell, light turns before it. The edge of the shell's image may
    // then be in the pixel.
    sight.turn(met.met & !layer.found(), position);
    return sight.fine();
  }

  const FlatEyeBatch& batch_;
  const EyeLine<T>& line_;
  LayerSearch<S> search_;
  S pixel_;
  const Before& before_;
  SeenLanes<T>& seen_;
};

}  // namespace ergodome::inline ERGO_TARGET
