#include "render/passes/objects/polygons/omni_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/core/error.h"
#include "render/eyes/disk_fit.h"
#include "render/passes/objects/polygons/object_view.h"

namespace ergodome {

namespace {

constexpr std::size_t omni_numbers = 4 * omni_groups;
//! Accepted errors of the fit: absolute errors of unit vectors and velocities, relative errors of
//! radii. The degree is increased until the error is at most `fine_omni_fit`, about the rounding
//! error of float; at the maximum degree, `coarsest_omni_fit` is accepted.
constexpr double fine_omni_fit = 1e-6;
constexpr double coarsest_omni_fit = 1e-4;

void put(std::vector<double>& to, const Vector3<double>& v, double fourth) {
  to.insert(to.end(), {v.x, v.y, v.z, fourth});
}

//! Returns the numbers that describe an eye; see omni_groups.
std::vector<double> numbers_of_eye(const ObjectView& head, const EyeCamera& eye) {
  const ObjectView own = object_view(eye);
  Vector3<double> axes[3];
  std::ranges::transform(own.axes, axes, [&](const Vector3<double>& axis) { return head.in_frame(axis); });
  const auto in_head = [&](double x, double y, double z) { return x * axes[0] + y * axes[1] + z * axes[2]; };
  const Vector3<double> velocity = observer_velocity(eye.motion, eye.spacetime, eye.r, eye.theta, eye.velocity);
  std::vector<double> numbers;
  put(numbers, axes[0], own.r);
  put(numbers, in_head(velocity.x, velocity.y, velocity.z), 0.0);
  for (const auto& row : own.view_from_frame) {
    put(numbers, in_head(row[0], row[1], row[2]), 0.0);
  }
  return numbers;
}

double largest_error(const DiskNumbers& numbers_at, int degree, const std::vector<double>& coefficients) {
  const auto terms = static_cast<std::size_t>(omni_terms(degree));
  double largest = 0.0;
  for (const DiskPoint& point : disk_points(3, 13, 0.37)) {
    const std::vector<double> term = disk_terms(point, degree);
    const std::vector<double> exact = numbers_at(point);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double value =
          std::inner_product(term.begin(), term.end(), coefficients.begin() + static_cast<long>(i * terms), 0.0);
      const double error = std::abs(value - exact[i]) / std::max(std::abs(exact[i]), 1.0);
      largest = error <= largest ? largest : error;
    }
  }
  return largest;
}

//! Reorders coefficients: from grouped by number to grouped by term.
std::vector<float> by_terms(const std::vector<double>& coefficients) {
  const std::size_t terms = coefficients.size() / omni_numbers;
  std::vector<float> turned(coefficients.size());
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    turned[i % terms * omni_numbers + i / terms] = static_cast<float>(coefficients[i]);
  }
  return turned;
}

//! Returns the range of the radii of eyes at many positions, slightly enlarged.
RadialRange radii_of(const DiskNumbers& numbers_at, double head_r) {
  RadialRange radii{head_r, head_r};
  for (const DiskPoint& point : disk_points(2, 16, 0.0)) {
    const double r = numbers_at(point)[3];
    radii.nearest = std::min(radii.nearest, r);
    radii.farthest = std::max(radii.farthest, r);
  }
  // Keeps the two limits distinct in single precision.
  const double more = 0.05 * (radii.farthest - radii.nearest) + 1e-5 * head_r;
  return {radii.nearest - more, radii.farthest + more};
}

}  // namespace

OmniView omni_view(const OmniEye& eye, const EyeAtOffset& eye_at) {
  const OmniCameraOf<double> turns = eye.cameras->exact(eye.side);
  const double reach = std::abs(turns.offset);
  const ObjectView head = object_view(eye_at({0.0, 0.0, 0.0}));
  const DiskNumbers numbers_at = [&](const DiskPoint& point) {
    return numbers_of_eye(head, eye_at({reach * point.p, 0.0, reach * point.q}));
  };
  OmniView view{eye.cameras->on_host(eye.side), 0, {}, radii_of(numbers_at, head.r)};
  double error = 0.0;
  for (view.degree = 1; view.degree <= omni_max_degree; ++view.degree) {
    const std::vector<double> coefficients = fit_numbers(numbers_at, view.degree);
    error = largest_error(numbers_at, view.degree, coefficients);
    view.coefficients = by_terms(coefficients);
    if (error <= fine_omni_fit) {
      return view;
    }
  }
  view.degree = omni_max_degree;
  if (!(error <= coarsest_omni_fit)) {
    throw Error("stereo.baseline",
                fmt::format("{:.6g} M is too large for objects in the model omni at r = {:.6g} M", 2.0 * reach, head.r),
                "choose a smaller baseline, or model = \"physical\"");
  }
  return view;
}

}  // namespace ergodome
