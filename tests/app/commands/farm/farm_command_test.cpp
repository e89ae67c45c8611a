#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/app/cli/command_line.h"
#include "tests/support/child_process.h"

// Tests of `ergodome farm`, mostly with the engine local. Tasks run the program itself.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::ChildProcess;
using test::CommandLine;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* farm_show =
    "duration_s = 1\nframe_rate_hz = 8\n[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nt_s = 0\nr = 30\n"
    "[[camera.key]]\nt_s = 1\nr = 20\nyaw_deg = 90\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 32\n";

class FarmCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("film.toml", farm_show);
  }

  //! Runs the command for the show, in tasks of three frames and without a bake.
  int farm(const std::string& more) {
    return run(
        std::string("farm film.toml --out 'my film' --backend cpu --bake 0 --program '" ERGODOME_CALL_PROGRAM "' ") +
        (more.find("--chunk") == std::string::npos ? "--chunk 3 " : "") + more);
  }

  [[nodiscard]] std::string frame(int number) const {
    return text("my film/film_00000" + std::to_string(number) + ".png");
  }
};

TEST_F(FarmCommand, MakesTheFramesOfASingleRun) {
  ASSERT_EQ(farm(""), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("render: 3 tasks done\nfilm: 1 task done\n8 frames in "));
  ASSERT_EQ(run("render film.toml --backend cpu --out whole"), 0) << output_;
  for (int number = 1; number <= 8; ++number) {
    EXPECT_TRUE(frame(number) == text("whole/film_00000" + std::to_string(number) + ".png")) << number;
  }
  EXPECT_EQ(text("my film/film.json"), text("whole/film.json"));
}

TEST_F(FarmCommand, BakesInPartsFirst) {
  ASSERT_EQ(run("farm film.toml --out film --backend cpu --chunk 8 --bake 2 --program '" ERGODOME_CALL_PROGRAM "'"), 0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("bake: 2 tasks done\njoin: 1 task done\nrender: 1 task done\n"));
  std::string trajectory;
  for (const auto& entry : fs::directory_iterator(folder_ / "film/farm")) {
    trajectory = entry.path().extension() == ".trajectory" ? entry.path().string() : trajectory;
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr(".part")));
  }
  ASSERT_EQ(run("render film.toml --backend cpu --out whole --trajectory '" + trajectory + "'"), 0) << output_;
  EXPECT_TRUE(text("whole/film_000005.png") == text("film/film_000005.png"));
}

TEST_F(FarmCommand, RepairsFramesThatAreMissingDamagedOrOfOtherSettings) {
  ASSERT_EQ(farm(""), 0) << output_;
  const std::string second = frame(2);
  const auto time_of = [&](int number) {
    return fs::last_write_time(folder_ / ("my film/film_00000" + std::to_string(number) + ".png"));
  };
  const auto first_time = time_of(1);
  const auto third_time = time_of(3);
  fs::remove(folder_ / "my film/film_000002.png");
  write("my film/film_000005.png", frame(5).substr(0, 300));
  ASSERT_EQ(run("render film.toml --backend cpu --out 'my film' --frames 8 --size 16"), 0) << output_;
  ASSERT_EQ(farm(""), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("render: 3 tasks done"));
  EXPECT_TRUE(frame(2) == second);
  EXPECT_EQ(time_of(1), first_time);
  EXPECT_EQ(time_of(3), third_time);
  EXPECT_EQ(run("render film.toml --backend cpu --out 'my film' --verify"), 0) << output_;
  ASSERT_EQ(farm(""), 0) << output_;
  EXPECT_THAT(output_, AllOf(Not(HasSubstr("render:")), HasSubstr("film: 1 task done")));
}

TEST_F(FarmCommand, ReportsAFailedTaskWithItsLogAndRepairsIt) {
  write("broken",
        "#!/bin/bash\n[[ $* != *4:6* ]] || { echo 'not enough memory' >&2; exit 9; }\nexec '" ERGODOME_CALL_PROGRAM
        "' \"$@\"\n");
  fs::permissions(folder_ / "broken", fs::perms::owner_all);
  EXPECT_EQ(run("farm film.toml --out 'my film' --backend cpu --bake 0 --chunk 3 --program ./broken"), 1);
  EXPECT_THAT(output_, HasSubstr("ergodome: farm: 1 task of step render failed; the last one (4:6) printed: not enough "
                                 "memory; see --status, and run the command again to repair the film\n"));
  EXPECT_EQ(run("farm --status 'my film'"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("film: 5 of 8 frames exist in "), HasSubstr("  render   2 done, 1 failed\n"),
                             HasSubstr("  film     1 not started\n"), HasSubstr("failed: render 4:6 on "),
                             HasSubstr(" ended with status 9 at "), HasSubstr("\n  not enough memory\n  log: ")));
  EXPECT_EQ(farm(""), 0) << output_;
  EXPECT_EQ(run("farm --status 'my film'"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("film: 8 of 8 frames exist"), HasSubstr("  render   1 done\n")));
}

