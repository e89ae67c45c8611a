#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "render/channels/picture_wcs.h"
#include "render/channels/pixel_channels.h"
#include "render/output/frame_files.h"

// Writes channels to EXR and FITS files.

namespace ergodome {

//! A metadata entry of a frame of channels.
struct MetadataEntry {
  std::string name;     //!< name of the attribute in an EXR, after the prefix "ergodome:"
  std::string keyword;  //!< name of the keyword in a FITS header
  std::variant<std::string, double, int> value;
  std::string comment{};  //!< comment of the keyword in a FITS header
};

//! Writes channels, at least one, as one EXR of 32-bit floats; `compression` must be lossless.
//! Metadata entries become attributes. The file is written completely or not at all. Throws Error
//! if it cannot be written.
void write_channel_exr(const std::filesystem::path& path, ExrCompression compression, int width, int height,
                       const std::vector<PixelChannel>& channels, const std::vector<MetadataEntry>& metadata);

//! Writes channels as image extensions of one FITS file, in doubles, with checksums. Metadata
//! entries become keywords of the primary header; `wcs` goes into the header of each channel. Rows
//! run upwards in the file. Otherwise like write_channel_exr().
void write_channel_fits(const std::filesystem::path& path, int width, int height,
                        const std::vector<PixelChannel>& channels, const std::optional<PictureWcs>& wcs,
                        const std::vector<MetadataEntry>& metadata);

}  // namespace ergodome
