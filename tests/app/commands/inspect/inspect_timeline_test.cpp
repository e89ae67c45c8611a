#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* spinning_show =
    "duration_s = 9\n[camera]\n[[camera.key]]\nr = 8\n[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 1, value = "
    "0.25 }, { t_s = 4, value = 0.75 }]\n[[chapter]]\nt_s = 2\ntitle = { en = \"The shadow\", de = \"Der Schatten\" }\n"
    "[[caption]]\nfrom_s = 1\nto_s = 2\ntext = \"Grüße\\nan alle\"\n";

//! A show that refers to several files, one of which is missing.
const std::string long_show = std::string(spinning_show) +
                              "[[overlay]]\nimage = \"logo.png\"\nfrom_s = 0\nto_s = 1\n[[audio]]\n"
                              "file = \"words.ogg\"\nlanguage = \"fr\"\n";

TEST_F(CommandLine, InspectTellsWhatAShowDoesWithTime) {
  write("long.toml", long_show);
  write("words.ogg", "");
  EXPECT_EQ(run("inspect long.toml"), 1) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("languages       de, en, fr"), HasSubstr("2 keys, 0.25 to 0.75"),
                             HasSubstr("2.000 s  de: Der Schatten | en: The shadow"), HasSubstr("Grüße an alle")));
  const std::size_t logo = output_.find("logo.png");
  const std::size_t words = output_.find("words.ogg");
  ASSERT_NE(logo, std::string::npos);
  ASSERT_NE(words, std::string::npos);
  EXPECT_THAT(output_.substr(logo, output_.find('\n', logo) - logo), HasSubstr("MISSING"));
  EXPECT_THAT(output_.substr(words), Not(HasSubstr("MISSING")));
}

