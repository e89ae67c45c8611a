#include "calibration/warps/blend_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration/warps/warp_mesh.h"
#include "content/files/whole_file.h"
#include "content/images/image_library.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 30U;

long pixels_of(const ImageShape& shape) { return static_cast<long>(shape.width) * shape.height; }

void check_shape(const ImageShape& shape, const std::string& name) {
  if (shape.width < 2 || shape.height < 2 || shape.depth > 1) {
    throw Error(name, fmt::format("is a mask of {} x {} pixels, too small", shape.width, shape.height),
                "use at least 2 x 2 pixels");
  }
  if (shape.width > max_mesh_side || shape.height > max_mesh_side ||
      pixels_of(shape) > static_cast<long>(max_mesh_nodes)) {
    throw Error(name, fmt::format("is a mask of {} x {} pixels, too large", shape.width, shape.height),
                fmt::format("use at most {} pixels a side and {} in total", max_mesh_side, max_mesh_nodes));
  }
  if (shape.channels != 1 && shape.channels != 3) {
    throw Error(name, fmt::format("has {} channels", shape.channels), "save it as gray or RGB, without transparency");
  }
}

}  // namespace

BlendMap parse_blend_map(std::span<const std::byte> bytes, const std::string& name) {
  std::string problem;
  const auto input = image_library().open(name, {bytes}, problem);
  if (!input) {
    throw Error(name, "cannot be read as an image: " + problem, "save the mask as a PNG with 8 or 16 bits per channel");
  }
  const ImageShape& shape = input->shape();
  check_shape(shape, name);
  BlendMap map{shape.width, shape.height, shape.channels, shape.sample_bytes > 1 ? 16 : 8, {}};
  map.values.resize(static_cast<std::size_t>(pixels_of(shape)) * static_cast<std::size_t>(shape.channels));
  if (!input->read_all(shape.channels, map.values.data())) {
    throw Error(name, "cannot be read: " + input->error(), "the file is truncated or damaged; save it again");
  }
  if (!std::all_of(map.values.begin(), map.values.end(), [](float value) { return value >= 0.0F && value <= 1.0F; })) {
    throw Error(name, "contains values outside 0 to 1", "save the mask as a PNG with 8 or 16 bits per channel");
  }
  return map;
}

bool has_shape_of(const BlendMap& map, int width_px, int height_px) {
  const double height = static_cast<double>(map.width) * height_px / width_px;
  return std::abs(map.height - height) <= std::max(1.0, 0.02 * height);
}

BlendMap in_shape_of(const BlendMap& map, int width_px, int height_px) {
  if (has_shape_of(map, width_px, height_px)) {
    return map;
  }
  BlendMap shaped{width_px, height_px, map.channels, map.bit_depth, {}};
  // Each sample is at the center of its rectangle of the raster.
  const auto position = [](int at, int count, int samples) {
    return std::clamp((at + 0.5) / count * samples - 0.5, 0.0, samples - 1.0);
  };
  const auto sample = [&](int x, int y, int channel) {
    const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
    return static_cast<double>(
        map.values[at * static_cast<std::size_t>(map.channels) + static_cast<std::size_t>(channel)]);
  };
  for (int row = 0; row < height_px; ++row) {
    const double y = position(row, height_px, map.height);
    const int top = std::min(static_cast<int>(y), map.height - 2);
    for (int column = 0; column < width_px; ++column) {
      const double x = position(column, width_px, map.width);
      const int left = std::min(static_cast<int>(x), map.width - 2);
      for (int c = 0; c < map.channels; ++c) {
        const double above = std::lerp(sample(left, top, c), sample(left + 1, top, c), x - left);
        const double below = std::lerp(sample(left, top + 1, c), sample(left + 1, top + 1, c), x - left);
        shaped.values.push_back(static_cast<float>(std::lerp(above, below, y - top)));
      }
    }
  }
  return shaped;
}

BlendMap read_blend_map(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, max_bytes, "give a mask as a PNG with 8 or 16 bits per channel");
  return parse_blend_map(std::as_bytes(std::span(bytes)), path.string());
}

std::string to_png(const BlendMap& map, const std::string& name) {
  std::vector<unsigned char> bytes;
  std::string problem;
  const auto output = image_library().create("png", &bytes, problem);
  const ImagePlan plan[] = {{map.width,
                             map.height,
                             map.channels,
                             map.bit_depth > 8 ? ImageSample::whole_16 : ImageSample::whole_8,
                             {},
                             {},
                             {}}};
  if (!output || !output->open(name, plan) || !output->write(map.values.data()) || !output->close()) {
    throw Error(name, "cannot be written: " + (output ? output->error() : problem), "free some memory");
  }
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace ergodome
