#include "render/passes/shells/shell_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/projection/make_projection.h"
#include "kernels/shells/shell_crossings.h"
#include "render/output/image_writer.h"
#include "render/passes/near_field/near_field.h"
#include "tests/render/eye_at.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::eye_at;

constexpr int shell_size_px = 96;
constexpr double tolerance_px = 0.02;

ShellSettings filled(double radius, double opacity, std::array<double, 3> color = {1.0, 1.0, 1.0}) {
  ShellSettings shell;
  shell.radius = radius;
  shell.line_opacity = 0.0;
  shell.fill_opacity = opacity;
  shell.fill_color = color;
  return shell;
}

Show show_with(double spin, std::vector<ShellSettings> shells) {
  Show show;
  show.spin = spin;
  show.shells = std::move(shells);
  return show;
}

struct Drawn {
  Projection projection;
  std::vector<float> rgba;

  [[nodiscard]] float at(int x, int y, int part) const {
    return rgba[4 * static_cast<std::size_t>(y * shell_size_px + x) + static_cast<std::size_t>(part)];
  }
  [[nodiscard]] float alpha(int x, int y) const { return at(x, y, 3); }
};

Drawn draw(const Show& show, const EyeCamera& eye, double field_of_view) {
  Drawn drawn{make_pinhole_projection(shell_size_px, shell_size_px, field_of_view),
              std::vector<float>(4UL * shell_size_px * shell_size_px)};
  const ShellPass shells(show, Backend::cpu);
  const std::unique_ptr<DiskPass> disk = show.disk ? std::make_unique<DiskPass>(show, Backend::cpu) : nullptr;
  draw_near_field(Backend::cpu, {disk.get(), &shells}, {eye, nullptr, drawn.projection, tolerance_px, 0.0},
                  {0, shell_size_px}, drawn.rgba.data());
  return drawn;
}

struct Met {
  int shell;
  double time;
  Vector3<double> direction;
};

struct Collector {
  std::vector<Met> met;
  void cross(int shell, bool lanes, const NearPosition<double>& at) {
    if (lanes) {
      const double c = std::cos(at.drag);
      const double s = std::sin(at.drag);
      met.push_back({shell, at.time, {c * at.m.x - s * at.m.y, s * at.m.x + c * at.m.y, at.m.z}});
    }
  }
  static void turn(bool /*lanes*/, const NearPosition<double>& /*at*/) {}
  [[nodiscard]] static bool done() { return false; }
};

Vector3<double> observed(const EyeCamera& eye, const Projection& projection, double x, double y) {
  const Vector3<double> view = direction_from_pixel(projection, x, y);
  const auto row = [&](int i) {
    const double* m = eye.frame_from_view[i];
    return m[0] * view.x + m[1] * view.y + m[2] * view.z;
  };
  return {row(0), row(1), row(2)};
}

NearRay<double> exact_shell_ray(const EyeCamera& eye, const Projection& projection, int x, int y) {
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
  return start_near_ray(camera, observed(eye, projection, x + 0.5, y + 0.5));
}

//! Returns the shells that the exact ray through a pixel's center crosses, traced in double.
//! `radii` must be sorted, the largest first.
std::vector<Met> met(const EyeCamera& eye, const Projection& projection, int x, int y,
                     const std::vector<double>& radii) {
  std::vector<double> u;
  u.reserve(radii.size());
  for (const double r : radii) {
    u.push_back(1.0 / r);
  }
  Collector collector;
  trace_shells<20, NearParts::azimuth>(eye.spacetime.spin, exact_shell_ray(eye, projection, x, y),
                                       {u.data(), static_cast<int>(u.size())}, {1e-15, 4000}, true, collector);
  return collector.met;
}

