#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "render/passes/objects/object_rays.h"
#include "render/passes/objects/traced_objects.h"
#include "tests/render/eye_at.h"
#include "tests/render/passes/objects/traced_scene.h"
#include "tests/support/sanitized.h"

// Tests of objects drawn by rays: in which pixels they are visible, and what fraction of a pixel
// they cover.
namespace ergodome {
namespace {

using test::ball;
using test::draw;
using test::Drawn;
using test::eye_at;
using test::observed;
using test::show_of;
using test::station;

//! Returns the fraction of a pixel that shows an object, by exact rays through the centers of the
//! cells of a `side` x `side` grid. If `sheared`, the positions are shifted so that no two of them
//! are in a line parallel to a side of the pixel.
double exact_part(const ObjectRays& rays, const EyeCamera& eye, const Projection& projection, int x, int y, int side,
                  bool sheared) {
  const CameraStation camera = station(eye);
  int hits = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double along = column + (sheared ? (row + 0.5) / side : 0.5);
      const double down = row + (sheared ? (side - column - 0.5) / side : 0.5);
      const auto hit = rays.first_hit(camera, observed(eye, projection, x + along / side, y + down / side), 1e-10);
      hits += hit && hit->mesh >= 0 ? 1 : 0;
    }
  }
  return static_cast<double>(hits) / (side * side);
}

