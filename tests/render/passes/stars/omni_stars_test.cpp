#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/stars/drawing/picture_regions.h"
#include "tests/render/direct_rays.h"
#include "tests/render/omni_eyes.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Images closer to the shadow's edge than this are not checked [px]: there, the sky within a pixel
//! extends over whole turns around the hole.
constexpr double ring_px = 2.0;
//! If the sky moves by less than this fraction of the motion on the screen, an image is on a
//! critical curve, where it becomes an arc; such images are not checked.
constexpr double min_move = 0.02;

struct Case {
  const char* name;
  double half_baseline;
  double convergence;
  Projection projection;
};

std::vector<Case> cases() {
  return {{"dome", 0.5, 0.0, make_dome_projection(160, pi, 0.4)},
          {"a dome that converges", 0.2, 12.0, make_dome_projection(160, pi, 0.4)},
          {"equirect", 0.5, 0.0, make_equirectangular_projection(192, 96)},
          {"cylinder", 0.5, 0.0, make_cylinder_projection(192, 62, 2.0 * pi, -1.0, 1.0)},
          {"cube", 0.2, 0.0, make_cube_projection(48, CubeLayout::strip)}};
}

//! Returns the show whose camera the tests use.
Show position_of_tests() {
  return parse_show("[hole]\nspin = 0.95\n[camera]\n[[camera.key]]\nr = 9\ntheta_deg = 70\n[sky]\nmap = \"grid\"\n",
                    "omni_stars.toml");
}

//! A star image that the program's search has found, and its position on the screen.
struct Found {
  StarImage image;
  StarSpot spot;
};

class OmniStars : public testing::TestWithParam<std::size_t> {
 protected:
  OmniStars()
      : case_(cases()[GetParam()]),
        show_(position_of_tests()),
        pose_(camera_pose(show_, 0.0)),
        eye_at_([this](const Vector3<double>& offset) { return eye_camera(show_, pose_, offset); }),
        field_(brightest(sanitized ? 60 : 300), glm::dmat3(1.0), colours().view()) {
    settings_ = settings_for(9.0);
    settings_.pixel = pixel_angle(case_.projection);
    settings_.redshift = true;
  }

  //! Returns the star images in the picture, as the program's search in patches finds them.
  [[nodiscard]] std::vector<Found> found(double side) const {
    const StarEye eye(eye_of(side));
    const LensStation station = build_star_station(eye, settings_);
    const StarPatches patches = star_patches(field_, colours().view(), eye, station, settings_);
    std::vector<Found> images;
    for (const StarImage& image : find_star_images(field_, colours().view(), eye, station, patches, settings_)) {
      StarSpot spot{};
      if (pixel_from_direction(case_.projection, widened(image.direction), spot.x_px, spot.y_px) && is_shown(spot)) {
        images.push_back({image, spot});
      }
    }
    return images;
  }

  [[nodiscard]] std::shared_ptr<const OmniEye> eye_of(double side) const {
    const auto cameras = std::make_shared<const OmniCamera>(
        Backend::cpu, eye_at_,
        OmniSettings{case_.half_baseline, case_.convergence, pi / 3.0, 0.5 * pi, 0.05 * settings_.pixel});
    return make_omni_eye(cameras, side, eye_at_);
  }

  //! Returns the star images that gather_stars() finds, which gathers the stars of each pixel.
  [[nodiscard]] std::vector<Found> gathered_by_pixels(double side) const {
    const StarEye eye(eye_of(side));
    const StarTree tree(field_);
    std::vector<Found> images;
    for (const PictureRegion& region : picture_regions(case_.projection)) {
      const GatheredStars gathered = gather_stars(field_, tree, colours().view(), eye, region.projection, settings_);
      for (const StarImage& image : star_images(gathered.stars, eye.camera, region.projection)) {
        StarSpot spot{};
        if (pixel_from_direction(case_.projection, widened(image.direction), spot.x_px, spot.y_px)) {
          images.push_back({image, spot});
        }
      }
    }
    return images;
  }

  //! Returns whether a position is inside the picture and at least `margin_px` away from its edges.
  [[nodiscard]] bool is_inside_by(const StarSpot& spot, double margin_px) const {
    return is_shown({spot.x_px - margin_px, spot.y_px - margin_px}) &&
           is_shown({spot.x_px + margin_px, spot.y_px - margin_px}) &&
           is_shown({spot.x_px - margin_px, spot.y_px + margin_px}) &&
           is_shown({spot.x_px + margin_px, spot.y_px + margin_px});
  }

