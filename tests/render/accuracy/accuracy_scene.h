#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "content/show_reader.h"
#include "render/accuracy/scene.h"

namespace ergodome::test {

//! A map of the sky of few pixels, gone when the program ends: to load the built-in ones takes longer than these tests.
class TinySky {
 public:
  TinySky() : file_(std::filesystem::temp_directory_path() / ("ergodome-sky-" + std::to_string(::getpid()) + ".ppm")) {
    std::ofstream stream(file_);
    stream << "P3 64 32 255\n";
    unsigned value = 1;
    for (int i = 0; i < 3 * 64 * 32; ++i) {
      value = value * 1664525U + 1013904223U;
      stream << (value >> 24U) << '\n';
    }
  }
  ~TinySky() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  TinySky(const TinySky&) = delete;
  TinySky& operator=(const TinySky&) = delete;

  [[nodiscard]] std::string path() const { return file_.string(); }

 private:
  std::filesystem::path file_;
};

//! A show on a small dome, a fast hole at r = 6 M; `more` are further lines, of the view's table and after.
inline Show small_dome(const std::string& more = {}) {
  static const TinySky sky;
  Show show = parse_show(
      "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 6\ntheta_deg = 80\nphi_deg = 30\npitch_deg = -20\n[sky]\nmap "
      "= \"grid\"\n"
      "[view]\nprojection = \"dome\"\nsize_px = 48\n" +
          more,
      "small.toml");
  show.sky.map = sky.path();
  return show;
}

//! A quick look with few of everything.
inline AccuracySettings few() {
  AccuracySettings settings;
  settings.moments = 1;
  settings.rounds = 1;
  settings.lattice = 16;
  settings.quick = true;
  return settings;
}

}  // namespace ergodome::test
