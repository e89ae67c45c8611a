#pragma once

#include "kernels/disk/draw_disk.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/trace/pixel_geometry.h"

namespace ergodome::inline ERGO_TARGET {

//! Order of the Taylor series of a disk's pictures, as of the sky's.
inline constexpr int disk_order = 10;

namespace detail {

//! ln T at a radius.
ERGO_HD float log_temperature_at(const DiskProfileTable& table, float r) {
  const float place = sqrt(maximum(1.0F - table.first_r / r, 0.0F)) / table.step;
  const float clamped = minimum(place, static_cast<float>(table.count - 1));
  const int i = static_cast<int>(clamped) < table.count - 1 ? static_cast<int>(clamped) : table.count - 2;
  const float t = clamped - static_cast<float>(i);
  const float temperature = table.temperature[i] + t * (table.temperature[i + 1] - table.temperature[i]);
  return ::logf(maximum(temperature, 1e-3F));
}

//! The part of a disk that a pixel sees: how much of it the pixel is covered by, and the radius in its middle.
struct DiskSpan {
  float coverage;
  float r;
};

//! `width` is how far u = 1/r changes across the pixel: edges cover it by the radii that lie between them. In u the map of pixels to the
//! plane is smooth past infinity, so that images that are finer than a pixel have their share of it.
ERGO_HD DiskSpan disk_span(float inner_r, float outer_r, float u, float width) {
  const float w = maximum(width, 1e-6F / inner_r);
  const float low = maximum(u - 0.5F * w, 1.0F / outer_r);
  const float high = minimum(u + 0.5F * w, 1.0F / inner_r);
  const float middle = minimum(maximum(0.5F * (low + high), 1.0F / outer_r), 1.0F / inner_r);
  return {minimum(maximum((high - low) / w, 0.0F), 1.0F), 1.0F / middle};
}

}  // namespace detail

//! A crossing as one pixel sees it.
struct SeenCrossing {
  float coverage;  //!< of the pixel by the disk
  float r;         //!< in the middle of what is covered [M]
  float blur;      //!< how far r changes across the pixel, as a part of it
  bool outwards;
  float phi;    //!< Boyer-Lindquist azimuth [rad], for the pattern
  float delay;  //!< [M], for the pattern
};

//! What of a photon stays the same on its way; see NearRay.
struct PhotonConstants {
  float energy;
  float axial_angular_momentum;
  float shear_constant;
  float carter;
};

//! Light of the disk at a crossing, in linear sRGB.
//!
//! Intensity over the cube of the frequency is the same all along a ray, so a blackbody of T is seen as one of g T: shift and beaming in one.
ERGO_HD Vector3<float> disk_light(const DiskLook& look, const PhotonConstants& photon, const SeenCrossing& at) {
  const float r = at.r;
  const float frequency =
      disk_frequency(look.flow, {r, photon.energy, photon.axial_angular_momentum, photon.shear_constant, at.outwards});
  const float g = 1.0F / maximum(frequency, 1e-30F);
  const float shift = look.shifted ? ::logf(maximum(g, 1e-30F)) : 0.0F;
  const Vector3<float> seen = read_blackbody(look.colours, detail::log_temperature_at(look.profile, r) + shift);
  float luminance = look.exposure * ::expf(minimum(seen.x - look.log_unit, 80.0F));
  if (look.limb_darkened) {
    // Cosine of the angle of emission: p_θ over the emitted energy. I = (1 + 2.06 μ) / 2.37 of the mean (Chandrasekhar 1950).
    const float cosine = minimum(g * safe_sqrt(photon.carter) / r, 1.0F);
    luminance *= (1.0F + 2.06F * cosine) / (1.0F + 2.06F * 2.0F / 3.0F);
  }
  if (look.contrast > 0.0F) {
    const float rotation = 1.0F / (r * sqrt(r) + look.flow.spin);
    const float clouds = disk_pattern(look.pattern, r, at.phi, rotation, at.delay, at.blur);
    luminance *= ::expf(look.contrast * clouds);
  }
  return displayable(linear_srgb(Vector3<float>{seen.y, 1.0F, seen.z}), luminance);
}

//! What the disk adds to pixels, and how much of what is behind they still see.
template <class T>
struct DiskLanes {
  T red, green, blue;
  T clear;
};

//! Draws the disk over pixels; index i stands for the pixels i * lanes, i * lanes + 1, ... of the block. The nearest crossing lies before
//! those further along the ray, and the sky behind them all. WithPattern compiles azimuth and time in: a plain disk pays for neither.
template <class T, bool WithPattern>
struct DrawDisk {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;
  using Crossings = EquatorialCrossing<D>[crossing_orders];
  using PlainCrossings = EquatorialCrossing<T>[crossing_orders];

