#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "render/channels/picture_wcs.h"
#include "render/channels/pixel_channels.h"
#include "render/output/frame_format.h"

namespace ergodome {

//! A fact about a frame of channels.
struct ChannelFact {
  std::string name;     //!< in an EXR, behind "ergodome:"
  std::string keyword;  //!< in a FITS header
  std::variant<std::string, double, int> value;
  std::string comment{};  //!< in a FITS header
};

//! Writes channels as one EXR of 32-bit floats; `compression` is lossless. Facts are attributes. The file is there whole or not at all; throws
//! Error where it cannot be written.
void write_channel_exr(const std::filesystem::path& path, ExrCompression compression, int width, int height,
                       const std::vector<PixelChannel>& channels, const std::vector<ChannelFact>& facts);

//! Writes channels as the image extensions of one FITS file, in doubles, with checksums. Facts are keywords of the primary header. Rows run
//! upwards. Otherwise as write_channel_exr().
void write_channel_fits(const std::filesystem::path& path, int width, int height,
                        const std::vector<PixelChannel>& channels, const std::optional<PictureWcs>& wcs,
                        const std::vector<ChannelFact>& facts);

}  // namespace ergodome
