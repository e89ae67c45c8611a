#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/make_projection.h"
#include "render/passes/stars/star_pass.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

Show show_of_stars(const std::string& faintest_mag) {
  return parse_show("[hole]\nspin = 0.5\n[[camera.key]]\nr = 8\n[sky]\nstars = \"bright_stars\"\nfaintest_mag = " +
                        faintest_mag + "\n[effects]\nmagnification = true\nredshift = true\n",
                    "stars.toml");
}

//! Returns a camera that first faces the hole from a position, then is rotated to its right by
//! `turn_deg`.
EyeCamera turned(double turn_deg, double phi = 0.3) {
  EyeCamera eye = test::eye_at_position({0.5, 8.0, 1.3, phi, ObserverMotion::zamo});
  const double sine = std::sin(one_degree * turn_deg);
  const double cosine = std::cos(one_degree * turn_deg);
  const double columns[3][3] = {{sine, 0, cosine}, {0, -1, 0}, {cosine, 0, -sine}};
  std::copy(&columns[0][0], &columns[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

Projection window(int width_px) { return make_pinhole_projection(width_px, width_px, 70.0 * one_degree); }

//! Returns how often work with the given name is done while an action runs.
template <class Work>
long runs_of(const std::string& name, Work&& work) {
  const auto before = work_done();
  work();
  const auto done = work_between(before, work_done());
  const auto found = done.find(name);
  return found != done.end() ? found->second.runs : 0;
}

constexpr const char* search = "search_patches";
constexpr const char* grid = "trace_nodes";

class CachedStars : public testing::Test {
 protected:
  std::vector<StarPoint> find(const EyeCamera& eye, int width_px = 400, PixelMatch match = PixelMatch::about) {
    return pass_.find(eye, window(width_px), {}, match);
  }

  StarPass pass_{show_of_stars("6")};
};

void expect_same_points(std::vector<StarPoint> points, std::vector<StarPoint> exact) {
  const auto position = [](const StarPoint& point) { return std::tuple(point.y_px, point.x_px, point.light.y); };
  std::ranges::sort(points, {}, position);
  std::ranges::sort(exact, {}, position);
  ASSERT_EQ(points.size(), exact.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].x_px, exact[i].x_px, 0.01);
    EXPECT_NEAR(points[i].y_px, exact[i].y_px, 0.01);
    EXPECT_NEAR(points[i].light.y, exact[i].light.y, 1e-3F * exact[i].light.y);
  }
}

TEST_F(CachedStars, AreThoseOfANewSearchWhereverACameraTurns) {
  for (double turn_deg = 0.0; turn_deg < 200.0; turn_deg += test::sanitized ? 60.0 : 12.0) {
    StarPass fresh(show_of_stars("6"));
    const EyeCamera eye = turned(turn_deg);
    const std::vector<StarPoint> exact = fresh.find(eye, window(400), {});
    EXPECT_GT(exact.size(), 50U);
    expect_same_points(find(eye), exact);
  }
}

TEST_F(CachedStars, AreNotSoughtAgainForACameraThatStands) {
  find(turned(0.0));
  EXPECT_EQ(runs_of(search, [&] { find(turned(0.0)); }), 0);
}

TEST_F(CachedStars, AreSoughtOnceForACameraThatTurnsALittle) {
  find(turned(0.0));
  EXPECT_EQ(runs_of(search,
                    [&] {
                      for (int turn_deg = 1; turn_deg < 12; ++turn_deg) {
                        find(turned(turn_deg));
                      }
                    }),
            1);
}

TEST_F(CachedStars, AreSoughtAnewWhereACameraGoesRound) {
  find(turned(0.0, 0.3));
  EXPECT_EQ(runs_of(search, [&] { find(turned(0.0, 0.301)); }), 1);
}

TEST_F(CachedStars, AreSoughtAnewWhereACameraMovesOtherwise) {
  EyeCamera eye = turned(0.0);
  find(eye);
  eye.motion = ObserverMotion::geodesic;
  const std::vector<StarPoint> moving = find(eye);
  expect_same_points(moving, StarPass(show_of_stars("6")).find(eye, window(400), {}));
}

TEST_F(CachedStars, OfBothEyesAreKept) {
  EyeCamera right = turned(0.0);
  right.r = 8.1;
  find(turned(0.0));
  find(right);
  EXPECT_EQ(runs_of(search,
                    [&] {
                      find(turned(0.0));
                      find(right);
                    }),
            0);
}

TEST_F(CachedStars, AreSoughtAnewWhereFainterOnesAreAskedFor) {
  const std::size_t bright = find(turned(0.0)).size();
  pass_.set_numbers(show_of_stars("6.5"));
  EXPECT_GT(find(turned(0.0)).size(), bright);
}

TEST_F(CachedStars, HaveNoNewGridWhereAPictureIsALittleNarrower) {
  find(turned(0.0), 400);
  EXPECT_EQ(runs_of(grid,
                    [&] {
                      for (const int width_px : {399, 380, 300, 210, 390}) {
                        find(turned(0.0, 0.01 * width_px), width_px);
                      }
                    }),
            0);
}

TEST_F(CachedStars, OfNarrowerPicturesAreAsExact) {
  find(turned(0.0), 400);
  expect_same_points(find(turned(0.0), 220), StarPass(show_of_stars("6")).find(turned(0.0), window(220), {}));
}

TEST_F(CachedStars, HaveANewGridForEachSizeWhereAPictureMustNotHangOnOthers) {
  find(turned(0.0), 400);
  EXPECT_GT(runs_of(grid, [&] { find(turned(0.0), 399, PixelMatch::exact); }), 0);
}

TEST_F(CachedStars, HaveANewGridWhereAPictureIsWider) {
  find(turned(0.0), 400);
  EXPECT_GT(runs_of(grid, [&] { find(turned(0.0), 420); }), 0);
}

TEST_F(CachedStars, HaveANewGridWhereAPictureIsMuchNarrower) {
  find(turned(0.0), 400);
  EXPECT_GT(runs_of(grid, [&] { find(turned(0.0), 190); }), 0);
}

TEST(ViewCones, HoldThemselves) {
  const ViewCone cone = view_cone(turned(40.0), window(100), 0.05);
  EXPECT_TRUE(holds(cone, cone));
}

TEST(ViewCones, HoldThoseThatAreTurnedByWhatTheyAreWider) {
  const ViewCone wide = widened(view_cone(turned(0.0), window(100), 0.05), 10.0 * one_degree);
  EXPECT_TRUE(holds(wide, view_cone(turned(9.9), window(100), 0.05)));
  EXPECT_FALSE(holds(wide, view_cone(turned(10.1), window(100), 0.05)));
}

TEST(ViewCones, OfTheWholeSkyHoldAll) {
  EXPECT_TRUE(holds({}, view_cone(turned(170.0), window(100), 0.05)));
  EXPECT_FALSE(holds(view_cone(turned(170.0), window(100), 0.05), {}));
}

}  // namespace
}  // namespace ergodome
