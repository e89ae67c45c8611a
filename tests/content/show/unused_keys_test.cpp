#include "content/show/unused_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "content/show/reading/show_reader.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<UnusedKey> unused_in(const std::string& text) {
  return unused_keys(parse_show(text + "[camera]\n[[camera.key]]\nr = 30\n", "film.toml"));
}

auto unused(int line, const std::string& key, const std::string& why) {
  return AllOf(Field(&UnusedKey::line, line), Field(&UnusedKey::key, key), Field(&UnusedKey::why, HasSubstr(why)));
}

TEST(UnusedKeys, AreNumbersOfAnotherCurve) {
  EXPECT_THAT(
      unused_in("[tone]\ncurve = \"filmic\"\ngamma = 2\nwhite = 3\n"),
      ElementsAre(unused(3, "tone.gamma", "curve = \"gamma\""), unused(4, "tone.white", "curve = \"reinhard\"")));
  EXPECT_THAT(unused_in("[tone]\ncurve = \"gamma\"\ngamma = 2\n"), IsEmpty());
  EXPECT_THAT(unused_in("[tone]\ncurve = \"reinhard\"\nwhite = 2\n"), IsEmpty());
}

TEST(UnusedKeys, AreCloudsOfADiskWithout) {
  EXPECT_THAT(unused_in("[disk]\nspeed = 3\n"), ElementsAre(unused(2, "disk.speed", "pattern")));
  EXPECT_THAT(unused_in("[disk]\npattern = \"procedural\"\nspeed = 3\n"), IsEmpty());
}

TEST(UnusedKeys, AreWhatConcernsStarsWhereThereAreNone) {
  EXPECT_THAT(unused_in("[sky]\nfaintest_mag = 7\n[effects]\npsf = { sigma_px = 1 }\nredshift = true\n"),
              ElementsAre(unused(2, "sky.faintest_mag", "stars"), unused(4, "effects.psf", "stars")));
  EXPECT_THAT(unused_in("[sky]\nstars = \"bright_stars\"\nfaintest_mag = 7\n[effects]\npsf = { sigma_px = 1 }\n"),
              IsEmpty());
}

TEST(UnusedKeys, AreTheApertureBesideAPattern) {
  const std::string stars = "[sky]\nstars = \"bright_stars\"\n[effects.diffraction]\nblades = 5\n";
  EXPECT_THAT(unused_in(stars), IsEmpty());
  EXPECT_THAT(unused_in(stars + "pattern = \"spikes.png\"\n"),
              ElementsAre(unused(4, "effects.diffraction.blades", "pattern")));
}

TEST(UnusedKeys, AreWhatConcernsAMapWhereTheSkyIsBlack) {
  EXPECT_THAT(unused_in("[sky]\nmap = \"black\"\nfilter = \"point\"\n"), ElementsAre(unused(3, "sky.filter", "black")));
  EXPECT_THAT(unused_in("[sky]\nmap = \"black\"\nexposure = 4\n"), ElementsAre(unused(3, "sky.exposure", "stars")));
  EXPECT_THAT(unused_in("[sky]\nmap = \"black\"\nstars = \"bright_stars\"\nexposure = 4\n"), IsEmpty());
}

TEST(UnusedKeys, AreTheAxisOfASkyThatIsNotThere) {
  const std::string axis = "spin_axis = { ra_deg = 10, dec_deg = 20 }\n";
  EXPECT_THAT(unused_in("[sky]\nmap = \"black\"\n" + axis), ElementsAre(unused(3, "sky.spin_axis", "stars")));
  EXPECT_THAT(unused_in("[sky]\nmap = \"black\"\nstars = \"bright_stars\"\n" + axis), IsEmpty());
  EXPECT_THAT(unused_in("[sky]\n" + axis), IsEmpty());
  EXPECT_THAT(unused_in("[sky]\nmap = \"grid\"\n" + axis), ElementsAre(unused(3, "sky.spin_axis", "own axes")));
}

TEST(UnusedKeys, AreThoseOfAnotherProjection) {
  const std::string numbers = "fov_deg = 90\naspect = 2\ntilt_deg = 10\n";
  EXPECT_THAT(unused_in("[view]\nprojection = \"equirect\"\naspect = 2\ntilt_deg = 10\n"),
              ElementsAre(unused(3, "view.aspect", "pinhole"), unused(4, "view.tilt_deg", "dome")));
  EXPECT_THAT(unused_in("[view]\nprojection = \"dome\"\n" + numbers), ElementsAre(unused(4, "view.aspect", "pinhole")));
  EXPECT_THAT(unused_in("[view]\nprojection = \"cylinder\"\n" + numbers),
              ElementsAre(unused(4, "view.aspect", "pinhole"), unused(5, "view.tilt_deg", "dome")));
  EXPECT_THAT(unused_in("[view]\nprojection = \"pinhole\"\n" + numbers),
              ElementsAre(unused(5, "view.tilt_deg", "dome")));
}

TEST(UnusedKeys, AreTheFieldOfViewOfADomeThatIsShownAsASphere) {
  Show show = parse_show("[view]\nfov_deg = 90\n[camera]\n[[camera.key]]\nr = 30\n", "film.toml");
  EXPECT_THAT(unused_keys(show), IsEmpty());
  show.view.projection = ViewProjection::equirect;
  EXPECT_THAT(unused_keys(show), IsEmpty()) << "a part of the sphere";
  show.view.field_of_view_deg = 360.0;
  EXPECT_THAT(unused_keys(show), ElementsAre(unused(2, "view.fov_deg", "the whole sphere")));
}