TEST_F(FarmCommand, ChoosesTheSizeOfTasksFromMeasuredFrames) {
  ASSERT_EQ(farm("--dry-run --jobs 4 --chunk 3"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("a frame takes about ")));
  ASSERT_EQ(run("farm film.toml --out film --backend cpu --dry-run --jobs 4"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("a frame takes about "), HasSubstr("a task renders 2 frames")));
}

TEST_F(FarmCommand, PrintsScriptsAndChangesNothingInADryRun) {
  ASSERT_EQ(farm("--dry-run --engine slurm --partition gpu --gpus 1 --set 'sky.exposure=0.5' --movie film.mkv "
                 "--container 'apptainer exec \"my image.sif\"'"),
            0)
      << output_;
  EXPECT_THAT(
      output_,
      AllOf(HasSubstr("### submit.sh\n#!/bin/bash\n"), HasSubstr(" --partition=gpu --gpus=1 "),
            HasSubstr("submit render --job-name=film-render --output="),
            HasSubstr("attempt render \"$task\" apptainer exec \"my image.sif\" " ERGODOME_CALL_PROGRAM
                      " render film.toml '--out="),
            HasSubstr("--set=sky.exposure=0.5 --backend=cpu --resume --no-summary --frames \"$task\"\n"),
            HasSubstr(" --frames=1:8 --verify --movie=film.mkv\n"), HasSubstr("### render.tasks\n1:3\n4:6\n7:8\n")));
  EXPECT_FALSE(fs::exists(folder_ / "my film"));
}

