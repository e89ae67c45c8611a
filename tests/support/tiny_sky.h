#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace ergodome::test {

//! A file with a sky map of a few pixels, which is deleted when the program ends. Loading the
//! built-in maps would take longer than the tests.
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

//! Returns the path of the map.
inline std::string tiny_sky() {
  static const TinySky sky;
  return sky.path();
}

}  // namespace ergodome::test
