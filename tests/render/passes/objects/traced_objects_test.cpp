#include "render/passes/objects/traced_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "render/passes/objects/object_rays.h"
#include "tests/render/eye_at.h"
#include "tests/render/passes/objects/traced_scene.h"
#include "tests/support/sanitized.h"

// Tests of objects drawn by rays: occlusion and brightness. traced_coverage_test.cpp tests in which
// pixels they are visible.
namespace ergodome {
namespace {

using test::ball;
using test::draw;
using test::Drawn;
using test::eye_at;
using test::observed;
using test::screen;
using test::show_of;
using test::station;
using test::traced_size_px;

TEST(TracedObjects, AreTheSameInBlocksOfRowsAsInOne) {
  const Show show = show_of(0.9, {ball({-4.0, 3.0, 1.0}, 1.2)});
  const EyeCamera eye = eye_at(0.9, 25.0, 1.2);
  const Drawn whole = draw(show, eye, screen(0.7));
  const Drawn blocks = draw(show, eye, screen(0.7), 12);
  int unlike = 0;
  for (std::size_t i = 0; i < whole.rgba.size(); ++i) {
    unlike += whole.rgba[i] == blocks.rgba[i] ? 0 : 1;
  }
  // If the picture is drawn in blocks, its tiles start at other positions, and some pixels are
  // sampled by four rays instead of sixteen.
  EXPECT_LE(unlike, test::sanitized ? 16 : 8);
}

//! Tests of a ball and a shell in front of the camera. seen() returns a color channel of the middle
//! pixel.
class BallBehindShell : public testing::Test {
 protected:
  static float seen(double ball_r, double shell_r, double opacity, int channel) {
    Show show = show_of(0.9, {ball({ball_r, 0.0, 0.0}, 0.5, {0.0, 1.0, 0.0})});
    ShellSettings shell;
    shell.radius = shell_r;
    shell.line_opacity = 0.0;
    shell.fill_opacity = opacity;
    shell.fill_color = {1.0, 0.0, 0.0};
    show.shells = {shell};
    return draw(show, eye_at(0.9, 25.0), screen(0.2)).at(traced_size_px / 2, traced_size_px / 2, channel);
  }
};

TEST_F(BallBehindShell, IsHiddenByOneThatIsOpaque) {
  EXPECT_NEAR(seen(8.0, 12.0, 1.0, 1), 0.0F, 1e-6F);
  EXPECT_NEAR(seen(8.0, 12.0, 1.0, 0), 1.0F, 1e-3F);
}

TEST_F(BallBehindShell, IsDimmedByOneThatIsNot) {
  EXPECT_NEAR(seen(8.0, 12.0, 0.25, 1), 0.75F, 1e-3F);
  EXPECT_NEAR(seen(8.0, 12.0, 0.25, 0), 0.25F, 1e-3F);
}

TEST_F(BallBehindShell, HidesOneThatIsNearerToTheHole) {
  EXPECT_NEAR(seen(12.0, 8.0, 1.0, 1), 1.0F, 1e-3F);
  EXPECT_NEAR(seen(12.0, 8.0, 1.0, 0), 0.0F, 1e-3F);
}

TEST(TracedObjects, AboveADiskHideItAndBelowItAreHidden) {
  for (const double height : {2.0, -2.0}) {
    Show show = show_of(0.9, {ball({10.0, 0.0, height}, 0.8, {0.0, 8.0, 0.0})});
    show.disk.emplace();
    show.disk->outer = 20.0;
    const EyeCamera eye = eye_at(0.9, 40.0, 0.6);
    const Drawn with = draw(show, eye, screen(0.9));
    show.objects.front().position = {200.0, 0.0, 0.0};
    const Drawn without = draw(show, eye, screen(0.9));
    int changed = 0;
    for (int y = 0; y < traced_size_px; ++y) {
      for (int x = 0; x < traced_size_px; ++x) {
        changed += std::abs(with.at(x, y, 1) - without.at(x, y, 1)) > 0.5F ? 1 : 0;
      }
    }
    if (height > 0.0) {
      EXPECT_GT(changed, 10);
    } else {
      EXPECT_EQ(changed, 0);
    }
  }
}

TEST(TracedObjects, AtRestShineWithTheFourthPowerOfTheirShift) {
  Show show = show_of(0.0, {ball({7.0, 0.0, 0.0}, 0.5)});
  show.effects.redshift = true;
  const Drawn drawn = draw(show, eye_at(0.0, 30.0, 0.5 * pi, ObserverMotion::fixed), screen(0.05));
  const double g = static_frequency_ratio(7.5, 30.0);
  EXPECT_NEAR(drawn.at(traced_size_px / 2, traced_size_px / 2, 0), std::pow(g, 4), 2e-3);
}

TEST(TracedObjects, ThatComeTowardsTheCameraAreBrighterThanThoseThatGo) {
  Show show = show_of(0.0, {ball({}, 0.5)});
  show.effects.redshift = true;
  ObjectOrbit orbit;
  orbit.r = 8.0;
  // Returns the light of the ball's first image at its position by the closed form. Sets `cosine`
  // from the direction in which this light leaves the ball.
  const auto seen = [&](double phi, double& cosine) {
    orbit.phi = phi;
    show.objects.front().orbit = orbit;
    const EyeCamera eye = eye_at(0.0, 40.0, 0.5 * pi, ObserverMotion::fixed);
    const Drawn drawn = draw(show, eye, screen(0.6));
    const ApparentPosition position = apparent_position({40.0, 0.0, 0.0}, {0.0, 8.0 * std::sin(phi), 0.0}, 1);
    cosine = dot(position.emission_direction, Vector3<double>{-std::sin(phi), 0.0, 0.0});
    double x = 0.0;
    double y = 0.0;
    const Vector3<double>& d = position.direction;
    EXPECT_TRUE(pixel_from_direction(drawn.projection, Vector3<double>{d.y, d.z, d.x}, x, y));
    return static_cast<double>(drawn.at(static_cast<int>(x), static_cast<int>(y), 0));
  };
  double to = 0.0;
  double fro = 0.0;
  const double ratio = seen(-0.5 * pi, to) / seen(0.5 * pi, fro);
  // Speed of the circular orbit as measured by an observer at rest there: √(1/8) / √(1 - 2/8).
  const double beta = std::sqrt(1.0 / 8.0) / std::sqrt(0.75);
  const double expected = std::pow((1.0 - beta * fro) / (1.0 - beta * to), 4);
  EXPECT_GT(expected, 5.0);
  EXPECT_NEAR(ratio, expected, 0.03 * expected);
}

TEST(TracedObjects, OfALampAreLitAsTheClosedFormHasIt) {
  Show show = show_of(0.0, {ball({10.0, 0.0, 0.0}, 1.0)});
  show.objects.front().lit = true;
  show.objects.front().sphere = {256, 128};
  show.light.emplace();
  show.light->position = {40.0, 20.0, 5.0};
  show.light->strength = 1500.0;
  show.light->falloff = LampFalloff::published;
  const Drawn drawn = draw(show, eye_at(0.0, 30.0, 0.5 * pi, ObserverMotion::fixed), screen(0.2));
  const ObjectRays rays(show, 0.0);
  const EyeCamera eye = eye_at(0.0, 30.0, 0.5 * pi, ObserverMotion::fixed);
  constexpr int middle_px = traced_size_px / 2;
  int compared = 0;
  for (int i = -12; i <= 12; i += 4) {
    const int x = middle_px + i;
    const auto hit = rays.first_hit(station(eye), observed(eye, drawn.projection, x + 0.5, middle_px + 0.5));
    if (!hit || hit->mesh < 0) {
      continue;
    }
    const Vector3<double> normal = hit->point - show.objects.front().position;
    double expected = 0.0;
    for (const int order : {1, 2}) {
      expected += illuminance(show.light->position, hit->point, (1.0 / std::sqrt(dot(normal, normal))) * normal, order,
                              show.light->strength);
    }
    EXPECT_NEAR(drawn.at(x, middle_px, 0), expected, 0.03 * expected + 2e-3) << i;
    ++compared;
  }
  EXPECT_GT(compared, 4);
}

TEST(TracedObjects, CastShadowsOnOneAnother) {
  Show show = show_of(0.5, {ball({12.0, 0.0, 0.0}, 2.0), ball({18.0, 6.0, 0.0}, 0.5)});
  for (ObjectSettings& object : show.objects) {
    object.lit = true;
  }
  show.light.emplace();
  show.light->position = {24.0, 12.0, 0.0};
  show.light->strength = 300.0;
  const EyeCamera eye = eye_at(0.5, 40.0);
  const Drawn shadowed = draw(show, eye, screen(0.25));
  show.objects[1].position = {0.0, 300.0, 0.0};
  const Drawn free = draw(show, eye, screen(0.25));
  int darkened = 0;
  for (int y = 0; y < traced_size_px; ++y) {
    for (int x = 0; x < traced_size_px; ++x) {
      // Compares only pixels that objects cover completely in both pictures.
      const bool same_position = shadowed.covered(x, y) == 1.0F && free.covered(x, y) == 1.0F;
      darkened += same_position && shadowed.at(x, y, 0) < 0.05F * free.at(x, y, 0) ? 1 : 0;
      EXPECT_LE(shadowed.at(x, y, 0), 1.2F * free.at(x, y, 0) + 2.0F * (free.covered(x, y) < 1.0F));
    }
  }
  EXPECT_GT(darkened, traced_size_px / 4);
}

TEST(TracedObjects, ThatAreRetardedAreSeenWhereTheyWere) {
  Show show = show_of(0.0, {ball({}, 0.5)});
  ObjectOrbit orbit;
  orbit.r = 20.0;
  orbit.phi = -0.4;
  orbit.speed = 10.0;
  show.objects.front().orbit = orbit;
  const EyeCamera eye = eye_at(0.0, 40.0, 0.5 * pi, ObserverMotion::fixed);
  const auto middle = [&](double time_s) {
    const Drawn drawn = draw(show, eye, screen(1.0), 1 << 20, time_s);
    double sum = 0.0;
    double x_sum = 0.0;
    for (int y = 0; y < traced_size_px; ++y) {
      for (int x = 0; x < traced_size_px; ++x) {
        sum += static_cast<double>(drawn.covered(x, y));
        x_sum += (x + 0.5) * static_cast<double>(drawn.covered(x, y));
      }
    }
    return x_sum / sum;
  };
  show.objects.front().retarded = true;
  const double late = middle(4.0);
  show.objects.front().retarded = false;
  // The light of the image travels for about 22 M, which is 2.2 s of the show.
  const double now = middle(4.0);
  const double before = middle(4.0 - 2.2);
  EXPECT_GT(std::abs(now - before), 4.0);
  EXPECT_NEAR(late, before, 0.1 * std::abs(now - before));
}

}  // namespace
}  // namespace ergodome
