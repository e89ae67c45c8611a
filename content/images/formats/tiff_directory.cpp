#include "content/images/formats/tiff_directory.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <memory>

namespace ergodome {

namespace {

//! Bytes in memory, as a source for libtiff.
struct Source {
  std::span<const std::byte> bytes;
  std::uint64_t at = 0;
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
  Source& source = source_of(handle);
  const std::uint64_t left = source.bytes.size() - std::min<std::uint64_t>(source.at, source.bytes.size());
  const auto taken = static_cast<std::size_t>(std::min<std::uint64_t>(left, static_cast<std::uint64_t>(count)));
  if (taken > 0) {
    std::memcpy(to, source.bytes.data() + source.at, taken);
  }
  source.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t write_nothing(thandle_t /*handle*/, void* /*from*/, tmsize_t /*count*/) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int origin) {
  Source& source = source_of(handle);
  source.at = origin == SEEK_SET ? offset : (origin == SEEK_CUR ? source.at : source.bytes.size()) + offset;
  return source.at;
}

int close(thandle_t /*handle*/) { return 0; }
toff_t size(thandle_t handle) { return source_of(handle).bytes.size(); }

//! Suppresses libtiff's messages; OpenImageIO reports the same problems.
int ignore_message(TIFF* /*file*/, void* /*data*/, const char* /*module*/, const char* /*format*/, va_list /*values*/) {
  return 1;
}

using File = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

File open(const std::string& name, Source* memory) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), ignore_message, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_message, nullptr);
  constexpr const char* mode = "rmD";  // no memory map; offsets are loaded on demand
  return {memory == nullptr ? TIFFOpenExt(name.c_str(), mode, options.get())
                            : TIFFClientOpenExt(name.c_str(), mode, memory, read, write_nothing, seek, close, size,
                                                nullptr, nullptr, options.get()),
          &TIFFClose};
}

//! Returns the size of an uncompressed strip or tile [bytes]; 0 if it is compressed.
std::uint64_t plain_bytes(TIFF* file, bool tiled, std::uint32_t strip) {
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(file, TIFFTAG_COMPRESSION, &compression);
  if (compression != COMPRESSION_NONE) {
    return 0;
  }
  if (tiled) {
    return TIFFTileSize64(file);
  }
  std::uint32_t rows = 0;
  std::uint32_t height = 0;
  TIFFGetFieldDefaulted(file, TIFFTAG_ROWSPERSTRIP, &rows);
  TIFFGetField(file, TIFFTAG_IMAGELENGTH, &height);
  rows = std::clamp<std::uint32_t>(rows, 1, std::max<std::uint32_t>(height, 1));
  // The last strip of each plane may have fewer rows than the others.
  const std::uint32_t of_plane = (height + rows - 1) / rows;
  const std::uint32_t first = strip % std::max<std::uint32_t>(of_plane, 1) * rows;
  return TIFFVStripSize64(file, std::min(rows, height - std::min(first, height)));
}

std::string problem_of_image(TIFF* file, std::uint64_t file_bytes) {
  const bool tiled = TIFFIsTiled(file) != 0;
  const std::uint32_t count = tiled ? TIFFNumberOfTiles(file) : TIFFNumberOfStrips(file);
  for (std::uint32_t i = 0; i < count; ++i) {
    int failed = 0;
    const std::uint64_t offset = TIFFGetStrileOffsetWithErr(file, i, &failed);
    const std::uint64_t bytes = failed != 0 ? 0 : TIFFGetStrileByteCountWithErr(file, i, &failed);
    if (failed != 0 || offset == 0 || bytes == 0) {
      return "it is damaged: some of its pixels are missing";
    }
    if (offset > file_bytes || bytes > file_bytes - offset) {
      return "it is truncated: pixels lie beyond its end";
    }
    if (bytes < plain_bytes(file, tiled, i)) {
      return "it is damaged: it has fewer bytes than its pixels need";
    }
  }
  return "";
}

}  // namespace

std::string problem_of_tiff(const std::string& name, const std::optional<std::span<const std::byte>>& bytes) {
  Source memory{bytes.value_or(std::span<const std::byte>())};
  const File file = open(name, bytes ? &memory : nullptr);
  if (!file) {
    return "";  // The file cannot be opened; OpenImageIO reports why.
  }
  const std::uint64_t file_bytes = TIFFGetSizeProc(file.get())(TIFFClientdata(file.get()));
  return problem_of_image(file.get(), file_bytes);
}

std::string tiff_icc_profile(const std::string& name, const std::optional<std::span<const std::byte>>& bytes) {
  Source memory{bytes.value_or(std::span<const std::byte>())};
  const File file = open(name, bytes ? &memory : nullptr);
  std::uint32_t size = 0;
  const char* profile = nullptr;
  if (!file || TIFFGetField(file.get(), TIFFTAG_ICCPROFILE, &size, &profile) == 0 || profile == nullptr) {
    return "";
  }
  return {profile, size};
}

}  // namespace ergodome
