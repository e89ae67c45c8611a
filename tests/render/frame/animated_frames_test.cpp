#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "kernels/launch/work_counter.h"
#include "render/bake/trajectory_baker.h"
#include "render/frame/show_renderer.h"
#include "tests/support/errors.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

//! Returns a show with stars and effects, for small pictures.
Show starry_show() {
  Show show = parse_show(
      "duration_s = 2\n[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nr = 9\n[sky]\nmap = \"grid\"\nstars = "
      "\"bright_stars\"\nfaintest_mag = 3\n[effects]\nmagnification = true\npsf = {}\n"
      "diffraction = { size_px = 33 }\nbloom = { radius_px = 4 }\n[view]\nsize_px = 48\n[tone]\nauto = {}\n[stereo]\n"
      "baseline = 0.1\nconvergence = 8\n",
      "show.toml");
  show.sky.map = test::tiny_sky();
  return show;
}

//! Returns the starry show, in which the number at `path` changes from one value to another between
//! 0 and 1 s.
Show animated_show(const std::string& path, double from, double to) {
  Show show = starry_show();
  show.timeline.animations = {{path, {{0.0, from, Ease::linear}, {1.0, to}}}};
  return show;
}

Picture picture_at(ShowRenderer& renderer, double time_s) { return renderer.render(time_s, {}).front().picture; }

//! Returns the picture of a show whose timeline is removed.
Picture still_picture(Show show) {
  show.timeline = {};
  ShowRenderer renderer(show, Backend::cpu);
  return picture_at(renderer, 0.0);
}

void expect_same(const Picture& picture, const Picture& expected) {
  EXPECT_EQ(picture.tone.gain, expected.tone.gain);
  EXPECT_EQ(picture.tone.white, expected.tone.white);
  EXPECT_EQ(picture.rgba, expected.rgba);
}

struct Change {
  const char* path;
  double from;
  double to;
};

class EachAnimatedNumber : public testing::TestWithParam<Change> {};

