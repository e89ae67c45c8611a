#include "kernels/core/dual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/kerr/camera_station.h"

namespace ergodome {
namespace {

using M = MixedDual<double>;

M x_at(double x) { return {x, 1.0, 0.0, 0.0}; }
M y_at(double y) { return {y, 0.0, 1.0, 0.0}; }

TEST(MixedDual, RationalFunctionHasItsMixedDerivative) {
  // f = x² y³ / (x + y). Expected derivatives by x and y at (2, 3) are calculated by hand.
  const M x = x_at(2.0);
  const M y = y_at(3.0);
  const M f = x * x * y * y * y / (x + y);
  EXPECT_DOUBLE_EQ(f.value, 108.0 / 5.0);
  EXPECT_DOUBLE_EQ(f.along_x, 108.0 / 5.0 - 108.0 / 25.0);
  EXPECT_DOUBLE_EQ(f.along_y, 108.0 / 5.0 - 108.0 / 25.0);
  EXPECT_NEAR(f.mixed, 108.0 / 5.0 - 36.0 * 3.0 / 25.0 - 4.0 * 27.0 / 25.0 + 2.0 * 108.0 / 125.0, 1e-13);
}

TEST(MixedDual, RootSineAndCosineHaveTheirMixedDerivatives) {
  const M p = x_at(0.7) * y_at(1.9);
  const double v = 0.7 * 1.9;
  EXPECT_NEAR(sqrt(p).mixed, 0.25 / std::sqrt(v), 1e-15);
  M sine;
  M cosine;
  sine_cosine(p, sine, cosine);
  EXPECT_NEAR(sine.mixed, std::cos(v) - v * std::sin(v), 1e-14);
  EXPECT_NEAR(cosine.mixed, -std::sin(v) - v * std::cos(v), 1e-14);
}

TEST(MixedDual, TracedRayHasTheMixedDerivativeOfDifferences) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 6.0, 1.1, 0.0, ObserverMotion::zamo);
  const auto sky = [&](const auto& angle, const auto& turn) {
    using T = std::decay_t<decltype(angle)>;
    T s;
    T c;
    T st;
    T ct;
    sine_cosine(angle, s, c);
    sine_cosine(turn, st, ct);
    const RayStart<T> start = start_ray(camera, Vector3<T>{c, s * st, s * ct});
    double steps = 0.0;
    bool reached = false;
    return trace_taylor<20>(camera.spin, start, true, {1e-14, 1000}, steps, reached).sky;
  };
  const Vector3<M> exact = sky(x_at(1.4), y_at(0.6));
  const double h = 1e-3;
  const auto y_part = [&](double a, double b) { return sky(a, b).y; };
  const double difference =
      (y_part(1.4 + h, 0.6 + h) - y_part(1.4 + h, 0.6 - h) - y_part(1.4 - h, 0.6 + h) + y_part(1.4 - h, 0.6 - h)) /
      (4.0 * h * h);
  EXPECT_NEAR(exact.y.mixed, difference, 1e-5 * std::max(1.0, std::abs(difference)));
}

}  // namespace
}  // namespace ergodome
