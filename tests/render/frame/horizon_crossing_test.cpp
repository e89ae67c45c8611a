#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "render/eyes/view_projection.h"
#include "render/lens/direct_lens.h"
#include "render/lens/lens_chooser.h"
#include "render/passes/stars/drawing/star_trails.h"
#include "tests/render/passes/stars/star_cameras.h"

// Tests of effects that combine several moments while a camera falls through the horizon: star
// trails, and grids that were built for an earlier moment.
namespace ergodome {
namespace {

//! Returns a show whose camera falls through the horizon of a hole with spin 0.9, at 1.4359 M. It
//! moves relative to the rain frame.
Show crossing_show() {
  return parse_show(
      "duration_s = 40\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 6\ntheta_deg = 70\n[camera.fall]\n"
      "velocity = { beta = 0.4, toward = [-3, 1, 1] }\nclock = 1\nleast_r = 0.8\n"
      "[view]\nprojection = \"equirect\"\nfov_deg = 360\nsize_px = 2048\n",
      "crossing.toml");
}

EyeCamera crossing_eye(const Show& show, double after_horizon_s) {
  return eye_camera(show, camera_pose(show, *show.camera.orbit->horizon_s() + after_horizon_s), 0.0);
}

//! Counts the trails that agree with star images at one end of the shutter time (the moment `end`).
//! `there` contains the images that were computed for that moment alone.
std::size_t meeting(const StarTrails& trails, const std::vector<StarImage>& images, std::size_t end,
                    const std::vector<StarImage>& there) {
  std::multimap<int, Vector3<float>> known;
  for (const StarImage& image : there) {
    known.emplace(image.star, image.direction);
  }
  std::size_t met = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto [first, last] = known.equal_range(images[i].star);
    const Vector3<float>& at = trails.directions[static_cast<std::size_t>(trails.positions) * i + end];
    met += std::any_of(first, last, [&](const auto& other) {
      const Vector3<float> off = other.second - at;
      return std::sqrt(static_cast<double>(dot(off, off))) < 0.05 * test::fine_pixel;
    });
  }
  return met;
}

TEST(HorizonCrossing, TrailsEndWhereTheImagesAreBeforeAndAfterIt) {
  const Show show = crossing_show();
  const StarField field(test::brightest(200), glm::dmat3(1.0), test::colours().view());
  Shutter shutter;
  for (int i = -3; i <= 3; ++i) {
    shutter.eyes.emplace_back(crossing_eye(show, 0.02 * i));
  }
  ASSERT_GT(shutter.eyes.front().camera.r, horizon_radius(spacetime_of(show)));
  ASSERT_LT(shutter.eyes.back().camera.r, horizon_radius(spacetime_of(show)));
  const auto images = test::images_of(field, shutter.eyes[3].camera, test::settings_for(6.0));
  const StarTrails trails = star_trails(images, field, shutter, test::fine_pixel);
  ASSERT_GT(images.size(), 200U);
  for (const std::size_t end : {0U, 6U}) {
    const auto there = test::images_of(field, shutter.eyes[end].camera, test::settings_for(8.0));
    // A few images merge at a caustic or disappear behind the edge of the shadow; the trails of all
    // others must agree.
    EXPECT_GE(static_cast<double>(meeting(trails, images, end, there)), 0.97 * static_cast<double>(images.size()));
  }
}

//! Returns the sky directions in some rows of a picture, one after the other; 0 in the shadow.
std::vector<Vector3<float>> skies(const LensSource& lens, const Projection& projection) {
  std::vector<Vector3<float>> all;
  const auto width = static_cast<std::size_t>(projection.width_px);
  for (const int row : {projection.height_px / 4, projection.height_px / 2, 3 * projection.height_px / 4}) {
    std::vector<float> sky[3];
    std::vector<float> coverage(width);
    LensPixels out{};
    for (int k = 0; k < 3; ++k) {
      sky[k].resize(width);
      out.sky[k] = sky[k].data();
    }
    out.coverage = coverage.data();
    lens.fill(row, 1, out);
    for (std::size_t i = 0; i < width; ++i) {
      all.push_back({sky[0][i], sky[1][i], sky[2][i]});
    }
  }
  return all;
}

//! Compares two lenses at the pixels where both see the sky. Returns the median angle between their
//! sky directions [rad].
double middle_difference(const std::vector<Vector3<float>>& a, const std::vector<Vector3<float>>& b) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (dot(a[i], a[i]) > 0.5F && dot(b[i], b[i]) > 0.5F) {
      const Vector3<float> off = a[i] - b[i];
      apart.push_back(std::sqrt(static_cast<double>(dot(off, off))));
    }
  }
  std::ranges::nth_element(apart, apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2));
  return apart[apart.size() / 2];
}

TEST(HorizonCrossing, GridsOfAMomentBeforeShowAboutTheSameSky) {
  const Show show = crossing_show();
  const Projection projection = make_projection(show.view, show.view.size_px, 0.0);
  int behind = 0;
  // On a busy machine, grids may be finished when they are asked for, so that none is behind.
  for (int attempt = 0; attempt < 20 && behind < 2; ++attempt) {
    LensChooser lenses(Backend::cpu);
    for (const double after_s : {-0.05, -0.03, -0.01, 0.01, 0.03, 0.05}) {
      const EyeCamera eye = crossing_eye(show, after_s);
      const auto lens = lenses.choose({LensChoice::live, eye, projection, ViewMode::sky, {}, {std::nullopt, 0.0}, {}});
      behind += lens->behind() ? 1 : 0;
      const DirectLens direct(Backend::cpu, eye, projection, 0.05);
      // A lens that is behind may differ by the motion of the camera in a moment. The Boyer-Lindquist
      // azimuth of the camera changes by half a radian in this time; if the lens did not correct for
      // that, the whole sky would be rotated.
      EXPECT_LT(middle_difference(skies(*lens, projection), skies(direct, projection)), lens->behind() ? 0.03 : 1e-3)
          << after_s;
    }
  }
  EXPECT_GE(behind, 2);
}

}  // namespace
}  // namespace ergodome