//! Compares the coverage of every pixel with exact rays, through the same 16 positions as the
//! program uses. Next to the edge of the shadow, the program samples in a different way; there, 64
//! rays are used.
void expect_exact_coverage(const Show& show, const EyeCamera& eye, const Projection& projection) {
  const Drawn drawn = draw(show, eye, projection);
  const ObjectRays rays(show, 0.0);
  int seen = 0;
  int unlike = 0;
  for (int y = 0; y < projection.height_px; ++y) {
    for (int x = 0; x < projection.width_px; ++x) {
      const auto covered = static_cast<double>(drawn.covered(x, y));
      const bool sliced = 16.0 * covered != std::round(16.0 * covered);
      const double part = exact_part(rays, eye, projection, x, y, sliced ? 8 : 4, sliced);
      seen += part > 0.0 ? 1 : 0;
      const double off = std::abs(covered - part);
      // In partially covered pixels, one of the 16 samples may be on an outline, and images thinner
      // than half a pixel may be missed by four.
      EXPECT_LT(off, part > 0.0 && part < 1.0 ? 0.45 : 0.07) << x << ", " << y;
      unlike += off > 0.07 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 40);
  EXPECT_LE(unlike, seen / 25);
}

constexpr int exact_px = test::sanitized ? 24 : 48;

TEST(TracedObjects, CoverTheVeryPartsOfPixelsThatExactRaysMeet) {
  for (const double spin : {0.0, 0.95, -1.0}) {
    SCOPED_TRACE(spin);
    const Show show = show_of(spin, {ball({-4.0, 3.0, 1.0}, 1.2), ball({3.0, -5.0, -2.0}, 1.5)});
    expect_exact_coverage(show, eye_at(spin, 25.0, 1.2), make_pinhole_projection(exact_px, exact_px, 0.75));
  }
}

TEST(TracedObjects, ExactlyBehindTheHoleAreARing) {
  const Show show = show_of(0.0, {ball({-12.0, 0.0, 0.0}, 0.6)});
  const EyeCamera eye = eye_at(0.0, 25.0, 0.5 * pi, ObserverMotion::fixed);
  expect_exact_coverage(show, eye, make_pinhole_projection(exact_px, exact_px, 0.9));
}

TEST(TracedObjects, OnTheAxisAndAcrossItAreSeenFromTheAxis) {
  const Show show = show_of(0.99, {ball({0.0, 0.0, 5.0}, 0.7), ball({0.0, 0.3, -6.0}, 1.0)});
  expect_exact_coverage(show, eye_at(0.99, 20.0, 0.0), make_pinhole_projection(exact_px, exact_px, 1.0));
}

TEST(TracedObjects, AboutTheCameraFillThePictureButForTheHole) {
  const Show show = show_of(0.5, {ball({0.0, 0.0, 0.0}, 14.0)});
  expect_exact_coverage(show, eye_at(0.5, 8.0, 1.0), make_pinhole_projection(exact_px, exact_px, 2.0));
}

// The program first marks the tiles of the picture that may show objects. The rays that mark them
// must find whatever the rays of pixels would find.
TEST(TracedObjects, AreMissedInNoPixelThatSeesThemAllOver) {
  struct Scene {
    double spin;
    double r;
    double field_of_view;
    ObjectSettings object;
  };
  constexpr int dense_px = test::sanitized ? 80 : 160;
  for (const Scene& at :
       {Scene{0.999, 60.0, 0.7, ball({22.0, -8.0, 1.0}, 2.2)}, Scene{0.999, 60.0, 0.3, ball({-22.0, 3.0, 1.0}, 0.8)},
        Scene{0.0, 25.0, 0.8, ball({-8.0, 1.0, 0.5}, 0.5)}, Scene{-1.0, 15.0, 1.2, ball({5.0, 6.0, -1.0}, 0.4)}}) {
    SCOPED_TRACE(testing::Message() << at.spin << " " << at.object.position.x);
    const Show show = show_of(at.spin, {at.object});
    const EyeCamera eye = eye_at(at.spin, at.r, 1.4);
    const Projection projection = make_pinhole_projection(dense_px, dense_px, at.field_of_view);
    const Drawn drawn = draw(show, eye, projection);
    const ObjectRays rays(show, 0.0);
    const auto sees = [&](double x, double y) {
      const auto hit = rays.first_hit(station(eye), observed(eye, projection, x, y), 1e-9);
      return hit && hit->mesh >= 0;
    };
    int seen = 0;
    int missed = 0;
    for (int y = 0; y < dense_px; ++y) {
      for (int x = 0; x < dense_px; ++x) {
        // Pixels count as showing the object all over if rays through their middle and through the
        // middles of their quarters meet it. Objects finer than a quarter of a pixel could be
        // between the samples.
        if (sees(x + 0.5, y + 0.5) && sees(x + 0.25, y + 0.25) && sees(x + 0.75, y + 0.25) &&
            sees(x + 0.25, y + 0.75) && sees(x + 0.75, y + 0.75)) {
          ++seen;
          missed += drawn.covered(x, y) > 0.0F ? 0 : 1;
        }
      }
    }
    EXPECT_GT(seen, test::sanitized ? 5 : 20);
    EXPECT_EQ(missed, 0);
  }
}

// A tile is marked by the ray in its middle. This ray may fall into the hole, while the rays of
// other pixels of the tile go around the hole to an object.
TEST(TracedObjects, LoseNoLightNextToTheShadowsEdge) {
  constexpr double r = 40.0;
  constexpr int size_px = test::sanitized ? 80 : 240;
  const Show show = show_of(0.0, {ball({14.0, 14.0, 2.0}, 9.0)});
  const EyeCamera eye = eye_at(0.0, r, 1.4, ObserverMotion::fixed);
  const Projection projection = make_pinhole_projection(size_px, size_px, 0.3);
  const Drawn drawn = draw(show, eye, projection);
  const ObjectRays rays(show, 0.0);
  const double edge_px = std::tan(std::asin(std::sqrt(27.0 * (1.0 - 2.0 / r)) / r)) / std::tan(0.15) * 0.5 * size_px;
  double expected = 0.0;
  double seen = 0.0;
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      if (std::abs(std::hypot(x + 0.5 - 0.5 * size_px, y + 0.5 - 0.5 * size_px) - edge_px) > 5.0) {
        continue;
      }
      for (int i = 0; i < 16; ++i) {
        const int row = i / 4;
        const Vector3<double> n = observed(eye, projection, x + (i % 4 + 0.5) / 4.0, y + (row + 0.5) / 4.0);
        const auto hit = rays.first_hit(station(eye), n, 1e-9);
        expected += hit && hit->mesh >= 0 ? 1.0 / 16.0 : 0.0;
      }
      seen += static_cast<double>(drawn.covered(x, y));
    }
  }
  EXPECT_GT(expected, test::sanitized ? 20.0 : 80.0);
  EXPECT_NEAR(seen, expected, 0.01 * expected);
}

}  // namespace
}  // namespace ergodome
