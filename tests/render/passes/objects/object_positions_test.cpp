#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "kernels/spacetime/kerr/frame_boost.h"
#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/sanitized.h"

// Hook of LeakSanitizer: disables its reports if a test loaded an OpenGL driver (gl_driver.h).
// NOLINTNEXTLINE: LeakSanitizer prescribes the name
extern "C" int __lsan_is_turned_off() { return ergodome::test::driver_was_loaded ? 1 : 0; }

// Tests that objects appear at the positions of the closed form.
namespace ergodome {
namespace {

using test::closed_form_direction;
using test::eye_looking;
using test::reference_pixel;
using test::small_sphere;

constexpr double positions_r_observer = 40.0;
const Vector3<double> to_hole = {-1.0, 0.0, 0.0};

class ObjectPositions : public test::ObjectScenes {
 protected:
  //! Distance of the image of a small sphere from its position by the closed form [rad]. The view
  //! is narrow, and this position is in its middle. offset() returns nothing if no image is drawn.
  struct Offset {
    //! Distance in the direction away from the hole.
    double away;
    //! Distance along a circle around the hole.
    double beside;
  };
  static std::optional<Offset> offset(const Vector3<double>& position, int order, double size, double field_of_view,
                                      int images = 2) {
    constexpr int width = 128;
    ObjectSettings object = test::small_sphere(position, size);
    object.images = images;
    ObjectPass pass(show_of({object}));
    const EyeCamera eye =
        eye_looking(positions_r_observer, closed_form_direction(positions_r_observer, position, order));
    const auto drawn = draw(pass, eye, make_pinhole_projection(width, width, field_of_view));
    if (!(drawn.light() > 4.0)) {
      return std::nullopt;
    }
    double x = 0.0;
    double y = 0.0;
    drawn.middle(x, y);
    const double scale = field_of_view / width;
    const double right = scale * (x - 0.5 * width);
    const double up = scale * (0.5 * width - y);
    const Vector3<double> hole = in_view(eye, to_hole);
    const double size_of_hole = std::hypot(hole.x, hole.y);
    return Offset{-(right * hole.x + up * hole.y) / size_of_hole, (right * hole.y - up * hole.x) / size_of_hole};
  }

  static double miss(const Vector3<double>& position, int order, double size, double field_of_view) {
    const std::optional<Offset> found = offset(position, order, size, field_of_view);
    return found ? std::hypot(found->away, found->beside) : 1.0;
  }

