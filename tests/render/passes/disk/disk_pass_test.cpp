#include "render/passes/disk/disk_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/disk/page_thorne.h"
#include "kernels/projection/make_projection.h"
#include "kernels/sky/blackbody.h"
#include "render/passes/near_field/near_field.h"
#include "tests/render/disk_scenes.h"
#include "tests/render/eye_at.h"

namespace ergodome {
namespace {

using test::eye_at;
using test::show_with;
using test::uniform_disk;

constexpr int disk_size_px = 96;
constexpr double disk_tolerance_px = 0.02;

struct DrawnDisk {
  Projection projection;
  std::vector<float> rgba;

  [[nodiscard]] float alpha(int x, int y) const { return rgba[4 * static_cast<std::size_t>(y * disk_size_px + x) + 3]; }
  [[nodiscard]] double luminance(int x, int y) const {
    const float* at = rgba.data() + 4 * static_cast<std::size_t>(y * disk_size_px + x);
    return static_cast<double>(luminance_of(Vector3<float>{at[0], at[1], at[2]}));
  }
};

DrawnDisk draw_disk(const Show& show, const EyeCamera& eye, double field_of_view, double time_s = 0.0) {
  DrawnDisk drawn{make_pinhole_projection(disk_size_px, disk_size_px, field_of_view),
                  std::vector<float>(4UL * disk_size_px * disk_size_px)};
  const DiskPass pass(show, Backend::cpu);
  draw_near_field(Backend::cpu, {&pass, nullptr}, {eye, nullptr, drawn.projection, disk_tolerance_px, time_s},
                  {0, disk_size_px}, drawn.rgba.data());
  return drawn;
}

//! The exact ray through the center of a pixel, traced in double.
struct ExactRay {
  NearRay<double> ray;
  EquatorialCrossing<double> crossings[crossing_orders];
};

ExactRay exact_ray(const EyeCamera& eye, const Projection& projection, int x, int y) {
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
  const Vector3<double> view = direction_from_pixel(projection, x + 0.5, y + 0.5);
  const auto row = [&](int i) {
    const double* m = eye.frame_from_view[i];
    return m[0] * view.x + m[1] * view.y + m[2] * view.z;
  };
  ExactRay exact{};
  exact.ray = start_near_ray(camera, Vector3<double>{row(0), row(1), row(2)});
  trace_crossings<20, true>(eye.spacetime.spin, exact.ray, {1e-7, 1e-15, 4000}, true, exact.crossings);
  return exact;
}

TEST(DiskPass, CoversThePixelsWhoseExactRaysMeetTheDisk) {
  for (const double theta : {0.3, 1.4, 1.52}) {
    const DiskSettings settings = uniform_disk(6.0, 18.0);
    const EyeCamera eye = eye_at(0.9, 40.0, theta);
    const DrawnDisk drawn = draw_disk(show_with(0.9, settings), eye, 1.1);
    int met = 0;
    for (int y = 0; y < disk_size_px; y += 2) {
      for (int x = 0; x < disk_size_px; x += 2) {
        const float alpha = drawn.alpha(x, y);
        if (alpha > 0.0F && alpha < 1.0F) {
          continue;
        }
        const ExactRay exact = exact_ray(eye, drawn.projection, x, y);
        const bool meets = std::any_of(std::begin(exact.crossings), std::end(exact.crossings), [&](const auto& each) {
          return each.u > 0.0 && 1.0 / each.u > 6.0 && 1.0 / each.u < 18.0;
        });
        met += meets ? 1 : 0;
        EXPECT_EQ(alpha > 0.5F, meets) << theta << ": " << x << ", " << y;
      }
    }
    EXPECT_GT(met, 40) << theta;
  }
}

TEST(DiskPass, ShowsSecondAndThirdImagesWhereTheyAre) {
  // Below the hole, the picture shows the image of order 1, which is the underside of the disk.
  const EyeCamera eye = eye_at(0.0, 40.0, 1.4);
  const DrawnDisk drawn = draw_disk(show_with(0.0, uniform_disk(6.0, 18.0)), eye, 0.5);
  bool found = false;
  for (int y = disk_size_px / 2; y < disk_size_px; ++y) {
    const ExactRay exact = exact_ray(eye, drawn.projection, disk_size_px / 2, y);
    const double first = exact.crossings[0].u > 0.0 ? 1.0 / exact.crossings[0].u : 0.0;
    const double second = exact.crossings[1].u > 0.0 ? 1.0 / exact.crossings[1].u : 0.0;
    if (!(first > 6.0 && first < 18.0) && second > 6.5 && second < 17.0) {
      found = found || drawn.luminance(disk_size_px / 2, y) > 0.0;
    }
  }
  EXPECT_TRUE(found);
}

TEST(DiskPass, HasTheShiftOfLuminetsFormulaAlongTheEquatorialLine) {
  // Without spin and for an observer at rest at infinity, 1 + z = (1 + r^(-3/2) b sin(i) sin(α)) /
  // √(1 - 3/r) (Luminet 1979, eq. 19). Here the observer is at r_o, which adds the factor of the
  // lapse, and sees the light at the angle ξ from the hole, so b = r_o sin(ξ) / √(1 - 2/r_o).
  const double r_o = 60.0;
  const double inclination = 1.4;
  const DiskSettings settings = uniform_disk(6.0, 25.0);
  const EyeCamera eye = eye_at(0.0, r_o, inclination, ObserverMotion::fixed);
  const DrawnDisk drawn = draw_disk(show_with(0.0, settings), eye, 0.9);
  const double lapse = std::sqrt(1.0 - 2.0 / r_o);
  const double at_rest = std::log(blackbody_tristimulus(settings.temperature_k).y);
  int compared = 0;
  for (int x = 0; x < disk_size_px; ++x) {
    const int y = disk_size_px / 2 - 2;
    const ExactRay exact = exact_ray(eye, drawn.projection, x, y);
    const double r = exact.crossings[0].u > 0.0 ? 1.0 / exact.crossings[0].u : 0.0;
    if (!(r > 6.5 && r < 24.0) || drawn.alpha(x, y) < 0.999F) {
      continue;
    }
    const Vector3<double> view = direction_from_pixel(drawn.projection, x + 0.5, y + 0.5);
    // Matter on the right side moves away from the camera, so b sin(α) is positive there.
    const double momentum = r_o * view.x / lapse * std::sin(inclination);
    const double g = std::sqrt(1.0 - 3.0 / r) / (1.0 + momentum / (r * std::sqrt(r))) / lapse;
    const double expected = std::exp(std::log(blackbody_tristimulus(g * settings.temperature_k).y) - at_rest);
    EXPECT_NEAR(drawn.luminance(x, y) / expected, 1.0, 0.01) << x << " r " << r << " g " << g;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(DiskPass, IsBrighterOnTheSideThatComes) {
  const DrawnDisk drawn = draw_disk(show_with(0.5, uniform_disk(6.0, 18.0)), eye_at(0.5, 40.0, 1.4), 1.1);
  double left = 0.0;
  double right = 0.0;
  for (int y = 0; y < disk_size_px; ++y) {
    for (int x = 0; x < disk_size_px; ++x) {
      (x < disk_size_px / 2 ? left : right) += drawn.luminance(x, y);
    }
  }
  EXPECT_GT(left, 2.0 * right);
}

TEST(DiskPass, HasTheAreaOfItsRingWithinASmallPartOfAPixelsWidth) {
  // A ring of radius r, seen from far above, appears at the impact parameter b = r + 1 + O(1/r)
  // (Gates, Hadar & Johnson 2021). Pixels at its edges are partially covered.
  const double r_o = 1e5;
  const double pixel = 600.0 / r_o / disk_size_px;
  const DrawnDisk drawn = draw_disk(show_with(0.0, uniform_disk(100.0, 250.0)), eye_at(0.0, r_o, 0.0), 600.0 / r_o);
  double area = 0.0;
  int partly = 0;
  for (int y = 0; y < disk_size_px; ++y) {
    for (int x = 0; x < disk_size_px; ++x) {
      area += static_cast<double>(drawn.alpha(x, y));
      partly += drawn.alpha(x, y) > 0.0F && drawn.alpha(x, y) < 1.0F ? 1 : 0;
    }
  }
  const double expected = pi * (251.0 * 251.0 - 101.0 * 101.0) / (r_o * r_o) / (pixel * pixel);
  EXPECT_NEAR(area / expected, 1.0, 3e-3);
  EXPECT_GT(partly, 100);
}

TEST(DiskPass, LetsLightThroughAsFarAsItIsNotOpaque) {
  DiskSettings settings = uniform_disk(6.0, 18.0);
  settings.opacity = 0.25;
  const DrawnDisk drawn = draw_disk(show_with(0.0, settings), eye_at(0.0, 40.0, 0.3), 1.1);
  float maximum = 0.0F;
  for (int y = 0; y < disk_size_px; ++y) {
    for (int x = 0; x < disk_size_px; ++x) {
      maximum = std::max(maximum, drawn.alpha(x, y));
    }
  }
  // The disk has an opacity of 1/4, and a ray crosses it at most three times: 1 - 0.75³.
  EXPECT_LE(maximum, 0.5782F);
  EXPECT_GE(maximum, 0.25F);
}

//! Returns the number of pixels that are much brighter than all of their neighbors.
int single_pixels(const DrawnDisk& drawn) {
  int found = 0;
  for (int y = 1; y + 1 < disk_size_px; ++y) {
    for (int x = 1; x + 1 < disk_size_px; ++x) {
      double brightest = 0.0;
      for (int beside = 0; beside < 9; ++beside) {
        brightest = std::max(brightest, beside == 4 ? 0.0 : drawn.luminance(x + beside % 3 - 1, y + beside / 3 - 1));
      }
      found += drawn.luminance(x, y) > 3.0 * brightest + 0.02 ? 1 : 0;
    }
  }
  return found;
}

//! Returns a camera at the horizon that moves with the rain frame. It faces the hole, except for
//! the given rotations of a fraction of a pixel.
EyeCamera eye_at_horizon(double spin, double theta, double right_rad, double up_rad) {
  EyeCamera eye = eye_at(spin, horizon_radius(Spacetime{spin}), theta, ObserverMotion::rain);
  const double back[3] = {std::cos(right_rad) * std::cos(up_rad), std::sin(up_rad),
                          -std::sin(right_rad) * std::cos(up_rad)};
  const double right[3] = {std::sin(right_rad), 0.0, std::cos(right_rad)};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    eye.frame_from_view[i][0] = right[i];
    eye.frame_from_view[i][1] = back[j] * right[k] - back[k] * right[j];
    eye.frame_from_view[i][2] = back[i];
  }
  return eye;
}

// A linear footprint is wrong if a neighbor's light meets the plane inside the horizon: the
// footprint would extend to a region outside the horizon, where such light cannot come from, and
// cause bright single pixels.
TEST(DiskPass, HasNoSinglePixelsWhereItFallsIntoAFastHole) {
  constexpr double spin = 0.998;
  DiskSettings disk = uniform_disk(1.0005 * horizon_radius(Spacetime{spin}), 16.0);
  disk.plunging = true;
  for (int i = 1; i <= 8; ++i) {
    const EyeCamera eye = eye_at_horizon(spin, 1.2217, 0.0096 * std::fmod(0.7548776662 * i, 1.0),
                                         0.0096 * std::fmod(0.5698402909 * i, 1.0));
    EXPECT_EQ(single_pixels(draw_disk(show_with(spin, disk), eye, 0.88)), 0) << i;
  }
}

TEST(DiskPass, CarriesItsCloudsRound) {
  DiskSettings settings = uniform_disk(6.0, 18.0);
  settings.pattern = DiskPattern::procedural;
  const Show show = show_with(0.0, settings);
  const EyeCamera eye = eye_at(0.0, 40.0, 0.3);
  const DrawnDisk now = draw_disk(show, eye, 1.1);
  const DrawnDisk again = draw_disk(show, eye, 1.1);
  const DrawnDisk later = draw_disk(show, eye, 1.1, 1.0);
  EXPECT_EQ(now.rgba, again.rgba);
  EXPECT_NE(now.rgba, later.rgba);
}

TEST(DiskPass, IsLightThroughoutAtFullSpin) {
  DiskSettings settings;
  settings.pattern = DiskPattern::procedural;
  for (const double spin : {-1.0, 1.0}) {
    const DrawnDisk drawn = draw_disk(show_with(spin, settings), eye_at(spin, 40.0, 1.4), 0.5);
    EXPECT_TRUE(std::all_of(drawn.rgba.begin(), drawn.rgba.end(), [](float x) { return x > -1e-6F && x < 1e6F; }))
        << spin;
  }
}

TEST(DiskTemperature, IsTheSettingWhereTheFluxIsGreatest) {
  DiskSettings settings;
  settings.temperature_k = 5000.0;
  EXPECT_NEAR(disk_temperature(settings, Spacetime{0.0}, 9.55), 5000.0, 0.1);
  EXPECT_NEAR(std::pow(disk_temperature(settings, Spacetime{0.0}, 30.0) / 5000.0, 4.0),
              page_thorne_flux(Spacetime{0.0}, 30.0) / page_thorne_flux(Spacetime{0.0}, 9.55), 1e-4);
  EXPECT_EQ(disk_temperature(settings, Spacetime{0.0}, 6.0), 0.0);
}

}  // namespace
}  // namespace ergodome
