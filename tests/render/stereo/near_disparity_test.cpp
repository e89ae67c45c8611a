#include "render/stereo/near_disparity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/geodesic/affine_distance.h"
#include "render/frame/show_renderer.h"
#include "render/lens/direct_lens.h"
#include "render/stereo/near_sights.h"
#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/sanitized.h"

// Tests of the disparity of objects near the hole that is reported to the operator.
namespace ergodome {
namespace {

const std::string spinning = "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 15\ntheta_deg = 75\nphi_deg = 20\n";
const std::string wide = "[view]\nprojection = \"pinhole\"\nfov_deg = 90\nsize_px = 400\n";

std::string small_ball(const std::string& position, const std::string& method = "trace") {
  return "[[objects]]\nmethod = \"" + method + "\"\nshape = \"sphere\"\nsegments = 24\nrings = 12\nsize = 0.08\n" +
         position + "\n";
}

std::string eyes(const std::string& model, const std::string& more = "baseline = 0.4\n") {
  return "[stereo]\nmodel = \"" + model + "\"\nlayout = \"separate\"\n" + more;
}

Show black_show(const std::string& scene) { return parse_show("[sky]\nmap = \"black\"\n" + scene, "disparity.toml"); }

Show with_sky(Show show) {
  show.sky.map = "milky_way";
  return show;
}

Projection projection_of(const Show& show) { return make_projection(show.view, show.view.size_px, 0.0); }

//! Returns the disparity of disk, shells and objects near the hole, without that of the sky.
std::optional<Disparity> near_disparity_of(const Show& show) {
  const ShowRenderer renderer(show, Backend::cpu);
  const CameraPose pose = camera_pose(show, 0.0);
  DisparityMeter meter(StereoEye(show, pose, -1.0), StereoEye(show, pose, 1.0), projection_of(show));
  add_near_things(show, pose, seen_directions(show, pose, projection_of(show), renderer.hiding_objects()),
                  renderer.object_outlines(), meter);
  return meter.result();
}

Disparity disparity_of(const Show& show) {
  const auto disparity = near_disparity_of(show);
  EXPECT_TRUE(disparity);
  return disparity.value_or(Disparity{});
}

//! Returns the horizontal center of the light within 25 pixels of the brightest pixel [px].
double middle_of_light(const Picture& picture) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < picture.rgba.size() / 4; ++i) {
    brightest = picture.rgba[4 * i] > picture.rgba[4 * brightest] ? i : brightest;
  }
  EXPECT_GT(picture.rgba[4 * brightest], 0.5F);
  double light = 0.0;
  double middle = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size() / 4; ++i) {
    const auto off = [&](std::size_t one, std::size_t other) {
      return static_cast<double>(one) - static_cast<double>(other);
    };
    if (std::hypot(off(i % width, brightest % width), off(i / width, brightest / width)) < 25.0) {
      light += static_cast<double>(picture.rgba[4 * i]);
      middle += (static_cast<double>(i % width) + 0.5) * static_cast<double>(picture.rgba[4 * i]);
    }
  }
  return middle / light;
}

//! Returns by how much the center of the light is farther to the right for the right eye than for
//! the left eye [px].
double apart_in_pictures(const Show& show) {
  ShowRenderer renderer(show, Backend::cpu);
  const auto parts = renderer.render_window_parts(camera_pose(show, 0.0), projection_of(show), ViewMode::sky);
  return middle_of_light(parts[1]) - middle_of_light(parts[0]);
}

//! Compares the reported disparity of a small ball with the disparity of its light in the pictures.
//! The center of this light is slightly farther away than the nearest point of the ball.
void expect_ball_of_pictures(const std::string& scene) {
  const Show show = black_show(scene);
  const double drawn = apart_in_pictures(show);
  const double counted = disparity_of(show).min_px;
  EXPECT_LT(drawn, -5.0);
  EXPECT_LT(counted, drawn);
  EXPECT_GT(counted, 1.04 * drawn);
}

