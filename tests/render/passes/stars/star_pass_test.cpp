#include "render/passes/stars/star_pass.h"

#include <gtest/gtest.h>

#include <string>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "render/frame/show_renderer.h"

namespace ergodome {
namespace {

//! Returns a show whose sky contains only stars.
Show star_show(const std::string& more) {
  return parse_show(R"(
duration_s = 10
[hole]
spin = 0.9
[camera]
[[camera.key]]
r = 12
theta_deg = 70
[[camera.key]]
t_s = 10
r = 12
theta_deg = 70
phi_deg = 60
[sky]
map = "black"
stars = "bright_stars"
faintest_mag = 6
[view]
size_px = 256
)" + more,
                    "stars.toml");
}

Picture rendered(const std::string& more) {
  ShowRenderer renderer(star_show(more), Backend::cpu);
  return renderer.render(5.0, {}).front().picture;
}

double light_of_stars(const Picture& picture) {
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    sum += static_cast<double>(picture.rgba[i + 1]);
  }
  return sum;
}

constexpr const char* plain_effects = "[effects]\nmagnification = true\n";

TEST(StarsOfAShow, AreAllTheLightOfABlackSky) {
  Show show = star_show(plain_effects);
  show.sky.stars.clear();
  ShowRenderer renderer(show, Backend::cpu);
  EXPECT_EQ(light_of_stars(renderer.render(5.0, {}).front().picture), 0.0);
}

TEST(StarsOfAShow, AddLightToItsSky) { EXPECT_GT(light_of_stars(rendered(plain_effects)), 1.0); }

TEST(StarsOfAShow, AreSoftByDefaultAndHardWhereTheShowAsks) {
  const auto lit = [](const Picture& picture) {
    long count = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      count += picture.rgba[i + 1] > 0.0F ? 1 : 0;
    }
    return count;
  };
  const auto picture = [&](const std::string& psf) {
    Show show = star_show(plain_effects + psf);
    show.sky.faintest_mag = 2.0;
    return ShowRenderer(show, Backend::cpu).render(5.0, {}).front().picture;
  };
  const Picture soft = picture("");
  // If sigma is 0, a star covers a single pixel, whatever the cut-off is. With the default sigma of
  // 0.85 px, it covers more than five by five pixels.
  const Picture hard = picture("psf = { sigma_px = 0, cutoff_px = 4 }\n");
  EXPECT_GT(lit(soft), 20 * lit(hard));
  EXPECT_NEAR(light_of_stars(soft), light_of_stars(hard), 0.05 * light_of_stars(hard));
}

TEST(StarsOfAShow, GatheredByPixelsShineAsMuch) {
  const double gathered = light_of_stars(rendered(std::string(plain_effects) + "[stars]\nmethod = \"gather\"\n"));
  EXPECT_NEAR(gathered / light_of_stars(rendered(plain_effects)), 1.0, 0.03);
}

TEST(StarsOfAShow, AreGatheredBesideAnExtremalHorizonWhereGridsHaveTheShadowWrong) {
  const auto picture = [](StarMethod method) {
    Show show = star_show(plain_effects);
    show.spin = 1.0;
    show.camera.keys = {show.camera.keys.front()};
    show.camera.keys[0].r = 1.001;
    show.camera.keys[0].theta = 0.5 * pi;
    show.view.projection = ViewProjection::equirect;
    show.sky.star_method = method;
    ShowRenderer renderer(show, Backend::cpu);
    return renderer.render(5.0, {}).front().picture;
  };
  const Picture sought = picture(StarMethod::inverse);
  EXPECT_GT(light_of_stars(sought), 0.0);
  EXPECT_EQ(sought.rgba, picture(StarMethod::gather).rgba);
}

TEST(StarsOfAShow, KeepTheirLightWithSpikes) {
  const double with =
      light_of_stars(rendered(std::string(plain_effects) + "diffraction = { brighter_than_mag = 3, size_px = 65 }\n"));
  EXPECT_NEAR(with / light_of_stars(rendered(plain_effects)), 1.0, 0.03);
}

TEST(StarsOfAShow, WithSpikesReachFarther) {
  const Picture without = rendered(plain_effects);
  const Picture with = rendered(std::string(plain_effects) + "diffraction = { brighter_than_mag = 3, size_px = 65 }\n");
  std::size_t brighter = 0;
  for (std::size_t i = 1; i < with.rgba.size(); i += 4) {
    brighter += with.rgba[i] > without.rgba[i] + 1e-4F ? 1U : 0U;
  }
  EXPECT_GT(brighter, 200U);
}