  //! Returns whether the magnification changes by at most two percent across the pixel around a
  //! position. Otherwise, gathered stars cannot be compared, because they have the mean
  //! magnification of their pixel.
  [[nodiscard]] bool changes_little(const DirectRays& rays, const StarSpot& spot) const {
    constexpr double max_change = 0.02;
    const auto middle = rays.map(spot);
    if (!middle) {
      return false;
    }
    const double here = pixel_area(spot) / middle->determinant();
    for (const StarSpot& beside : {StarSpot{spot.x_px - 1.0, spot.y_px}, StarSpot{spot.x_px + 1.0, spot.y_px},
                                   StarSpot{spot.x_px, spot.y_px - 1.0}, StarSpot{spot.x_px, spot.y_px + 1.0}}) {
      const auto map = rays.map(beside);
      if (!map || std::abs(pixel_area(beside) / map->determinant() / here - 1.0) > max_change) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool is_shown(const StarSpot& spot) const {
    return spot.x_px >= 0.0 && spot.x_px <= case_.projection.width_px && spot.y_px >= 0.0 &&
           spot.y_px <= case_.projection.height_px && image_coverage(case_.projection, spot.x_px, spot.y_px) >= 1.0;
  }

  [[nodiscard]] DirectRays rays(double side) const {
    return {eye_at_, side * case_.half_baseline, case_.convergence, case_.projection};
  }

  [[nodiscard]] Vector3<double> direction(int star) const {
    return field_.stars()[static_cast<std::size_t>(star)].direction;
  }

  //! Returns whether all points at the distance `ring_px` from a position are outside the shadow.
  [[nodiscard]] bool off_the_edge(const DirectRays& rays, const StarSpot& spot) const {
    for (int i = 0; i < 8; ++i) {
      const double turn = 0.25 * pi * i;
      if (!rays.sky({spot.x_px + ring_px * std::cos(turn), spot.y_px + ring_px * std::sin(turn)})) {
        return false;
      }
    }
    return true;
  }

  //! Returns the length of a displacement on the screen, in units of the picture's middle pixel. A
  //! column counts by its width at this position: at the poles of an equirectangular picture, it is
  //! 0.
  [[nodiscard]] double apart_px(const StarSpot& spot, double columns, double rows) const {
    constexpr double h = 1e-3;
    const Vector3<double> column = (0.5 / h) * (direction_from_pixel(case_.projection, spot.x_px + h, spot.y_px) -
                                                direction_from_pixel(case_.projection, spot.x_px - h, spot.y_px));
    const double narrower = std::min(std::sqrt(dot(column, column)) / settings_.pixel, 1.0);
    return std::hypot(narrower * columns, rows);
  }

  //! Returns the solid angle of a pixel [sr].
  [[nodiscard]] double pixel_area(const StarSpot& spot) const {
    constexpr double h = 1e-3;
    const auto n = [&](double x, double y) { return direction_from_pixel(case_.projection, x, y); };
    const Vector3<double> normal = cross((0.5 / h) * (n(spot.x_px + h, spot.y_px) - n(spot.x_px - h, spot.y_px)),
                                         (0.5 / h) * (n(spot.x_px, spot.y_px + h) - n(spot.x_px, spot.y_px - h)));
    return std::sqrt(dot(normal, normal));
  }

  Case case_;
  Show show_;
  CameraPose pose_;
  EyeAtOffset eye_at_;
  StarField field_;
  StarSettings settings_;
};

TEST_P(OmniStars, AreWhereTheirPixelsOwnCameraSeesThem) {
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(std::string(case_.name) + (side < 0.0 ? " left" : " right"));
    const DirectRays own = rays(side);
    double largest_px = 0.0;
    double worst_g = 0.0;
    double worst_magnification = 0.0;
    int compared = 0;
    for (const Found& each : found(side)) {
      if (!off_the_edge(own, each.spot)) {
        continue;
      }
      const auto map = own.map(each.spot);
      ASSERT_TRUE(map.has_value());
      if (min_move_of(*map) < min_move * std::sqrt(pixel_area(each.spot))) {
        continue;
      }
      const StarSpot way = DirectRays::way_to(*map, direction(each.image.star));
      largest_px = std::max(largest_px, apart_px(each.spot, way.x_px, way.y_px));
      const DirectRay ray = own.ray(each.spot);
      const double g = 1.0 / start_ray(ray.camera, ray.n).energy;
      worst_g = std::max(worst_g, std::abs(static_cast<double>(each.image.frequency_ratio) / g - 1.0));
      const double magnification = pixel_area(each.spot) / map->determinant();
      worst_magnification = std::max(
          worst_magnification, std::abs(std::abs(static_cast<double>(each.image.magnification)) / magnification - 1.0));
      ++compared;
    }
    EXPECT_LT(largest_px, 0.2);
    EXPECT_LT(worst_g, 1e-3);
    EXPECT_LT(worst_magnification, 0.05);
    EXPECT_GT(compared, sanitized ? 20 : 100);
  }
}

TEST_P(OmniStars, AreAllThatASearchPixelByPixelFinds) {
  if (sanitized) {
    GTEST_SKIP() << "many rays";
  }
  const double faintest = static_cast<double>(settings_.faintest);
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(std::string(case_.name) + (side < 0.0 ? " left" : " right"));
    const DirectRays own = rays(side);
    const PixelMesh mesh(own, case_.projection);
    const std::vector<Found> ours = found(side);
    int compared = 0;
    int missed = 0;
    for (std::size_t star = 0; star < field_.stars().size(); ++star) {
      for (const StarSpot& pixel : mesh.pixels_with(field_.stars()[star].direction)) {
        const auto spot = own.image(pixel, field_.stars()[star].direction);
        if (!spot || !is_shown(*spot) || !off_the_edge(own, *spot)) {
          continue;
        }
        const auto map = own.map(*spot);
        const DirectRay ray = own.ray(*spot);
        const double g = 1.0 / start_ray(ray.camera, ray.n).energy;
        const double light = static_cast<double>(field_.stars()[star].illuminance) * pixel_area(*spot) /
                             map->determinant() * std::min(g * g * g * g, 1.0);
        if (light < 3.0 * faintest || min_move_of(*map) < min_move * std::sqrt(pixel_area(*spot))) {
          continue;
        }
        const bool there = std::ranges::any_of(ours, [&](const Found& each) {
          return each.image.star == static_cast<int>(star) &&
                 apart_px(*spot, each.spot.x_px - spot->x_px, each.spot.y_px - spot->y_px) < 0.2;
        });
        missed += there ? 0 : 1;
        ++compared;
      }
    }
    EXPECT_EQ(missed, 0);
    EXPECT_GT(compared, 100);
  }
}

