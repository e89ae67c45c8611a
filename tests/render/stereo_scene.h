#pragma once

#include <string>

#include "content/show/reading/show_reader.h"
#include "render/picture/picture.h"
#include "tests/support/tiny_sky.h"

// Shows with two eyes, for tests of stereo.
namespace ergodome::test {

inline Show show_of_eyes(const std::string& stereo,
                         const std::string& view = "projection = \"pinhole\"\nfov_deg = 100\nsize_px = 400\n",
                         const std::string& position = "r = 9\ntheta_deg = 70\n") {
  Show show = parse_show("[hole]\nspin = 0.95\n[camera]\n[[camera.key]]\n" + position + "[view]\n" + view +
                             "[stereo]\nlayout = \"separate\"\n" + stereo,
                         "stereo.toml");
  show.sky.map = tiny_sky();
  return show;
}

inline float coverage_at(const Picture& picture, int x, int y) {
  return picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + 3];
}

}  // namespace ergodome::test
