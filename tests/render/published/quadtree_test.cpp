#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "render/published/quadtree_builder.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

//! Returns the camera of the standard setup of Verbraeck & Eisemann: a circular orbit at r = 5 and
//! a = 0.999.
CameraStation published_camera() {
  return make_camera_station(Spacetime{0.999}, 5.0, 0.5 * pi, 0.0, ObserverMotion::geodesic);
}

const QuadtreeLens& published_grid() {
  static const QuadtreeLens lens(published_camera(), true, {});
  return lens;
}

//! Traced rays for all vertices of the upper half of the finest regular grid.
struct FullGrid {
  static constexpr int level = 10;
  static constexpr int columns = 2 << level;
  static constexpr int rows = (1 << level) / 2;
  std::vector<double> n[3], sky[3], status;

  FullGrid() : status(static_cast<std::size_t>(columns) * (rows + 1)) {
    RayBatch<double> batch{};
    for (int k = 0; k < 3; ++k) {
      n[k].resize(status.size());
      sky[k].resize(status.size());
      batch.direction[k] = n[k].data();
      batch.sky[k] = sky[k].data();
    }
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const Vector3<double> v = quadtree_direction(level, row, column);
        n[0][index(row, column)] = v.x;
        n[1][index(row, column)] = v.y;
        n[2][index(row, column)] = v.z;
      }
    }
    batch.camera = published_camera();
    batch.settings = {1e-8, 100'000};
    batch.count = static_cast<int>(status.size());
    batch.status = status.data();
    launch(Backend::cpu, batch);
  }

  static std::size_t index(int row, int column) {
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  }
};

//! Returns the cumulative error by the measure of Verbraeck & Eisemann: the sum of squared
//! differences in (θ, φ) over both halves of the sky, without the vertices of the grid itself.
double cumulative_squared_error(const QuadtreeLens& lens, QuadtreeInterpolation how) {
  static const FullGrid full;
  const QuadtreeGrid grid = lens.view();
  double sum = 0.0;
  for (int row = 0; row <= FullGrid::rows; ++row) {
    for (int column = 0; column < FullGrid::columns; ++column) {
      const std::size_t i = FullGrid::index(row, column);
      SkyAngles vertex{};
      if (full.status[i] != 0.0 || find_vertex(grid, row, column, vertex)) {
        continue;
      }
      const SkyAngles read = read_quadtree(grid, how, static_cast<float>(row), static_cast<float>(column));
      if (!in_shadow(read)) {
        const double theta = static_cast<double>(read.theta) - std::acos(full.sky[2][i]);
        const double phi =
            std::remainder(static_cast<double>(read.phi) - std::atan2(full.sky[1][i], full.sky[0][i]), 2.0 * pi);
        sum += theta * theta + phi * phi;
      }
    }
  }
  return 2.0 * sum;
}