TEST(ShellPass, LetsThroughWhatEachCrossingLeaves) {
  // Cameras outside all shells and between them, near the spin axis and the equator.
  for (const double camera_r : {30.0, 9.0, 4.0}) {
    for (const double theta : {0.0, 0.4, 1.5}) {
      const std::vector<double> radii = {12.0, 6.0, 1.5};
      const EyeCamera eye = eye_at(0.9, camera_r, theta);
      const Drawn drawn = draw(show_with(0.9, {filled(6.0, 0.5), filled(1.5, 0.25), filled(12.0, 0.125)}), eye, 1.4);
      int wrong = 0;
      for (int y = 0; y < shell_size_px; y += 2) {
        for (int x = 0; x < shell_size_px; x += 2) {
          double clear = 1.0;
          for (const Met& each : met(eye, drawn.projection, x, y, radii)) {
            clear *= 1.0 - std::array{0.125, 0.5, 0.25}[static_cast<std::size_t>(each.shell)];
          }
          wrong += std::abs(static_cast<double>(drawn.alpha(x, y)) - (1.0 - clear)) > 1e-3 ? 1 : 0;
        }
      }
      // Pixels on the edge of a shell are only partially covered and count as wrong. Edges are
      // circles of a few hundred pixels, a quarter of which are compared.
      EXPECT_LT(wrong, 130) << camera_r << " " << theta;
    }
  }
}

TEST(ShellPass, ShowsOfOpaqueShellsTheNearestAlone) {
  const Show show = show_with(0.9, {filled(12.0, 1.0, {0.0, 1.0, 0.0}), filled(5.0, 1.0, {1.0, 0.0, 0.0})});
  const Drawn between = draw(show, eye_at(0.9, 8.0, 1.2), 2.4);
  const EyeCamera eye = eye_at(0.9, 8.0, 1.2);
  int red = 0;
  for (int y = 0; y < shell_size_px; y += 3) {
    for (int x = 0; x < shell_size_px; x += 3) {
      EXPECT_NEAR(between.alpha(x, y), 1.0F, 1e-3F);
      const float seen = between.at(x, y, 0);
      if (seen > 0.0F && seen < 1.0F) {
        continue;
      }
      const std::vector<Met> all = met(eye, between.projection, x, y, {12.0, 5.0});
      ASSERT_FALSE(all.empty());
      EXPECT_EQ(seen > 0.5F, all[0].shell == 1) << x << " " << y;
      red += seen > 0.5F ? 1 : 0;
    }
  }
  EXPECT_GT(red, 50);
  const Drawn outside = draw(show, eye_at(0.9, 30.0, 1.2), 0.3);
  EXPECT_EQ(outside.at(shell_size_px / 2, shell_size_px / 2, 1), 1.0F);
  EXPECT_EQ(outside.at(shell_size_px / 2, shell_size_px / 2, 0), 0.0F);
}

TEST(ShellPass, HidesTheHoleItselfBehindAShellJustAboveTheHorizon) {
  for (const double spin : {0.0, 0.9, -0.9}) {
    const Drawn drawn =
        draw(show_with(spin, {filled(horizon_radius(Spacetime{spin}) * 1.001, 1.0)}), eye_at(spin, 20.0, 1.2), 0.1);
    for (int y = 0; y < shell_size_px; y += 5) {
      for (int x = 0; x < shell_size_px; x += 5) {
        EXPECT_NEAR(drawn.alpha(x, y), 1.0F, 1e-3F) << spin;
      }
    }
  }
}

TEST(ShellPass, LiesBeforeAndBehindTheDiskAsLightMeetsThem) {
  DiskSettings disk;
  disk.inner = 6.0;
  disk.outer = 18.0;
  disk.profile = DiskProfile::uniform;
  Show show = show_with(0.0, {filled(10.0, 1.0, {0.0, 0.0, 7.0})});
  show.disk = disk;
  const EyeCamera eye = eye_at(0.0, 40.0, 1.2);
  const Drawn drawn = draw(show, eye, 1.1);
  int shell_first = 0;
  int disk_first = 0;
  for (int y = 0; y < shell_size_px; y += 2) {
    for (int x = 0; x < shell_size_px; x += 2) {
      const std::vector<Met> shells = met(eye, drawn.projection, x, y, {10.0});
      EquatorialCrossing<double> crossings[crossing_orders];
      trace_crossings<20, true>(0.0, exact_shell_ray(eye, drawn.projection, x, y), {1e-7, 1e-15, 4000}, true,
                                crossings);
      const double r = crossings[0].u > 0.0 ? 1.0 / crossings[0].u : 0.0;
      if (shells.empty() || !(r > 6.5 && r < 17.5)) {
        continue;
      }
      // Skips pixels next to the edge of the shell, which show both the shell and the disk.
      const float blue = drawn.at(x, y, 2);
      if (blue > 2.0F && blue < 6.9F) {
        continue;
      }
      const bool shell = shells[0].time < crossings[0].time;
      EXPECT_EQ(blue > 6.0F, shell) << x << " " << y << " " << blue;
      shell_first += shell ? 1 : 0;
      disk_first += shell ? 0 : 1;
    }
  }
  EXPECT_GT(shell_first, 20);
  EXPECT_GT(disk_first, 20);
}

