#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "content/files/whole_file.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::HasSubstr;
using testing::Not;

constexpr const char* starry_show =
    "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 8\n[sky]\nmap = \"grid\"\nstars = \"bright_stars\"\n"
    "faintest_mag = 3\n[effects]\nredshift = true\n[view]\nsize_px = 64\n";

nlohmann::json json_in(const std::string& output) { return nlohmann::json::parse(output.substr(output.find('{'))); }

TEST_F(CommandLine, PlanNamesThePassesAndTheLinesThatCallForThem) {
  write("starry.toml", starry_show);
  ASSERT_EQ(run("plan starry.toml --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("effects.redshift (starry.toml line 11)"));
  EXPECT_THAT(output_, HasSubstr("search_patches"));
  EXPECT_THAT(output_, HasSubstr("64 x 64 pixels, 1 eye, lens: direct"));
  EXPECT_THAT(output_, Not(HasSubstr("bloom")));
  ASSERT_EQ(run("plan starry.toml --backend cpu --view steps --size 128 --stereo side_by_side"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("128 x 128 pixels, 2 eyes"));
  EXPECT_THAT(output_, HasSubstr("shade_heat_map"));
  EXPECT_THAT(output_, Not(HasSubstr("search_patches")));
}

TEST_F(CommandLine, AFolderDoesNotHideTheBuiltInShowOfItsName) {
  std::filesystem::create_directory(folder_ / "shells");
  EXPECT_EQ(run("plan shells --backend cpu"), 0) << output_;
  std::filesystem::create_directory(folder_ / "elsewhere");
  EXPECT_NE(run("plan elsewhere --backend cpu"), 0);
  EXPECT_THAT(output_, HasSubstr("is neither a file nor a built-in show"));
}

TEST_F(CommandLine, PlanMeasuresWhatItPlanned) {
  write("starry.toml", starry_show);
  ASSERT_EQ(run("plan starry.toml --backend cpu --measure --json"), 0) << output_;
  const nlohmann::json plan = json_in(output_);
  EXPECT_EQ(plan["lens"], "direct");
  EXPECT_EQ(plan["measured"]["next"]["trace_pixels, footprints"]["elements"], 64 * 64);
  EXPECT_EQ(plan["measured"]["first"]["load_stars"]["runs"], 1);
  EXPECT_FALSE(plan["measured"]["next"].contains("load_stars"));
  EXPECT_GT(plan["measured"]["picture_ms"].get<double>(), 0.0);
  for (const auto& buffer : plan["buffers"]) {
    if (!buffer["bytes"].is_null()) {
      const std::string name = buffer["name"];
      EXPECT_EQ(plan["measured"]["first"][name]["elements"], buffer["bytes"]) << name;
    }
  }
}

TEST_F(CommandLine, TimesOutsideAShowAreRefusedWithThoseInIt) {
  write("my.toml", std::string("duration_s = 12\n") + starry_show);
  for (const char* command : {"plan my.toml --backend cpu --measure", "inspect my.toml --picture g.png"}) {
    for (const char* time : {"99", "-5"}) {
      EXPECT_EQ(run(std::string(command) + " --time " + time), 2) << output_;
      EXPECT_THAT(output_, HasSubstr(std::string("--time: ") + time + " s is outside my; choose from 0 to 12 s"));
    }
    EXPECT_EQ(run(std::string(command) + " --time 12"), 0) << output_;
  }
}

TEST_F(CommandLine, PlanRefusesWhatIsNotAShow) {
  for (const char* words : {"plan", "plan nothing.toml", "plan dome-still --size 0", "plan dome-still --view light"}) {
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
}

TEST_F(CommandLine, CatalogueTellsWhatItHoldsAndWritesIt) {
  ASSERT_EQ(run("catalogue bright_stars --faintest 2 --out few.stars"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("49 stars, 0 without a color"));
  const std::string brightest = "32349   101.287";
  EXPECT_THAT(output_, HasSubstr(brightest));
  ASSERT_EQ(run("catalogue few.stars"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(brightest));
}

TEST_F(CommandLine, CatalogueReadsATableAndSaysWhatItLeftOut) {
  write("own.csv", "id,ra,dec,mag,ci\n1,1.5,20,3.0,0.6\n2,2.5,-10,4.0,\n3,,0,5.0,0.1\n");
  ASSERT_EQ(run("catalogue own.csv"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("2 stars, 1 without a color, 1 row skipped: 1 row without a position (line 4)"));
  EXPECT_THAT(output_, testing::ContainsRegex("4\\.00       -\n"));
}

TEST_F(CommandLine, CatalogueWritesOverNothingButACatalogueOfItsOwn) {
  write("precious.toml", "duration_s = 1\n");
  EXPECT_EQ(run("catalogue bright_stars --faintest 2 --out precious.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("--out precious.toml: already exists and is not an Ergodome catalogue"));
  EXPECT_EQ(read_whole_file(folder_ / "precious.toml", 1000, ""), "duration_s = 1\n");
  EXPECT_EQ(run("catalogue bright_stars --faintest 2 --out precious.toml --replace"), 0) << output_;
  EXPECT_EQ(run("catalogue bright_stars --faintest 1 --out precious.toml"), 0) << output_;
}

TEST_F(CommandLine, ShowsTellWhichRowsOfTheirCatalogueAreLeftOut) {
  write("own.csv", "ra_deg,dec,mag\n1,20,3\n2,-10,\n");
  write("own.toml", "[[camera.key]]\nr = 12\n[sky]\nmap = \"black\"\nstars = \"own.csv\"\n[view]\nsize_px = 16\n");
  const std::string reported = "1 row skipped: 1 row without a magnitude (line 3)";
  ASSERT_EQ(run("inspect own.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("own.csv: 1 star, " + reported));
  ASSERT_EQ(run("inspect own.toml --json"), 0) << output_;
  const auto stars = json_in(output_)["stars"];
  EXPECT_EQ(stars["count"], 1);
  EXPECT_EQ(stars["left_out"][0]["first_line"], 3);
  EXPECT_EQ(stars["read_as"], "ra_deg in degrees, dec; V from mag");
  ASSERT_EQ(run("render own.toml --out o --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("own.csv: " + reported));
}

TEST_F(CommandLine, CatalogueRefusesWhatItCannotRead) {
  write("torn.csv", "ra,dec\n1,2\n");
  for (const char* words : {"catalogue", "catalogue nothing.csv", "catalogue torn.csv", "catalogue /dev/null",
                            "catalogue bright_stars --out /nowhere/few.stars", "catalogue bright_stars --faintest x"}) {
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
}

}  // namespace
}  // namespace ergodome