TEST_P(EachAnimatedNumber, GivesThePictureOfAShowThatStandsStillThere) {
  const Change& change = GetParam();
  Show show = animated_show(change.path, change.from, change.to);
  if (std::string_view(change.path).starts_with("stereo.")) {
    show.stereo.layout = StereoLayout::side_by_side;
  }
  show.tone.automatic->adapt_s = 0.0;  // makes exposure independent of previous pictures
  ShowRenderer renderer(show, Backend::cpu);
  // The times go forwards and then back, to check that no value of an earlier picture remains.
  for (const double time_s : {1.0, 0.0}) {
    SCOPED_TRACE(time_s);
    Show still = show;
    find_animatable(change.path)->put(still, change.from + time_s * (change.to - change.from));
    expect_same(picture_at(renderer, time_s), still_picture(still));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, EachAnimatedNumber,
    testing::Values(Change{"hole.spin", 0.0, 0.99}, Change{"sky.exposure", 0.0, 4.0},
                    Change{"sky.faintest_mag", 1.0, 5.0}, Change{"sky.spin_axis.ra_deg", 270.0, 300.0},
                    Change{"effects.psf.sigma_px", 0.3, 2.0}, Change{"effects.diffraction.strength", 0.0, 0.5},
                    Change{"effects.diffraction.scale", 0.5, 2.0}, Change{"effects.bloom.strength", 0.0, 0.5},
                    Change{"view.fov_deg", 180.0, 60.0}, Change{"view.tilt_deg", 0.0, 30.0},
                    Change{"stereo.baseline", 0.0, 0.5}, Change{"stereo.convergence", 4.0, 40.0},
                    Change{"tone.exposure_stops", -4.0, 1.0}, Change{"tone.auto.target", 0.05, 0.5}),
    [](const testing::TestParamInfo<Change>& each) {
      std::string name = each.param.path;
      std::erase_if(name, [](char c) { return c == '.' || c == '_'; });
      return name;
    });

TEST(AnimatedFrames, ReadNothingAnewWhereNothingIsAnimated) {
  ShowRenderer renderer(starry_show(), Backend::cpu);
  const auto before = work_done();
  for (const double time_s : {0.0, 0.7, 1.9}) {
    renderer.apply(time_s);
  }
  EXPECT_THAT(work_between(before, work_done()), testing::IsEmpty());
}

TEST(AnimatedFrames, ReadTheSkyAnewOnlyWhereItTurns) {
  ShowRenderer spun(animated_show("hole.spin", 0.0, 0.9), Backend::cpu);
  auto before = work_done();
  spun.apply(0.5);
  EXPECT_THAT(work_between(before, work_done()), testing::IsEmpty());
  ShowRenderer turned(animated_show("sky.spin_axis.dec_deg", 0.0, 0.9), Backend::cpu);
  before = work_done();
  turned.apply(0.5);
  const auto done = work_between(before, work_done());
  EXPECT_TRUE(done.contains("buffer: sky map"));
  EXPECT_TRUE(done.contains("load_stars"));
}

TEST(AnimatedFrames, ReadTheCatalogueOfATurningSkyNoMoreThanOnce) {
  ShowRenderer turned(animated_show("sky.spin_axis.dec_deg", 0.0, 0.9), Backend::cpu);
  turned.apply(0.3);
  const auto before = work_done();
  turned.apply(0.6);
  const auto done = work_between(before, work_done());
  EXPECT_TRUE(done.contains("buffer: sky map"));
  EXPECT_FALSE(done.contains("load_stars"));
}

TEST(AnotherShow, GivesThePictureOfARendererOfItsOwn) {
  const Show first = starry_show();
  std::vector<Show> others(5, first);
  others[0].sky.stars.clear();
  others[1].effects.diffraction.reset();
  others[2].effects.redshift = true;
  others[3].sky.filter = SkyFilter::point;
  others[4].stereo.layout = StereoLayout::side_by_side;
  others[4].tone.automatic.reset();
  ShowRenderer renderer(first, Backend::cpu);
  picture_at(renderer, 0.0);
  for (std::size_t i = 0; i < others.size(); ++i) {
    SCOPED_TRACE(i);
    others[i].tone.automatic.reset();
    renderer.set_show(others[i]);
    expect_same(picture_at(renderer, 0.0), still_picture(others[i]));
  }
  renderer.set_show(first);
  EXPECT_EQ(picture_at(renderer, 0.0).rgba, still_picture(first).rgba);
}

TEST(AnotherShow, KeepsTheTimeOfTheLast) {
  ShowRenderer renderer(starry_show(), Backend::cpu);
  renderer.apply(0.5);
  renderer.set_show(animated_show("hole.spin", 0.0, 0.5));
  EXPECT_EQ(renderer.show().spin, 0.25);
}

TEST(AnotherShow, ReadsTheSkyAnewOnlyWhereItIsAnother) {
  ShowRenderer renderer(starry_show(), Backend::cpu);
  Show other = starry_show();
  other.sky.exposure = 2.0;
  other.effects.bloom.reset();
  other.camera.keys[0].r = 8.0;
  const auto before = work_done();
  renderer.set_show(other);
  EXPECT_THAT(work_between(before, work_done()), testing::IsEmpty());
}

TEST(AnotherShow, ThatCannotBeReadLeavesTheOldOne) {
  ShowRenderer renderer(starry_show(), Backend::cpu);
  Show broken = starry_show();
  broken.title = {{"", "broken"}};
  broken.sky.map = "nothing.png";
  EXPECT_THROW(renderer.set_show(broken), Error);
  broken = starry_show();
  broken.title = {{"", "broken"}};
  broken.stereo.layout = StereoLayout::side_by_side;
  broken.stereo.convergence = 5.0;
  broken.view.projection = ViewProjection::equirect;
  EXPECT_THROW(renderer.set_show(broken), Error);
  EXPECT_NE(text_in(renderer.show().title, ""), "broken");
  EXPECT_EQ(picture_at(renderer, 0.0).rgba, still_picture(starry_show()).rgba);
}

TEST(AnimatedFrames, OfASpinThatChangesAreNotBaked) {
  EXPECT_THAT(test::error_of([] { provenance_of(animated_show("hole.spin", 0.0, 0.5), {}); }), HasSubstr("one spin"));
}

TEST(AnimatedFrames, WordsAndTonesDoNotCallForAnotherBake) {
  Show other = animated_show("tone.exposure_stops", 0.0, 1.0);
  other.timeline.captions.resize(1);
  EXPECT_EQ(provenance_of(other, {}), provenance_of(starry_show(), {}));
}

}  // namespace
}  // namespace ergodome