TEST_F(FarmCommand, WritesATemplateOfOpenJobDescription) {
  ASSERT_EQ(farm("--engine openjd --frames 2:7"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("farm/runs/0001/job.json: render (2 tasks), film (1 task)"));
  const nlohmann::json job = nlohmann::json::parse(text("my film/farm/runs/0001/job.json"));
  EXPECT_EQ(job["steps"][0]["parameterSpace"]["taskParameterDefinitions"][0]["range"], "2-4,5-7");
  EXPECT_EQ(run("farm --cancel 'my film'"), 1);
  EXPECT_THAT(output_, HasSubstr("which this program does not control; cancel the job in its scheduler"));
}

TEST_F(FarmCommand, RefusesWhatHasNoEffectOrNoMeaningInOneLine) {
  const auto refused = [&](const std::string& words, const std::string& message) {
    EXPECT_EQ(run("farm " + words), 2) << words << ": " << output_;
    EXPECT_THAT(output_, HasSubstr(message)) << words;
  };
  refused("film.toml", "farm: has no folder for the frames; add --out DIR");
  refused("--out f", "farm: has nothing to render; name a show file");
  refused("film.toml --out f --engine lsf", "--engine");
  refused("film.toml --out f --chunk 0", "--chunk");
  refused("film.toml --out f --memory much", "\"much\" is not an amount of memory; write, for example, 8G");
  refused("film.toml --out f --partition gpu", "--partition");
  refused("film.toml --out f --gpus 1", "--gpus");
  refused("film.toml --out f --engine slurm --jobs 2", "--jobs");
  refused("film.toml --out f --status f", "--status");
  refused("film.toml --out f --bake 2 --lens live",
          "--bake 2: is not possible: --lens live uses no trajectory; leave it out");
  refused("film.toml --out f --bake 2 --budget 0.5px", "which needs the finished trajectory");
  refused("film.toml --out f --frames 9:10", "is not a frame of this show");
  refused("film.toml --out f --language de", "has no effect");
  EXPECT_FALSE(fs::exists(folder_ / "f"));
  EXPECT_EQ(run("farm --status nowhere"), 1);
  EXPECT_THAT(output_, HasSubstr("nowhere: contains no film of ergodome farm; name the folder that was --out"));
  EXPECT_EQ(run("farm --cancel nowhere"), 1);
}

TEST_F(FarmCommand, SubmitsToSlurmOnceAndAsksItsQueue) {
  const auto write_program = [&](const std::string& name, const std::string& text) {
    write("bin/" + name, "#!/bin/bash\ncd \"${0%/*}\" || exit\n" + text + "\n");
    fs::permissions(folder_ / "bin" / name, fs::perms::owner_all);
  };
  fs::create_directory(folder_ / "bin");
  write_program("sbatch", "echo x >>jobs; echo $((10 + $(wc -l <jobs)))");
  write_program("squeue", "cat queue");
  write_program("scancel", "echo \"$@\" >canceled");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ((folder_ / "bin").string() + ":" + path).c_str(), 1);
  ASSERT_EQ(farm("--engine slurm"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("submitted: render (3 tasks), film (1 task)\n"));
  // The first call of sbatch was for its version, so render has job 12 and film has job 13.
  write("bin/queue", "12 2 RUNNING\n12 3 PENDING\n13 N/A PENDING\n99 1 RUNNING\n");
  write("my film/farm/runs/0001/attempts/render-4-6.n1-7-1", "began 100 render 4:6 7 n1\n");
  write("my film/farm/runs/0001/attempts/render-1-3.n1-6-1", "began 90 render 1:3 6 n1\nended 99 1\n");
  EXPECT_EQ(run("farm --status 'my film'"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("  render   1 running, 1 waiting, 1 failed\n  film     1 waiting\n"),
                             HasSubstr("running: render 4:6 on n1 since ")));
  EXPECT_EQ(farm("--engine slurm"), 1);
  EXPECT_THAT(output_, HasSubstr("run 1 still has tasks in Slurm's queue; wait until they end (--status), or stop them "
                                 "with --cancel"));
  ASSERT_EQ(run("farm --cancel 'my film'"), 0) << output_;
  EXPECT_EQ(text("bin/canceled"), "13 12\n");
  write_program("squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1");
  EXPECT_EQ(farm("--engine slurm"), 1);
  EXPECT_THAT(output_, HasSubstr("squeue: slurm_load_jobs error: Unable to contact slurm controller; check"));
  EXPECT_EQ(farm(""), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("tasks of run 1 may still be in Slurm's queue"));
  ::setenv("PATH", path.c_str(), 1);
}

TEST_F(FarmCommand, StopsWhenItIsCanceled) {
  write("slow", "#!/bin/bash\ntouch begun; exec sleep 60\n");
  fs::permissions(folder_ / "slow", fs::perms::owner_all);
  const std::string farm_words = "farm film.toml --out film --backend cpu --bake 0 --chunk 3 --jobs 2 --program ./slow";
  ChildProcess farm(
      {"bash", "-c", "cd '" + folder_.string() + "' && exec '" ERGODOME_PROGRAM "' " + farm_words + " 2>&1"});
  for (int i = 0; i < 3000 && !fs::exists(folder_ / "begun"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_EQ(run("farm --status film"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("render   2 running, 1 waiting"), HasSubstr("\nrunning: render 1:3 on ")));
  EXPECT_EQ(run(farm_words), 1);
  EXPECT_THAT(output_, HasSubstr("is in use by another ergodome farm; wait until it ends, or stop it with --cancel"));
  ASSERT_EQ(run("farm --cancel film"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(" was asked to stop"));
  EXPECT_THAT(farm.output_until("run it again to continue", std::chrono::seconds(30)),
              HasSubstr("ergodome: farm: was stopped; run it again to continue"));
}

TEST_F(FarmCommand, ReportsThatNothingRunsWhichItCouldCancel) {
  ASSERT_EQ(farm(""), 0) << output_;
  EXPECT_EQ(run("farm --cancel 'my film'"), 1);
  EXPECT_THAT(output_, HasSubstr("no farm is running; see --status"));
}

TEST_F(FarmCommand, ReportsADamagedDescriptionOfARun) {
  ASSERT_EQ(farm("--engine openjd"), 0) << output_;
  write("my film/farm/runs/0001/run.json", "{\"engine\": 3}");
  EXPECT_EQ(run("farm --status 'my film'"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("run.json: is damaged ("), HasSubstr("run ergodome farm again")));
}

}  // namespace
}  // namespace ergodome
