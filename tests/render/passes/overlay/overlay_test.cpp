#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/make_projection.h"
#include "render/eyes/view_projection.h"
#include "render/frame/show_renderer.h"
#include "render/passes/overlay/camera_readout.h"
#include "tests/render/passes/overlay/overlay_scene.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): overlays and how they are looked at

TEST_F(Overlays, StandOnTheScreenForBothEyesOrBehindIt) {
  const Projection head = make_pinhole_projection(400, 200, 60.0 * one_degree);
  const double px = 200.0 / std::tan(30.0 * one_degree);
  Timeline timeline;
  timeline.overlays = {image_at("white.png", 0.0, 0.0, 2.0)};
  OverlayPass pass = pass_of(timeline, folder_.string());
  const auto position = [&](double offset, double convergence, double distance) {
    Picture picture = even_picture(head, 0.0F);
    pass.draw({Backend::cpu, picture.rgba.data(), picture.tone, false},
              overlay_projection(head, offset, convergence, distance), 0.0);
    return middle_of(picture).x_px;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // The eye is displaced to the right. For this eye, an object beyond the screen distance appears
  // farther to the right on the screen, and a closer one farther to the left; at the screen
  // distance, it does not move.
  EXPECT_NEAR(position(0.1, 5.0, 0.0), 200.0, 0.05);
  EXPECT_NEAR(position(0.1, 5.0, 5.0), 200.0, 0.05);
  EXPECT_NEAR(position(0.1, 5.0, infinity), 200.0 + 0.1 / 5.0 * px, 0.05);
  EXPECT_NEAR(position(0.1, 5.0, 2.5), 200.0 - 0.1 / 5.0 * px, 0.05);
  EXPECT_NEAR(position(0.1, 0.0, infinity), 200.0, 0.05);
}

TEST_F(Overlays, BehindTheDomeAreWhereThePictureHasTheSky) {
  const Projection head = make_dome_projection(800, pi, 0.0);
  const Projection eye = converged_projection(head, 0.3, 6.0);
  const Projection behind = overlay_projection(head, 0.3, 6.0, std::numeric_limits<double>::infinity());
  for (const double x : {200.0, 410.0, 600.0}) {
    const Vector3<double> a = direction_from_pixel(eye, x, 350.0);
    const Vector3<double> b = direction_from_pixel(behind, x, 350.0);
    EXPECT_NEAR(dot(a, b), 1.0, 1e-12);
  }
}

TEST(CameraReadout, SaysSpinDistanceAndLatitude) {
  const LocalText text = readout_text(Spacetime{0.999}, 14.2, 80.0 * one_degree);
  EXPECT_EQ(text_in(text, "en"), "spin a/M 0.999, distance r 14.20 M, latitude 10.0°");
  EXPECT_EQ(text_in(text, "de-AT"), "Spin a/M 0.999, Abstand r 14.20 M, Breite 10.0°");
  EXPECT_EQ(text_in(text, "fr"), text_in(text, "en"));
  EXPECT_EQ(text_in(readout_text(Spacetime{-1.0}, 1.5e6, 0.5 * pi + 1e-9), "en"),
            "spin a/M -1, distance r 1.5e+06 M, latitude 0.0°");
}

TEST_F(Overlays, OfAShowWithAReadoutSayWhereItsCameraIs) {
  const std::string without = "[[camera.key]]\nr = 8\n[sky]\nmap = \"black\"\n[view]\nsize_px = 256\n";
  const std::string with = without + "[readout]\nletter_deg = 1.5\nelevation_deg = 30\n";
  ShowRenderer dark(parse_show(without, "dark.toml"), Backend::cpu);
  ShowRenderer read(parse_show(with, "read.toml"), Backend::cpu);
  EXPECT_EQ(sum_of_light(dark.render(0.0, {}).front().picture), 0.0);
  const Picture picture = read.render(0.0, {}).front().picture;
  // The line is 30 degrees above the front of a dome, which is at the bottom of the picture: a
  // third of the way from the rim to the middle. It is curved around the middle, so the center of
  // its light is slightly closer to the middle.
  const Spot middle = middle_of(picture);
  EXPECT_NEAR(middle.x_px, 128.0, 2.0);
  EXPECT_NEAR(middle.y_px, 128.0 + 128.0 * 60.0 / 90.0, 3.0);
  read.overlays().set_captions(false);
  EXPECT_EQ(sum_of_light(read.render(0.0, {}).front().picture), 0.0);
}

TEST_F(Overlays, AreSetInTheLanguageThatIsChosen) {
  Caption caption = caption_of("");
  caption.text = {{"en", "A"}, {"de", "Ein sehr viel längerer Text"}};
  OverlayPass pass = pass_of(captions_of({caption}));
  const Projection projection = make_dome_projection(300, pi, 0.0);
  const auto light = [&](const std::string& language) {
    pass.set_language(language);
    Picture picture = even_picture(projection, 0.0F);
    draw(pass, picture, projection);
    return sum_of_light(picture);
  };
  EXPECT_GT(light("de"), 5.0 * light("en"));
}

TEST_F(Overlays, HideTheShowsCaptionsAndNotItsImages) {
  Timeline timeline = captions_of({caption_of("Here")});
  OverlayPass words = pass_of(timeline);
  words.set_captions(false);
  EXPECT_FALSE(words.draws_at(0.0));
  timeline.overlays = {image_at("white.png", 0.0, 20.0, 5.0)};
  OverlayPass both = pass_of(timeline, folder_.string());
  both.set_captions(false);
  EXPECT_TRUE(both.draws_at(0.0));
}

TEST_F(Overlays, ApartFromThePictureAreTheSameCaptionsOnNothing) {
  Timeline timeline = captions_of({caption_of("Here", 0.0, 40.0), caption_of("There", 10.0, 20.0)});
  timeline.captions[1].presence = {0.0, 10.0, 4.0, 0.0};
  OverlayPass pass = pass_of(timeline);
  const Projection projection = make_dome_projection(400, pi, 0.0);
  Picture whole = even_picture(projection, 0.0F);
  for (std::size_t i = 3; i < whole.rgba.size(); i += 4) {
    whole.rgba[i] = 0.0F;
  }
  pass.draw({Backend::cpu, whole.rgba.data(), {}, true}, overlay_projection(projection), 2.0);
  pass.set_captions_apart(true);
  EXPECT_FALSE(pass.draws_at(2.0)) << "pictures have none now";
  const auto layer = pass.caption_layer(overlay_projection(projection), 2.0).layer;
  ASSERT_TRUE(layer);
  ASSERT_LT(layer->row_count, 300);
  std::vector<float> rows(whole.rgba.size());
  std::ranges::copy(layer->rgba, rows.begin() + 4L * layer->width * layer->first_row);
  EXPECT_EQ(rows, std::vector<float>(whole.rgba.begin(), whole.rgba.end()));
}

TEST_F(Overlays, ApartAreDrawnAnewOnlyWhereTheyChange) {
  Caption fading = caption_of("Here");
  fading.presence = {0.0, 10.0, 4.0, 0.0};
  OverlayPass pass = pass_of(captions_of({fading}));
  const Projection small = overlay_projection(make_dome_projection(200, pi, 0.0));
  const Projection large = overlay_projection(make_dome_projection(400, pi, 0.0));
  const LaidCaptions full = pass.caption_layer(small, 5.0);
  EXPECT_EQ(full.opacity, 1.0);
  const LaidCaptions half = pass.caption_layer(small, 2.0);
  EXPECT_EQ(half.layer, full.layer);
  // The opacity of a fade is 3 x² - 2 x³, with the fraction x of its time. In its middle, this is
  // one half.
  EXPECT_NEAR(half.opacity, 0.5, 1e-12);
  const auto larger = pass.caption_layer(large, 2.0).layer;
  EXPECT_EQ(larger->width, 400);
  EXPECT_EQ(pass.caption_layer(large, 11.0).layer, nullptr);
  EXPECT_EQ(pass.caption_layer(large, 2.0).layer->rgba, larger->rgba) << "nothing of other layers is left";
}

TEST_F(Overlays, OfOthersAreThereWithoutAShow) {
  OverlayPass pass = pass_of({});
  const Projection projection = make_dome_projection(300, pi, 0.0);
  EXPECT_FALSE(pass.draws_at(std::nullopt));
  Caption welcome = caption_of("Welcome");
  welcome.presence = {};
  pass.set_extra({welcome});
  ASSERT_TRUE(pass.draws_at(std::nullopt));
  Picture picture = even_picture(projection, 0.0F);
  pass.draw({Backend::cpu, picture.rgba.data(), picture.tone, false}, projection, std::nullopt);
  EXPECT_GT(sum_of_light(picture), 50.0);
  pass.set_extra({});
  EXPECT_FALSE(pass.draws_at(std::nullopt));
}

TEST_F(Overlays, ThatAreNotThereTakeNothing) {
  Timeline timeline = captions_of({caption_of("Later")});
  timeline.captions[0].presence = {5.0, 8.0, 0.5, 0.5};
  OverlayPass pass = pass_of(timeline);
  const Projection projection = make_dome_projection(300, pi, 0.0);
  Picture picture = even_picture(projection, 0.0F);
  const auto before = work_done();
  draw(pass, picture, projection, 4.0);
  EXPECT_TRUE(work_between(before, work_done()).empty());
}

TEST_F(Overlays, AreSetOnceAndTouchTheirOwnTilesAlone) {
  OverlayPass pass = pass_of(captions_of({caption_of("Once")}));
  const Projection projection = make_dome_projection(1024, pi, 0.0);
  Picture picture = even_picture(projection, 0.0F);
  draw(pass, picture, projection);
  const auto before = work_done();
  draw(pass, picture, projection);
  const auto work = work_between(before, work_done());
  ASSERT_EQ(work.size(), 1U);
  EXPECT_EQ(work.at("draw_overlay").runs, 1);
  EXPECT_LT(work.at("draw_overlay").elements, 1024L * 1024 / 20);
}

TEST_F(Overlays, ThatCannotBeReadAreErrors) {
  const auto problem = [&](const Overlay& overlay) {
    Timeline timeline;
    timeline.overlays = {overlay};
    try {
      const OverlayPass pass = pass_of(timeline, folder_.string());
    } catch (const Error& error) {
      EXPECT_FALSE(error.remedy().empty());
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(problem(image_at("missing.png", 0.0, 0.0, 10.0)), testing::HasSubstr("missing.png"));
  EXPECT_THAT(problem(image_at("white.png", 0.0, 0.0, 170.0)), testing::HasSubstr("170 degrees"));
  write_png(folder_ / "wide.png", std::vector<std::uint8_t>(3UL * 16 * 8, 255), 16, 8);
  Overlay wide = image_at("wide.png", 0.0, 0.0, 10.0);
  wide.fisheye = true;
  EXPECT_THAT(problem(wide), testing::HasSubstr("square"));
  write_png(folder_ / "long.png", std::vector<std::uint8_t>(3UL * 8200 * 2, 255), 8200, 2);
  EXPECT_THAT(problem(image_at("long.png", 0.0, 0.0, 10.0)), testing::HasSubstr("8192"));
}

TEST_F(Overlays, OfAShowTellTheLineOfAnImageThatCannotBe) {
  const Show show = parse_show(
      "[camera]\n[[camera.key]]\nr = 30\n"
      "[[overlay]]\nimage = \"white.png\"\nfrom_s = 0\nto_s = 9\n"
      "[[overlay]]\nimage = \"none.png\"\nfrom_s = 0\nto_s = 9\n",
      (folder_ / "film.toml").string());
  const auto reported = testing::HasSubstr("(overlay[1].image, film.toml:9)");
  EXPECT_THAT(error_of([&] { const OverlayPass pass(show); }), reported);
  EXPECT_THAT(error_of([&] { OverlayPass::image_bytes(show); }), reported);
}

}  // namespace
}  // namespace ergodome
