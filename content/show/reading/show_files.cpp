#include "content/show/reading/show_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "content/sky/environment_image.h"
#include "content/sky/sky_map.h"
#include "content/stars/star_catalogue.h"

namespace ergodome {

std::vector<NamedFile> files_of_pictures(const Show& show) {
  std::vector<NamedFile> files;
  const auto add = [&](const std::string& key, const std::string& name) {
    if (!name.empty()) {
      files.push_back({key, name});
    }
  };
  const auto add_image = [&](const std::string& key, const std::string& name) {
    const std::filesystem::path folder(show.folder);
    if (!name.empty()) {
      const std::string layer = layered_file(folder / name).layer;
      const std::size_t selection = layer.empty() ? 0 : layer.size() + 1;
      files.push_back({key, name.substr(0, name.size() - selection), layer});
    }
  };
  if (!is_built_in_sky(show.sky.map)) {
    add_image("sky.map", show.sky.map);
  }
  if (!is_built_in_catalogue(show.sky.stars)) {
    add("sky.stars", show.sky.stars);
  }
  if (show.effects.diffraction) {
    add("effects.diffraction.pattern", show.effects.diffraction->pattern);
  }
  for (std::size_t i = 0; i < show.shells.size(); ++i) {
    add_image(fmt::format("shells[{}].texture", i), show.shells[i].texture);
  }
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    add(fmt::format("objects[{}].mesh", i), show.objects[i].mesh);
  }
  return files;
}

std::vector<NamedFile> files_of_show(const Show& show) {
  std::vector<NamedFile> files = files_of_pictures(show);
  for (std::size_t i = 0; i < show.timeline.overlays.size(); ++i) {
    files.push_back({fmt::format("overlay[{}].image", i), show.timeline.overlays[i].image});
  }
  for (std::size_t i = 0; i < show.timeline.audio.size(); ++i) {
    files.push_back({fmt::format("audio[{}].file", i), show.timeline.audio[i].file});
  }
  return files;
}

bool is_there(const Show& show, const std::string& name) {
  std::error_code problem;
  return std::filesystem::is_regular_file(std::filesystem::path(show.folder) / name, problem);
}

bool is_folder(const Show& show, const std::string& name) {
  std::error_code problem;
  return std::filesystem::is_directory(std::filesystem::path(show.folder) / name, problem);
}

}  // namespace ergodome
