#include "render/eyes/omni_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/eyes/disk_fit.h"

namespace ergodome {

namespace {

//! Minimum tolerance of a fit: the rounding errors of float are larger than this.
constexpr double finest_fit = 2e-7;

using Numbers = std::array<double, omni_numbers>;

CameraStation station_of(const EyeCamera& eye, double phi) {
  return make_camera_station(eye.spacetime, eye.r, eye.theta, phi, eye.motion, eye.velocity);
}

//! A linear form of the view's direction: its constant term, and its coefficients for the
//! components x, y and z.
using Form = std::array<double, 4>;

Form form_in_view(const EyeCamera& eye, const DirectionForm<double>& form) {
  const Vector3<double> along = in_view(eye, form.along);
  return {form.constant, along.x, along.y, along.z};
}

Form sum_of(double a, const Form& first, double b, const Form& second) {
  Form sum{};
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = a * first[i] + b * second[i];
  }
  return sum;
}

//! Returns whether eyes of this head may be on both sides of the horizon.
bool is_ingoing(const EyeCamera& head) {
  return head.motion == ObserverMotion::rain_boost && is_near_horizon(head.spacetime, head.r);
}

//! Returns an eye's azimuth, in ingoing Kerr coordinates if `ingoing`.
double azimuth_of(const EyeCamera& eye, bool ingoing) {
  const bool outside = eye.r > horizon_radius(eye.spacetime);
  return eye.phi + (ingoing && outside ? ingoing_turn(eye.spacetime, eye.r) : 0.0);
}

//! Returns the values of an exact camera that the polynomials fit, in the order of omni_numbers: u,
//! the unit vector m of the position, and six linear forms.
Numbers numbers_of(const EyeCamera& eye, const EyeCamera& head) {
  const bool ingoing = is_ingoing(head);
  const CameraStation camera = station_of(eye, azimuth_of(eye, ingoing) - azimuth_of(head, ingoing));
  const double st = camera.sine_theta;
  const double ct = camera.cosine_theta;
  const double sp = camera.sine_phi;
  const double cp = camera.cosine_phi;
  const Form polar = form_in_view(eye, camera.polar_rate);
  const Form around = form_in_view(eye, camera.azimuthal_rate);
  const Form forms[6] = {form_in_view(eye, camera.energy),       form_in_view(eye, camera.axial_momentum),
                         form_in_view(eye, camera.outward_rate), sum_of(ct * cp, polar, -sp, around),
                         sum_of(ct * sp, polar, cp, around),     sum_of(-st, polar, 0.0, around)};
  Numbers numbers = {camera.u, st * cp, st * sp, ct};
  for (std::size_t i = 0; i < 6; ++i) {
    std::ranges::copy(forms[i], numbers.begin() + static_cast<long>(4 + 4 * i));
  }
  return numbers;
}

//! Returns a function that computes numbers_of() the exact camera for a point on the unit disk,
//! which stands for the disk of all eye positions with radius `reach` [M].
DiskNumbers exact_numbers(const EyeAtOffset& eye_at, double reach, const EyeCamera& head) {
  return [&eye_at, reach, head](const DiskPoint& point) {
    const Numbers numbers = numbers_of(eye_at({reach * point.p, 0.0, reach * point.q}), head);
    return std::vector<double>(numbers.begin(), numbers.end());
  };
}

//! Returns the largest error of a fit. The error of each number is relative to the largest number
//! of its group.
double fit_error(const EyeAtOffset& eye_at, double reach, const EyeCamera& head, int degree,
                 const std::vector<double>& coefficients) {
  const std::vector<DiskPoint> points = disk_points(3, 13, 0.37);
  const DiskNumbers numbers_at = exact_numbers(eye_at, reach, head);
  const auto terms = static_cast<std::size_t>(omni_terms(degree));
  double scale[8] = {};
  double error[8] = {};
  // Groups of numbers (see omni_numbers) with a common scale: 0: u; 1: m; 2 to 4: the forms of
  // energy, axial momentum and outward rate; 5: the three forms of the vector dm/dλ together.
  const auto group = [](std::size_t i) { return i < 1 ? 0U : i < 4 ? 1U : std::min<std::size_t>(2 + (i - 4) / 4, 5); };
  for (const DiskPoint& point : points) {
    const std::vector<double> term = disk_terms(point, degree);
    const std::vector<double> exact = numbers_at(point);
    for (std::size_t i = 0; i < omni_numbers; ++i) {
      const double value =
          std::inner_product(term.begin(), term.end(), coefficients.begin() + static_cast<long>(i * terms), 0.0);
      scale[group(i)] = std::max(scale[group(i)], std::abs(exact[i]));
      error[group(i)] = std::max(error[group(i)], std::abs(value - exact[i]));
    }
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    // The minimum prevents a division by zero. No group of numbers vanishes everywhere, except by
    // rounding; that includes the axial momenta without spin.
    largest = std::max(largest, error[i] / std::max(scale[i], 1e-300));
  }
  return largest;
}

}  // namespace

