#include "render/passes/stars/search/moving_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "tests/render/passes/stars/image_courses.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

constexpr double path_pixel = pi / 1024;

StarSettings path_settings() {
  StarSettings settings = settings_for(7.0);
  settings.pixel = path_pixel;
  settings.redshift = true;
  return settings;
}

//! Returns the patches of the cell around a camera.
MovingPatches patches_around(const EyeCamera& eye, const StarField& field, const StarSettings& settings) {
  const LensPosition middle = *cell_middle(eye.spacetime, {eye.r, eye.theta});
  EyeCamera there = eye;
  there.r = there.head_r = middle.r;
  there.theta = there.head_theta = middle.theta;
  LensStation station = build_moving_station(there, settings);
  MotionRoom room;
  StarPatches patches = star_patches(field, colours().view(), there, station, settings);
  return {std::move(station), std::move(patches), room};
}

std::vector<StarImage> moved_images(const MovingPatches& cell, const EyeCamera& eye, const StarField& field,
                                    const StarSettings& settings) {
  PatchRoom room;
  const LensStation there = cell.station_at({eye.r, eye.theta});
  return find_star_images(field, colours().view(), eye, there, cell.patches_at(there, room), settings);
}

//! Returns how many images that are clearly bright enough are in one list but not in the other: no
//! image of the same star and parity is within half a pixel of them.
std::size_t images_without_twin(const std::vector<StarImage>& images, const std::vector<StarImage>& others,
                                const StarSettings& settings) {
  return static_cast<std::size_t>(std::ranges::count_if(images, [&](const StarImage& image) {
    return image.illuminance.y > 1.1F * settings.faintest && std::ranges::none_of(others, [&](const StarImage& other) {
             const Vector3<float> apart = other.direction - image.direction;
             return other.star == image.star && (other.magnification < 0.0F) == (image.magnification < 0.0F) &&
                    static_cast<double>(dot(apart, apart)) < 0.25 * settings.pixel * settings.pixel;
           });
  }));
}

//! Largest differences between an image and the nearest image of its star in another list, for
//! images that are not next to a caustic.
struct Difference {
  double distance_px = 0.0;
  double brightness = 0.0;  //!< relative
};

void compare(const std::vector<StarImage>& images, const std::vector<StarImage>& others, double pixel,
             Difference& largest) {
  for (const StarImage& image : images) {
    double nearest_px = 1.0;
    float brightness = image.illuminance.y;
    for (const StarImage& other : others) {
      const Vector3<float> apart = other.direction - image.direction;
      const double apart_px = std::sqrt(static_cast<double>(dot(apart, apart))) / pixel;
      if (other.star == image.star && apart_px < nearest_px) {
        nearest_px = apart_px;
        brightness = other.illuminance.y;
      }
    }
    if (std::abs(image.magnification) < 10.0F && nearest_px < 1.0) {
      largest.distance_px = std::max(largest.distance_px, nearest_px);
      largest.brightness =
          std::max(largest.brightness, std::abs(static_cast<double>(brightness / image.illuminance.y) - 1.0));
    }
  }
}

class MovingCamera : public testing::TestWithParam<CameraState> {};

