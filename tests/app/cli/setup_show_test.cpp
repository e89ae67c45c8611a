#include "app/cli/setup_show.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibration/projectors/projector_optics.h"
#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "render/eyes/view_projection.h"
#include "render/patterns/pattern_position.h"

namespace ergodome {
namespace {

//! Returns the setup of a tilted dome with a rotated picture and a single projector, whose light
//! covers much of the dome.
DomeSetup leaning_dome(double tilt_deg, double rotation_deg) {
  DomeSetup setup;
  setup.radius_m = 8.0;
  setup.tilt_deg = tilt_deg;
  setup.rotation_deg = rotation_deg;
  ProjectorSetup projector;
  projector.name = "up";
  projector.position_m = {0.3, 0.1, -0.4};
  projector.orientation.pitch_deg = 70.0;
  projector.lens = Frustum{-60, 60, 55, -55};
  projector.width_px = 64;
  projector.height_px = 48;
  setup.projectors.push_back(projector);
  return setup;
}

//! Compares the elevations and azimuths of a pattern with those of the points on the dome where the
//! projector shows them; azimuths on the dome count from the setup's rotation. Returns the maximum
//! difference [deg].
double worst_pattern_error_deg(const DomeSetup& setup) {
  constexpr int size_px = 1024;
  const PatternView master = upright_master(setup, size_px);
  const ProjectorOptics optics(setup, setup.projectors[0]);
  const WarpMesh warp = projector_pictures(setup)[0].warp;
  double worst = 0.0;
  int lit = 0;
  for (const WarpNode& node : warp.nodes) {
    const auto point = optics.dome_point({static_cast<double>(node.x), static_cast<double>(node.y)});
    if (!node.valid || !point || std::hypot(node.u - 0.5F, node.v - 0.5F) > 0.5F) {
      continue;
    }
    ++lit;
    const PatternPosition position =
        pattern_position(master, static_cast<double>(node.u) * size_px, static_cast<double>(node.v) * size_px);
    const Vector3<double> way = *point - setup.viewer_m;
    const double elevation_deg = std::atan2(way.y, std::hypot(way.x, way.z)) / one_degree;
    const double azimuth_deg = std::atan2(way.x, -way.z) / one_degree - setup.rotation_deg;
    const double round = std::cos(elevation_deg * one_degree);
    worst = std::max({worst, std::abs(position.elevation_deg - elevation_deg),
                      round * std::abs(std::remainder(position.azimuth_deg - azimuth_deg, 360.0))});
  }
  EXPECT_GT(lit, 50);
  return worst;
}

//! Compares the directions of a show's domemaster with the directions in which the viewer sees the
//! same points on the dome, except for a rotation of the whole sky about the dome's axis. Returns
//! the maximum difference [deg].
double worst_show_error_deg(const DomeSetup& setup, double view_tilt_deg) {
  constexpr int size_px = 1024;
  Show show;
  show.view.tilt_deg = view_tilt_deg;
  fit_to_setup(show, setup);
  const Projection master = make_projection(show.view, size_px, 0.0);
  const auto leaned = [](const Vector3<double>& n, double deg) {
    const double c = std::cos(deg * one_degree);
    const double s = std::sin(deg * one_degree);
    return Vector3<double>{n.x, c * n.y + s * n.z, c * n.z - s * n.y};
  };
  const double c = std::cos(setup.rotation_deg * one_degree);
  const double s = std::sin(setup.rotation_deg * one_degree);
  const ProjectorOptics optics(setup, setup.projectors[0]);
  double worst = 0.0;
  int lit = 0;
  const WarpMesh warp = projector_pictures(setup)[0].warp;
  for (const WarpNode& node : warp.nodes) {
    const auto point = optics.dome_point({static_cast<double>(node.x), static_cast<double>(node.y)});
    if (!node.valid || !point || std::hypot(node.u - 0.5F, node.v - 0.5F) > 0.5F) {
      continue;
    }
    ++lit;
    const Vector3<double> way = *point - setup.viewer_m;
    const Vector3<double> own = leaned((1.0 / std::sqrt(dot(way, way))) * way, -setup.tilt_deg);
    const Vector3<double> seen = leaned({c * own.x + s * own.z, own.y, c * own.z - s * own.x}, view_tilt_deg);
    const Vector3<double> shown = direction_from_pixel<double>(master, static_cast<double>(node.u) * size_px,
                                                               static_cast<double>(node.v) * size_px);
    const Vector3<double> off = seen - (1.0 / std::sqrt(dot(shown, shown))) * shown;
    worst = std::max(worst, std::sqrt(dot(off, off)) / one_degree);
  }
  EXPECT_GT(lit, 50);
  return worst;
}

TEST(MasterOfASetup, ShowsTheSkyAsTheViewerSeesItWhereThePictureIsTurnedAndTheDomeLeans) {
  for (const double rotation_deg : {0.0, 40.0, -70.0}) {
    DomeSetup setup = leaning_dome(27.0, rotation_deg);
    setup.viewer_m = {2.0, -1.0, 1.5};
    EXPECT_LT(worst_show_error_deg(setup, 27.0), 1e-3) << rotation_deg;
    EXPECT_LT(worst_show_error_deg(setup, 0.0), 1e-3) << rotation_deg;
  }
}

TEST(MasterOfASetup, FollowsTheTiltThatTheSetupStates) {
  DomeSetup setup = leaning_dome(27.0, 0.0);
  const auto tilt_deg = [&](bool known, bool artistic) {
    setup.tilt_known = known;
    Show show;
    show.view.tilt_deg = 10.0;
    show.view.artistic_tilt = artistic;
    fit_to_setup(show, setup);
    return show.view.tilt_deg;
  };
  EXPECT_EQ(tilt_deg(true, false), 27.0);
  EXPECT_EQ(tilt_deg(false, false), 10.0);
  EXPECT_EQ(tilt_deg(true, true), 10.0);
}

TEST(UprightMaster, IsLevelInADomeThatLeans) { EXPECT_LT(worst_pattern_error_deg(leaning_dome(27.0, 0.0)), 1e-3); }

TEST(UprightMaster, IsLevelWhereThePictureIsTurned) {
  EXPECT_LT(worst_pattern_error_deg(leaning_dome(0.0, 40.0)), 1e-3);
}

TEST(UprightMaster, IsLevelInADomeThatLeansWhereThePictureIsTurned) {
  EXPECT_LT(worst_pattern_error_deg(leaning_dome(27.0, 40.0)), 1e-3);
}

TEST(UprightMaster, IsLevelForAViewerBesideTheMiddle) {
  DomeSetup setup = leaning_dome(27.0, -70.0);
  setup.viewer_m = {2.0, -1.0, 1.5};
  EXPECT_LT(worst_pattern_error_deg(setup), 1e-3);
}

TEST(UprightMaster, HasLinesAsWideTurnedAsNot) {
  const Projection projection = make_dome_projection(512, pi, 0.4);
  const PatternView turned(projection, 0.5 * pi);
  // A rotation by a quarter turn moves (400, 256), on the right of the master, to (256, 400), at
  // the bottom.
  const DomeSteps steps = dome_steps(turned, pattern_position(turned, 256.0, 400.0));
  const DomeSteps expected = dome_steps(projection, pattern_position(projection, 400.0, 256.0));
  EXPECT_NEAR(steps.elevation_deg, expected.elevation_deg, 1e-9);
  EXPECT_NEAR(steps.azimuth_deg, expected.azimuth_deg, 1e-9);
}

}  // namespace
}  // namespace ergodome