TEST(ShellPass, HasTheAreaOfItsEdgeWithinASmallPartOfAPixelsWidth) {
  // Without spin, the edge of the shell is where light has its turning point at the shell: b = R /
  // √(1 - 2/R), with the shell's radius R.
  const double r_o = 1e5;
  const double pixel = 40.0 / r_o / shell_size_px;
  const Drawn drawn = draw(show_with(0.0, {filled(10.0, 1.0)}), eye_at(0.0, r_o, 1.0), 40.0 / r_o);
  double area = 0.0;
  int partly = 0;
  for (int y = 0; y < shell_size_px; ++y) {
    for (int x = 0; x < shell_size_px; ++x) {
      area += static_cast<double>(drawn.alpha(x, y));
      partly += drawn.alpha(x, y) > 0.01F && drawn.alpha(x, y) < 0.99F ? 1 : 0;
    }
  }
  const double b = 10.0 / std::sqrt(0.8);
  EXPECT_NEAR(area / (pi * b * b / (r_o * r_o) / (pixel * pixel)), 1.0, 3e-3);
  EXPECT_GT(partly, 100);
}

//! Returns the angle between a direction and the nearest line of a grid with the given spacing
//! [rad].
double from_line(const Vector3<double>& d, double spacing) {
  const double sine = std::hypot(d.x, d.y);
  return std::min(std::abs(std::remainder(std::atan2(sine, d.z), spacing)),
                  std::abs(std::remainder(std::atan2(d.y, d.x), spacing)) * sine);
}

TEST(ShellPass, DrawsLinesWhereExactRaysMeetThem) {
  for (const double theta : {0.0, 0.3, 1.5}) {
    for (const double camera_r : {5.0, 30.0}) {
      ShellSettings grid;
      grid.radius = 12.0;
      grid.spacing_deg = 30.0;
      grid.line_width_deg = 8.0;
      grid.fill_color = {0.0, 0.0, 0.0};
      grid.fill_opacity = 1.0;
      const EyeCamera eye = eye_at(0.9, camera_r, theta);
      const Drawn drawn = draw(show_with(0.9, {grid}), eye, camera_r > 12.0 ? 0.7 : 2.6);
      int line = 0;
      int between = 0;
      for (int y = 0; y < shell_size_px; y += 2) {
        for (int x = 0; x < shell_size_px; x += 2) {
          const std::vector<Met> all = met(eye, drawn.projection, x, y, {12.0});
          if (all.empty()) {
            continue;
          }
          const double off = from_line(all[0].direction, pi / 6.0) - 4.0 * pi / 180.0;
          const float seen = drawn.at(x, y, 0);
          if (seen == 0.0F || seen == 1.0F) {
            EXPECT_EQ(seen == 1.0F, off < 0.0) << theta << " " << camera_r << ": " << x << ", " << y;
            (seen == 1.0F ? line : between) += 1;
          } else if (camera_r > 12.0 && x > shell_size_px / 4 && x < 3 * shell_size_px / 4 && y > shell_size_px / 4 &&
                     y < 3 * shell_size_px / 4) {
            EXPECT_LT(std::abs(off), 0.12) << theta << " " << camera_r << ": " << x << ", " << y;
          }
        }
      }
      EXPECT_GT(line, 30) << theta << " " << camera_r;
      EXPECT_GT(between, 30) << theta << " " << camera_r;
    }
  }
}