TEST(NearDisparity, OfATracedBallIsThatOfItsPicturesInEveryModel) {
  // Under sanitizers, pictures of the models `flat` and `omni` take too long; other tests of these
  // models cover the same code.
  for (const char* const model : test::sanitized ? std::vector{"physical"} : std::vector{"physical", "flat", "omni"}) {
    SCOPED_TRACE(model);
    expect_ball_of_pictures(spinning + wide + small_ball("position = [11, 4, 2.5]") + eyes(model));
  }
}

class NearDisparityOfPolygons : public test::ObjectScenes {};

TEST_F(NearDisparityOfPolygons, IsThatOfTheirPictures) {
  const std::string still = "[hole]\nspin = 0\n[camera]\n[[camera.key]]\nr = 15\ntheta_deg = 75\nphi_deg = 20\n";
  expect_ball_of_pictures(still + wide + small_ball("position = [11, 4, 2.5]", "polygon") + eyes("physical"));
}

TEST(NearDisparity, OfWhatMovesWhileItsLightIsOnTheWayIsWhereItIsSeen) {
  const std::string orbit = "orbit = { r = 12, phi_deg = 32, speed = 1 }\nretarded = true";
  expect_ball_of_pictures(spinning + wide + small_ball(orbit) + eyes("physical"));
}

TEST(NearDisparity, OfEyesThatConvergeIsThatOfTheirPictures) {
  const auto show_of = [](const std::string& stereo) {
    return black_show(spinning + wide + small_ball("position = [11, 4, 2.5]") + stereo);
  };
  for (const char* const model : {"physical", "omni"}) {
    const double apart = disparity_of(show_of(eyes(model))).min_px;
    const Show show = show_of(eyes(model, "baseline = 0.4\nconvergence = 9\n"));
    EXPECT_NEAR(disparity_of(show).min_px, apart_in_pictures(show), 0.04 * std::abs(apart)) << model;
  }
}

TEST(NearDisparity, FarFromTheHoleIsTheBaselineOverTheDistance) {
  const std::string far = "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 2000\ntheta_deg = 90\n";
  for (const char* const model : {"physical", "flat", "omni"}) {
    const Show show = black_show(far + wide + small_ball("position = [1980, 0, 0]") + eyes(model));
    EXPECT_NEAR(disparity_of(show).min_arcmin, -60.0 / one_degree * 0.4 / (20.0 - 0.08), 0.2) << model;
  }
}

TEST(NearDisparity, OnADomeIsAcrossForWhoLooksThereInTheModelOmni) {
  const std::string dome =
      "[hole]\nspin = 0\n[camera]\n[[camera.key]]\nr = 2000\ntheta_deg = 90\n[view]\nprojection = \"dome\"\nfov_deg "
      "= 180\nsize_px = 400\n";
  // The balls are 20 M from the camera horizontally and 6 M above it, so their zenith angle is
  // atan(20 / 6).
  const double zenith_angle = std::atan2(20.0, 6.0);
  const double turn = 0.4 / (std::hypot(20.0, 6.0) - 0.08);
  for (const char* const position : {"[1980, 0, 6]", "[2020, 0, 6]", "[2000, 20, 6]", "[2000, -20, 6]"}) {
    const Disparity found =
        disparity_of(black_show(dome + small_ball(std::string("position = ") + position) + eyes("omni")));
    EXPECT_NEAR(found.min_arcmin, -60.0 / one_degree * turn, 0.5) << position;
    EXPECT_NEAR(found.min_px, -200.0 / (90.0 * one_degree) * zenith_angle / std::sin(zenith_angle) * turn, 0.03)
        << position;
  }
}

