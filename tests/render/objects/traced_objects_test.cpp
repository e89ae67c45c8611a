#include "render/objects/traced_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "kernels/schwarzschild/apparent_place.h"
#include "render/near_field/near_field.h"
#include "render/objects/object_rays.h"
#include "tests/render/eye_at.h"
#include "tests/support/sanitized.h"

// Objects drawn by rays: where they are seen, what hides them, and how bright they are.
namespace ergodome {
namespace {

using test::eye_at;

constexpr int traced_size_px = test::sanitized ? 64 : 128;
constexpr double tolerance_px = 0.05;

ObjectSettings ball(const Vector3<double>& position, double size, const Vector3<double>& color = {1.0, 1.0, 1.0}) {
  ObjectSettings object;
  object.form = ObjectForm::sphere;
  object.method = ObjectMethod::trace;
  object.position = position;
  object.size = size;
  object.color = color;
  return object;
}

Show show_of(double spin, std::vector<ObjectSettings> objects) {
  Show show;
  show.name = "scene";
  show.spin = spin;
  show.objects = std::move(objects);
  return show;
}

struct Drawn {
  Projection projection;
  std::vector<float> rgba;

  [[nodiscard]] float at(int x, int y, int part) const {
    return rgba[4 * static_cast<std::size_t>(y * projection.width_px + x) + static_cast<std::size_t>(part)];
  }
  [[nodiscard]] float covered(int x, int y) const { return at(x, y, 3); }
};

//! Over black, in blocks of so many rows.
Drawn draw(const Show& show, const EyeCamera& eye, const Projection& projection, int rows = 1 << 20,
           double time_s = 0.0) {
  Drawn drawn{projection,
              std::vector<float>(4UL * static_cast<std::size_t>(projection.width_px * projection.height_px))};
  TracedObjects objects(show, Backend::cpu);
  const ShellPass shells(show, Backend::cpu);
  const std::unique_ptr<DiskPass> disk = show.disk ? std::make_unique<DiskPass>(show, Backend::cpu) : nullptr;
  for (int row = 0; row < projection.height_px; row += rows) {
    draw_near_field(Backend::cpu, {disk.get(), show.shells.empty() ? nullptr : &shells, &objects},
                    {eye, nullptr, projection, tolerance_px, time_s}, {row, std::min(rows, projection.height_px - row)},
                    drawn.rgba.data() + 4L * row * projection.width_px);
  }
  return drawn;
}

Projection screen(double field_of_view) {
  return make_pinhole_projection(traced_size_px, traced_size_px, field_of_view);
}

Vector3<double> observed(const EyeCamera& eye, const Projection& projection, double x, double y) {
  const Vector3<double> v = direction_from_pixel(projection, x, y);
  const auto part = [&](int i) {
    return eye.frame_from_view[i][0] * v.x + eye.frame_from_view[i][1] * v.y + eye.frame_from_view[i][2] * v.z;
  };
  return {part(0), part(1), part(2)};
}

CameraStation station(const EyeCamera& eye) {
  return make_camera_station(eye.spin, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
}

//! Holds every pixel to exact rays through sixteen places of it.
void expect_exact_coverage(const Show& show, const EyeCamera& eye, const Projection& projection) {
  const Drawn drawn = draw(show, eye, projection);
  const ObjectRays rays(show, 0.0);
  const CameraStation camera = station(eye);
  int seen = 0;
  int unlike = 0;
  for (int y = 0; y < projection.height_px; ++y) {
    for (int x = 0; x < projection.width_px; ++x) {
      int hits = 0;
      for (int i = 0; i < 16; ++i) {
        const int row = i / 4;
        const double along = x + (i % 4 + 0.5) / 4.0;
        const double down = y + (row + 0.5) / 4.0;
        const auto hit = rays.look(camera, observed(eye, projection, along, down), 1e-10);
        hits += hit && hit->mesh >= 0 ? 1 : 0;
      }
      seen += hits > 0 ? 1 : 0;
      const double off = std::abs(static_cast<double>(drawn.covered(x, y)) - hits / 16.0);
      // Of sixteen places one may lie on an outline; of what is thinner than half a pixel four may see nothing.
      EXPECT_LT(off, hits > 0 && hits < 16 ? 0.45 : 0.07) << x << ", " << y;
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

// Of tiles that are marked: the rays that tell look for triangles as the pixels' own do.
TEST(TracedObjects, AreMissedInNoPixelThatSeesThemAllOver) {
  struct Scene {
    double spin;
    double r;
    double field_of_view;
    ObjectSettings object;
  };
  constexpr int dense_px = test::sanitized ? 80 : 240;
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
      const auto hit = rays.look(station(eye), observed(eye, projection, x, y), 1e-9);
      return hit && hit->mesh >= 0;
    };
    int seen = 0;
    int missed = 0;
    for (int y = 0; y < dense_px; ++y) {
      for (int x = 0; x < dense_px; ++x) {
        // The middle, and the middles of the quarters: images finer than a quarter may lie between samples.
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

TEST(TracedObjects, AreTheSameInBlocksOfRowsAsInOne) {
  const Show show = show_of(0.9, {ball({-4.0, 3.0, 1.0}, 1.2)});
  const EyeCamera eye = eye_at(0.9, 25.0, 1.2);
  const Drawn whole = draw(show, eye, screen(0.7));
  const Drawn blocks = draw(show, eye, screen(0.7), 12);
  int unlike = 0;
  for (std::size_t i = 0; i < whole.rgba.size(); ++i) {
    unlike += whole.rgba[i] == blocks.rgba[i] ? 0 : 1;
  }
  // Tiles begin elsewhere, and with them where four rays are taken for enough.
  EXPECT_LE(unlike, test::sanitized ? 16 : 8);
}

//! The middle pixel of a picture of a ball before the camera, with something else about.
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
  // Where the ball's middle is seen first, and how light leaves it there, in closed form.
  const auto seen = [&](double phi, double& cosine) {
    orbit.phi = phi;
    show.objects.front().orbit = orbit;
    const EyeCamera eye = eye_at(0.0, 40.0, 0.5 * pi, ObserverMotion::fixed);
    const Drawn drawn = draw(show, eye, screen(0.6));
    const ApparentPlace place = apparent_place({40.0, 0.0, 0.0}, {0.0, 8.0 * std::sin(phi), 0.0}, 1);
    cosine = dot(place.emission_direction, Vector3<double>{-std::sin(phi), 0.0, 0.0});
    double x = 0.0;
    double y = 0.0;
    const Vector3<double>& d = place.direction;
    EXPECT_TRUE(pixel_from_direction(drawn.projection, Vector3<double>{d.y, d.z, d.x}, x, y));
    return static_cast<double>(drawn.at(static_cast<int>(x), static_cast<int>(y), 0));
  };
  double to = 0.0;
  double fro = 0.0;
  const double ratio = seen(-0.5 * pi, to) / seen(0.5 * pi, fro);
  // An orbit's speed at rest there: √(1/8) / √(1 - 2/8).
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
  const Drawn drawn = draw(show, eye_at(0.0, 30.0, 0.5 * pi, ObserverMotion::fixed), screen(0.2));
  const ObjectRays rays(show, 0.0);
  const EyeCamera eye = eye_at(0.0, 30.0, 0.5 * pi, ObserverMotion::fixed);
  constexpr int middle_px = traced_size_px / 2;
  int compared = 0;
  for (int i = -12; i <= 12; i += 4) {
    const int x = middle_px + i;
    const auto hit = rays.look(station(eye), observed(eye, drawn.projection, x + 0.5, middle_px + 0.5));
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
      // Where the small ball itself is not.
      const bool same_place = shadowed.covered(x, y) == 1.0F && free.covered(x, y) == 1.0F;
      darkened += same_place && shadowed.at(x, y, 0) < 0.05F * free.at(x, y, 0) ? 1 : 0;
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
  // Light from there takes some 22 M: 2.2 s of the show.
  const double now = middle(4.0);
  const double before = middle(4.0 - 2.2);
  EXPECT_GT(std::abs(now - before), 4.0);
  EXPECT_NEAR(late, before, 0.1 * std::abs(now - before));
}

}  // namespace
}  // namespace ergodome
