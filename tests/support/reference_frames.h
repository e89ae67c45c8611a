#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "render/output/image_writer.h"

// Frames that a person has looked at, in tests/data/frames. With ERGODOME_RENEW_REFERENCES=1 in the environment tests write them anew
// instead of comparing: look at each before it is committed.
namespace ergodome::test {

//! RGB bytes, the top row first.
struct SeenFrame {
  int width;
  int height;
  std::vector<std::uint8_t> rgb;
};

//! Compares a frame with its reference as an eye would: a pixel may be off by a tenth of full where edges and letters lie (drivers and fonts
//! round differently), but not one in fifty, and all of them together by a two-hundredth on average.
inline void expect_like_reference(const std::filesystem::path& path, const SeenFrame& frame) {
  const char* const renew = std::getenv("ERGODOME_RENEW_REFERENCES");
  if (renew != nullptr && std::string(renew) == "1") {
    std::filesystem::create_directories(path.parent_path());
    write_png(path, frame.rgb, frame.width, frame.height);
    GTEST_SKIP() << "written anew: " << path;
  }
  constexpr float visible = 0.1F;
  constexpr double most_visible = 0.02;
  constexpr double most_mean = 0.005;
  OIIO::ImageBuf reference(path.string());
  std::vector<std::uint8_t> bytes = frame.rgb;
  const OIIO::ImageBuf seen(OIIO::ImageSpec(frame.width, frame.height, 3, OIIO::TypeDesc::UINT8), bytes.data());
  ASSERT_TRUE(reference.init_spec(path.string(), 0, 0)) << path << " is missing: run with ERGODOME_RENEW_REFERENCES=1";
  ASSERT_EQ(reference.spec().width, frame.width) << path;
  ASSERT_EQ(reference.spec().height, frame.height) << path;
  const auto difference = OIIO::ImageBufAlgo::compare(seen, reference, visible, visible);
  const double share = static_cast<double>(difference.nfail) / (static_cast<double>(frame.width) * frame.height);
  EXPECT_LT(share, most_visible) << path;
  EXPECT_LT(difference.meanerror, most_mean) << path;
}

}  // namespace ergodome::test