TEST(NearDisparity, OfALargeThingIsThatOfItsNearestPlace) {
  const std::string far = "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 2000\ntheta_deg = 90\n" + wide;
  const std::string ball =
      "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nsegments = 96\nrings = 48\nsize = 15\n"
      "position = [1980, 0, 0]\n";
  const std::string plate =
      "[[objects]]\nmethod = \"trace\"\nshape = \"triangle\"\ncorners = [[0, -30, -30], [0, 40, -20], [0, -10, 50]]\n"
      "position = [1995, 0, 0]\n";
  for (const std::string& thing : {ball, plate}) {
    for (const char* const model : {"physical", "flat"}) {
      const Disparity found = disparity_of(black_show(far + thing + eyes(model)));
      EXPECT_NEAR(found.min_arcmin, -60.0 / one_degree * 0.4 / 5.0, 3.0) << model;
    }
  }
}

TEST(NearDisparity, OfAThingAboutTheCameraIsThatOfWhatThePictureShows) {
  const std::string far = "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 2000\ntheta_deg = 90\n" + wide;
  const std::string ball =
      "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nsegments = 96\nrings = 48\nsize = 15\n"
      "position = [1990, 0, 0]\n";
  // The camera is inside a large ball. Straight ahead, the surface is 25 M away; in the corners of
  // the picture, its depth is 10.6 M. Behind the camera it is only 5 M away, but not visible.
  const Disparity found = disparity_of(black_show(far + ball + eyes("physical")));
  EXPECT_NEAR(found.max_px, -200.0 * 0.4 / 25.0, 0.1);
  EXPECT_NEAR(found.min_px, -200.0 * 0.4 / 10.6, 0.3);
}

TEST(NearDisparity, IsThereForWhatStandsAbreastOfTheHole) {
  for (int phi_deg = 90; phi_deg <= 130; phi_deg += 4) {
    const std::string at = "position = [" + std::to_string(7.0 * std::cos(phi_deg * one_degree)) + ", " +
                           std::to_string(7.0 * std::sin(phi_deg * one_degree)) + ", 0]";
    const Show show = black_show(spinning + wide + small_ball(at) + eyes("flat"));
    ASSERT_TRUE(near_disparity_of(show)) << phi_deg;
    EXPECT_LT(near_disparity_of(show)->min_px, -3.0) << phi_deg;
  }
}

TEST(NearDisparity, OnTheAxisIsThatOfPictures) {
  const std::string above = "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 15\ntheta_deg = 0\nphi_deg = 30\n";
  for (const char* const model : test::sanitized ? std::vector{"physical"} : std::vector{"physical", "flat"}) {
    SCOPED_TRACE(model);
    expect_ball_of_pictures(above + wide + small_ball("position = [1.5, 1.5, 11]") + eyes(model));
  }
}

TEST(NearDisparity, OfWhatIsWithinTwoMCountsInTheFlatModelAlone) {
  const std::string near = "[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 6\ntheta_deg = 75\n" + wide;
  const auto of = [&](const std::string& model) {
    return near_disparity_of(black_show(near + "[[shells]]\nradius = 1.5\n" + eyes(model)));
  };
  EXPECT_FALSE(of("physical"));
  EXPECT_FALSE(of("omni"));
  EXPECT_TRUE(of("flat"));
}

TEST(NearDisparity, OfEyesFartherApartThanAThingIsAwayIsANumber) {
  for (const char* const model : {"physical", "flat", "omni"}) {
    const Show show =
        black_show(spinning + wide + small_ball("position = [13, 4.7, 3.7]") + eyes(model, "baseline = 6\n"));
    const auto found = near_disparity_of(show);
    EXPECT_TRUE(!found || std::abs(found->min_px) < 4000.0) << model;
  }
}

TEST(NearDisparity, LeavesOutCornersThatAreNoNumbersOrOfNoTriangle) {
  TriangleMesh mesh;
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float x : {0.0F, 1.0F, 2.0F, infinity, 50.0F}) {
    mesh.vertices.emplace_back().position[0] = x;
  }
  mesh.indices = {0, 1, 2, 0, 1, 3};
  EXPECT_EQ(outline_of(mesh).size(), 3U);
  EXPECT_TRUE(outline_of({}).empty());
}

