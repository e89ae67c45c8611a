#include "app/commands/render/frame_files.h"

#include <gtest/gtest.h>

#include "app/cli/setup_show.h"
#include "content/show/reading/show_reader.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

class FilesOfFrames : public test::FolderTest {};

TEST_F(FilesOfFrames, WishForTheTimeOfTheirFrameAndKeepIt) {
  const Show show = parse_show(
      "duration_s = 2\nframe_rate_hz = 5\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 8\n[sky]\nmap = \"milky_way\"\n"
      "[view]\nsize_px = 16\n[stereo]\nlayout = \"separate\"\nbaseline = 0.1\n",
      "files.toml");
  RenderOptions options;
  options.out = (folder_ / "frames").string();
  ShowRenderer renderer(show, Backend::cpu);
  FrameFiles files(options, renderer, {}, std::nullopt, FrameRequests(options, show, std::nullopt));
  files.go_to(3);
  const OutputWish wish = files.wish();
  ASSERT_TRUE(wish.show_time_s);
  EXPECT_DOUBLE_EQ(*wish.show_time_s, 0.6);
  std::vector<Picture> eyes = renderer.render_frame(*wish.show_time_s, files.choice());
  OutputFrame frame;
  frame.picture = std::move(eyes.at(0));
  EXPECT_FALSE(files.is_there(3));
  frame.right_eye = std::move(eyes.at(1));
  files.take(frame);
  EXPECT_TRUE(files.is_there(3));
  EXPECT_FALSE(files.is_there(2));
  EXPECT_EQ(files.missing(2, 4), 2);
  EXPECT_EQ(files.remove(), 2);
  EXPECT_FALSE(files.is_there(3));
}

}  // namespace
}  // namespace ergodome