TEST(ShellPass, IsTheSameAllRoundForACameraOnTheAxis) {
  ShellSettings grid;
  grid.radius = 8.0;
  grid.fill_opacity = 0.5;
  for (const double camera_r : {4.0, 20.0}) {
    const Drawn drawn = draw(show_with(0.9, {grid}), eye_at(0.9, camera_r, 0.0), 0.9);
    for (int y = 0; y < shell_size_px; ++y) {
      for (int x = 0; x < shell_size_px; ++x) {
        // A rotation by a quarter turn is a multiple of the distance between meridians, so the
        // picture must be the same after it.
        EXPECT_NEAR(drawn.alpha(x, y), drawn.alpha(shell_size_px - 1 - y, x), 0.02F) << x << " " << y;
      }
    }
  }
}

TEST(ShellPass, ShinesWithTheFourthPowerOfTheShift) {
  Show show = show_with(0.0, {filled(4.0, 1.0)});
  show.effects.redshift = true;
  const Drawn drawn = draw(show, eye_at(0.0, 20.0, 1.2), 0.1);
  const double g = std::sqrt((1.0 - 2.0 / 4.0) / (1.0 - 2.0 / 20.0));
  EXPECT_NEAR(static_cast<double>(drawn.at(shell_size_px / 2, shell_size_px / 2, 0)) / (g * g * g * g), 1.0, 1e-4);
}

TEST(ShellPass, IsLightThroughoutAtFullSpin) {
  for (const double spin : {-1.0, 1.0}) {
    Show show = show_with(spin, {filled(1.001, 1.0), filled(8.0, 0.5)});
    show.effects.redshift = true;
    show.shells[0].line_opacity = 1.0;
    for (const double r : {1.2, 6.0, 20.0}) {
      const Drawn drawn = draw(show, eye_at(spin, r, 1.4), 1.5);
      EXPECT_TRUE(std::all_of(drawn.rgba.begin(), drawn.rgba.end(), [](float x) { return x > -1e-6F && x < 1e6F; }))
          << spin << " " << r;
    }
  }
}

class ShellTextures : public test::FolderTest {};

TEST_F(ShellTextures, AreThoseOfAGlobeWithLongitudeZeroInTheMiddle) {
  Picture map;
  map.width = 64;
  map.height = 32;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      // The northern half of the map is blue, and its eastern half (the right half) is red.
      map.rgba.insert(map.rgba.end(), {x >= 32 ? 1.0F : 0.0F, 0.0F, y < 16 ? 1.0F : 0.0F, 1.0F});
    }
  }
  write_picture(folder_ / "map.exr", {ImageFormat::exr}, map, {});
  Show show = show_with(0.0, {filled(8.0, 1.0)});
  show.folder = folder_.string();
  show.shells[0].texture = "map.exr";
  const Drawn drawn = draw(show, eye_at(0.0, 30.0, pi / 2.0), 0.3);
  const int left = shell_size_px / 4;
  const int right = 3 * shell_size_px / 4;
  // In the picture, φ increases to the right, and north is up.
  EXPECT_NEAR(drawn.at(right, left, 0), 1.0F, 0.01F);
  EXPECT_NEAR(drawn.at(left, left, 0), 0.0F, 0.01F);
  EXPECT_NEAR(drawn.at(left, left, 2), 1.0F, 0.01F);
  EXPECT_NEAR(drawn.at(left, right, 2), 0.0F, 0.01F);
}

TEST_F(ShellTextures, ThatAreMissingAreNamedWithTheShow) {
  Show show = show_with(0.0, {filled(8.0, 1.0)});
  show.folder = folder_.string();
  show.name = "scene";
  show.shells[0].texture = "nowhere.jpg";
  const std::string problem = test::error_of([&] { const ShellPass pass(show, Backend::cpu); });
  EXPECT_THAT(problem, testing::HasSubstr("scene.toml"));
  EXPECT_THAT(problem, testing::HasSubstr("shells[0].texture"));
  EXPECT_THAT(problem, testing::HasSubstr("nowhere.jpg"));
}

}  // namespace
}  // namespace ergodome
