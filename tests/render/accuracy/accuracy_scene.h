#pragma once

#include <string>

#include "content/show/reading/show_reader.h"
#include "render/accuracy/scene.h"
#include "tests/support/tiny_sky.h"

// A small show and fast settings, for tests of accuracy measurements.
namespace ergodome::test {

//! Returns a show on a small dome, at r = 6 M from a fast-spinning hole; `more` is appended to its
//! text, starting inside the [view] table.
inline Show small_dome(const std::string& more = {}) {
  Show show = parse_show(
      "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 6\ntheta_deg = 80\nphi_deg = 30\npitch_deg = -20\n[sky]\nmap "
      "= \"grid\"\n"
      "[view]\nprojection = \"dome\"\nsize_px = 48\n" +
          more,
      "small.toml");
  show.sky.map = tiny_sky();
  return show;
}

//! Returns settings for a fast measurement with few samples.
inline AccuracySettings few() {
  AccuracySettings settings;
  settings.moments = 1;
  settings.rounds = 1;
  settings.lattice = 16;
  settings.quick = true;
  return settings;
}

}  // namespace ergodome::test
