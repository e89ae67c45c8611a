#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/command_line.h"

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

//! The same with files of which one is missing.
const std::string long_show = std::string(spinning_show) +
                              "[[overlay]]\nimage = \"logo.png\"\nfrom_s = 0\nto_s = 1\n[[audio]]\n"
                              "file = \"words.ogg\"\nlanguage = \"fr\"\n";

TEST_F(CommandLine, InspectTellsWhatAShowDoesWithTime) {
  write("long.toml", long_show);
  write("words.ogg", "");
  ASSERT_EQ(run("inspect long.toml"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("languages       de, en, fr"), HasSubstr("2 keys, 0.25 to 0.75"),
                             HasSubstr("2.000 s  de: Der Schatten | en: The shadow"), HasSubstr("Grüße an alle")));
  const std::size_t logo = output_.find("logo.png");
  const std::size_t words = output_.find("words.ogg");
  ASSERT_NE(logo, std::string::npos);
  ASSERT_NE(words, std::string::npos);
  EXPECT_THAT(output_.substr(logo, output_.find('\n', logo) - logo), HasSubstr("NOT THERE"));
  EXPECT_THAT(output_.substr(words), Not(HasSubstr("NOT THERE")));
}

TEST_F(CommandLine, InspectTellsWhichFilesOfAShowAreMissing) {
  write("named.toml",
        "duration_s = 2\n[[camera.key]]\nr = 20\n[sky]\nmap = \"nomap.png\"\nstars = \"nostars.csv\"\n[effects]\n"
        "diffraction = { pattern = \"nopattern.exr\" }\n[[shells]]\nradius = 30\ntexture = \"notexture.png\"\n"
        "[[objects]]\nmesh = \"there.obj\"\nmethod = \"trace\"\nposition = [12, 0, 0]\n[[caption]]\nfrom_s = 5\n"
        "to_s = 6\ntext = \"too late\"\n");
  write("there.obj", "");
  ASSERT_EQ(run("inspect named.toml"), 0) << output_;
  const auto line_of = [&](const std::string& name) {
    const std::size_t at = output_.rfind(name);
    return at == std::string::npos ? "" : output_.substr(at, output_.find('\n', at) - at);
  };
  for (const char* const name : {"nomap.png", "nostars.csv", "nopattern.exr", "notexture.png"}) {
    EXPECT_THAT(line_of(name), HasSubstr("NOT THERE")) << name;
  }
  EXPECT_THAT(line_of("there.obj"), AllOf(HasSubstr("objects[0].mesh"), Not(HasSubstr("NOT THERE"))));
  EXPECT_THAT(line_of("too late"), HasSubstr("AFTER THE END"));
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

TEST_F(CommandLine, InspectTellsItAsJson) {
  write("long.toml", long_show);
  ASSERT_EQ(run("inspect long.toml --json"), 0) << output_;
  const nlohmann::json timeline = nlohmann::json::parse(output_)["timeline"];
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