TEST_P(OmniStars, GatheredByPixelsShineLikeInvertedImages) {
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(std::string(case_.name) + (side < 0.0 ? " left" : " right"));
    const DirectRays own = rays(side);
    const std::vector<Found> gathered = gathered_by_pixels(side);
    std::vector<double> errors;
    for (const Found& each : found(side)) {
      if (!is_inside_by(each.spot, 1.0) || !changes_little(own, each.spot)) {
        continue;
      }
      const auto match = std::ranges::find_if(gathered, [&](const Found& other) {
        return other.image.star == each.image.star &&
               std::hypot(other.spot.x_px - each.spot.x_px, other.spot.y_px - each.spot.y_px) < 0.5;
      });
      ASSERT_NE(match, gathered.end()) << "no gathered star at " << each.spot.x_px << ", " << each.spot.y_px;
      EXPECT_GT(match->image.magnification * each.image.magnification, 0.0F);
      EXPECT_NEAR(match->image.frequency_ratio / each.image.frequency_ratio, 1.0F, 2e-3F);
      errors.push_back(std::abs(static_cast<double>(match->image.illuminance.y / each.image.illuminance.y) - 1.0));
    }
    ASSERT_GT(errors.size(), sanitized ? 5U : 30U);
    std::ranges::sort(errors);
    EXPECT_LT(errors[errors.size() / 2], 3e-3);
    EXPECT_LT(errors.back(), 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Projections, OmniStars, testing::Range<std::size_t>(0, 5));

}  // namespace
}  // namespace ergodome
