#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/openxr_runtime/test_head.h"

namespace ergodome::openxr_test {

namespace {

using nlohmann::json;

//! Mistakes of the client and the violations that the runtime must report.
struct Mistake {
  const char* scenario;
  const char* violation;
};

const std::vector<Mistake> mistakes = {{"begin_without_wait", "frame_order"},
                                       {"blend_mode", "blend_mode"},
                                       {"destroy_order", "destroy_order"},
                                       {"display_time", "display_time"},
                                       {"end_without_begin", "frame_order"},
                                       {"image_not_released", "image_not_released"},
                                       {"next_pointer", "next_pointer"},
                                       {"not_running", "not_running"},
                                       {"rect", "rect"},
                                       {"release_without_wait", "swapchain_order"},
                                       {"structure_type", "structure_type"},
                                       {"sync_without_focus", "sync_without_focus"},
                                       {"view_fov", "view_fov"},
                                       {"view_pose", "view_pose"},
                                       {"wait_twice", "frame_order"},
                                       {"wait_without_acquire", "swapchain_order"}};

//! Runs all scenarios in one client, because a virtual display takes long to start.
class OpenXrTestRuntime : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (std::system("command -v xvfb-run >/dev/null") != 0) {
      return;
    }
    folder = std::filesystem::temp_directory_path() / ("ergodome-openxr-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "input.txt") << "40 /user/hand/right/input/trigger/value 1\n";
    // OpenGL drivers leak memory, and they are unloaded before the leaks could be attributed to them.
    std::string command = "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 XR_RUNTIME_JSON='" ERGODOME_OPENXR_RUNTIME
                          "' xvfb-run -a -s '-screen 0 640x480x24' '" ERGODOME_OPENXR_CLIENT "' '" +
                          folder.string() + "' clean validated hostile:changes_context,gl_error,restart,slow_wait";
    for (const Mistake& mistake : mistakes) {
      command += std::string(" ") + mistake.scenario;
    }
    command += " >'" + (folder / "output").string() + "' 2>&1";
    std::system(command.c_str());
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder); }

  void SetUp() override {
    if (folder.empty()) {
      GTEST_SKIP() << "no virtual display";
    }
  }

  static std::string text(const std::string& name) {
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  static std::vector<json> log_of(const std::string& scenario) {
    std::vector<json> lines;
    std::ifstream file(folder / (scenario + ".jsonl"));
    for (std::string line; std::getline(file, line);) {
      lines.push_back(json::parse(line));
    }
    return lines;
  }

  //! Returns the values of a key in a log, in the order of the lines.
  static std::vector<json> values(const std::string& scenario, const std::string& key) {
    std::vector<json> found;
    for (const json& line : log_of(scenario)) {
      if (line.contains(key)) {
        found.push_back(line[key]);
      }
    }
    return found;
  }

  static inline std::filesystem::path folder;
};

TEST_F(OpenXrTestRuntime, ShowsFramesOfAClientWithoutMistakes) {
  EXPECT_THAT(values("clean", "violation"), testing::IsEmpty()) << text("clean.jsonl");
  EXPECT_THAT(values("clean", "state"), testing::ElementsAre("IDLE", "READY", "SYNCHRONIZED", "VISIBLE", "FOCUSED",
                                                             "VISIBLE", "SYNCHRONIZED", "STOPPING", "IDLE", "EXITING"));
  const std::vector<json> summaries = values("clean", "summary");
  ASSERT_EQ(summaries.size(), 1U) << text("output");
  EXPECT_EQ(summaries[0]["frames"], 60);
  EXPECT_EQ(summaries[0]["frames_with_layers"], 58);
  EXPECT_EQ(summaries[0]["calls"]["xrEndFrame"], 60);
}

TEST_F(OpenXrTestRuntime, PassesOpenXrsValidation) {
  EXPECT_EQ(text("clean.txt"), "");
  // The layer is active: it rejects a wrong type before the runtime sees it.
  EXPECT_NE(text("validated.txt").find("XrViewState"), std::string::npos) << text("output");
  EXPECT_THAT(values("validated", "violation"), testing::IsEmpty());
}

TEST_F(OpenXrTestRuntime, ReportsEveryMistake) {
  for (const Mistake& mistake : mistakes) {
    EXPECT_THAT(values(mistake.scenario, "violation"),
                testing::AllOf(testing::Not(testing::IsEmpty()), testing::Each(mistake.violation)))
        << mistake.scenario << '\n'
        << text("output");
  }
}

TEST_F(OpenXrTestRuntime, LocatesTheEyesWhereTheClosedFormsAre) {
  int frames = 0;
  for (const json& line : log_of("clean")) {
    if (!line.contains("layers") || line["layers"].empty()) {
      continue;
    }
    ++frames;
    const std::int64_t time_ns = line["display_time_ns"];
    const Pose eye = compose(head_in_stage(time_ns), eye_in_head(1, 0.064));
    const FieldOfView fov = field_of_view(1, time_ns);
    const json& view = line["layers"][0]["views"][1];
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(view["pose"][i].get<double>(), eye.position[i], 1e-6);
      EXPECT_NEAR(view["pose"][3 + i].get<double>(), eye.rotation[i], 1e-6);
    }
    EXPECT_NEAR(view["fov"][0].get<double>(), fov.left, 1e-6);
    EXPECT_NEAR(view["fov"][3].get<double>(), fov.down, 1e-6);
  }
  EXPECT_EQ(frames, 58);
}

TEST_F(OpenXrTestRuntime, WritesPicturesWithTheTopRowFirst) {
  const std::string header = "P6\n32 24\n255\n";
  // The trigger is pressed in frame 50, which adds blue to the upper half.
  const std::string left = text("clean/frame-00050-left.ppm");
  ASSERT_EQ(left.size(), header.size() + 3 * 32 * 24) << text("output");
  EXPECT_EQ(left.substr(0, header.size() + 3), header + "\xff" + std::string(1, '\0') + "\xff");
  EXPECT_EQ(left.substr(left.size() - 3), std::string(2, '\0') + "\xff");
  EXPECT_EQ(text("clean/frame-00050-right.ppm").substr(header.size(), 3), std::string(1, '\0') + "\xff\xff");
}

TEST_F(OpenXrTestRuntime, TroublesAClientThatCopes) {
  EXPECT_THAT(values("hostile", "violation"), testing::IsEmpty()) << text("hostile.jsonl");
  const std::vector<json> sessions = values("hostile", "session");
  EXPECT_EQ(std::count(sessions.begin(), sessions.end(), "begun"), 2);
  ASSERT_EQ(values("hostile", "summary").size(), 1U) << text("output");
  EXPECT_EQ(values("hostile", "summary")[0]["foreign_contexts"], 0);
  EXPECT_EQ(text("hostile/frame-00050-left.ppm"), text("clean/frame-00050-left.ppm"));
}

}  // namespace

}  // namespace ergodome::openxr_test