TEST(Quadtree, TracesThePublishedNumberOfRays) {
  // Verbraeck & Eisemann, section 5.1, report 47,848 rays for a symmetric grid of level 10.
  EXPECT_NEAR(published_grid().vertex_count(), 47'848, 5);
}

TEST(Quadtree, HasThePublishedErrorsOfBothInterpolations) {
  if (test::sanitized) {
    GTEST_SKIP() << "a million rays";
  }
  // Verbraeck & Eisemann, section 4.3.2, report 0.369 rad² for linear and 0.008 rad² for spline
  // interpolation, over a full grid of level 10.
  QuadtreeSettings settings;
  settings.repair = false;
  const QuadtreeLens lens(published_camera(), true, settings);
  EXPECT_NEAR(cumulative_squared_error(lens, QuadtreeInterpolation::linear), 0.369, 0.01);
  EXPECT_NEAR(cumulative_squared_error(lens, QuadtreeInterpolation::spline), 0.008, 0.0006);
}

TEST(Quadtree, MirroredGridIsTheWholeOne) {
  const QuadtreeLens whole(published_camera(), false, {});
  const QuadtreeGrid a = published_grid().view();
  const QuadtreeGrid b = whole.view();
  for (int i = 0; i < 2000; ++i) {
    const float row = static_cast<float>(std::fmod(37.31 * i, 1023.0));
    const float column = static_cast<float>(std::fmod(911.7 * i, 2047.0));
    const SkyAngles p = read_quadtree(a, QuadtreeInterpolation::linear, row, column);
    const SkyAngles q = read_quadtree(b, QuadtreeInterpolation::linear, row, column);
    ASSERT_EQ(in_shadow(p), in_shadow(q));
    EXPECT_NEAR(p.theta, q.theta, 2e-3F);
  }
}

TEST(Quadtree, RepairClosesTheGapsBetweenCellsOfDifferentSize) {
  // The spline has different values on both sides of a large cell's side if smaller cells are next
  // to it. The repair must make this jump smaller.
  QuadtreeSettings settings;
  settings.repair = false;
  const QuadtreeLens torn(published_camera(), true, settings);
  const auto jump = [](const QuadtreeLens& lens) {
    const QuadtreeGrid grid = lens.view();
    double sum = 0.0;
    int count = 0;
    for (int row = 16; row < 512; row += 16) {
      for (int column = 3; column < 2048; column += 7) {
        const auto r = static_cast<float>(row);
        const auto c = static_cast<float>(column);
        if (find_quadtree_leaf(grid, r - 0.01F, c).width == find_quadtree_leaf(grid, r + 0.01F, c).width) {
          continue;
        }
        const SkyAngles above = read_quadtree(grid, QuadtreeInterpolation::spline, r - 1e-3F, c);
        const SkyAngles below = read_quadtree(grid, QuadtreeInterpolation::spline, r, c);
        if (!in_shadow(above) && !in_shadow(below)) {
          sum += std::pow(static_cast<double>(above.theta) - static_cast<double>(below.theta), 2);
          ++count;
        }
      }
    }
    return count > 0 ? sum / count : 0.0;
  };
  EXPECT_LT(jump(published_grid()), jump(torn));
}

TEST(Quadtree, EveryDirectionHasALeafAndAFiniteSky) {
  const QuadtreeGrid grid = published_grid().view();
  for (const Vector3<double>& n :
       {Vector3<double>{0.0, -1.0, 0.0}, Vector3<double>{0.0, 1.0, 0.0}, Vector3<double>{0.0, 0.0, 1.0},
        Vector3<double>{-1e-12, 0.0, 1.0}, Vector3<double>{1.0, 0.0, 0.0}, Vector3<double>{0.0, 0.0, -1.0}}) {
    float row = 0.0F;
    float column = 0.0F;
    quadtree_position(grid.level, n, row, column);
    const SkyAngles sky = read_quadtree(grid, QuadtreeInterpolation::spline, row, column);
    EXPECT_FALSE(in_shadow(sky));
    EXPECT_TRUE(std::isfinite(sky.theta) && std::isfinite(sky.phi));
  }
}

//! Returns the error of a blend of the grids at r = 5.0 and 5.2, for a camera at 5.1, by the
//! measure of Verbraeck & Eisemann (section 5.2): the mean squared error in (θ, φ) over the
//! camera's sky. If `warped`, the shadows are aligned before the grids are blended.
double blending_error(bool warped) {
  const auto camera = [](double r) {
    return make_camera_station(Spacetime{0.999}, r, 0.5 * pi, 0.0, ObserverMotion::geodesic);
  };
  const QuadtreeLens near(camera(5.0), true, {});
  const QuadtreeLens far(camera(5.2), true, {});
  const QuadtreeLens middle(camera(5.1), true, {});
  const QuadtreeShadowTable near_shadow(camera(5.0), 10);
  const QuadtreeShadowTable far_shadow(camera(warped ? 5.2 : 5.0), 10);
  const QuadtreeLookUp blend = {
      {near.view(), far.view()}, {near_shadow.view(), far_shadow.view()}, 0.5F, QuadtreeInterpolation::spline};
  double sum = 0.0;
  int count = 0;
  constexpr int step = 3;
  for (int row = 2; row < 1024; row += step) {
    for (int column = 1; column < 2048; column += step) {
      const SkyAngles read = read_quadtree(blend, static_cast<float>(row), static_cast<float>(column));
      const SkyAngles exact = read_quadtree(middle.view(), QuadtreeInterpolation::spline, static_cast<float>(row),
                                            static_cast<float>(column));
      if (!in_shadow(read) && !in_shadow(exact)) {
        sum += std::pow(static_cast<double>(read.theta) - static_cast<double>(exact.theta), 2) +
               std::pow(std::remainder(static_cast<double>(read.phi) - static_cast<double>(exact.phi), 2.0 * pi), 2);
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(QuadtreeBlend, HasThePublishedErrorBetweenTwoGrids) {
  if (test::sanitized) {
    GTEST_SKIP() << "few places miss by much: a mean takes many";
  }
  const double error = blending_error(true);
  EXPECT_GT(error, 0.0045 / 2.5);
  EXPECT_LT(error, 0.0045 * 2.5);
}

TEST(QuadtreeBlend, WarpOfTheShadowsIsWorthItsWhile) {
  if (test::sanitized) {
    GTEST_SKIP() << "takes six grids";
  }
  EXPECT_LT(blending_error(true), 0.7 * blending_error(false));
}

TEST(QuadtreeBlend, AGridBlendedWithItselfIsThatGrid) {
  const QuadtreeShadowTable shadow(published_camera(), 10);
  const QuadtreeGrid grid = published_grid().view();
  const QuadtreeLookUp blend = {{grid, grid}, {shadow.view(), shadow.view()}, 0.5F, QuadtreeInterpolation::spline};
  for (int i = 0; i < 2000; ++i) {
    const float row = static_cast<float>(std::fmod(37.31 * i, 1023.0));
    const float column = static_cast<float>(std::fmod(911.7 * i, 2047.0));
    const SkyAngles alone = read_quadtree(grid, QuadtreeInterpolation::spline, row, column);
    const SkyAngles both = read_quadtree(blend, row, column);
    if (!in_shadow(alone) && !in_shadow(both)) {
      EXPECT_NEAR(alone.theta, both.theta, 5e-3F) << row << ' ' << column;
    }
  }
}

}  // namespace
}  // namespace ergodome
