#include "tests/bench/published_sky.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "content/stars/star_catalogue.h"
#include "content/stars/star_file.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

constexpr std::size_t published_stars = 5047;
constexpr int published_width = 4096;

std::filesystem::path temporary(const char* name) { return std::filesystem::temp_directory_path() / name; }

std::string written_stars(const Show& show) {
  StarCatalogue brightest = load_stars(show);
  brightest.stars.resize(std::min(brightest.stars.size(), published_stars));
  const std::filesystem::path path = temporary("ergodome_bench.stars");
  write_star_file(brightest, path);
  return path.string();
}

std::string written_map(const Show& show) {
  const EnvironmentImage map = load_sky_map(show);
  Picture picture;
  picture.width = published_width;
  picture.height = published_width / 2;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const long texel = static_cast<long>(y) * map.height / picture.height * map.width +
                         static_cast<long>(x) * map.width / picture.width;
      const auto from = map.rgb.begin() + 3 * texel;
      picture.rgba.insert(picture.rgba.end(), {from[0], from[1], from[2], 1.0F});
    }
  }
  const std::filesystem::path path = temporary("ergodome_bench.exr");
  write_picture(path, {ImageFormat::exr, ExrCompression::zip, false}, picture, {});
  return path.string();
}

}  // namespace

Show published_show() {
  Show show = parse_show(
      "[hole]\nspin = 0.999\n[camera]\nobserver = \"geodesic\"\n[[camera.key]]\nr = 5\n[view]\nprojection = "
      "\"equirect\"\n"
      "[sky]\nmap = \"milky_way\"\nstars = \"bright_stars\"\nfaintest_mag = 10\n[effects]\nredshift = true\n"
      "magnification = true\npsf = { sigma_px = 0.5 }\ndiffraction = { brighter_than_mag = 2.0 }\n",
      "bench.toml");
  show.sky.stars = written_stars(show);
  show.sky.map = written_map(show);
  return show;
}

}  // namespace ergodome
