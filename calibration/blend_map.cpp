#include "calibration/blend_map.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>

#include "calibration/warp_mesh.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30U;

void check_shape(const OIIO::ImageSpec& spec, const std::string& name) {
  if (spec.width < 2 || spec.height < 2 || spec.depth > 1) {
    throw Error(name, fmt::format("is a mask of {} x {} pixels", spec.width, spec.height), "a mask has at least 2 x 2");
  }
  if (spec.width > most_mesh_side || spec.height > most_mesh_side ||
      spec.image_pixels() > static_cast<OIIO::imagesize_t>(most_mesh_nodes)) {
    throw Error(name, fmt::format("is a mask of {} x {} pixels", spec.width, spec.height),
                fmt::format("{} a side and {} in all are the most", most_mesh_side, most_mesh_nodes));
  }
  if (spec.nchannels != 1 && spec.nchannels != 3) {
    throw Error(name, fmt::format("has {} channels", spec.nchannels), "save it as grey or RGB, without transparency");
  }
}

}  // namespace

BlendMap parse_blend_map(std::span<const std::byte> bytes, const std::string& name) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto input = OIIO::ImageInput::open(name, nullptr, &memory);
  if (!input) {
    throw Error(name, "is not an image that can be read: " + OIIO::geterror(),
                "save the mask as a PNG of 8 or 16 bits");
  }
  const OIIO::ImageSpec& spec = input->spec();
  check_shape(spec, name);
  BlendMap map{spec.width, spec.height, spec.nchannels, spec.format.size() > 1 ? 16 : 8, {}};
  map.values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, map.values.data())) {
    throw Error(name, "cannot be read: " + input->geterror(), "the file seems torn; save it again");
  }
  if (!std::all_of(map.values.begin(), map.values.end(), [](float value) { return value >= 0.0F && value <= 1.0F; })) {
    throw Error(name, "holds values outside 0 to 1", "save the mask as a PNG of 8 or 16 bits");
  }
  return map;
}

BlendMap read_blend_map(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, most_bytes, "give a mask as a PNG of 8 or 16 bits");
  return parse_blend_map(std::as_bytes(std::span(bytes)), path.string());
}

std::string to_png(const BlendMap& map, const std::string& name) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("png", &memory);
  const auto type = map.bit_depth > 8 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
  const OIIO::ImageSpec spec(map.width, map.height, map.channels, type);
  if (!output || !output->open(name, spec) || !output->write_image(OIIO::TypeDesc::FLOAT, map.values.data()) ||
      !output->close()) {
    throw Error(name, "cannot be written: " + (output ? output->geterror() : OIIO::geterror()), "free some memory");
  }
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace ergodome
