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

// Reference frames are in tests/data/frames, and each was checked by a person. If the environment
// variable ERGODOME_RENEW_REFERENCES is 1, tests overwrite them instead of comparing with them.
// Check each by eye before you commit it.
namespace ergodome::test {

//! A frame as displayed, in 8-bit RGB, row by row from the top.
struct SeenFrame {
  int width;
  int height;
  std::vector<std::uint8_t> rgb;
};

//! Compares a frame with its reference. Tolerates invisible differences, because drivers and fonts
//! round differently at edges and letters: fewer than one pixel in fifty may differ by more than a
//! tenth of the full range, and the mean difference must be less than 1/200.
inline void expect_like_reference(const std::filesystem::path& path, const SeenFrame& frame) {
  const char* const renew = std::getenv("ERGODOME_RENEW_REFERENCES");
  if (renew != nullptr && std::string(renew) == "1") {
    std::filesystem::create_directories(path.parent_path());
    write_png(path, frame.rgb, frame.width, frame.height);
    GTEST_SKIP() << "written anew: " << path;
  }
  constexpr float visible = 0.1F;
  constexpr double max_visible = 0.02;
  constexpr double max_mean = 0.005;
  OIIO::ImageBuf reference(path.string());
  std::vector<std::uint8_t> bytes = frame.rgb;
  const OIIO::ImageBuf seen(OIIO::ImageSpec(frame.width, frame.height, 3, OIIO::TypeDesc::UINT8), bytes.data());
  ASSERT_TRUE(reference.init_spec(path.string(), 0, 0)) << path << " is missing: run with ERGODOME_RENEW_REFERENCES=1";
  ASSERT_EQ(reference.spec().width, frame.width) << path;
  ASSERT_EQ(reference.spec().height, frame.height) << path;
  const auto difference = OIIO::ImageBufAlgo::compare(seen, reference, visible, visible);
  const double share = static_cast<double>(difference.nfail) / (static_cast<double>(frame.width) * frame.height);
  EXPECT_LT(share, max_visible) << path;
  EXPECT_LT(difference.meanerror, max_mean) << path;
}

}  // namespace ergodome::test