  DiskBatch batch;

  ERGO_HD void operator()(int index) const {
    const PixelBatch& pixels = batch.pixels;
    const int first = index * RealTraits<T>::lane_count;
    T x_px;
    T y_px;
    pixel_middles(pixels, first, x_px, y_px);
    const T inside = image_coverage(pixels.projection, x_px, y_px);
    Mask fine = inside > T(S(0));
    DiskLanes<T> seen = look(x_px, y_px, S(1), fine);
    if (any(fine)) {
      average(x_px, y_px, fine, seen);
    }
    const int count = pixel_count(pixels);
    for (int i = 0; i < RealTraits<T>::lane_count && first + i < count; ++i) {
      float* rgba = batch.rgba + 4 * static_cast<long>(first + i);
      const float clear = lane(seen.clear, i);
      const float part = lane(inside, i);
      if (clear < 1.0F) {
        rgba[0] = part * lane(seen.red, i) + clear * rgba[0];
        rgba[1] = part * lane(seen.green, i) + clear * rgba[1];
        rgba[2] = part * lane(seen.blue, i) + clear * rgba[2];
        rgba[3] = part * (1.0F - clear) + clear * rgba[3];
      }
    }
  }

 private:
  //! Samples along each side of a pixel that holds images finer than itself.
  static constexpr int samples = 4;
  //! A change of 1/r across the pixel, as a part of the whole disk's, from which on it may: next to the critical curve image after image is
  //! thinner, e^π times about without spin.
  static constexpr float fine_change = 0.25F;

  //! Looks at many places within the pixels of the mask.
  ERGO_HD void average(const T& x_px, const T& y_px, const Mask& fine, DiskLanes<T>& seen) const {
    const T zero(S(0));
    DiskLanes<T> sum = {zero, zero, zero, zero};
    constexpr S step = S(1) / samples;
    for (int i = 0; i < samples * samples; ++i) {
      const int row = i / samples;
      const S along = (static_cast<S>(i - row * samples) + S(0.5)) * step - S(0.5);
      const S down = (static_cast<S>(row) + S(0.5)) * step - S(0.5);
      Mask wanted = fine;
      const DiskLanes<T> there = look(x_px + along, y_px + down, step, wanted);
      sum = {sum.red + there.red, sum.green + there.green, sum.blue + there.blue, sum.clear + there.clear};
    }
    constexpr S share = step * step;
    seen = {select(fine, sum.red * share, seen.red), select(fine, sum.green * share, seen.green),
            select(fine, sum.blue * share, seen.blue), select(fine, sum.clear * share, seen.clear)};
  }