TEST(NearDisparity, OfWhatNoPictureShowsDoesNotCount) {
  for (const char* const position : {"position = [18, 7, 4]", "position = [13, -9, 4]"}) {
    EXPECT_FALSE(near_disparity_of(black_show(spinning + wide + small_ball(position) + eyes("physical")))) << position;
  }
}

TEST(NearDisparity, OfManyThingsIsThatOfTheOneThatIsSeenNearest) {
  // Sixteen balls are closer than the current position of another, moving ball. Its light was
  // emitted earlier and shows it in front of them.
  const std::string mover = small_ball("retarded = true\norbit = { r = 12, phi_deg = 73, speed = 20 }");
  std::string balls;
  for (int i = 0; i < 16; ++i) {
    balls += small_ball("position = [10.69, -5." + std::to_string(450 + i) + ", 0]");
  }
  const auto min_of = [&](const std::string& objects) {
    return disparity_of(
               black_show(spinning + "[view]\nprojection = \"equirect\"\nsize_px = 1000\n" + objects + eyes("omni")))
        .min_px;
  };
  const double of_mover = min_of(mover);
  EXPECT_LT(of_mover, min_of(balls));
  EXPECT_EQ(min_of(balls + mover), of_mover);
}

TEST(NearDisparity, IsPartOfThatOfTheFrame) {
  for (const char* const model : {"physical", "flat", "omni"}) {
    const Show show = black_show(spinning + wide + small_ball("position = [13.5, 4.6, 3.4]") + eyes(model));
    const ShowRenderer renderer(show, Backend::cpu);
    const auto frame = frame_disparity(with_sky(show), camera_pose(show, 0.0), projection_of(show),
                                       renderer.object_outlines(), renderer.hiding_objects());
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->min_px, disparity_of(show).min_px) << model;
    EXPECT_GT(frame->max_px, frame->min_px) << model;
  }
}

TEST(NearDisparity, OfTheSkyCountsWhereNothingOpaqueIsBeforeIt) {
  const auto sky_beyond_shell = [](const std::string& opacity) {
    const Show show =
        black_show(spinning + wide + "[[shells]]\nradius = 18\nfill_opacity = " + opacity + "\n" + eyes("flat"));
    return frame_disparity(with_sky(show), camera_pose(show, 0.0), projection_of(show), {}, {}).value().max_px -
           near_disparity_of(show).value().max_px;
  };
  EXPECT_EQ(sky_beyond_shell("1"), 0.0);
  EXPECT_GT(sky_beyond_shell("0.3"), 1.0);
}

TEST(NearDisparity, OfTheSkyAndShellsCountsWhereNoObjectIsBeforeIt) {
  // The ball has a radius of 15 M, 20 M in front of the camera. The shell is about a thousand M
  // away.
  const Show show =
      black_show("[hole]\nspin = 0\n[camera]\n[[camera.key]]\nr = 2000\ntheta_deg = 90\n" + wide +
                 "[[shells]]\nradius = 1000\nfill_opacity = 0.3\n[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\n"
                 "segments = 96\nrings = 48\nsize = 15\nposition = [1980, 0, 0]\n" +
                 eyes("physical"));
  const ShowRenderer renderer(show, Backend::cpu);
  const double rim = std::asin(15.0 / 20.0);
  int hidden = 0;
  for (const SeenDirection& direction :
       seen_directions(show, camera_pose(show, 0.0), projection_of(show), renderer.hiding_objects())) {
    const double off = std::acos(-direction.view.z) - rim;
    if (std::abs(off) > 0.02) {
      EXPECT_EQ(direction.shows_sky(), off > 0.0) << off;
      hidden += off < 0.0 ? 1 : 0;
      EXPECT_TRUE(off > 0.0 || direction.sights.empty()) << off;
    }
  }
  EXPECT_GT(hidden, 40);
}