  //! Returns the minimum and maximum angle between the middle of the hole and anything that is
  //! drawn.
  static std::pair<double, double> extent(const test::DrawnObjects& drawn, const Projection& projection) {
    std::pair<double, double> range{10.0, 0.0};
    drawn.each([&](double x, double y, double value) {
      if (value > 0.0) {
        const double angle = std::acos(-direction_from_pixel(projection, x, y).z);
        range = {std::min(range.first, angle), std::max(range.second, angle)};
      }
    });
    return range;
  }
};

TEST_F(ObjectPositions, FirstImagesAreWithinATwentiethOfAPixelOfTheClosedForm) {
  for (const Vector3<double>& position : {Vector3<double>{-5.0, 3.0, -0.5},
                                          {-5.0, 0.7, -0.5},
                                          {5.0, 1.0, 2.0},
                                          {0.0, -2.6, 0.3},
                                          {-9.0, 12.0, 4.0},
                                          {-30.0, -2.0, 3.0},
                                          {10.0, 0.0, -0.5},
                                          {45.0, 3.0, 4.0}}) {
    EXPECT_LT(miss(position, 1, 0.02, 0.8 * one_degree), 0.05 * reference_pixel)
        << position.x << " " << position.y << " " << position.z;
  }
}

TEST_F(ObjectPositions, SecondImagesAreOnTheOtherSideAndWithinATwentiethOfAPixelOfTheClosedForm) {
  for (const Vector3<double>& position :
       {Vector3<double>{-5.0, 3.0, -0.5}, {-6.0, 1.5, -1.0}, {5.0, 3.0, 2.0}, {-30.0, -2.0, 3.0}}) {
    EXPECT_LT(miss(position, 2, 0.03, 0.1 * one_degree), 0.05 * reference_pixel)
        << position.x << " " << position.y << " " << position.z;
    const Vector3<double> first = closed_form_direction(positions_r_observer, position, 1);
    const Vector3<double> second = closed_form_direction(positions_r_observer, position, 2);
    EXPECT_LT(first.y * second.y + first.z * second.z, 0.0);
  }
}

TEST_F(ObjectPositions, FurtherImagesThatAreAskedForAreAsFarFromTheHoleAsTheClosedFormHasThem) {
  // The third and fourth images are streaks along a ring, and longer than the view. Triangles are
  // chords of the ring, which does not matter for such small spheres.
  for (const Vector3<double>& position : {Vector3<double>{-5.0, 3.0, -0.5}, {-6.0, 1.5, -1.0}, {5.0, 3.0, 2.0}}) {
    const auto third = offset(position, 3, 0.05, 0.01 * one_degree, 3);
    const auto fourth = offset(position, 4, 0.05, 0.001 * one_degree, 4);
    ASSERT_TRUE(third && fourth) << position.x << " " << position.y << " " << position.z;
    EXPECT_NEAR(third->away, 0.0, 0.002 * reference_pixel) << position.x << " " << position.y << " " << position.z;
    EXPECT_NEAR(fourth->away, 0.0, 0.002 * reference_pixel) << position.x << " " << position.y << " " << position.z;
  }
}

TEST_F(ObjectPositions, ImagesThatAreNotAskedForAreNotDrawn) {
  EXPECT_FALSE(offset({-5.0, 3.0, -0.5}, 2, 0.03, 0.1 * one_degree, 1));
  EXPECT_FALSE(offset({-5.0, 3.0, -0.5}, 3, 0.1, 0.02 * one_degree, 2));
}

TEST_F(ObjectPositions, AMovingObserverSeesThemWhereAberrationPutsThem) {
  const Vector3<double> position{-5.0, 3.0, -0.5};
  const Vector3<double> velocity{-0.3, 0.2, 0.4};
  const FrameBoost boost = frame_boost(velocity);
  double energy = 0.0;
  const Vector3<double> seen = aberrated(FrameBoost{boost.axis, 1.0 / boost.stretch},
                                         closed_form_direction(positions_r_observer, position, 1), energy);
  // Aberration shifts a direction towards the direction of motion.
  EXPECT_GT(dot(seen, boost.axis), dot(closed_form_direction(positions_r_observer, position, 1), boost.axis));
  EyeCamera eye = eye_looking(positions_r_observer, seen);
  eye.motion = ObserverMotion::velocity;
  eye.velocity = velocity;
  constexpr double field_of_view = 0.8 * one_degree;
  const auto drawn =
      draw(show_of({small_sphere(position, 0.02)}), eye, make_pinhole_projection(128, 128, field_of_view));
  double x = 0.0;
  double y = 0.0;
  drawn.middle(x, y);
  EXPECT_GT(drawn.light(), 4.0);
  EXPECT_LT(std::hypot(x - 64.0, y - 64.0) * field_of_view / 128.0, 0.05 * reference_pixel);
}

TEST_F(ObjectPositions, ASphereExactlyBehindIsARingOfTheRightRadii) {
  constexpr double r = 10.0;
  constexpr double size = 0.5;
  const Projection projection = make_pinhole_projection(512, 512, 25.0 * one_degree);
  // The sphere is slightly off the line through observer and hole, so that no corner of a triangle
  // is exactly on that line. The image of a point on it is a ring, so its triangles would be left
  // out.
  ObjectSettings sphere = small_sphere({-r, 0.0, 1e-3}, size);
  sphere.tessellation.maximum = 64.0;
  const auto drawn = draw(show_of({sphere}), eye_looking(positions_r_observer, to_hole), projection);
  // The expected radii of the ring are those of the limb: light that grazes the ball on the inner
  // and on the outer side.
  double inner = 10.0;
  double outer = 0.0;
  for (int i = 0; i < 720; ++i) {
    const double at = i * 0.5 * one_degree;
    const double x = -r + size * std::cos(at);
    const double y = size * std::sin(at);
    const double phi = std::atan2(std::abs(y), x);
    for (const int order : {1, 2}) {
      const double angle =
          std::acos(-1.0) - connecting_ray(positions_r_observer, std::hypot(x, y), image_angle(phi, order)).xi;
      inner = std::min(inner, angle);
      outer = std::max(outer, angle);
    }
  }
  const auto [nearest, farthest] = extent(drawn, projection);
  constexpr double pixel = 25.0 * one_degree / 512.0;
  EXPECT_NEAR(nearest, inner, 1.5 * pixel);
  EXPECT_NEAR(farthest, outer, 1.5 * pixel);
  // The ring must not have a gap.
  const double middle = 0.5 * (inner + 0.2 * inner + 0.8 * outer);
  int covered = 0;
  for (int i = 0; i < 360; ++i) {
    double x = 0.0;
    double y = 0.0;
    const double sine = std::sin(middle);
    pixel_from_direction(projection,
                         {sine * std::cos(i * one_degree), sine * std::sin(i * one_degree), -std::cos(middle)}, x, y);
    covered += drawn.at(static_cast<int>(x), static_cast<int>(y)) > 0.9F ? 1 : 0;
  }
  EXPECT_GT(covered, 350);
}

TEST_F(ObjectPositions, NothingIsDrawnAcrossTheShadowWhileASphereCrossesTheAxis) {
  const Projection projection = make_pinhole_projection(128, 128, 25.0 * one_degree);
  const double shadow = std::asin(std::sqrt(27.0 * (1.0 - 2.0 / positions_r_observer)) / positions_r_observer);
  for (const double y : test::sanitized ? std::vector{-0.003, 0.3} : std::vector{-0.7, -0.003, 0.0, 0.3}) {
    for (const double x : {-6.0, 6.0}) {
      ObjectSettings sphere = small_sphere({x, y, 0.0}, 0.5);
      // Coarse and fine triangles are split in the same way. Drawing four times as many triangles
      // by the CPU takes four times as long, which is a minute under sanitizers.
      for (const double maximum : {1.0, test::sanitized ? 4.0 : 32.0}) {
        sphere.tessellation.maximum = maximum;
        const auto drawn = draw(show_of({sphere}), eye_looking(positions_r_observer, to_hole), projection);
        EXPECT_GT(drawn.light(), 10.0) << x << " " << y;
        // Triangles are chords of the ring and are therefore slightly closer to the hole, by less
        // than a tenth.
        const auto [nearest, farthest] = extent(drawn, projection);
        if (x < 0.0) {
          EXPECT_GT(nearest, 0.9 * shadow) << y << " " << maximum;
        }
        EXPECT_LT(farthest, 12.0 * one_degree) << y << " " << maximum;
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
