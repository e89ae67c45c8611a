#include "render/passes/objects/object_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "content/mesh/built_in_meshes.h"
#include "kernels/core/angles.h"
#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/sanitized.h"

// Compares polygons, which are drawn by means of connecting rays, with rays that are traced to the
// same triangles.
namespace ergodome {
namespace {

using test::eye_looking;

constexpr double r_observer = 40.0;
constexpr int size_px = test::sanitized ? 96 : 240;

class ObjectRaysAndPolygons : public test::ObjectScenes {
 protected:
  //! Returns, for each pixel, whether the ray through its middle meets an object.
  static std::vector<bool> seen_by_rays(const Show& show, const EyeCamera& eye, const Projection& projection) {
    const ObjectRays rays(show, 0.0);
    const CameraStation camera = make_camera_station(Spacetime{0.0}, eye.r, eye.theta, eye.phi, eye.motion);
    std::vector<bool> seen;
    for (int y = 0; y < size_px; ++y) {
      for (int x = 0; x < size_px; ++x) {
        const Vector3<double> v = direction_from_pixel(projection, x + 0.5, y + 0.5);
        const auto part = [&](int i) {
          return eye.frame_from_view[i][0] * v.x + eye.frame_from_view[i][1] * v.y + eye.frame_from_view[i][2] * v.z;
        };
        const auto hit = rays.first_hit(camera, {part(0), part(1), part(2)}, 1e-9);
        EXPECT_TRUE(hit.has_value());
        seen.push_back(hit && hit->mesh >= 0);
      }
    }
    return seen;
  }

  //! Returns the light of a pixel's brightest channel, because faces have different colors.
  static float light_at(const test::DrawnObjects& drawn, int x, int y) {
    return std::max({drawn.at(x, y, 0), drawn.at(x, y, 1), drawn.at(x, y, 2)});
  }

  static bool at(const std::vector<bool>& seen, int x, int y) {
    return seen[static_cast<std::size_t>(y) * size_px + static_cast<std::size_t>(x)];
  }

  //! Returns whether a pixel and all of its neighbors agree about whether they see an object.
  static bool is_inner(const std::vector<bool>& seen, int x, int y) {
    for (int row = std::max(0, y - 1); row <= std::min(size_px - 1, y + 1); ++row) {
      for (int column = std::max(0, x - 1); column <= std::min(size_px - 1, x + 1); ++column) {
        if (at(seen, column, row) != at(seen, x, y)) {
          return false;
        }
      }
    }
    return true;
  }

  //! Expects that polygons and rays have the same outlines: pixels may differ only next to an
  //! outline.
  static void expect_same_outlines(const ObjectSettings& object) {
    const EyeCamera eye = eye_looking(r_observer, {-1.0, 0.0, 0.0});
    const Projection projection = make_pinhole_projection(size_px, size_px, 25.0 * one_degree);
    const Show show = show_of({object});
    const test::DrawnObjects drawn = draw(show, eye, projection);
    const std::vector<bool> seen = seen_by_rays(show, eye, projection);
    float brightest = 0.0F;
    drawn.each([&](double x, double y, double /*red*/) {
      brightest = std::max(brightest, light_at(drawn, static_cast<int>(x), static_cast<int>(y)));
    });
    int inner = 0;
    for (int y = 0; y < size_px; ++y) {
      for (int x = 0; x < size_px; ++x) {
        const bool hit = at(seen, x, y);
        if (is_inner(seen, x, y)) {
          EXPECT_EQ(light_at(drawn, x, y) > 0.5F * brightest, hit) << x << ", " << y;
          inner += hit ? 1 : 0;
        }
      }
    }
    EXPECT_GT(inner, size_px / 4);
  }
};

TEST_F(ObjectRaysAndPolygons, ShowASphereInTheSamePixelsRoundTheHole) {
  for (const double phi_deg : {20.0, 75.0, 130.0, 165.0}) {
    SCOPED_TRACE(phi_deg);
    ObjectSettings sphere;
    sphere.form = ObjectForm::sphere;
    sphere.position = {6.0 * std::cos(phi_deg * one_degree), 6.0 * std::sin(phi_deg * one_degree), 0.3};
    sphere.tessellation.maximum = 16.0;
    expect_same_outlines(sphere);
  }
}

TEST_F(ObjectRaysAndPolygons, ShowATriangleWhoseSidesAreBentInTheSamePixels) {
  ObjectSettings triangle;
  triangle.form = ObjectForm::triangle;
  triangle.triangle.corners = {{{-5.0, 1.0, -0.5}, {-5.0, 5.0, -0.5}, {-5.0, 1.0, 4.5}}};
  expect_same_outlines(triangle);
}

TEST_F(ObjectRaysAndPolygons, ShowADiskWithAThicknessInTheSamePixels) {
  ObjectSettings disk;
  disk.form = ObjectForm::disk;
  disk.disk.segments = 24;
  disk.disk.rings = 4;
  disk.turn = {0.0, 20.0 * one_degree, 0.0};
  disk.size = 0.4;
  disk.tessellation.maximum = 16.0;
  expect_same_outlines(disk);
}

TEST(ObjectRays, MeetAnObjectWhereItIsByTheShowsTime) {
  Show show;
  show.name = "scene";
  ObjectSettings sphere;
  sphere.form = ObjectForm::sphere;
  sphere.size = 0.5;
  sphere.orbit = ObjectOrbit{};
  show.objects = {sphere};
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 30.0, 0.5 * pi, 0.0, ObserverMotion::fixed);
  const auto now = ObjectRays(show, 0.0).first_hit(camera, {-1.0, 0.0, 0.0});
  ASSERT_TRUE(now && now->mesh == 0);
  EXPECT_NEAR(now->point.x, 10.5, 0.02);
  // After half a period, the object is behind the hole, and this ray falls into the hole.
  const double half = pi * std::sqrt(1000.0) / sphere.orbit->speed;
  const auto later = ObjectRays(show, half).first_hit(camera, {-1.0, 0.0, 0.0});
  ASSERT_TRUE(later.has_value());
  EXPECT_EQ(later->mesh, -1);
}

TEST(ObjectRays, NameTheTriangleOfTheMesh) {
  Show show;
  show.name = "scene";
  ObjectSettings sphere;
  sphere.form = ObjectForm::sphere;
  sphere.position = {10.0, 0.0, 0.0};
  show.objects = {sphere};
  const ObjectRays rays(show, 0.0);
  const auto hit =
      rays.first_hit(make_camera_station(Spacetime{0.0}, 30.0, 0.5 * pi, 0.0, ObserverMotion::fixed), {-1.0, 0.0, 0.0});
  ASSERT_TRUE(hit && hit->mesh == 0);
  const TriangleMesh mesh = make_sphere({});
  const std::size_t first = 3 * static_cast<std::size_t>(rays.triangle(*hit));
  const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.indices[first + i]].position; };
  const double weights[3] = {1.0 - hit->weight_1 - hit->weight_2, hit->weight_1, hit->weight_2};
  double x = 10.0;
  for (std::size_t i = 0; i < 3; ++i) {
    x += weights[i] * static_cast<double>(corner(i)[0]);
  }
  EXPECT_NEAR(x, hit->point.x, 1e-9);
}

}  // namespace
}  // namespace ergodome