OmniSettings omni_settings(const StereoSettings& stereo, double baseline, double tolerance) {
  return {0.5 * baseline, stereo.convergence, one_degree * stereo.fade_from_deg, one_degree * stereo.fade_to_deg,
          tolerance};
}

OmniCamera::OmniCamera(Backend backend, const EyeAtOffset& eye_at, const OmniSettings& settings) {
  const EyeCamera head = eye_at({0.0, 0.0, 0.0});
  const double reach = settings.half_baseline;
  camera_.spin = head.spacetime.spin;
  camera_.horizon_r = horizon_radius(head.spacetime);
  camera_.offset = reach;
  camera_.inverse_convergence = settings.convergence > 0.0 ? 1.0 / settings.convergence : 0.0;
  camera_.fade_begin = std::cos(settings.fade_to);
  camera_.fade_scale = 1.0 / (std::cos(settings.fade_from) - camera_.fade_begin);
  camera_.inverse_reach = reach > 0.0 ? 1.0 / reach : 0.0;
  if (is_ingoing(head)) {
    const CameraStation station = station_of(head, 0.0);
    camera_.ingoing = true;
    camera_.turn = station.turn;
    camera_.lag = station.lag;
  }
  const double tolerance = std::clamp(0.1 * settings.tolerance, finest_fit, omni_min_exact);
  double error = 0.0;
  for (int degree = reach > 0.0 ? 1 : 0; degree <= omni_max_degree; ++degree) {
    camera_.degree = degree;
    coefficients_ = fit_numbers(exact_numbers(eye_at, reach, head), degree);
    error = fit_error(eye_at, reach, head, degree, coefficients_);
    if (error <= tolerance) {
      break;
    }
  }
  if (!(error <= omni_min_exact)) {
    throw Error("stereo.baseline",
                fmt::format("{:.6g} M is too large for the model omni at r = {:.6g} M", 2.0 * reach, head.r),
                "choose a smaller baseline, or model = \"physical\"");
  }
  coefficients_as_float_.assign(coefficients_.begin(), coefficients_.end());
  for_kernels_ = Buffer<float>(backend, coefficients_as_float_, "omni cameras");
}

OmniCameraOf<float> OmniCamera::on_host(double side) const {
  OmniCameraOf<float> camera = view(side);
  camera.coefficients = coefficients_as_float_.data();
  return camera;
}

OmniCameraOf<float> OmniCamera::view(double side) const {
  const auto narrow = [](double value) { return static_cast<float>(value); };
  return {narrow(camera_.spin),          narrow(camera_.horizon_r),
          narrow(side * camera_.offset), narrow(camera_.inverse_convergence),
          narrow(camera_.fade_begin),    narrow(camera_.fade_scale),
          narrow(camera_.inverse_reach), camera_.degree,
          for_kernels_.data(),           camera_.ingoing,
          narrow(camera_.turn),          narrow(camera_.lag)};
}

