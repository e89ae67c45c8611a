#include "app/commands/render/frame_request.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "app/cli/show_loading.h"
#include "tests/app/cli/command_line.h"

// Tests of the request text, which identifies the content of a frame.
namespace ergodome {
namespace {

namespace fs = std::filesystem;

const std::string requested_show =
    "duration_s = 10\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 8\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 48\n";
//! A caption that is visible from 2 s to 6 s and fully opaque from 3 s to 5 s.
const std::string requested_caption =
    "[[caption]]\nfrom_s = 2\nto_s = 6\nfade_in_s = 1\nfade_out_s = 1\ntext = { en = \"Light\", de = \"Licht\" }\n";

class RequestsOfFrames : public test::CommandLine {
 protected:
  //! Returns the request text of the frame at a time [s] of the show small.toml.
  [[nodiscard]] std::string request_at(double time_s, const RenderOptions& options = {}) const {
    return FrameRequests(options, load_show((folder_ / "small.toml").string()), std::nullopt).at(time_s);
  }
  //! Returns the request text of the frame at a time [s] of a show with the given TOML text.
  [[nodiscard]] std::string request_of(const std::string& show, double time_s,
                                       const RenderOptions& options = {}) const {
    write("small.toml", show);
    return request_at(time_s, options);
  }
  static RenderOptions in_language(const std::string& language) {
    RenderOptions options;
    options.language = language;
    return options;
  }
};

TEST_F(RequestsOfFrames, HangOnWhatFilesHoldNotOnTheirTimes) {
  write("small.toml", requested_show);
  const std::string before = request_at(0.0);
  const fs::path file = folder_ / "sky.ppm";
  const fs::file_time_type time = fs::last_write_time(file);
  fs::last_write_time(file, time + std::chrono::seconds(2));
  EXPECT_EQ(request_at(0.0), before);
  std::string sky = text("sky.ppm");
  sky.back() = static_cast<char>(sky.back() ^ 1);
  write("sky.ppm", sky);
  fs::last_write_time(file, time);
  EXPECT_NE(request_at(0.0), before);
}

TEST_F(RequestsOfFrames, HangOnWhatMeshesName) {
  write("ship.obj", "mtllib ship.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("ship.mtl", "newmtl hull\nmap_Kd -s 2 2 1 hull plates.png\n");
  write("hull plates.png", "rust");
  write("small.toml", requested_show + "[[objects]]\nmesh = \"ship.obj\"\nmethod = \"trace\"\nposition = [5, 0, 0]\n");
  const std::string rusty = request_at(0.0);
  EXPECT_EQ(request_at(0.0), rusty);
  write("hull plates.png", "lead");
  const std::string leaden = request_at(0.0);
  EXPECT_NE(leaden, rusty) << "a picture that the materials name";
  write("ship.mtl", "newmtl hull\nKd 1 0 0\n");
  EXPECT_NE(request_at(0.0), leaden) << "the materials";
}

TEST_F(RequestsOfFrames, HangOnNoSoundAndNoChapters) {
  const std::string before = request_of(requested_show, 4.0);
  EXPECT_EQ(request_of(requested_show + "[[audio]]\nfile = \"music.flac\"\nfrom_s = 0\n", 4.0), before);
  EXPECT_EQ(request_of(requested_show + "[[chapter]]\nt_s = 4\ntitle = \"The shadow\"\n", 4.0), before);
}

TEST_F(RequestsOfFrames, HangOnCaptionsThatAreSeenAlone) {
  const std::string without = request_of(requested_show, 4.0);
  for (const double unseen_s : {1.9, 6.0}) {
    EXPECT_EQ(request_of(requested_show + requested_caption, unseen_s), without) << unseen_s;
  }
  for (const double seen_s : {2.1, 4.0, 5.9}) {
    EXPECT_NE(request_of(requested_show + requested_caption, seen_s), without) << seen_s;
  }
  RenderOptions heat;
  heat.view = "g";
  EXPECT_EQ(request_of(requested_show + requested_caption, 4.0, heat), request_of(requested_show, 4.0, heat));
}

TEST_F(RequestsOfFrames, HangOnHowMuchOfACaptionIsSeen) {
  std::string longer = requested_caption;
  longer.replace(longer.find("to_s = 6"), 8, "to_s = 7");
  const auto alike = [&](double time_s) {
    return request_of(requested_show + requested_caption, time_s) == request_of(requested_show + longer, time_s);
  };
  EXPECT_TRUE(alike(2.5)) << "while it comes";
  EXPECT_TRUE(alike(4.0)) << "while it is there in full";
  EXPECT_FALSE(alike(5.5)) << "while it goes";
}

TEST_F(RequestsOfFrames, HangOnACaptionsLookAndPlace) {
  const std::string before = request_of(requested_show + requested_caption, 4.0);
  for (const char* key : {"azimuth_deg = 5", "elevation_deg = 5", "roll_deg = 5", "letter_deg = 5", "width_deg = 5",
                          "color = [1, 0, 0]"}) {
    EXPECT_NE(request_of(requested_show + requested_caption + key + "\n", 4.0), before) << key;
  }
}

TEST_F(RequestsOfFrames, HangOnTheLanguageWhereItsWordsAreSeen) {
  write("small.toml", requested_show + requested_caption);
  EXPECT_EQ(request_at(1.0, in_language("de")), request_at(1.0));
  EXPECT_NE(request_at(4.0, in_language("de")), request_at(4.0));
  EXPECT_EQ(request_at(4.0, in_language("fr")), request_at(4.0)) << "English for both";
  std::string corrected = requested_caption;
  corrected.replace(corrected.find("Licht"), 5, "Liecht");
  EXPECT_EQ(request_of(requested_show + corrected, 4.0), request_of(requested_show + requested_caption, 4.0));
}

TEST_F(RequestsOfFrames, HangOnTheShowsLengthWhereSomethingDoes) {
  std::string longer = requested_show;
  longer.replace(longer.find("10"), 2, "20");
  const auto alike = [&](const RenderOptions& options) {
    return request_of(requested_show, 4.0, options) == request_of(longer, 4.0, options);
  };
  EXPECT_TRUE(alike({}));
  RenderOptions measured;
  measured.budget = {"0.5px"};
  EXPECT_FALSE(alike(measured));
  write("small.trajectory", "");
  EXPECT_FALSE(alike({})) << "it is left alone where its show is not as long";
}

}  // namespace
}  // namespace ergodome