TEST_F(CommandLine, InspectPrintsOneTitleOfSeveralLanguages) {
  const std::string rest = "\nduration_s = 1\n[[camera.key]]\nr = 20\n";
  for (const auto& [titles, printed] :
       {std::pair("{ de = \"Schatten\", en = \"Shadow\" }", "title           Shadow\n"),
        std::pair("{ fr = \"Ombre\", de = \"Schatten\" }", "title           Schatten\n"),
        std::pair("\"Small\"", "title           Small\n")}) {
    write("titled.toml", "title = " + std::string(titles) + rest);
    EXPECT_EQ(run("inspect titled.toml"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr(printed));
  }
}

TEST_F(CommandLine, InspectTellsWhichFilesOfAShowAreMissing) {
  write("named.toml",
        "duration_s = 2\n[[camera.key]]\nr = 20\n[sky]\nmap = \"nomap.png\"\nstars = \"nostars.csv\"\n[effects]\n"
        "diffraction = { pattern = \"nopattern.exr\" }\n[[shells]]\nradius = 30\ntexture = \"notexture.png\"\n"
        "[[objects]]\nmesh = \"there.obj\"\nmethod = \"trace\"\nposition = [12, 0, 0]\n[[caption]]\nfrom_s = 5\n"
        "to_s = 6\ntext = \"too late\"\n");
  write("there.obj", "");
  EXPECT_EQ(run("inspect named.toml"), 1) << output_;
  const auto line_of = [&](const std::string& name) {
    const std::size_t at = output_.rfind(name);
    return at == std::string::npos ? "" : output_.substr(at, output_.find('\n', at) - at);
  };
  for (const char* const name : {"nomap.png", "nostars.csv", "nopattern.exr", "notexture.png"}) {
    EXPECT_THAT(line_of(name), HasSubstr("MISSING")) << name;
  }
  EXPECT_THAT(line_of("there.obj"), AllOf(HasSubstr("objects[0].mesh"), Not(HasSubstr("MISSING"))));
  EXPECT_THAT(line_of("too late"), HasSubstr("AFTER THE END"));
}

TEST_F(CommandLine, InspectRemarksOnEyesThatConvergeNearerThanTheyAreApart) {
  const auto inspect = [&](const std::string& convergence) {
    write("crossed.toml",
          "[[camera.key]]\nr = 20\n[sky]\nmap = \"black\"\n[stereo]\nlayout = \"rows\"\nbaseline = 1\n"
          "convergence = " +
              convergence + "\n");
    EXPECT_EQ(run("inspect crossed.toml"), 0) << output_;
  };
  inspect("0.4");
  EXPECT_THAT(output_, HasSubstr("the baseline is 1 M but the convergence distance only 0.4 M"));
  inspect("5");
  EXPECT_THAT(output_, Not(HasSubstr("converge at")));
}

TEST_F(CommandLine, InspectTellsAFolderFromAFileThatIsMissing) {
  write("named.toml",
        "[[camera.key]]\nr = 20\n[sky]\nmap = \"black\"\n[[overlay]]\nimage = \"logo\"\nfrom_s = 0\nto_s = 1\n");
  std::filesystem::create_directory(folder_ / "logo");
  EXPECT_EQ(run("inspect named.toml"), 1) << output_;
  EXPECT_THAT(output_, AllOf(testing::ContainsRegex("logo [^\n]*IS A FOLDER"), Not(HasSubstr("MISSING"))));
}

TEST_F(CommandLine, InspectTellsOfSoundThatBreaksOff) {
  write("loud.toml", "[[camera.key]]\nr = 12\n[sky]\nmap = \"black\"\n[[audio]]\nfile = \"words.wav\"\n");
  // The header declares eight samples of 16 bits, but the file contains only four.
  const std::string samples(8, 'x');
  const std::string header{
      "RIFF\x34\0\0\0WAVEfmt \x10\0\0\0\x01\0\x01\0\x40\x1F\0\0\x80\x3E\0\0\x02\0\x10\0data\x10\0\0\0", 44};
  write("words.wav", header + samples);
  EXPECT_EQ(run("inspect loud.toml"), 1) << output_;
  EXPECT_THAT(output_, HasSubstr("CANNOT BE USED: words.wav: is truncated"));
  write("words.wav", header + samples + samples);
  EXPECT_EQ(run("inspect loud.toml"), 0) << output_;
}

TEST_F(CommandLine, InspectMarksCameraKeysAndNumbersThatComeAfterTheEnd) {
  write("late.toml",
        "duration_s = 2\n[[camera.key]]\nr = 20\n[[camera.key]]\nt_s = 60\nr = 30\n[[animate]]\nnumber = "
        "\"sky.exposure\"\n"
        "key = [{ t_s = 3, value = 2 }, { t_s = 4, value = 1 }]\n");
  ASSERT_EQ(run("inspect late.toml"), 0) << output_;
  EXPECT_THAT(output_, testing::ContainsRegex("60.000 +30 [^\n]* AFTER THE END"));
  EXPECT_THAT(output_, testing::ContainsRegex("sky.exposure [^\n]* AFTER THE END"));
  EXPECT_THAT(output_, Not(testing::ContainsRegex(" 0.000 +20 [^\n]* AFTER THE END")));
}

TEST_F(CommandLine, InspectMarksNumbersThatHaveNotComeToTheirLastKeyAtTheEnd) {
  write("late.toml",
        "duration_s = 20\n[[camera.key]]\nr = 20\n"
        "[[animate]]\nnumber = \"sky.exposure\"\nkey = [{ t_s = 5, value = 1 }, { t_s = 60, value = 4 }]\n"
        "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 5, value = 0.1 }, { t_s = 20, value = 0.4 }]\n");
  ASSERT_EQ(run("inspect late.toml"), 0) << output_;
  EXPECT_THAT(output_, testing::ContainsRegex("sky.exposure [^\n]* CONTINUES AFTER THE END"));
  EXPECT_THAT(output_, Not(testing::ContainsRegex("hole.spin [^\n]* AFTER THE END")));
}

//! Returns a show with a sphere of radius 1 at a position.
std::string show_with_sphere(const std::string& location) {
  return "[hole]\nspin = 0.5\n[[camera.key]]\nr = 12\n[sky]\nmap = \"black\"\n[view]\nsize_px = 16\n[[objects]]\n"
         "shape = \"sphere\"\nmethod = \"trace\"\nsize = 0.5\nposition = " +
         location + "\n";
}

constexpr const char* sunk_note =
    "objects[0]: is inside the horizon, r = 1.87 M, and is never visible (objects[0].position, sunk.toml:13); ";

TEST_F(CommandLine, InspectTellsOfAnObjectWithinTheHorizon) {
  write("sunk.toml", show_with_sphere("[1, 0, 0]"));
  ASSERT_EQ(run("inspect sunk.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(sunk_note));
}

TEST_F(CommandLine, RenderTellsWhatNobodyWillSee) {
  std::string sunk = show_with_sphere("[1, 0, 0]");
  write("sunk.toml", sunk.replace(sunk.find("[view]"), 6, "stars = \"none.csv\"\n[view]"));
  write("none.csv", "ra_deg,dec_deg,v_mag\n");
  ASSERT_EQ(run("render sunk.toml --frames 1:1 --backend cpu --out f"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("none.csv: contains no stars"));
  EXPECT_THAT(output_, HasSubstr("ergodome: objects[0]: is inside the horizon"));
}

TEST_F(CommandLine, InspectTellsOfAnObjectThatLiesPartlyWithinTheHorizon) {
  write("half.toml", show_with_sphere("[2, 0, 0]"));
  ASSERT_EQ(run("inspect half.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("objects[0]: is partly inside the horizon, r = 1.87 M, at 0 s"));
}

TEST_F(CommandLine, InspectSaysNothingOfAnObjectBesideTheHorizon) {
  write("beside.toml", show_with_sphere("[2.4, 0, 0]"));
  ASSERT_EQ(run("inspect beside.toml"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("horizon,")));
}

TEST_F(CommandLine, InspectTellsOfACatalogueWithoutStars) {
  write("dark.toml", "[[camera.key]]\nr = 12\n[sky]\nmap = \"black\"\nstars = \"none.csv\"\n[view]\nsize_px = 16\n");
  write("none.csv", "ra_deg,dec_deg,v_mag\n");
  ASSERT_EQ(run("inspect dark.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("none.csv: contains no stars (sky.stars, dark.toml:5); choose another star table"));
}

TEST_F(CommandLine, ShowsTellOfTexelsOfTheirMapThatAreNoLight) {
  write("bright.toml", "[[camera.key]]\nr = 12\n[sky]\nmap = \"sky.pfm\"\n[view]\nsize_px = 16\n");
  std::vector<float> light(std::size_t{3} * 16 * 8, 0.5F);
  light[5] = 1e20F;
  light[30] = -1.0F;
  write("sky.pfm", "PF\n16 8\n-1.0\n" + std::string(reinterpret_cast<const char*>(light.data()), 4 * light.size()));
  const std::string reported =
      "sky.pfm: has 1 texel infinite or brighter than 1e+09 (clamped), 1 texel with a negative color (set to 0) "
      "(sky.map, bright.toml:4)";
  ASSERT_EQ(run("inspect bright.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(reported));
  ASSERT_EQ(run("render bright.toml --out o --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(reported));
}

TEST_F(CommandLine, InspectTellsTheSizeOfMeshesAndRemarksOnThem) {
  write("ship.toml",
        "[[camera.key]]\nr = 20\n[sky]\nmap = \"black\"\n[view]\nsize_px = 16\n[[objects]]\nmesh = \"ship.obj\"\n"
        "method = \"trace\"\nsize = 0.5\nposition = [12, 0, 0]\n");
  write("ship.obj", "v 0 0 0\nv 2 0 0\nv 2 4 0\nv 0 4 0\nusemtl steel\nf 1 2 3 4\nf 1 1 2\n");
  ASSERT_EQ(run("inspect ship.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("2 triangles, 1 without area omitted, 1 x 2 x 0 M before rotation\n"
                                 "    uses materials that no material file defines (\"steel\")"));
  ASSERT_EQ(run("inspect ship.toml --json"), 0) << output_;
  const auto mesh = nlohmann::json::parse(output_)["meshes"][0];
  EXPECT_EQ(mesh["triangles"], 2);
  EXPECT_EQ(mesh["extent_M"][1], 2.0);
}

TEST_F(CommandLine, InspectTellsOfASoundFileThatCannotBePlayed) {
  write("loud.toml", "[[camera.key]]\nr = 12\n[[audio]]\nfile = \"words.ogg\"\n");
  write("words.ogg", "no sound");
  EXPECT_EQ(run("inspect loud.toml"), 1) << output_;
  EXPECT_THAT(output_, testing::ContainsRegex("CANNOT BE USED: [^\n]*words.ogg"));
}

TEST_F(CommandLine, InspectReadsEveryFileThatAShowNames) {
  write("evening.toml",
        "duration_s = 2\n[[camera.key]]\nr = 20\n[sky]\nmap = \"map.png\"\n[effects]\ndiffraction = { pattern = "
        "\"spikes.png\" }\n[[shells]]\nradius = 30\ntexture = \"square.ppm\"\n[[objects]]\nmesh = \"ship.obj\"\n"
        "method = \"trace\"\nposition = [12, 0, 0]\n[[overlay]]\nimage = \"torn.ppm\"\nfrom_s = 0\nto_s = 1\n"
        "[[overlay]]\nimage = \"sky.ppm\"\nfrom_s = 1\nto_s = 2\n");
  write("map.png", "no image");
  write("spikes.png", "");
  write("square.ppm", "P6\n16 16\n255\n" + std::string(768, 'x'));
  write("torn.ppm", "P6\n16 8\n255\n" + std::string(40, 'x'));
  write("ship.obj", "v 0 0 0\n");
  EXPECT_EQ(run("inspect evening.toml"), 1);
  const std::pair<const char*, const char*> problems[] = {
      {"map.png", "(sky.map, evening.toml:5)"},
      {"spikes.png", "(effects.diffraction.pattern, evening.toml:7"},
      {"square.ppm", "is 16 x 16, neither twice as wide as high nor a cube map"},
      {"ship.obj", "(objects[0].mesh, evening.toml:12)"},
      {"torn.ppm", "(overlay[0].image, evening.toml:16)"}};
  for (const auto& [file, problem] : problems) {
    const std::size_t at = output_.find(std::string("CANNOT BE USED: ") + file);
    ASSERT_NE(at, std::string::npos) << file << ": " << output_;
    EXPECT_THAT(output_.substr(at, output_.find('\n', at) - at), HasSubstr(problem)) << file;
  }
  EXPECT_THAT(output_, HasSubstr("evening.toml: 5 of 6 referenced files cannot be used; see the list above"));
}

TEST_F(CommandLine, InspectTellsItAsJson) {
  write("long.toml", long_show);
  EXPECT_EQ(run("inspect long.toml --json"), 1) << "files are missing";
  const nlohmann::json timeline = nlohmann::json::parse(output_.substr(output_.find('{')))["timeline"];
  EXPECT_EQ(timeline["animated"][0]["number"], "hole.spin");
  EXPECT_EQ(timeline["animated"][0]["to_s"], 4.0);
  EXPECT_EQ(timeline["chapters"][0]["title"]["de"], "Der Schatten");
  EXPECT_EQ(timeline["captions"][0]["text"][""], "Grüße\nan alle");
  EXPECT_EQ(timeline["overlays"][0]["there"], false);
  EXPECT_EQ(timeline["audio"][0]["language"], "fr");
  EXPECT_EQ(timeline["audio"][0]["after_end"], false);
}

TEST_F(CommandLine, BakeRefusesASpinThatChangesAndLeavesNothing) {
  write("long.toml", long_show);
  EXPECT_NE(run("bake long.toml --out long.trajectory"), 0);
  EXPECT_THAT(output_, AllOf(HasSubstr("spin changes with time"), HasSubstr("--lens live")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "long.trajectory.part"));
}

TEST_F(CommandLine, RendersAnAnimatedShow) {
  write("spinning.toml", spinning_show);
  ASSERT_EQ(run("render spinning.toml --frames 30:32 --size 32 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("3 frames"));
}

}  // namespace
}  // namespace ergodome