OmniCameraOf<double> OmniCamera::exact(double side) const {
  OmniCameraOf<double> camera = camera_;
  camera.offset = side * camera_.offset;
  camera.coefficients = coefficients_.data();
  return camera;
}

ShadowChart omni_shadow_chart(const OmniCameraOf<double>& camera, const EyeAtOffset& eye_at) {
  const EyeCamera head = eye_at({0.0, 0.0, 0.0});
  Vector3<double> middle = in_view(head, make_shadow_chart(station_of(head, 0.0)).centre);
  // Iterates: the shadow's center is that seen by the camera that looks in the direction of this
  // center.
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    double right = 0.0;
    double back = 0.0;
    omni_offset(camera, middle, right, back);
    const EyeCamera eye = eye_at({right, 0.0, back});
    const Vector3<double> seen = in_view(eye, make_shadow_chart(station_of(eye, 0.0)).centre);
    middle = normalized(seen + camera.inverse_convergence * Vector3<double>{right, 0.0, back});
  }
  return detail::chart_about(middle);
}

namespace {

double omni_darkness(const OmniCameraOf<double>& camera, const ShadowChart& chart, double gamma, double alpha) {
  const Vector3<double> view = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
  return darkness(camera.spin, camera.horizon_r, start_omni_ray(camera, view));
}

//! Returns the angle from the chart's center, along the great circle at position angle `gamma`, at
//! which the shadow ends and the sky begins. Uses false position with bisection. Throws Error like
//! solve_omni_edge().
double omni_edge_angle(const OmniCameraOf<double>& camera, const ShadowChart& chart, double gamma) {
  double dark = 0.0;
  double bright = pi;
  double dark_value = omni_darkness(camera, chart, gamma, dark);
  double bright_value = omni_darkness(camera, chart, gamma, bright);
  if (!(dark_value > 0.0) || !(bright_value < 0.0)) {
    throw Error("stereo.baseline", "is too large for the model omni, because the shadow would break into pieces",
                "choose a smaller baseline, or model = \"physical\"");
  }
  for (int round = 0; round < 100 && bright - dark > 1e-9; ++round) {
    const double secant = dark + (bright - dark) * dark_value / (dark_value - bright_value);
    // The step goes slightly beyond the root, so that both ends of the interval approach the root.
    const double hair = 1e-10 + 1e-3 * (bright - dark);
    const double tried = round % 3 == 2 ? 0.5 * (dark + bright) : secant + (round % 3 == 0 ? hair : -hair);
    const double angle = std::clamp(tried, dark + 1e-11, bright - 1e-11);
    const double value = omni_darkness(camera, chart, gamma, angle);
    (value > 0.0 ? dark : bright) = angle;
    (value > 0.0 ? dark_value : bright_value) = value;
  }
  return 0.5 * (dark + bright);
}

}  // namespace

std::vector<float> solve_omni_edge(const OmniCameraOf<double>& camera, const ShadowChart& chart, int count) {
  std::vector<float> polar_angle(static_cast<std::size_t>(count));
  // Solves for the first angle on the calling thread, where an Error reaches the caller. Other
  // threads only record that there was an Error; the first failed angle is solved again below, to
  // throw it.
  polar_angle[0] = static_cast<float>(omni_edge_angle(camera, chart, 0.0));
  std::vector<char> failed(static_cast<std::size_t>(count), 0);
  parallel_for(count, 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      try {
        polar_angle[static_cast<std::size_t>(i)] =
            static_cast<float>(omni_edge_angle(camera, chart, full_turn * i / count));
      } catch (const Error&) {
        failed[static_cast<std::size_t>(i)] = 1;
      }
    }
  });
  if (const auto first = std::ranges::find(failed, 1); first != failed.end()) {
    static_cast<void>(omni_edge_angle(camera, chart, full_turn * static_cast<double>(first - failed.begin()) / count));
  }
  return polar_angle;
}

}  // namespace ergodome
