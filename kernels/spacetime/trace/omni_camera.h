#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/kerr/horizon_winding.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Cameras of omnidirectional eyes.
namespace ergodome {

//! Number of values that set up the rays of a camera, all smooth functions of its position, also
//! across the spin axis: u, m, and six forms of the view's direction (energy, axial momentum,
//! outward rate, and dm/dλ along x, y, z), each with a constant and three weights. They are those
//! of CameraStation, in the view's axes. The axes of m rotate with the head's azimuth only.
inline constexpr int omni_numbers = 28;
//! Index of the first value of the energy's form.
inline constexpr int omni_energy = 4;

//! Highest degree of the polynomials that give these values as functions of the eye's position.
inline constexpr int omni_max_degree = 10;

constexpr int omni_terms(int degree) { return (degree + 1) * (degree + 2) / 2; }

//! An omnidirectional eye, which turns with the azimuth of the viewing direction. For each
//! direction it is to the right of that direction, in the view's horizontal plane, so every
//! direction has its own camera.
//!
//! The values that rays need are polynomials of the eye's position in that plane, fitted to exact
//! cameras (render/eyes/omni_camera.h).
template <class S>
struct OmniCameraOf {
  S spin;
  S horizon_r;
  S offset;               //!< distance of the eye from the head's center, positive to the right [M]
  S inverse_convergence;  //!< 1 / radius of the sphere on which the eyes' directions meet [1/M]
  S fade_begin;           //!< cosine of the elevation at which the offset is 0
  S fade_scale;           //!< 1 / (cosine at which the offset is full - fade_begin)
  //! 1 / distance of the eye from the head up to which the polynomials are valid [1/M].
  S inverse_reach;
  int degree;  //!< degree in p and q of the polynomials of `coefficients`
  //! omni_numbers polynomials, each with omni_terms(degree) coefficients, of the terms 1, p, q, p²,
  //! p q, q², ... p and q are the eye's position to the right and to the back, times inverse_reach.
  const S* coefficients;
  //! The head is falling through the horizon, or is near it: azimuths of m are in ingoing Kerr
  //! coordinates, which are continuous for eyes on both sides of the horizon.
  bool ingoing = false;
  S turn = S(0);  //!< `turn` of the head's CameraStation
  S lag = S(0);
};

//! A block of rows of one image of an omnidirectional eye. The edge in `pixels` is that of the
//! whole image, in the view's axes; the camera in `pixels` is the head's, for its spin and azimuth.
struct OmniBatch {
  PixelBatch pixels;
  OmniCameraOf<float> camera;
};

//! Many rays of an omnidirectional eye, traced by Taylor series; `rays.method` is ignored.
//! Directions are in the view's axes; the camera in `rays` is the head's, for its azimuth.
struct OmniRayBatch {
  RayBatch<double> rays;
  OmniCameraOf<double> camera;
};

inline namespace ERGO_TARGET {

//! Computes the position of the eye for a direction of the view (unit vector: x right, y up, z
//! back): to the right and to the back [M].
template <class T>
ERGO_HD void omni_offset(const OmniCameraOf<ScalarOf<T>>& camera, const Vector3<T>& view, T& right, T& back) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const T zero(S(0));
  const T one(S(1));
  const T across = sqrt(view.x * view.x + view.z * view.z + S(1e-20));
  const T ramp = (across - camera.fade_begin) * camera.fade_scale;
  const Real height = value_of(ramp);
  const T part = select(height > Real(S(0)), select(height < Real(S(1)), ramp, one), zero);
  const T share = (part * part * (S(3) - S(2) * part)) * camera.offset / across;
  right = -(view.z * share);
  back = view.x * share;
}

//! The camera of an eye for one direction of the view: u, m, and the values of its six forms in
//! that direction (see omni_numbers).
template <class T>
struct OmniSight {
  T u;
  Vector3<T> m;
  T energy;
  T axial_momentum;
  T outward_rate;
  Vector3<T> m_rate;
};

//! Returns the angle by which m and its rate must be rotated about the spin axis to have the head's
//! azimuth. Light that moves only inwards (and is followed in ingoing Kerr coordinates) needs the
//! head's full turn; other light starts from the eye's Boyer-Lindquist azimuth.
template <class T>
ERGO_HD T omni_turn(const OmniCameraOf<ScalarOf<T>>& camera, const OmniSight<T>& sight) {
  const RealOf<T> zero(ScalarOf<T>(0));
  const T head(RealOf<T>(camera.turn));
  const auto horizon = horizon_winding(camera.spin);
  const auto comes_in = value_of(sight.outward_rate) > zero;
  return select(comes_in, head, head - winding_turn(horizon) * winding(horizon, sight.u));
}

//! Converts the values of an eye whose head is `ingoing` to axes of m that are rotated to the
//! head's azimuth.
template <class T>
ERGO_HD OmniSight<T> in_heads_azimuth(const OmniCameraOf<ScalarOf<T>>& camera, const OmniSight<T>& sight) {
  T sine;
  T cosine;
  sine_cosine(omni_turn(camera, sight), sine, cosine);
  const auto turned = [&](const Vector3<T>& v) {
    return Vector3<T>{cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z};
  };
  OmniSight<T> other = sight;
  other.m = turned(sight.m);
  other.m_rate = turned(sight.m_rate);
  return other;
}

template <class T>
ERGO_HD OmniSight<T> omni_sight(const OmniCameraOf<ScalarOf<T>>& camera, const Vector3<T>& view) {
  using S = ScalarOf<T>;
  T right;
  T back;
  omni_offset(camera, view, right, back);
  // The directions of both eyes converge on a sphere about the head: there, both see the same
  // point.
  Vector3<T> n = {view.x - camera.inverse_convergence * right, view.y, view.z - camera.inverse_convergence * back};
  const T inverse_length = S(1) / sqrt(dot(n, n));
  n = {n.x * inverse_length, n.y * inverse_length, n.z * inverse_length};

  T term[omni_terms(omni_max_degree)];
  const T p = camera.inverse_reach * right;
  const T q = camera.inverse_reach * back;
  term[0] = T(S(1));
  int count = 1;
  for (int degree = 1; degree <= camera.degree; ++degree) {
    // The terms of this degree are p times each term of the degree below, and q times the last of
    // those.
    const int before = count - degree;
    for (int i = 0; i < degree; ++i) {
      term[count + i] = p * term[before + i];
    }
    term[count + degree] = q * term[before + degree - 1];
    count += degree + 1;
  }
  const auto number = [&](int i) {
    const S* c = camera.coefficients + i * count;
    T sum = T(c[0]);
    for (int k = 1; k < count; ++k) {
      sum = sum + c[k] * term[k];
    }
    return sum;
  };
  const auto form = [&](int i) {
    return number(omni_energy + 4 * i) +
           (number(omni_energy + 4 * i + 1) * n.x + number(omni_energy + 4 * i + 2) * n.y +
            number(omni_energy + 4 * i + 3) * n.z);
  };
  const OmniSight<T> sight = {number(0), {number(1), number(2), number(3)}, form(0), form(1),
                              form(2),   {form(3), form(4), form(5)}};
  return camera.ingoing ? in_heads_azimuth(camera, sight) : sight;
}

//! Returns the ray that an eye sees in a direction of the view, in axes that are rotated to the
//! head's azimuth, as turned_to_camera() expects.
template <class T>
ERGO_HD RayStart<T> start_omni_ray(const OmniCameraOf<ScalarOf<T>>& camera, const Vector3<T>& view) {
  using S = ScalarOf<T>;
  const OmniSight<T> sight = omni_sight(camera, view);
  RayStart<T> ray;
  ray.energy = sight.energy;
  const T inverse_energy = S(1) / ray.energy;
  ray.axial_angular_momentum = sight.axial_momentum * inverse_energy;
  ray.u = sight.u;
  ray.u_rate = -(sight.outward_rate * inverse_energy);
  ray.m = sight.m;
  ray.m_rate = {sight.m_rate.x * inverse_energy, sight.m_rate.y * inverse_energy, sight.m_rate.z * inverse_energy};
  const S a = camera.spin;
  ray.polar_constant = dot(ray.m_rate, ray.m_rate) - (a * a) * (ray.m.z * ray.m.z);
  ray.shear_constant = ray.polar_constant - S(2) * a * ray.axial_angular_momentum + a * a;
  ray.ingoing = camera.ingoing;
  return ray;
}

//! Returns the same ray as start_omni_ray(), under the name that kernels call for any camera.
template <class T>
ERGO_HD RayStart<T> start_ray(const OmniCameraOf<ScalarOf<T>>& camera, const Vector3<T>& view) {
  return start_omni_ray(camera, view);
}

//! Returns the energy at infinity of light that an eye sees in a direction, for an observed energy
//! of 1.
template <class T>
ERGO_HD T energy_of(const OmniCameraOf<ScalarOf<T>>& camera, const Vector3<T>& view) {
  return start_omni_ray(camera, view).energy;
}

}  // namespace ERGO_TARGET
template <>
struct Kernel<OmniBatch> : KernelDefaults {
  static const char* name(const OmniBatch& batch) {
    return has_footprints(batch.pixels.out) ? "trace_omni_pixels, footprints" : "trace_omni_pixels";
  }
  static PixelRows rows(const OmniBatch& batch) { return Kernel<PixelBatch>::rows(batch.pixels); }

  template <class Visit>
  static void visit_outputs(const OmniBatch& batch, const Visit& visit) {
    Kernel<PixelBatch>::visit_outputs(batch.pixels, visit);
  }
};

template <>
struct Kernel<OmniRayBatch> : KernelDefaults {
  using Real = double;
  static const char* name(const OmniRayBatch& /*batch*/) { return "trace_rays, double"; }
  static int elements(const OmniRayBatch& batch) { return batch.rays.count; }

  template <class Visit>
  static void visit_outputs(const OmniRayBatch& batch, const Visit& visit) {
    Kernel<RayBatch<double>>::visit_outputs(batch.rays, visit);
  }
};

}  // namespace ergodome