// The motion of patches is exact in the middle of a cell and at its corners.
TEST_P(MovingCamera, SeesTheImagesOfAFullSearchFromAllOverACell) {
  const StarField field(brightest(sanitized ? 100 : 1000), glm::dmat3(1.0), colours().view());
  const StarSettings settings = path_settings();
  EyeCamera eye = eye_at_position(GetParam());
  const LensPosition middle = *cell_middle(eye.spacetime, {eye.r, eye.theta});
  const LensPosition reach = cell_reach(eye.spacetime, middle);
  const MovingPatches cell = patches_around(eye, field, settings);
  std::size_t compared = 0;
  std::size_t different = 0;
  Difference largest;
  for (const double outward : {-0.98, -0.6, 0.0, 0.6, 0.98}) {
    for (const double southward : {-0.98, 0.0, 0.98}) {
      eye.r = eye.head_r = middle.r + outward * reach.r;
      eye.theta = eye.head_theta = middle.theta + southward * reach.theta;
      const std::vector<StarImage> images = moved_images(cell, eye, field, settings);
      const std::vector<StarImage> exact = images_of(field, eye, settings);
      compared += exact.size();
      different += images_without_twin(exact, images, settings) + images_without_twin(images, exact, settings);
      compare(exact, images, settings.pixel, largest);
    }
  }
  EXPECT_GT(compared, sanitized ? 1000U : 10'000U);
  // Next to a caustic, either search may find only one of two images.
  EXPECT_LE(different, compared / 10'000);
  EXPECT_LT(largest.distance_px, 0.1);
  EXPECT_LT(largest.brightness, 0.03);
}

// The camera crosses two borders of cells, one along r and one along θ. As it also goes around the
// hole, stars cross caustics and come out of the shadow's edge on the way.
TEST_P(MovingCamera, SeesTheImagesOfAFullSearchOnAPathOf600Frames) {
  constexpr int frames = 600;
  const StarField field(brightest(sanitized ? 100 : 1000), glm::dmat3(1.0), colours().view());
  const StarSettings settings = path_settings();
  EyeCamera eye = eye_at_position(GetParam());
  const double horizon = horizon_radius(eye.spacetime);
  const LensPosition first_middle = *cell_middle(eye.spacetime, {eye.r, eye.theta});
  const double first_height = (first_middle.r - horizon) * std::exp(-0.5 * position_cell_height + 0.004);
  const double first_theta = first_middle.theta + 0.5 * position_cell_theta - 0.003;
  std::optional<MovingPatches> cell;
  LensPosition middle{};
  int entered = 0;
  std::vector<StarImage> before;
  std::size_t compared = 0;
  std::size_t different = 0;
  std::size_t lost = 0;
  Difference largest;
  for (int frame = 0; frame < frames; frame += sanitized ? 200 : 1) {
    const double part = static_cast<double>(frame) / frames;
    eye.r = eye.head_r = horizon + first_height * std::exp(-0.0125 * part);
    eye.theta = eye.head_theta = first_theta + 0.006 * part;
    eye.phi = GetParam().phi + 0.8 * part;
    const LensPosition here = *cell_middle(eye.spacetime, {eye.r, eye.theta});
    const bool enters = !cell || !same_position(here, middle);
    if (enters) {
      ++entered;
      middle = here;
      cell.emplace(patches_around(eye, field, settings));
    }
    const std::vector<StarImage> images = moved_images(*cell, eye, field, settings);
    // Errors are largest at the border of a cell.
    if (enters || frame % 60 == 0) {
      const std::vector<StarImage> exact = images_of(field, eye, settings);
      compared += exact.size();
      different += images_without_twin(exact, images, settings) + images_without_twin(images, exact, settings);
      compare(exact, images, settings.pixel, largest);
    }
    // Only images of successive frames are similar. Next to a caustic, the search may have missed the
    // image with which another then merges, so the full search decides whether one is lost.
    if (!sanitized && images_lost(before, images, settings) > 0) {
      lost += images_without_twin(images_of(field, eye, settings), images, settings);
    }
    before = images;
  }
  EXPECT_EQ(entered, 3);
  EXPECT_GT(compared, sanitized ? 200U : 10'000U);
  EXPECT_EQ(different, 0U);
  EXPECT_EQ(lost, 0U);
  EXPECT_LT(largest.distance_px, 0.1);
  EXPECT_LT(largest.brightness, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Paths, MovingCamera,
                         testing::Values(CameraState{0.999, 5.0, 1.4, 0.7, ObserverMotion::zamo},
                                         CameraState{0.0, 12.0, 1.5, 0.0, ObserverMotion::fixed}));

//! Distance of a patch's control point nearest to a plane that encloses the patch, in gnomonic
//! projection about the patch's axis; negative if a control point is outside.
double margin_of(const StarPatch& patch, const float (&inward)[3]) {
  const Vector3<double> normal = {static_cast<double>(inward[0]), static_cast<double>(inward[1]),
                                  static_cast<double>(inward[2])};
  double least = 1e30;
  for (int i = 0; i < 16; ++i) {
    const Vector3<double> p = control_point(patch.sky, i);
    const Vector3<double> direction = p.x * patch.frame.first + p.y * patch.frame.second + p.z * patch.frame.axis;
    least = std::min(least, dot(normal, direction) / p.z);
  }
  return least;
}

//! Size of a patch along one of its axes, in gnomonic projection.
double size_of(const StarPatch& patch, const float (BezierPatch::*along)[16]) {
  double low = 1e30;
  double high = -1e30;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto position = static_cast<double>((patch.sky.*along)[i] / patch.sky.z[i]);
    low = std::min(low, position);
    high = std::max(high, position);
  }
  return high - low;
}

// A star outside these planes is not searched for, and each star between a patch and its planes
// costs time.
TEST(MovingPatches, AreCloselyEnclosedByTheirPlanes) {
  const StarField field(brightest(1000), glm::dmat3(1.0), colours().view());
  EyeCamera eye = eye_at_position({0.999, 5.0, 1.4, 0.7, ObserverMotion::zamo});
  const MovingPatches cell = patches_around(eye, field, path_settings());
  const LensPosition middle = *cell_middle(eye.spacetime, {eye.r, eye.theta});
  const double height = middle.r - horizon_radius(eye.spacetime);
  std::size_t compared = 0;
  std::size_t wide = 0;
  for (const double side : {-0.49, 0.0, 0.49}) {
    PatchRoom room;
    const LensStation there =
        cell.station_at({middle.r + side * position_cell_height * height, middle.theta + side * position_cell_theta});
    const StarPatches moved = cell.patches_at(there, room);
    for (const StarPatch& patch : moved.patches()) {
      // Patches that reach 90 degrees from their axis keep the planes of all positions in the cell.
      if (*std::ranges::min_element(patch.sky.z) < 2e-3F) {
        ++wide;
        continue;
      }
      for (std::size_t plane = 0; plane < 4; ++plane) {
        const double size = size_of(patch, plane < 2 ? &BezierPatch::x : &BezierPatch::y);
        const double slack = static_cast<double>(part_slack) * size + static_cast<double>(min_part_slack + patch.error);
        const double margin = margin_of(patch, patch.part.inward[plane]);
        ASSERT_GT(margin, 0.5 * slack);
        ASSERT_LT(margin, 1.5 * slack);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 10'000U);
  EXPECT_LT(wide, compared / 500);
}

TEST(PositionCells, HoldTheirPositions) {
  const Spacetime spacetime{0.9};
  const double horizon = horizon_radius(spacetime);
  for (double r = 2.5; r < 40.0; r *= 1.1) {
    const LensPosition middle = *cell_middle(spacetime, {r, 1.2});
    EXPECT_LE(std::abs(std::log((r - horizon) / (middle.r - horizon))), 0.501 * position_cell_height);
    EXPECT_LE(std::abs(1.2 - middle.theta), 0.501 * position_cell_theta);
    EXPECT_TRUE(same_position(*cell_middle(spacetime, middle), middle));
  }
}

TEST(PositionCells, AreNotNextToTheHorizonOrTheAxis) {
  EXPECT_FALSE(cell_middle(Spacetime{0.9}, {1.5, 1.2}));
  EXPECT_FALSE(cell_middle(Spacetime{0.9}, {8.0, 0.01}));
  EXPECT_FALSE(cell_middle(Spacetime{0.9}, {std::nan(""), 1.0}));
}

Show show_of_moving_stars() {
  Show show;
  show.sky.stars = "bright_stars";
  show.sky.faintest_mag = 5.0;
  return show;
}

TEST(StarsOfASlowCamera, DoNotDependOnEarlierPictures) {
  StarPass passing(show_of_moving_stars());
  StarPass fresh(show_of_moving_stars());
  const Projection projection = make_dome_projection(512, pi, 0.5);
  EyeCamera eye = eye_at_position({0.9, 8.0, 1.3, 0.2, ObserverMotion::zamo});
  std::vector<StarPoint> points;
  const LensPosition step = {-0.04, 0.0};
  for (int frame = 0; frame < 12; ++frame) {
    eye.r = eye.head_r = 8.0 + step.r * frame;
    points = passing.find(eye, projection, {}, PixelMatch::exact, {true, step});
  }
  const std::vector<StarPoint> alone = fresh.find(eye, projection, {}, PixelMatch::exact, {true});
  ASSERT_EQ(points.size(), alone.size());
  EXPECT_TRUE(std::ranges::equal(points, alone, [](const StarPoint& a, const StarPoint& b) {
    return a.x_px == b.x_px && a.y_px == b.y_px && a.light.y == b.light.y;
  }));
}

}  // namespace
}  // namespace ergodome