TEST(NearDisparity, OfADiskCountsBeforeObjectsAlone) {
  const auto sights_beside = [](const std::string& ball) {
    const Show show = black_show("[hole]\nspin = 0\n[camera]\n[[camera.key]]\nr = 60\ntheta_deg = 30\n" + wide +
                                 "[disk]\nouter = 20\n" + ball + eyes("physical"));
    const ShowRenderer renderer(show, Backend::cpu);
    std::size_t count = 0;
    for (const SeenDirection& direction :
         seen_directions(show, camera_pose(show, 0.0), projection_of(show), renderer.hiding_objects())) {
      count += direction.sights.size();
    }
    return count;
  };
  const auto ball = [](const char* position) {
    return "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nsize = 4\nposition = " + std::string(position) + "\n";
  };
  EXPECT_GT(sights_beside(""), 5U);
  EXPECT_EQ(sights_beside(ball("[25, 0, 43.3]")), 0U);
  EXPECT_EQ(sights_beside(ball("[-25, 0, -43.3]")), sights_beside(""));
}

TEST(NearDisparity, OfAShellsNearestPlaceIsThatOfABallThere) {
  // Objects are straight ahead, where the lattice of samples has a point.
  const auto min_of = [](const std::string& thing, const std::string& stereo) {
    const std::string camera = "[hole]\nspin = 0\n[camera]\n[[camera.key]]\nr = 24\ntheta_deg = 90\n";
    return disparity_of(black_show(camera + wide + thing + stereo)).min_px;
  };
  for (const char* const model : {"physical", "flat"}) {
    const double of_shell = min_of("[[shells]]\nradius = 18\n", eyes(model));
    EXPECT_LT(of_shell, -5.0);
    EXPECT_NEAR(of_shell, min_of(small_ball("position = [17.92, 0, 0]"), eyes(model)), 0.02) << model;
  }
}

TEST(NearSights, AreSeenWhereTheyWereLookedAt) {
  const Show show = black_show(
      "[hole]\nspin = 0.9\n[camera]\nobserver = \"geodesic\"\n[[camera.key]]\nr = 24\ntheta_deg = 75\nroll_deg = 30\n" +
      wide + "[disk]\nouter = 12\n[[shells]]\nradius = 3\n");
  const EyeCamera head = eye_camera(show, camera_pose(show, 0.0), 0.0);
  const CameraStation camera = station_of(head);
  int of_disk = 0;
  int of_shell = 0;
  int at_once = 0;
  visit_lattice(make_projection(show.view, 400, 45.0), [&](const Vector3<double>& view) {
    const auto row = [&](int i) {
      const double(&m)[3][3] = head.frame_from_view;
      return m[i][0] * view.x + m[i][1] * view.y + m[i][2] * view.z;
    };
    for (const NearSight& sight : near_sights(show, head, view)) {
      if (!sight.first) {
        continue;
      }
      const auto seen = seen_by_camera(head, {sight.position});
      ASSERT_TRUE(seen);
      const Vector3<double> off = seen->view - view;
      EXPECT_LT(std::sqrt(dot(off, off)), 1e-5);
      const auto distance = distance_of_position(head, seen->view, sight.position);
      ASSERT_TRUE(distance);
      EXPECT_NEAR(*distance, sight.distance, 1e-4 * sight.distance);
      const double r = std::sqrt(dot(sight.position, sight.position));
      (std::abs(r - 3.0) < 1e-6 ? of_shell : of_disk) += 1;
      // affine_distance() finds by another series where light first reaches a radius: at this
      // crossing or, for light that comes back, before its turning point. It may miss light that
      // only touches the radius.
      const double to_radius = affine_distance(camera, {row(0), row(1), row(2)}, r);
      EXPECT_TRUE(std::isinf(to_radius) || sight.distance > (1.0 - 1e-5) * to_radius);
      at_once += sight.distance < (1.0 + 1e-5) * to_radius ? 1 : 0;
    }
  });
  EXPECT_GT(of_disk, 12);
  EXPECT_GT(of_shell, 3);
  EXPECT_GT(at_once, 20);
}

}  // namespace
}  // namespace ergodome