TEST(StarsOfAShow, LeaveTrailsAsBrightAsTheyAre) {
  const double with = light_of_stars(rendered(std::string(plain_effects) + "trails = { shutter_s = 0.2 }\n"));
  EXPECT_NEAR(with / light_of_stars(rendered(plain_effects)), 1.0, 0.03);
}

//! Returns the pictures of both eyes of a show with stars, in the stereo model `omni`.
std::vector<FrameImage> omni_eyes(const std::string& baseline, const std::string& more = plain_effects) {
  ShowRenderer renderer(
      star_show(more + "[stereo]\nlayout = \"separate\"\nmodel = \"omni\"\nbaseline = " + baseline + "\n"),
      Backend::cpu);
  return renderer.render(5.0, {});
}

TEST(StarsOfAShow, AreThoseOfOneEyeInTheModelOmniWithoutABaseline) {
  const Picture one = rendered(plain_effects);
  for (const FrameImage& eye : omni_eyes("0.0")) {
    ASSERT_EQ(eye.picture.rgba.size(), one.rgba.size());
    // Compares only the color channels. The sky map is black, so these contain only the light of
    // stars; the fourth channel is the coverage outside the shadow.
    std::size_t different = 0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i) {
      different += i % 4 < 3 && eye.picture.rgba[i] != one.rgba[i] ? 1U : 0U;
    }
    EXPECT_EQ(different, 0U);
  }
}

TEST(StarsOfAShow, ShineAsMuchInBothEyesOfTheModelOmni) {
  const double one = light_of_stars(rendered(plain_effects));
  const auto eyes = omni_eyes("0.4");
  ASSERT_EQ(eyes.size(), 2U);
  EXPECT_NE(eyes[0].picture.rgba, eyes[1].picture.rgba);
  for (const FrameImage& eye : eyes) {
    EXPECT_NEAR(light_of_stars(eye.picture) / one, 1.0, 0.05);
  }
}

TEST(StarsOfAShow, LeaveTrailsInTheModelOmni) {
  const auto still = omni_eyes("0.4");
  const auto trailed = omni_eyes("0.4", std::string(plain_effects) + "trails = { shutter_s = 0.2 }\n");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(light_of_stars(trailed[i].picture) / light_of_stars(still[i].picture), 1.0, 0.03);
  }
}

TEST(StarsOfAShow, GatheredByPixelsShineAsMuchInTheModelOmni) {
  const auto inverted = omni_eyes("0.4");
  const auto gathered = omni_eyes("0.4", std::string(plain_effects) + "[stars]\nmethod = \"gather\"\n");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(light_of_stars(gathered[i].picture) / light_of_stars(inverted[i].picture), 1.0, 0.03);
  }
}

TEST(BloomOfAShow, KeepsTheLightAndTheRim) {
  const Picture without = rendered(plain_effects);
  const Picture with = rendered(std::string(plain_effects) + "bloom = { strength = 0.3, radius_px = 5 }\n");
  // Light that bloom scatters beyond the rim of the dome is lost.
  EXPECT_NEAR(light_of_stars(with) / light_of_stars(without), 1.0, 0.05);
  EXPECT_EQ(with.rgba[0], 0.0F);
  EXPECT_NE(with.rgba, without.rgba);
}

TEST(ExposureOfAShow, BringsItsMiddleLightToTheTarget) {
  const Picture picture = rendered("[tone]\nauto = { target = 0.2, least_stops = -20.0, most_stops = 20.0 }\n");
  LightMeter meter;
  meter.add(picture);
  EXPECT_NEAR(static_cast<double>(picture.tone.gain) * meter.middle_light(), 0.2, 1e-3);
}

TEST(ExposureOfAShow, IsTheSameForBothEyes) {
  ShowRenderer renderer(star_show("[stereo]\nlayout = \"separate\"\nbaseline = 2.0\n[tone]\nauto = {}\n"),
                        Backend::cpu);
  const auto images = renderer.render(5.0, {});
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].picture.tone.gain, images[1].picture.tone.gain);
}

}  // namespace
}  // namespace ergodome
