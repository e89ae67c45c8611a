#include "app/cli/option_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/usage_error.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

//! Returns the error message for a command line, or an empty string if its options are accepted.
//! The commands themselves fail immediately, because none of the files exists.
std::string problem_of(const std::string& words) {
  CLI::App app;
  for (const auto add : {add_play_command, add_render_command, add_bake_command, add_inspect_command, add_plan_command,
                         add_accuracy_command, add_calibrate_command, add_convert_command, add_pad_command,
                         add_trace_command, add_connect_command}) {
    add(app);
  }
  try {
    app.parse(words);
  } catch (const CLI::ParseError& problem) {
    return problem.what();
  } catch (const UsageError& problem) {
    return problem.what();
  } catch (const std::exception&) {
    return "";
  }
  return "";
}

TEST(IgnoredOptions, AreRefusedWhereTheyAreGivenAndHaveNoUse) {
  CLI::App app;
  std::string way = "short";
  int miles = 3;
  app.add_option("--way", way);
  app.add_option("--miles", miles);
  IgnoredOptions ignored(app);
  ignored.add("of the short way", [&way] { return way == "short"; }, {"--miles"});
  app.parse("--way short");
  EXPECT_NO_THROW(ignored.refuse());
  app.parse("--way long --miles 4");
  EXPECT_NO_THROW(ignored.refuse());
  app.parse("--way short --miles 4");
  EXPECT_THROW(ignored.refuse(), CLI::ValidationError);
}

TEST(IgnoredOptions, OfEveryCommandAreToldWithWhatLeavesThemNoUse) {
  const std::pair<const char*, const char*> lines[] = {
      {"trace --rays r --out o --budget 1px", "--budget: has no effect without --method grid; leave it out"},
      {"trace --rays r --out o --method quadtree --size 64", "--size: has no effect without --method grid"},
      {"trace --rays r --out o --method grid --level 9", "--level: has no effect without --method quadtree"},
      {"trace --rays r --out o --method closed_form --tolerance 1e-6", "--tolerance: has no effect with"},
      {"trace --rays r --out o --method quadtree --precision float", "--precision: has no effect with"},
      {"connect --pairs p --out o --rows 64", "--rows: has no effect without --method table"},
      {"play none.toml --lens live --trajectory t", "--trajectory: has no effect with --lens live or direct"},
      {"play none.toml --no-sound --sound-later 1", "--no-sound"},
      {"play none.toml --setup d.toml --projection cube", "--projection: has no effect with --setup"},
      {"render none.toml --lens direct --stream-memory 9", "--stream-memory: has no effect with --lens"},
      {"render none.toml --pattern checker --lens live", "--lens: has no effect with --pattern"},
      {"render none.toml --compression zip", "--compression: has no effect without --format exr"},
      {"render", "render: has nothing to render; name a show"},
      {"play none.toml --clock-start 01:00:00:00", "--clock-start: has no effect without --clock mtc"},
      {"play none.toml --clock mtc --clock-start 1", "--clock-start: \"1\" is not a time code"},
      {"play none.toml --clock osc", "--clock osc: needs an OSC port"},
      {"play none.toml --exhibit --fly", "--fly: has no effect with --exhibit"},
      {"bake none.toml --out t --part 3/2", "--part: \"3/2\" does not name a part"},
      {"render none.toml --budget 1px --check 2 --resume", "--resume: has no effect with --check"},
      {"plan none.toml --time 2", "--time requires --measure"},
      {"inspect none.toml --time 2", "--time requires --picture"},
      {"inspect none.png --picture p.png", "--picture: has no effect for a sky map"},
      {"accuracy none.toml --json --at 1px", "--at: has no effect with --json"},
      {"calibrate d.toml --live --out o", "--out excludes --live"},
      {"calibrate d.toml", "calibrate: has nothing to do; add --out"},
      {"calibrate d.toml --out o --for 2", "--for requires --live"},
      {"convert a.toml made --radius 5", "--radius: has no effect unless FROM is an MPCDI file"},
      {"convert a.toml made --aspect 2", "--aspect: has no effect unless FROM or TO"},
      {"convert a.data b.png", "convert: cannot make"},
      {"convert a.data b.pfm --size 1x4", "--size: Value 1 not in range"},
      {"convert a.pfm b.data --size 4x4", "--size: has no effect unless TO"},
      {"pad --for 2", "--for: has no effect without --live"},
      {"pad --pad 2", "--pad requires --calibrate"},
  };
  for (const auto& [words, problem] : lines) {
    EXPECT_THAT(problem_of(words), HasSubstr(problem)) << words;
  }
}

TEST(IgnoredOptions, AreTakenWhereTheyHaveAUse) {
  for (const char* words :
       {"trace --rays r --out o --method grid --budget 1px --precision float --tolerance 1e-6",
        "trace --rays r --out o --method quadtree --level 9 --blend 1",
        "trace --rays r --out o --disk --tolerance 1e-6", "connect --pairs p --out o --method table --rows 64",
        "render none.toml --lens streamed --trajectory t", "inspect none.toml --picture p.png --time 2 --size 64",
        "accuracy none.toml --json --out o --at 1px", "calibrate none.toml --live --size 512",
        "convert a.mpcdi b.toml --radius 5", "convert a.data b.pfm --aspect 2 --size 4x4",
        "plan none.toml --measure --time 2"}) {
    EXPECT_EQ(problem_of(words), "") << words;
  }
}

}  // namespace
}  // namespace ergodome
