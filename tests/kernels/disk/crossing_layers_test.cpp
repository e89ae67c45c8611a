#include "kernels/disk/crossing_layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/disk/disk_chart.h"
#include "kernels/disk/disk_emitter.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome::test {
namespace {

template <class T>
using Layers = CrossingLayer<T>[crossing_orders];

//! Returns limits for the radius of crossings: from just above the horizon (far inside the photon
//! orbit) to 80 M.
LayerLimits<double> wide_limits(double spin) {
  const double horizon = horizon_radius(Spacetime{spin});
  return {1.0 / (horizon + 0.02 * (photon_orbit_radius(Spacetime{std::abs(spin)}, 1.0) - horizon) + 1e-4),
          1.0 / 80.0,
          3.0,
          -1.0,
          1e-15,
          4000};
}

TEST(CrossingLayers, HaveTheReferenceRadiusAzimuthAndDelay) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const CameraStation camera = station_of(row);
    Layers<double> layers;
    ASSERT_TRUE((trace_layers<20, NearParts::azimuth_and_delay>(row.a, start_near_ray(camera, row.n),
                                                                wide_limits(row.a), layers)))
        << row.id;
    const CrossingLayer<double>& layer = layers[row.order];
    EXPECT_NEAR(1.0 / layer.u, row.r_hit, 1e-8) << row.id;
    const HorizonWinding<double> horizon = horizon_winding(row.a);
    const double wound = winding(horizon, layer.u);
    const double azimuth = std::atan2(layer.sine, layer.cosine) + winding_turn(horizon) * wound;
    EXPECT_LT(std::abs(std::remainder(azimuth - row.phi_hit, 2.0 * pi)), 1e-8) << row.id;
    EXPECT_NEAR(layer.delay + winding_delay(horizon) * wound, row.delay, 1e-8) << row.id;
  }
}

TEST(CrossingLayers, HaveTheReferenceShiftByTheClosedForm) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const NearRay<double> ray = start_near_ray(station_of(row), row.n);
    Layers<double> layers;
    trace_layers<20, NearParts::position_alone>(row.a, ray, wide_limits(row.a), layers);
    const DiskLight<double> light = {1.0 / layers[row.order].u, ray.energy, ray.axial_angular_momentum,
                                     ray.shear_constant, true};
    EXPECT_NEAR(1.0 / circular_frequency(row.a, light), row.g_kepler, 1e-8) << row.id;
  }
}

//! Returns limits as for the grid of a disk: from halfway between the horizon and the photon orbit
//! to 80 M, with a margin on both sides.
LayerLimits<double> disk_limits(double spin) {
  LayerLimits<double> limits = wide_limits(spin);
  const double horizon = horizon_radius(Spacetime{spin});
  limits.near_u = 1.0 / (horizon + 0.5 * (photon_orbit_radius(Spacetime{std::abs(spin)}, 1.0) - horizon) + 1e-3);
  limits.highest_u = 2.0 * limits.near_u;
  limits.lowest_u = -0.3;
  return limits;
}

TEST(CrossingLayers, AreSmoothAcrossTheShadowsEdge) {
  for (const double spin : {-1.0, 0.0, 0.9, 0.999}) {
    const CameraStation camera = make_camera_station(Spacetime{spin}, 30.0, 1.3, 0.0, ObserverMotion::rain);
    const ShadowChart chart = make_shadow_chart(camera);
    for (const double gamma : {0.3, 1.7, 3.0, 4.4}) {
      const double edge = edge_polar_angle(camera, chart, gamma);
      Layers<double> within;
      Layers<double> outside;
      const auto trace = [&](double alpha, Layers<double>& layers) {
        const Vector3<double> n = chart_direction(chart, std::cos(alpha), std::sin(alpha), gamma);
        return trace_layers<20, NearParts::position_alone>(spin, start_near_ray(camera, n), disk_limits(spin), layers);
      };
      ASSERT_TRUE(trace(edge - 1e-9, within) && trace(edge + 1e-9, outside)) << spin << " " << gamma;
      for (int order = 0; order < crossing_orders; ++order) {
        // Rays are 2e-9 rad apart. The difference between their crossings grows by a factor e^π per
        // order, and is largest around a fast-spinning hole, where light at the edge of the shadow
        // winds for long.
        EXPECT_NEAR(within[order].u, outside[order].u, 1e-4) << spin << " " << gamma << " " << order;
      }
    }
  }
}

//! Computes the layers of the disk (its crossings by order) in a camera's direction with the chart
//! coordinates (γ [turns], s).
template <class T>
bool trace_position(const CameraStation& camera, const EdgeCurve& edge, const T& alpha, double gamma_turns,
                    Layers<T>& layers) {
  return trace_layers<16, NearParts::azimuth_and_delay>(
      camera.spin, start_near_ray(camera, chart_direction_at(LensChart{edge, 1.0F}, gamma_turns, alpha)),
      disk_limits(camera.spin), layers);
}

