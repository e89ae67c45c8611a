#include "app/commands/farm/farm_scripts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/commands/farm/farm_attempts.h"
#include "app/commands/farm/farm_folder.h"
#include "app/commands/farm/programs.h"
#include "app/commands/farm/shell_words.h"
#include "tests/app/commands/farm/test_plan.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FarmScripts : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    // Scripts must keep every character of a path.
    folder_ /= "it's $HOME \"film\"";
    fs::create_directories(folder_);
    plan_ = test::test_plan(folder_);
  }
  void TearDown() override {
    folder_ = folder_.parent_path();
    FolderTest::TearDown();
  }

  //! Writes the scripts of a run and runs one of them.
  ProgramResult run_script(const std::string& name, const std::string& before, const std::string& arguments) {
    const FarmFolder farm(plan_.out);
    const int number = farm.newest_run() + 1;
    run_ = farm.run_folder(number);
    farm.write_run(number, "local", plan_, farm_scripts(plan_, run_));
    return run_and_read({"bash", "-c", before + "bash " + shell_word((run_ / name).string()) + " " + arguments}, "");
  }

  [[nodiscard]] static std::string log_of(const Attempt& attempt) {
    std::ifstream file(attempt.log);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  FarmPlan plan_;
  fs::path run_;
};

TEST_F(FarmScripts, RunTheTaskThatIsTheirArgument) {
  EXPECT_EQ(run_script("render.sh", "", "13:24").status, 0);
  const std::vector<Attempt> attempts = read_attempts(run_);
  ASSERT_EQ(attempts.size(), 1U);
  EXPECT_EQ(attempts[0].step, "render");
  EXPECT_EQ(attempts[0].task, "13:24");
  EXPECT_EQ(attempts[0].status, 0);
  EXPECT_GE(attempts[0].ended_s, attempts[0].began_s);
  EXPECT_EQ(log_of(attempts[0]), "render\nit's.toml\n--frames\n13:24\n");
}

TEST_F(FarmScripts, RunTheTaskOfASlurmArray) {
  EXPECT_EQ(run_script("bake.sh", "SLURM_ARRAY_TASK_ID=2 SLURMD_NODENAME=n7 ", "").status, 0);
  const std::vector<Attempt> attempts = read_attempts(run_);
  ASSERT_EQ(attempts.size(), 1U);
  EXPECT_EQ(attempts[0].host, "n7");
  EXPECT_EQ(log_of(attempts[0]), "bake\nmoving.toml\n--out=a b.trajectory\n--part\n2/2\n");
}

TEST_F(FarmScripts, UnderstandTheRangesOfOpenJobDescription) {
  EXPECT_EQ(run_script("render.sh", "", "49-60").status, 0);
  EXPECT_THAT(log_of(read_attempts(run_).at(0)), HasSubstr("--frames\n49:60\n"));
}

TEST_F(FarmScripts, GiveNoTaskToStepsWithOneTask) {
  EXPECT_EQ(run_script("film.sh", "", "").status, 0);
  EXPECT_EQ(log_of(read_attempts(run_).at(0)), "render\nmoving.toml\n--verify\n");
}

TEST_F(FarmScripts, UseTheThreadsThatSlurmGrants) {
  plan_.program = "bash -c 'echo threads: $ERGODOME_THREADS' --";
  EXPECT_EQ(run_script("film.sh", "SLURM_CPUS_PER_TASK=6 ", "").status, 0);
  EXPECT_EQ(log_of(read_attempts(run_).at(0)), "threads: 6\n");
}

TEST_F(FarmScripts, RecordFailuresAndPassTheirStatusOn) {
  plan_.program = "bash -c 'echo first; echo broken >&2; exit 5' --";
  const ProgramResult result = run_script("render.sh", "", "1:12");
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.output, HasSubstr("broken"));
  const std::vector<Attempt> attempts = read_attempts(run_);
  ASSERT_EQ(attempts.size(), 1U);
  EXPECT_EQ(attempts[0].status, 5);
  EXPECT_EQ(last_line_of_log(attempts[0]), "broken");
}

TEST_F(FarmScripts, KeepARecordOfEachAttempt) {
  EXPECT_EQ(run_script("film.sh", "", "").status, 0);
  run_and_read({"bash", (run_ / "film.sh").string()}, "");
  EXPECT_EQ(read_attempts(run_).size(), 2U);
}

TEST_F(FarmScripts, AreWrittenOncePerRun) {
  const FarmFolder farm(plan_.out);
  farm.write_run(1, "local", plan_, {});
  EXPECT_THROW(farm.write_run(1, "local", plan_, {}), std::exception);
  const FarmRun run = newest_farm_run(plan_.out);
  EXPECT_EQ(run.number, 1);
  EXPECT_EQ(run.engine, "local");
  EXPECT_EQ(run.plan.film.last, 59);
  ASSERT_EQ(run.plan.steps.size(), 4U);
  EXPECT_EQ(run.plan.steps[2].tasks, plan_.steps[2].tasks);
}

TEST_F(FarmScripts, ChoicesOfAFilmAreKeptForItsFingerprint) {
  const FarmFolder farm(plan_.out);
  store_choices(farm, {"0123", 12, {"--lens=live"}});
  ASSERT_TRUE(stored_choices(farm, "0123"));
  EXPECT_EQ(stored_choices(farm, "0123")->chunk, 12);
  EXPECT_EQ(stored_choices(farm, "0123")->quality, std::vector<std::string>{"--lens=live"});
  EXPECT_FALSE(stored_choices(farm, "4567"));
}

}  // namespace
}  // namespace ergodome
