#include "app/commands/farm/slurm_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/commands/farm/programs.h"
#include "app/commands/farm/shell_words.h"
#include "kernels/core/error.h"
#include "tests/app/commands/farm/test_plan.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

//! A folder of a run with programs in place of Slurm's.
class SlurmEngine : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    run_ = folder_ / "a 50%'s film";
    fs::create_directories(run_);
    plan_ = test::test_plan(folder_);
  }

  void write_program(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << "#!/bin/bash\ncd \"${0%/*}\" || exit\n" << text;
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }

  //! Runs the submission script.
  ProgramResult submit(const TaskResources& resources) const {
    std::ofstream(run_ / "submit.sh") << slurm_submission(plan_, resources, run_);
    return run_and_read(
        {"bash", "-c",
         "PATH=" + shell_word(folder_.string()) + ":$PATH; bash " + shell_word((run_ / "submit.sh").string())},
        "");
  }

  fs::path run_;
  FarmPlan plan_;
};

TEST_F(SlurmEngine, SubmitsStepsThatWaitForTheOneBefore) {
  write_program("sbatch", "printf '%s\\n' \"$@\" '' >>calls\necho \"$(($(grep -c '^$' calls) + 40));cluster\"\n");
  const ProgramResult result = submit({4, "8G", "a100:1", "30", "gpu", "physics"});
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(slurm_jobs(run_),
            (std::map<std::string, std::string>{{"bake", "41"}, {"join", "42"}, {"render", "43"}, {"film", "44"}}));
  const std::string calls = text("calls");
  const std::string log = run_.string().replace(run_.string().find('%'), 1, "%%") + "/slurm-render-%a.log";
  EXPECT_THAT(calls, HasSubstr("--partition=gpu\n--account=physics\n--time=30\n--mem=8G\n--gpus=a100:1\n"
                               "--cpus-per-task=4\n--dependency=afterok:42\n--kill-on-invalid-dep=yes\n"
                               "--job-name=moving-render\n--output=" +
                               log + "\n--array=1-3\n" + (run_ / "render.sh").string() + "\n"));
  EXPECT_THAT(calls, HasSubstr("--array=1-2\n" + (run_ / "bake.sh").string()));
}

TEST_F(SlurmEngine, CancelsWhatItHasSubmittedIfAStepFails) {
  write_program("sbatch", "[[ $* != *join* ]] || { echo 'sbatch: error: invalid account' >&2; exit 1; }\necho 7\n");
  write_program("scancel", "echo \"canceled $1\"\n");
  const ProgramResult result = submit({});
  EXPECT_NE(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("invalid account"));
  EXPECT_THAT(result.output, HasSubstr("canceled 7"));
}

TEST(SlurmQueue, IsReadWithAndWithoutArrays) {
  const auto queue = parse_queue("41 3 RUNNING\n41 4 PENDING\n42 N/A PENDING\n");
  EXPECT_EQ(queue.size(), 3U);
  EXPECT_EQ(queue.at({"41", 3}), "RUNNING");
  EXPECT_EQ(queue.at({"42", 1}), "PENDING");
  EXPECT_TRUE(parse_queue("").empty());
}

}  // namespace
}  // namespace ergodome
