#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "content/show/reading/show_reader.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

const std::string minimal = "[camera]\n[[camera.key]]\nr = 10\n";

std::string problem_of(const std::string& text) {
  return error_of([&] { parse_show(text, "show.toml"); });
}

TEST(Show, HasATitleInSeveralLanguages) {
  const Show show = parse_show("title = { en = \"The shadow\", de = \"Der Schatten\" }\n" + minimal, "a.toml");
  EXPECT_EQ(text_in(show.title, "de-AT"), "Der Schatten");
  EXPECT_EQ(text_in(show.title, "fr"), "The shadow");
  EXPECT_EQ(languages(show), (std::vector<std::string>{"de", "en"}));
  EXPECT_EQ(parse_show(to_toml(show), "a.toml").title, show.title);
  EXPECT_EQ(text_in(parse_show(minimal, "shows/evening.toml").title, ""), "evening");
  EXPECT_THAT(problem_of("title = { en = \"A\\nB\" }\n" + minimal), HasSubstr("title.en contains a line break"));
  EXPECT_THAT(problem_of("title = { e = \"A\" }\n" + minimal), HasSubstr("title.e is not a language tag"));
  EXPECT_THAT(problem_of("title = {}\n" + minimal), HasSubstr("title has no language"));
}

TEST(Show, OfTheDesignReadsBackAsItIsWritten) {
  const Show show = parse_show(R"(
title = "Once around"
duration_s = 30
[hole]
spin = 0.999
[camera]
observer = "geodesic"
[[camera.key]]
t_s = 0.0
r = 30.0
theta_deg = 80.0
phi_deg = 0.0
look = "hole"
[[camera.key]]
t_s = 30.0
r = 6.0
theta_deg = 90.0
phi_deg = 720.0
[sky]
map = "milky_way"
stars = "bright_stars"
spin_axis = { ra_deg = 270.0, dec_deg = 66.6 }
[effects]
redshift = true
magnification = true
psf = { sigma_px = 0.5, cutoff_px = 1.5 }
trails = { shutter_s = 0.02 }
[view]
projection = "dome"
fov_deg = 180.0
tilt_deg = 20.0
size_px = 4096
[stereo]
layout = "mono"
model = "physical"
baseline = 0.02
[quality]
budget_px = 0.25
)",
                               "shows/once.toml");
  EXPECT_EQ(show.title, (LocalText{{"", "Once around"}}));
  EXPECT_EQ(show.name, "once");
  EXPECT_EQ(show.folder, "shows");
  EXPECT_EQ(show.spin, 0.999);
  EXPECT_EQ(show.camera.motion, ObserverMotion::geodesic);
  ASSERT_EQ(show.camera.keys.size(), 2U);
  EXPECT_NEAR(show.camera.keys[1].phi, 4.0 * 3.14159265358979323846, 1e-12);
  EXPECT_EQ(show.sky.stars, "bright_stars");
  EXPECT_TRUE(show.effects.redshift);
  EXPECT_EQ(show.effects.psf.sigma_px, 0.5);
  EXPECT_EQ(show.effects.psf.cutoff_px, 1.5);
  EXPECT_EQ(show.view.size_px, 4096);
  EXPECT_EQ(show.stereo.baseline, 0.02);
  EXPECT_EQ(frame_count(show), 900);
  EXPECT_TRUE(missing_features(show).empty());
}

TEST(Show, SpreadsItsStarsOverTwoPixelsUnlessItSaysOtherwise) {
  // The full width at half maximum of a Gaussian is 2 √(2 ln 2) times its standard deviation.
  const double width = 2.0 * std::sqrt(2.0 * std::numbers::ln2);
  const std::string text = minimal;
  EXPECT_NEAR(width * parse_show(text, "show.toml").effects.psf.sigma_px, 2.0, 0.005);
  EXPECT_NEAR(width * parse_show(text + "[effects]\npsf = {}\n", "show.toml").effects.psf.sigma_px, 2.0, 0.005);
  const Show hard = parse_show(text + "[effects]\npsf = { sigma_px = 0 }\n", "show.toml");
  EXPECT_EQ(hard.effects.psf.sigma_px, 0.0);
  EXPECT_EQ(parse_show(to_toml(hard), "show.toml").effects.psf.sigma_px, 0.0);
}