  //! What is seen at places of the image, by pixels of a part of the image's own. `lanes` says which to look at, and then where images may
  //! be finer than that.
  ERGO_HD DiskLanes<T> look(const T& x_px, const T& y_px, S pixel, Mask& lanes) const {
    const PixelBatch& pixels = batch.pixels;
    const T zero(S(0));
    DiskLanes<T> seen = {zero, zero, zero, T(S(1))};
    const NearRay<D> ray = start_near_ray(pixels.camera, observed_direction(pixels, x_px, y_px));
    const Mask wanted = lanes & may_reach(ray);
    lanes = zero > zero;
    if (!any(wanted)) {
      return seen;
    }
    // No light turns back to the hole from beyond its photon orbits.
    const CrossingLimits<S> limits = {minimum(S(0.5) / batch.look.outer_r, S(0.22)),
                                      static_cast<S>(pixels.settings.tolerance), pixels.settings.step_limit};
    Crossings crossings;
    trace_crossings<disk_order, false>(pixels.camera.spin, ray, limits, wanted, crossings);
    PlainCrossings carried;
    if constexpr (WithPattern) {
      trace_pattern(ray, limits, wanted, crossings, pixel, carried);
    }
    T fine = zero;
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(wanted, i)) {
        compose(ray, crossings, carried, i, pixel, seen);
        set_lane(fine, i, is_fine(crossings, i) ? S(1) : S(0));
      }
    }
    lanes = fine > zero;
    return seen;
  }

  //! Whether light from the disk may come along a ray: from outside the disk it must go inwards, and not turn before the outer edge.
  ERGO_HD Mask may_reach(const NearRay<D>& ray) const {
    // A pixel's width beyond the edge is still the edge's.
    const S u = S(0.9) / batch.look.outer_r;
    const S a2 = batch.pixels.camera.spin * batch.pixels.camera.spin;
    const T e2 = ray.energy.value * ray.energy.value;
    const T potential = e2 + (u * u) * ((a2 * e2 - ray.polar_constant.value) +
                                        u * (S(2) * ray.shear_constant.value - (a2 * u) * ray.carter.value));
    const auto within = ray.u.value > T(u);
    return within | ((ray.u_rate.value > T(S(0))) & (potential > T(S(0))));
  }

  ERGO_HD static bool is_crossing(const EquatorialCrossing<D>& crossing, int i) {
    const S u = lane(crossing.u.value, i);
    return u < S(0) || u > S(0);
  }

  //! How far 1/r changes across a pixel.
  ERGO_HD static float change(const EquatorialCrossing<D>& crossing, int i) {
    const float along_x = lane(crossing.u.along_x, i);
    const float along_y = lane(crossing.u.along_y, i);
    return sqrt(along_x * along_x + along_y * along_y);
  }

  ERGO_HD bool is_fine(const Crossings& crossings, int i) const {
    const float least = fine_change * (1.0F / batch.look.inner_r - 1.0F / batch.look.outer_r);
    bool fine = false;
    for (const EquatorialCrossing<D>& crossing : crossings) {
      fine = fine || (is_crossing(crossing, i) && change(crossing, i) > least);
    }
    return fine;
  }

  //! What of the disk a lane sees at a crossing.
  ERGO_HD SeenCrossing seen_at(const EquatorialCrossing<D>& crossing, int i, S pixel) const {
    const float width = pixel * change(crossing, i);
    const detail::DiskSpan span =
        detail::disk_span(batch.look.inner_r, batch.look.outer_r, lane(crossing.u.value, i), width);
    return {span.coverage, span.r, width * span.r, lane(crossing.u_rate.value, i) > 0.0F, 0.0F, 0.0F};
  }

  //! Azimuth and time at the crossings, of the lanes that see the disk at all.
  ERGO_HD void trace_pattern(const NearRay<D>& ray, const CrossingLimits<S>& limits, const Mask& wanted,
                             const Crossings& crossings, S pixel, PlainCrossings& carried) const {
    T covered(S(0));
    for (const EquatorialCrossing<D>& crossing : crossings) {
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        if (mask_lane(wanted, i) && is_crossing(crossing, i) && seen_at(crossing, i, pixel).coverage > 0.0F) {
          set_lane(covered, i, S(1));
        }
      }
    }
    trace_crossings<disk_order, true>(batch.pixels.camera.spin, plain_ray(ray), limits, covered > T(S(0)), carried);
  }

  //! Adds the crossings of a lane, the nearest first.
  ERGO_HD void compose(const NearRay<D>& ray, const Crossings& crossings, const PlainCrossings& carried, int i, S pixel,
                       DiskLanes<T>& to) const {
    const DiskLook& look = batch.look;
    const PhotonConstants photon = {lane(ray.energy.value, i), lane(ray.axial_angular_momentum.value, i),
                                    lane(ray.shear_constant.value, i), lane(ray.carter.value, i)};
    Vector3<float> light = {0.0F, 0.0F, 0.0F};
    float clear = 1.0F;
    for (int order = 0; order < crossing_orders && is_crossing(crossings[order], i); ++order) {
      SeenCrossing at = seen_at(crossings[order], i, pixel);
      const float opacity = look.opacity * at.coverage;
      // A number that is not one covers nothing.
      if (!(opacity > 0.0F)) {
        continue;
      }
      if constexpr (WithPattern) {
        const EquatorialCrossing<T>& there = carried[order];
        const CameraStationOf<float>& camera = batch.pixels.camera;
        at.phi = ::atan2f(lane(there.y, i), lane(there.x, i)) + lane(there.drag, i) +
                 ::atan2f(camera.sine_phi, camera.cosine_phi);
        at.delay = lane(there.delay, i);
      }
      light = light + (clear * opacity) * disk_light(look, photon, at);
      clear *= 1.0F - opacity;
    }
    set_lane(to.red, i, light.x);
    set_lane(to.green, i, light.y);
    set_lane(to.blue, i, light.z);
    set_lane(to.clear, i, clear);
  }
};

}  // namespace ergodome::inline ERGO_TARGET
