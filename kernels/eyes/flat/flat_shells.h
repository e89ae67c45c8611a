#pragma once

#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/shells/shell_crossings.h"
#include "kernels/shells/shell_sight.h"

// Shells as an eye's lines of sight meet them. Each shell has two sheets: where light crosses it on
// its way in, and on its way out. If light turns before it reaches the shell, both sheets continue
// at the turning point, which makes their distances continuous; no shell is visible there.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! A visitor of trace_shells() that stores where light crosses one shell, on its way in or on its
//! way out.
template <class T>
class SheetOfShell {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  ERGO_HD explicit SheetOfShell(bool inwards) : inwards_(inwards), found_(S(0)), turned_(S(0)), place_{} {}

  ERGO_HD void cross(int, const Mask& lanes, const NearPlace<D>& place) {
    const T one(S(1));
    const Mask own = lanes & (inwards_ ? place.u_rate.value > T(S(0)) : !(place.u_rate.value > T(S(0))));
    keep(own, place);
    found_ = select(own, one, found_);
  }

  ERGO_HD void turn(const Mask& lanes, const NearPlace<D>& place) {
    const Mask own = lanes & !(found_ > T(S(0)));
    keep(own, place);
    turned_ = select(own, T(S(1)), turned_);
  }

  [[nodiscard]] ERGO_HD Mask done() const { return found_ > T(S(0)); }

  //! Returns the lanes whose light neither crosses the shell in this sense (in or out) nor turns.
  [[nodiscard]] ERGO_HD Mask fallen() const { return (!(found_ > T(S(0)))) & !(turned_ > T(S(0))); }

  //! Copies the results of the lanes outside the mask from another visitor.
  ERGO_HD void keep_others(const Mask& own, const SheetOfShell& other) {
    keep(!own, other.place_);
    found_ = select(own, found_, other.found_);
    turned_ = select(own, turned_, other.turned_);
  }

  //! Returns the lanes whose light crosses the shell in this sense (in or out).
  [[nodiscard]] ERGO_HD Mask found() const { return found_ > T(S(0)); }

  [[nodiscard]] ERGO_HD const NearPlace<D>& place() const { return place_; }

  //! Returns q = 1 / affine distance of the sheet. Light that neither crosses the shell nor turns
  //! moves away from it: the inward sheet is then nearer than everything, and the outward sheet
  //! infinitely far.
  [[nodiscard]] ERGO_HD D nearness(S most_w) const {
    const Mask there = (found_ > T(S(0))) | (turned_ > T(S(0)));
    const D none(T(inwards_ ? S(2) * most_w : S(0)));
    return select(there, D(T(S(1))) / select(there, place_.distance, D(T(S(1)))), none);
  }

 private:
  ERGO_HD void keep(const Mask& mask, const NearPlace<D>& from) {
    place_ = {
        select(mask, from.u, place_.u),
        select(mask, from.u_rate, place_.u_rate),
        {select(mask, from.m.x, place_.m.x), select(mask, from.m.y, place_.m.y), select(mask, from.m.z, place_.m.z)},
        select(mask, from.drag, place_.drag),
        place_.delay,
        select(mask, from.distance, place_.distance),
        place_.time};
  }

  bool inwards_;
  T found_;
  T turned_;
  NearPlace<D> place_;
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

  ERGO_HD FlatShells(const FlatEyeBatch& batch, const EyeLine<T>& line, const SheetSearch<S>& search, S pixel,
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
    detail::SheetOfShell<T> sheet(inwards);
    const auto trace = [&](const EyePoint<T>& point, const Mask& wanted) {
      sheet = detail::SheetOfShell<T>(inwards);
      const S own[1] = {u};
      trace_shells<near_order, NearParts::azimuth_and_distance>(camera.spin, start_near_ray(camera, point.n), {own, 1},
                                                                limits, wanted, sheet);
      return sheet.nearness(search_.most_w);
    };
    MetSheet<T> met = meet_sheet(line_, T(S(0)), search_, lanes, trace);
    const Mask fallen = lanes & sheet.fallen();
    if (any(fallen)) {
      // Light from the far side may pass the shadow's edge nearer to the eye, so search from the
      // near end, too.
      const detail::SheetOfShell<T> far_sheet = sheet;
      const MetSheet<T> again = meet_sheet(line_, T(search_.most_w), search_, fallen, trace);
      const Mask other = again.met & sheet.found();
      keep_sheet(other, far_sheet, met, sheet, again);
    }
    Mask seen = met.met & sheet.found() & (met.nearness() > T(S(0)));
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(seen, i) && is_behind_horizon(batch_.horizon, line_.direction(i), lane(met.nearness(), i))) {
        T flags = select(seen, T(S(1)), T(S(0)));
        set_lane(flags, i, S(0));
        seen = flags > T(S(0));
      }
    }
    return compose(shell, met, sheet, seen);
  }

  //! Selects the result of the last search in the lanes of the mask, and that of the search before
  //! in the others.
  ERGO_HD static void keep_sheet(const Mask& last, const detail::SheetOfShell<T>& before, MetSheet<T>& met,
                                 detail::SheetOfShell<T>& sheet, const MetSheet<T>& again) {
    sheet.keep_others(last, before);
    met = chosen(last, again, met);
  }

  ERGO_HD Mask compose(int shell, const MetSheet<T>& met, const detail::SheetOfShell<T>& sheet,
                       const Mask& seen) const {
    const NearFieldBatch& scene = batch_.near_field;
    const NearPlace<D>& at = sheet.place();
    const NearPlace<D> place = {
        met.carried(at.u),    at.u_rate, {met.carried(at.m.x), met.carried(at.m.y), met.carried(at.m.z)},
        met.carried(at.drag), at.delay,  at.distance,
        -met.nearness()};
    const NearRay<D> ray = start_near_ray(scene.pixels.camera, met.direction());
    ShellSight<T, Before> sight(scene.pixels.camera, scene.shells, ray, pixel_, before_, seen_);
    sight.cross(shell, seen & !sight.done(), place);
    // In lanes that do not meet the shell, light turns before it. The edge of the shell's image may
    // then be in the pixel.
    sight.turn(met.met & !sheet.found(), place);
    return sight.fine();
  }

  const FlatEyeBatch& batch_;
  const EyeLine<T>& line_;
  SheetSearch<S> search_;
  S pixel_;
  const Before& before_;
  SeenLanes<T>& seen_;
};

}  // namespace ergodome::inline ERGO_TARGET