TEST(UnusedKeys, AreTheFieldOfViewBesideAFrustum) {
  const std::string frustum = "frustum = { left_deg = -30, right_deg = 20, up_deg = 25, down_deg = -10 }\n";
  EXPECT_THAT(unused_in("[view]\nprojection = \"pinhole\"\nfov_deg = 90\naspect = 2\n" + frustum),
              ElementsAre(unused(3, "view.fov_deg", "frustum"), unused(4, "view.aspect", "frustum")));
}

TEST(UnusedKeys, AreColoursOfAShellThatDoesNotShowThem) {
  const std::string shell = "[[shells]]\nradius = 10\nline_color = [1, 0, 0]\nfill_color = [1, 0, 0]\n";
  EXPECT_THAT(unused_in(shell), ElementsAre(unused(4, "shells[0].fill_color", "fill_opacity")));
  EXPECT_THAT(unused_in(shell + "fill_opacity = 0.5\nline_width_deg = 0\n"),
              ElementsAre(unused(3, "shells[0].line_color", "width")));
  EXPECT_THAT(unused_in(shell + "fill_opacity = 0.5\nline_opacity = 0\n"),
              ElementsAre(unused(3, "shells[0].line_color", "opacity")));
  EXPECT_THAT(unused_in(shell + "fill_opacity = 0.5\n"), IsEmpty());
}

TEST(UnusedKeys, AreNotThoseOfAShellThatComesToShowThem) {
  EXPECT_THAT(
      unused_in("duration_s = 9\n[[shells]]\nradius = 10\nfill_color = [1, 0, 0]\n[[animate]]\n"
                "number = \"shells[0].fill_opacity\"\nkey = [{ t_s = 0, value = 0 }, { t_s = 9, value = 1 }]\n"),
      IsEmpty());
}

TEST(UnusedKeys, AreTheShiftOfAMapWithoutRedshift) {
  EXPECT_THAT(unused_in("[sky]\nshift = \"blackbody_fit\"\n"), ElementsAre(unused(2, "sky.shift", "redshift")));
  EXPECT_THAT(unused_in("[sky]\nshift = \"blackbody_fit\"\n[effects]\nredshift = true\n"), IsEmpty());
}

TEST(UnusedKeys, AreTheFadesOfEyesThatDoNotTurn) {
  const std::string fade = "[stereo]\nlayout = \"side_by_side\"\nfade = { from_deg = 50, to_deg = 80 }\n";
  EXPECT_THAT(unused_in(fade), ElementsAre(unused(3, "stereo.fade", "omni")));
  EXPECT_THAT(unused_in(fade + "model = \"omni\"\n"), IsEmpty());
}

TEST(UnusedKeys, AreThoseOfTwoEyesWhereThereIsOne) {
  const std::string eyes = "swap_eyes = true\ntint_eyes = true\ncomfort_deg = 2\nbaseline = 1\nconvergence = 9\n";
  EXPECT_THAT(unused_in("[stereo]\n" + eyes),
              ElementsAre(unused(2, "stereo.swap_eyes", "mono"), unused(3, "stereo.tint_eyes", "mono"),
                          unused(4, "stereo.comfort_deg", "mono"), unused(5, "stereo.baseline", "mono"),
                          unused(6, "stereo.convergence", "mono")));
  EXPECT_THAT(unused_in("[stereo]\nlayout = \"rows\"\n" + eyes), IsEmpty());
}

TEST(UnusedKeys, AreAnimationsToo) {
  EXPECT_THAT(unused_in("[[animate]]\nnumber = \"tone.gamma\"\nkey = [{ t_s = 0, value = 2 }]\n"),
              ElementsAre(unused(1, "animate.tone.gamma", "curve")));
}

TEST(UnusedKeys, AreInNoBuiltInShow) {
  for (const auto& entry : std::filesystem::directory_iterator(ERGODOME_SOURCE_DIR "/content/shows")) {
    if (entry.path().extension() == ".toml") {
      EXPECT_THAT(unused_keys(read_show(entry.path())), IsEmpty()) << entry.path();
    }
  }
}

TEST(UnusedKeys, AreTheTessellationOfTracedObjects) {
  const std::string ball = "[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\ntessellation = { most = 8 }\n";
  EXPECT_THAT(unused_in(ball), IsEmpty());
  EXPECT_THAT(unused_in(ball + "method = \"trace\"\n"),
              ElementsAre(unused(4, "objects[0].tessellation", "only with method = \"polygon\"")));
  EXPECT_THAT(unused_in("[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\nmethod = \"trace\"\n"
                        "tessellation = { torn = 5 }\n"),
              IsEmpty());
}

TEST(UnusedKeys, OfALightAreThoseThatLightNothing) {
  const std::string light = "[light]\nposition = [40, 0, 0]\nfalloff = \"lens\"\n";
  const auto ball = [](const std::string& more) {
    return "[[objects]]\nshape = \"sphere\"\nposition = [10, 0, 0]\n" + more;
  };
  EXPECT_THAT(unused_in(light + ball("method = \"trace\"\nlight = \"lambert\"\n")), IsEmpty());
  EXPECT_THAT(unused_in(light + ball("light = \"lambert\"\n")),
              ElementsAre(unused(3, "light.falloff", "method = \"trace\"")));
  EXPECT_THAT(unused_in(light + ball("method = \"trace\"\n")), ElementsAre(unused(1, "light", "lambert")));
}

}  // namespace
}  // namespace ergodome