TEST(Show, WrittenAsTextReadsBackTheSame) {
  Show show = parse_show(minimal, "show.toml");
  show.title = {{"", "A \"quoted\" title, ünïcode"}};
  show.duration_s = 12.5;
  show.spin = -0.7;
  show.camera.motion = ObserverMotion::velocity;
  show.camera.velocity = {0.1, -0.2, 0.3};
  show.camera.keys.push_back({4.0, 20.0, 1.0, 7.0, {LookTarget::Kind::direction, {0.0, 1.0, 0.5}}, 0.1, -0.2, 0.3});
  show.effects.trails = TrailSettings{0.1};
  show.stereo = {StereoLayout::half_top_bottom, StereoModel::omni, 0.5, 12.0, 40.0, 80.0, 0.7, true, true};
  show.tone = {ToneCurve::gamma, -1.5, 8.0, 1.8, AutoExposureSettings{0.2, -2.0, 3.0, 0.5}};
  show.sky.filter = SkyFilter::polygon;
  show.sky.shift = SkyShift::blackbody_fit;
  show.sky.brightening = true;
  const Show back = parse_show(to_toml(show), "show.toml");
  EXPECT_EQ(back.title, show.title);
  EXPECT_EQ(back.duration_s, show.duration_s);
  EXPECT_EQ(back.spin, show.spin);
  EXPECT_NEAR(back.camera.velocity.y, -0.2, 1e-15);
  ASSERT_EQ(back.camera.keys.size(), 2U);
  EXPECT_NEAR(back.camera.keys[1].theta, 1.0, 1e-15);
  EXPECT_NEAR(back.camera.keys[1].roll, 0.3, 1e-15);
  EXPECT_EQ(back.camera.keys[1].look.direction.z, 0.5);
  EXPECT_EQ(back.effects.trails->shutter_s, 0.1);
  EXPECT_EQ(back.tone.curve, ToneCurve::gamma);
  EXPECT_EQ(back.tone.exposure_stops, -1.5);
  EXPECT_EQ(back.tone.white, 8.0);
  EXPECT_EQ(back.tone.gamma, 1.8);
  EXPECT_EQ(back.tone.automatic->most_stops, 3.0);
  EXPECT_EQ(back.sky.filter, SkyFilter::polygon);
  EXPECT_EQ(back.sky.shift, SkyShift::blackbody_fit);
  EXPECT_TRUE(back.sky.brightening);
  EXPECT_EQ(back.effects.psf.sigma_px, show.effects.psf.sigma_px);
  EXPECT_EQ(back.stereo, show.stereo);
}

TEST(Show, EveryBuiltInShowReadsAndCanBeDrawn) {
  int shows = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ERGODOME_SOURCE_DIR "/content/shows")) {
    EXPECT_TRUE(missing_features(read_show(entry.path())).empty()) << entry.path();
    ++shows;
  }
  EXPECT_GE(shows, 4);
}

//! Returns the paths of all built-in shows and of all shows in the seed corpus of the fuzzers.
std::vector<std::filesystem::path> all_show_files() {
  std::vector<std::filesystem::path> files;
  for (const char* const folder : {"/content/shows", "/tests/fuzz/corpus/show", "/tests/fuzz/corpus/show_reload"}) {
    for (const auto& entry : std::filesystem::directory_iterator(ERGODOME_SOURCE_DIR + std::string(folder))) {
      files.push_back(entry.path());
    }
  }
  return files;
}

//! Returns the text of a show without its [camera] table, whose velocities and angles are rounded
//! each time they are read.
std::string without_camera(std::string text) {
  const std::size_t begin = text.find("\n[camera]\n");
  return text.erase(begin, text.find("\n[", begin + 1) - begin);
}

TEST(Show, IsWrittenTheSameAfterReadingWhatWasWritten) {
  int shows = 0;
  for (const std::filesystem::path& path : all_show_files()) {
    std::string text;
    if (error_of([&] { text = to_toml(read_show(path)); }).empty()) {
      const std::string again = to_toml(parse_show(text, path.string()));
      EXPECT_EQ(without_camera(again), without_camera(text)) << path;
      ++shows;
    }
  }
  EXPECT_GE(shows, 30);
}

