#include "kernels/spacetime/kerr/frame_boost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/shadow_chart.h"

namespace ergodome {
namespace {

constexpr ObserverMotion motions[] = {ObserverMotion::zamo,       ObserverMotion::fixed, ObserverMotion::geodesic,
                                      ObserverMotion::retrograde, ObserverMotion::rain,  ObserverMotion::velocity};

Vector3<double> direction(int i) {
  const double z = 1.0 - 2.0 * (i + 0.5) / 40.0;
  const double angle = 2.399963 * i;
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

TEST(FrameBoost, OneRayHasTheSameConstantsInBothFrames) {
  const Vector3<double> velocity = {0.3, -0.5, 0.6};
  for (const ObserverMotion motion : motions) {
    const CameraStation observer = make_camera_station(Spacetime{0.9}, 6.0, 1.2, 0.0, motion, velocity);
    const CameraStation rain = make_camera_station(Spacetime{0.9}, 6.0, 1.2, 0.0, ObserverMotion::rain);
    const Aberration aberration = aberration_to_rain(Spacetime{0.9}, 6.0, 1.2, motion, velocity);
    for (int i = 0; i < 40; ++i) {
      const RayStart<double> a = start_ray(observer, direction(i));
      const RayStart<double> b = start_ray(rain, rain_direction(aberration, direction(i)));
      EXPECT_NEAR(a.axial_angular_momentum, b.axial_angular_momentum, 1e-12);
      EXPECT_NEAR(a.polar_constant, b.polar_constant, 1e-11);
      EXPECT_NEAR(a.u_rate, b.u_rate, 1e-13);
    }
  }
}

TEST(FrameBoost, ObservedScaleIsTheStretchOfSmallAngles) {
  const Vector3<double> velocity = {0.2, 0.7, -0.1};
  const Aberration aberration = aberration_to_rain(Spacetime{0.9}, 4.0, 1.2, ObserverMotion::velocity, velocity);
  for (int i = 0; i < 40; ++i) {
    const Vector3<double> n = direction(i);
    const Vector3<double> beside = normalized(n + 1e-6 * Vector3<double>{0.3, -0.2, 0.9});
    const Vector3<double> turn = cross(n, beside);
    const Vector3<double> a = rain_direction(aberration, n);
    const Vector3<double> b = rain_direction(aberration, beside);
    const Vector3<double> turned = cross(a, b);
    EXPECT_NEAR(observed_scale(aberration, a), std::sqrt(dot(turn, turn) / dot(turned, turned)), 1e-5);
  }
}

TEST(FrameBoost, StaysAUnitVectorInFloatNextToTheHorizon) {
  const double r = horizon_radius(Spacetime{0.9}) + 1e-6;
  const AberrationOf<float> aberration =
      converted_aberration<float>(aberration_to_rain(Spacetime{0.9}, r, 1.2, ObserverMotion::zamo, {}));
  for (int i = 0; i < 40; ++i) {
    const Vector3<double> n = direction(i);
    const Vector3<float> rain = rain_direction(
        aberration, Vector3<float>{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    EXPECT_NEAR(dot(rain, rain), 1.0F, 1e-5F);
  }
}

}  // namespace
}  // namespace ergodome