TEST(CrossingLayers, HaveDerivativesAsDifferencesHaveThem) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 20.0, 1.35, 0.0, ObserverMotion::rain);
  // A circle replaces the edge of the shadow, because the chart works for any edge.
  const std::vector<float> polar_angle(64, 0.25F);
  const EdgeCurve edge = {
      {-1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}, polar_angle.data(), 64, 0.25F, 0.25F};
  using M = MixedDual<double>;
  for (const double gamma : {0.07, 0.3, 0.55, 0.8}) {
    for (const double s : {0.3, 0.45, 0.6, 0.75}) {
      Layers<M> exact;
      ASSERT_TRUE(trace_position(camera, edge, disk_polar_angle<double>(edge, gamma, s), gamma, exact));
      constexpr double h = 2e-5;
      const auto at = [&](double g, double v, int order, int part) {
        // Computes the direction at (g, v) without derivatives, for finite differences.
        M alpha = disk_polar_angle<double>(edge, g, v);
        Layers<M> layers;
        trace_position(camera, edge, alpha, g, layers);
        const M parts[4] = {layers[order].u, layers[order].cosine, layers[order].sine, layers[order].delay};
        return parts[part].value;
      };
      for (int order = 0; order < 2; ++order) {
        const M parts[4] = {exact[order].u, exact[order].cosine, exact[order].sine, exact[order].delay};
        if (parts[0].value < -0.25 || parts[0].value > 0.9) {
          continue;
        }
        for (int part = 0; part < 4; ++part) {
          const double by_gamma = (at(gamma + h, s, order, part) - at(gamma - h, s, order, part)) / (2.0 * h);
          const double by_s = (at(gamma, s + h, order, part) - at(gamma, s - h, order, part)) / (2.0 * h);
          const double mixed = (at(gamma + h, s + h, order, part) - at(gamma - h, s + h, order, part) -
                                at(gamma + h, s - h, order, part) + at(gamma - h, s - h, order, part)) /
                               (4.0 * h * h);
          const double size = 1.0 + std::abs(parts[part].value) + std::abs(by_gamma) + std::abs(by_s);
          EXPECT_NEAR(parts[part].along_x, by_gamma, 2e-4 * size) << gamma << " " << s << " " << order << " " << part;
          EXPECT_NEAR(parts[part].along_y, by_s, 2e-4 * size) << gamma << " " << s << " " << order << " " << part;
          EXPECT_NEAR(parts[part].mixed, mixed, 2e-2 * (size + std::abs(mixed)))
              << gamma << " " << s << " " << order << " " << part;
        }
      }
    }
  }
}

TEST(CrossingLayers, OfLightInTheCamerasOwnPlaneAreThoseOfItsNeighbours) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 20.0, 0.5 * pi, 0.0, ObserverMotion::rain);
  for (const double across : {-0.6, -0.3, 0.35, 0.7}) {
    Layers<double> in_plane;
    Layers<double> beside;
    const double along = -std::sqrt(1.0 - across * across);
    trace_layers<20, NearParts::azimuth_and_delay>(0.9, start_near_ray(camera, Vector3<double>{along, 0.0, across}),
                                                   disk_limits(0.9), in_plane);
    trace_layers<20, NearParts::azimuth_and_delay>(0.9, start_near_ray(camera, Vector3<double>{along, 1e-5, across}),
                                                   disk_limits(0.9), beside);
    EXPECT_NEAR(in_plane[0].u, beside[0].u, 1e-6) << across;
    EXPECT_NEAR(in_plane[0].cosine, beside[0].cosine, 1e-5) << across;
  }
}

TEST(DiskChart, LeadsBackToWhereADirectionIs) {
  const std::vector<float> polar_angle = [] {
    std::vector<float> values;
    values.reserve(256);
    for (int i = 0; i < 256; ++i) {
      values.push_back(0.3F + 0.05F * std::cos(2.0F * 3.14159265F * static_cast<float>(i) / 256.0F));
    }
    return values;
  }();
  const EdgeCurve edge = {
      {-1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}, polar_angle.data(), 256, 0.25F, 0.35F};
  for (const double gamma : {0.01, 0.26, 0.51, 0.93}) {
    for (const double s : {0.02, 0.3, 0.5, 0.7, 0.99}) {
      const MixedDual<double> alpha = disk_polar_angle<double>(edge, gamma, s);
      const Vector3<MixedDual<double>> n = chart_direction_at(LensChart{edge, 1.0F}, gamma, alpha);
      // The direction is differentiated along the chart's coordinate lines, so the derivatives of
      // the coordinates themselves must be 1 and 0.
      const auto along = [](const MixedDual<double>& a) { return Dual<double>{a.value, a.along_x, a.along_y}; };
      const DiskPosition<double> position =
          disk_position(edge, Vector3<Dual<double>>{along(n.x), along(n.y), along(n.z)});
      EXPECT_NEAR(position.gamma_turns.value, gamma, 1e-12);
      EXPECT_NEAR(position.s.value, s, 1e-6);
      EXPECT_NEAR(position.gamma_turns.along_x, 1.0, 1e-9);
      EXPECT_NEAR(position.gamma_turns.along_y, 0.0, 1e-9);
      EXPECT_NEAR(position.s.along_x, 0.0, 1e-5);
      EXPECT_NEAR(position.s.along_y, 1.0, 1e-5);
    }
  }
  EXPECT_NEAR((disk_polar_angle<double>(edge, 0.25, 0.5).value), 0.3, 1e-6);
}

}  // namespace
}  // namespace ergodome::test