TEST(Show, CountsTelevisionsFramesByTheirExactRate) {
  const Show show = parse_show("duration_s = 4000\nframe_rate_hz = 29.97\n[[camera.key]]\nr = 8\n", "a.toml");
  EXPECT_NEAR(frame_time_s(show, 30'000 * 3), 1001.0 * 3, 1e-9);
}

TEST(Show, UnknownKeyNamesTheNearestTheFileAndTheLine) {
  EXPECT_THAT(problem_of(minimal + "[veiw]\n"),
              AllOf(HasSubstr("show.toml:4"), HasSubstr("veiw"), HasSubstr("\"view\"")));
  EXPECT_THAT(problem_of(minimal + "[view]\nfov = 3\n"),
              AllOf(HasSubstr("show.toml:5"), HasSubstr("view.fov"), HasSubstr("fov_deg")));
  EXPECT_THAT(problem_of("[camera]\n[[camera.key]]\nr = 10\nradius = 4\n"), HasSubstr("camera.key[0].radius"));
}

TEST(Show, WrongWordNamesTheNearest) {
  EXPECT_THAT(problem_of("[camera]\nobserver = \"geodesik\"\n[[camera.key]]\nr = 10\n"), HasSubstr("\"geodesic\""));
}

TEST(Show, LaysItsMapOnTheSkyAsItSays) {
  const std::string sky = minimal + "[sky]\nmap = \"dust.exr\"\n";
  EXPECT_EQ(parse_show(sky, "show.toml").sky.map_layout, MapLayout{});
  const Show show = parse_show(sky + "map_layout = { coordinates = \"galactic\", mirrored = true }\n", "show.toml");
  EXPECT_EQ(show.sky.map_layout, (MapLayout{MapCoordinates::galactic, 0.0, true}));
  EXPECT_EQ(parse_show(to_toml(show), "show.toml").sky.map_layout, show.sky.map_layout);
  EXPECT_EQ(parse_show(sky + "map_layout = { middle_deg = 180 }\n", "show.toml").sky.map_layout,
            (MapLayout{MapCoordinates::equatorial, 180.0, false}));
}

TEST(Show, LaysNoBuiltInMapOtherwise) {
  EXPECT_THAT(problem_of(minimal + "[sky]\nmap_layout = { mirrored = true }\n"),
              AllOf(HasSubstr("show.toml:5"), HasSubstr("sky.map_layout"), HasSubstr("milky_way")));
  EXPECT_THAT(problem_of(minimal + "[sky]\nmap = \"a.png\"\nmap_layout = { coordinates = \"galaxy\" }\n"),
              HasSubstr("galactic, ecliptic"));
}

TEST(Show, LooksAtTheSkyThroughEllipsesUnlessItSaysOtherwise) {
  const Show plain = parse_show(minimal, "show.toml");
  EXPECT_EQ(plain.sky.filter, SkyFilter::ewa);
  EXPECT_EQ(plain.sky.shift, SkyShift::luminance);
  EXPECT_FALSE(plain.sky.brightening);
  EXPECT_EQ(parse_show(to_toml(plain), "show.toml").sky.shift, SkyShift::luminance);
  EXPECT_EQ(parse_show(minimal + "[sky]\nfilter = \"point\"\n", "show.toml").sky.filter, SkyFilter::point);
  EXPECT_THAT(problem_of(minimal + "[sky]\nfilter = \"poligon\"\n"),
              AllOf(HasSubstr("show.toml:5"), HasSubstr("sky.filter"), HasSubstr("\"polygon\"")));
  EXPECT_THAT(problem_of(minimal + "[sky]\n\nshift = \"none\"\n"),
              AllOf(HasSubstr("show.toml:6"), HasSubstr("sky.shift")));
  EXPECT_THAT(problem_of(minimal + "[sky]\nbrightening = 2\n"),
              AllOf(HasSubstr("show.toml:5"), HasSubstr("sky.brightening")));
}

TEST(Show, RefusesWhatCannotBe) {
  EXPECT_THAT(problem_of(""), HasSubstr("camera.key is missing"));
  EXPECT_THAT(problem_of("[camera]\n"), HasSubstr("camera.key is missing"));
  EXPECT_THAT(problem_of("[hole]\nspin = 1.5\n" + minimal), HasSubstr("hole.spin is 1.5"));
  EXPECT_THAT(problem_of("[hole]\nspin = nan\n" + minimal), HasSubstr("hole.spin is nan"));
  EXPECT_THAT(problem_of("[hole]\nspin = inf\n" + minimal), HasSubstr("hole.spin is inf"));
  EXPECT_THAT(problem_of("[camera]\n[[camera.key]]\nr = 1.9\n"), HasSubstr("inside the horizon"));
  EXPECT_THAT(problem_of("[camera]\n[[camera.key]]\nr = \"ten\"\n"), HasSubstr("is not a number"));
  EXPECT_THAT(problem_of("[camera]\n[[camera.key]]\nt_s = 1\n"), HasSubstr("r is missing"));
  EXPECT_THAT(problem_of(minimal + "[[camera.key]]\nr = 9\n"), HasSubstr("is not later than"));
  EXPECT_THAT(problem_of(minimal + "[view]\nsize_px = 0\n"), HasSubstr("view.size_px"));
  EXPECT_THAT(problem_of(minimal + "[view]\nsize_px = 16385\n"), HasSubstr("view.size_px"));
  EXPECT_THAT(problem_of(minimal + "[stereo]\nbaseline = -1\n"), HasSubstr("stereo.baseline"));
  EXPECT_THAT(problem_of(minimal + "[stereo]\nbaseline = nan\n"), HasSubstr("stereo.baseline"));
  EXPECT_THAT(problem_of(minimal + "[stereo]\nconvergence = 0\n"), HasSubstr("stereo.convergence"));
  EXPECT_THAT(problem_of(minimal + "[stereo]\nfade = { from_deg = 80, to_deg = 80.5 }\n"),
              HasSubstr("to_deg is 80.5, less than 1 degree above from_deg (80)"));
  for (const char* const word : {"convergance", "conv"}) {
    EXPECT_THAT(problem_of(minimal + "[stereo]\n" + word + " = 14\n"), HasSubstr("did you mean \"convergence\""));
  }
  EXPECT_THAT(problem_of(minimal + "[effects]\nredshift = 1\n"), HasSubstr("neither true nor false"));
  EXPECT_THAT(problem_of("x = = 1\n"), HasSubstr("show.toml:1"));
  EXPECT_THAT(problem_of("camera = 4\n"), HasSubstr("is not a table"));
}

TEST(Show, RefusesObserversThatCannotExist) {
  EXPECT_THAT(problem_of("[hole]\nspin = 0.9\n[camera]\nobserver = \"static\"\n[[camera.key]]\nr = 1.9\n"),
              HasSubstr("faster than light"));
  EXPECT_THAT(problem_of("[camera]\nobserver = \"geodesic\"\n[[camera.key]]\nr = 2.9\n"), HasSubstr("photon orbit"));
  EXPECT_THAT(problem_of("[camera]\nobserver = { beta = 1.0, toward = [1, 0, 0] }\n[[camera.key]]\nr = 9\n"),
              HasSubstr("speed of light"));
  EXPECT_THAT(problem_of("[camera]\nobserver = { beta = 0.5, toward = [0, 0, 0] }\n[[camera.key]]\nr = 9\n"),
              HasSubstr("toward is zero"));
}

TEST(Show, RefusesWaysOnWhichTheObserverCannotExist) {
  const std::string keys =
      "[[camera.key]]\nr = 1.7\ntheta_deg = 10\n[[camera.key]]\nt_s = 10\nr = 1.7\ntheta_deg = 170\n";
  EXPECT_THAT(
      problem_of("[hole]\nspin = 0.9\n[camera]\nobserver = \"static\"\n" + keys),
      AllOf(HasSubstr("show.toml:10"), HasSubstr("leads the camera to r = 1.7 M"), HasSubstr("faster than light")));
  EXPECT_EQ(problem_of("[hole]\nspin = 0.9\n[camera]\nobserver = \"zamo\"\n" + keys), "");
  const std::string over_the_equator =
      "[[camera.key]]\nr = 2.5\ntheta_deg = 10\n[[camera.key]]\nt_s = 10\nr = 2.5\ntheta_deg = 170\n";
  EXPECT_THAT(problem_of("[camera]\nobserver = \"geodesic\"\n" + over_the_equator), HasSubstr("an orbiting observer"));
}

TEST(Show, RefusesSpinsForWhichTheObserverCannotExist) {
  const std::string spins =
      "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = 0.99 }, { t_s = 5, value = 0.5 }]\n";
  const std::string still = "[camera]\nobserver = \"geodesic\"\n[[camera.key]]\nr = 2.2\n";
  EXPECT_THAT(problem_of("[hole]\nspin = 0.99\n" + spins + still),
              AllOf(HasSubstr("at 5 s"), HasSubstr("faster than light")));
  const std::string held =
      "[camera]\nobserver = \"geodesic\"\n[[camera.key]]\nr = 2.2\nhold_s = 4\n[[camera.key]]\nt_s = 4.5\nr = 9\n";
  EXPECT_THAT(problem_of("[hole]\nspin = 0.99\n" + spins + held), HasSubstr("faster than light"));
}

TEST(Show, MissingFileAndFolderAreErrorsWithTheirName) {
  EXPECT_THAT(error_of([] { read_show("no/such/show.toml"); }), HasSubstr("no/such/show.toml"));
  EXPECT_THAT(error_of([] { read_show(ERGODOME_SOURCE_DIR); }), HasSubstr("is not a regular file"));
}

TEST(Show, LastsForYearsWithoutLosingAFrame) {
  Show show = parse_show(minimal, "show.toml");
  show.duration_s = 1e9;
  EXPECT_EQ(frame_count(show), 1'000'000'000);
  EXPECT_NEAR(frame_time_s(show, 999'999'999), 1e9 / 30.0, 0.1);
}

TEST(Show, ToneLimitsThatCrossAreRefused) {
  EXPECT_THROW(
      parse_show("[camera]\n[[camera.key]]\nr = 9\n[tone]\nauto = { least_stops = 3, most_stops = 1 }\n", "a.toml"),
      Error);
}

}  // namespace
}  // namespace ergodome
