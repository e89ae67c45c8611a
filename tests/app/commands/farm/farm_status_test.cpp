#include "app/commands/farm/farm_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/commands/farm/test_plan.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class FarmStatus : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    run_.number = 2;
    run_.folder = folder_ / "film/farm/runs/0002";
    run_.engine = "slurm";
    run_.plan = test::test_plan(folder_);
    fs::create_directories(run_.folder / "attempts");
  }

  //! Writes the record of an attempt and its log.
  void attempt(const std::string& name, const std::string& record, const std::string& log = "") const {
    std::ofstream(run_.folder / "attempts" / name) << record;
    std::ofstream(run_.folder / "attempts" / (name + ".log")) << log;
  }

  //! Returns the states of the tasks of step render: 1:12, 13:24 and 49:60.
  [[nodiscard]] std::vector<TaskState> render_states(QueueState queue) const {
    std::vector<TaskState> states;
    for (const TaskStatus& task : statuses(queue)) {
      if (task.step == "render") {
        states.push_back(task.state);
      }
    }
    return states;
  }

  [[nodiscard]] std::vector<TaskStatus> statuses(QueueState queue) const {
    return task_statuses(run_, read_attempts(run_.folder), [queue](const FarmStep&, std::size_t) { return queue; });
  }

  FarmRun run_;
};

TEST_F(FarmStatus, OfATaskIsThatOfItsBestAttempt) {
  attempt("render-1-12.n1-7-1", "began 100 render 1:12 7 n1\nended 160 0\n");
  attempt("render-1-12.n2-8-2", "began 120 render 1:12 8 n2\nended 170 1\n");
  attempt("render-13-24.n1-9-3", "began 100 render 13:24 9 n1\nended 160 2\n");
  EXPECT_EQ(render_states(QueueState::absent),
            (std::vector{TaskState::done, TaskState::failed, TaskState::not_started}));
}

TEST_F(FarmStatus, OfATaskInTheQueueIsRunningOrWaiting) {
  attempt("render-1-12.n1-7-1", "began 100 render 1:12 7 n1\n");
  EXPECT_EQ(render_states(QueueState::running),
            (std::vector{TaskState::running, TaskState::waiting, TaskState::waiting}));
  EXPECT_EQ(render_states(QueueState::waiting),
            (std::vector{TaskState::waiting, TaskState::waiting, TaskState::waiting}));
  EXPECT_TRUE(is_active(statuses(QueueState::waiting)));
}

TEST_F(FarmStatus, OfATaskThatVanishedIsFailed) {
  attempt("render-1-12.n1-7-1", "began 100 render 1:12 7 n1\n");
  EXPECT_EQ(render_states(QueueState::absent).front(), TaskState::failed);
  EXPECT_THAT(status_text(run_, statuses(QueueState::absent)),
              HasSubstr("failed: render 1:12 on n1 ended without a status: it was killed, or its machine failed"));
}

TEST_F(FarmStatus, CountsFramesAndTasksAndShowsLogsOfFailures) {
  for (const char* frame :
       {"moving_000001.png", "moving_000002.png", "moving_000061.png", "moving.json", "other_000003.png"}) {
    std::ofstream(run_.plan.out / frame) << "x";
  }
  attempt("render-13-24.n1-9-3", "began 100 render 13:24 9 n1\nended 160 2\n", "first\nno memory\x1B[31m\n\n");
  EXPECT_THAT(
      status_text(run_, statuses(QueueState::absent)),
      AllOf(HasSubstr("moving: 2 of 60 frames exist in " + run_.plan.out.string() + "\nrun 2 (slurm):\n"),
            HasSubstr("  bake     2 not started\n"), HasSubstr("  render   1 failed, 2 not started\n"),
            HasSubstr("failed: render 13:24 on n1 ended with status 2 at "), HasSubstr("  no memory\\x1B[31m\n"),
            HasSubstr("log: " + (run_.folder / "attempts/render-13-24.n1-9-3.log").string()),
            HasSubstr("run the same ergodome farm command again to repair the film\n")));
}

TEST_F(FarmStatus, IgnoresRecordsThatAreNotComplete) {
  attempt("render-1-12.n1-7-1", "");
  attempt("render-1-12.n1-7-2", "began x render");
  EXPECT_TRUE(read_attempts(run_.folder).empty());
  EXPECT_THAT(status_text(run_, statuses(QueueState::absent)), Not(HasSubstr("failed")));
}

}  // namespace
}  // namespace ergodome
