#include "render/channels/channel_files.h"

#include <fmt/format.h>

#include "content/files/atomic_file.h"
#include "content/images/image_library.h"
#include "kernels/core/error.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

Error channels_cannot_be_written(const std::filesystem::path& path, const std::string& problem) {
  const std::string reason = disk_is_full(path) ? "the disk is full"
                             : problem.empty()  ? "the file system rejects it"
                                                : problem.substr(0, problem.find('\n'));
  return {path.string(), "cannot be written: " + reason, "check the folder, its permissions and the free space"};
}

FrameMetadata texts_of_metadata(const std::vector<MetadataEntry>& metadata) {
  FrameMetadata texts;
  for (const MetadataEntry& entry : metadata) {
    texts.emplace_back(entry.name, std::visit([](const auto& value) { return fmt::format("{}", value); }, entry.value));
  }
  return texts;
}

std::vector<FitsCard> primary_cards(const std::vector<MetadataEntry>& metadata) {
  std::vector<FitsCard> cards;
  cards.reserve(metadata.size());
  for (const MetadataEntry& entry : metadata) {
    cards.push_back({entry.keyword, entry.value, entry.comment});
  }
  return cards;
}

void add_wcs(const PictureWcs& wcs, std::vector<FitsCard>& cards) {
  constexpr const char* axes[] = {"VLON", "VLAT"};
  constexpr const char* comments[] = {"view longitude, 0 = ahead, positive right",
                                      "view latitude, 0 = level, positive up"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto named = [i](const char* keyword) { return fmt::format("{}{}", keyword, i + 1); };
    cards.push_back({named("CTYPE"), fmt::format("{}-{}", axes[i], wcs.code), comments[i]});
    cards.push_back({named("CUNIT"), "deg"});
    cards.push_back({named("CRPIX"), wcs.crpix[i]});
    cards.push_back({named("CDELT"), wcs.cdelt[i]});
    cards.push_back({named("CRVAL"), wcs.crval[i]});
  }
  if (wcs.lonpole_deg) {
    cards.push_back({"LONPOLE", *wcs.lonpole_deg});
  }
  for (const auto& [number, value] : wcs.pv2) {
    cards.push_back({fmt::format("PV2_{}", number), value});
  }
}

std::vector<FitsCard> image_cards(const ChannelMeaning& meaning, const std::optional<PictureWcs>& wcs) {
  std::vector<FitsCard> cards = {{"EXTNAME", meaning.name, meaning.meaning}};
  if (*meaning.unit != '\0') {
    cards.push_back({"BUNIT", meaning.unit});
  }
  if (wcs) {
    add_wcs(*wcs, cards);
  }
  return cards;
}

std::vector<float> values_by_pixel(const std::vector<PixelChannel>& channels) {
  std::vector<float> pixels(channels.size() * channels.front().values.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    for (std::size_t i = 0; i < channels[c].values.size(); ++i) {
      pixels[i * channels.size() + c] = static_cast<float>(channels[c].values[i]);
    }
  }
  return pixels;
}

}  // namespace

void write_channel_exr(const std::filesystem::path& path, ExrCompression compression, int width, int height,
                       const std::vector<PixelChannel>& channels, const std::vector<MetadataEntry>& metadata) {
  NumberImage image = {width, height, {}, values_by_pixel(channels)};
  for (const PixelChannel& channel : channels) {
    image.channels.emplace_back(channel.meaning.name);
  }
  write_numbers(path, compression, image, texts_of_metadata(metadata));
}

void write_channel_fits(const std::filesystem::path& path, int width, int height,
                        const std::vector<PixelChannel>& channels, const std::optional<PictureWcs>& wcs,
                        const std::vector<MetadataEntry>& metadata) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    std::vector<FitsImage> images;
    images.reserve(channels.size());
    for (const PixelChannel& channel : channels) {
      images.push_back({image_cards(channel.meaning, wcs), width, height, channel.values});
    }
    std::string problem;
    if (!image_library().write_fits(partial.string(), primary_cards(metadata), images, problem)) {
      throw channels_cannot_be_written(path, problem);
    }
  });
}

}  // namespace ergodome
