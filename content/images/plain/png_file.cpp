#include "content/images/plain/png_file.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>

#include "content/images/formats/image_bytes.h"
#include "content/images/formats/png_chunks.h"
#include "content/images/plain/png_filter.h"

namespace ergodome {

namespace {

//! Compresses twice as fast as zlib's level 4, to the same size.
constexpr int png_compression_level = 1;
constexpr std::size_t largest_png_bytes = std::size_t{1} << 28U;

std::string big_endian_bytes(std::uint32_t number) {
  return {static_cast<char>(number >> 24U), static_cast<char>(number >> 16U), static_cast<char>(number >> 8U),
          static_cast<char>(number)};
}

std::size_t png_row_bytes(int width, int channels, ImageSample sample) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) *
         (sample == ImageSample::whole_16 ? 2 : 1);
}

//! An array of bytes without initial values.
struct RawBytes {
  explicit RawBytes(std::size_t size) : bytes(std::make_unique_for_overwrite<std::uint8_t[]>(size)), count(size) {}
  std::unique_ptr<std::uint8_t[]> bytes;
  std::size_t count;
};

class PngOutput final : public ImageOutput {
 public:
  bool open(const std::string& path, std::span<const ImagePlan> parts) override {
    plan_ = parts.front();
    file_.reset(std::fopen(path.c_str(), "wb"));
    return file_ != nullptr || note_error();
  }
  bool open_next(const std::string& /*path*/, const ImagePlan& /*part*/) override { return false; }

  bool write(const float* /*pixels*/) override { return false; }
  bool write(const std::uint8_t* pixels) override {
    const std::size_t row_bytes = png_row_bytes(plan_.width, plan_.channels, plan_.sample);
    return write_rows([&](int y) { return std::span(pixels + row_bytes * static_cast<std::size_t>(y), row_bytes); });
  }
  bool write(const std::uint16_t* pixels) override {
    std::vector<std::uint8_t> row(png_row_bytes(plan_.width, plan_.channels, plan_.sample));
    return write_rows([&](int y) {
      const std::uint16_t* from = pixels + row.size() / 2 * static_cast<std::size_t>(y);
      for (std::size_t i = 0; i < row.size(); i += 2, ++from) {
        row[i] = static_cast<std::uint8_t>(*from >> 8U);
        row[i + 1] = static_cast<std::uint8_t>(*from);
      }
      return std::span<const std::uint8_t>(row);
    });
  }

  bool close() override {
    std::FILE* const file = file_.release();
    return file != nullptr && (std::fclose(file) == 0 || note_error());
  }
  std::string error() override { return error_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  bool note_error() {
    error_ = std::strerror(errno);
    return false;
  }

  bool write_bytes(std::string_view bytes) {
    return std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size() || note_error();
  }

  //! `data` must not be a null pointer, for which libdeflate would restart the checksum.
  bool write_chunk(std::string_view kind, std::string_view data) {
    const std::uint32_t sum = libdeflate_crc32(libdeflate_crc32(0, kind.data(), kind.size()), data.data(), data.size());
    return write_bytes(big_endian_bytes(static_cast<std::uint32_t>(data.size()))) && write_bytes(kind) &&
           write_bytes(data) && write_bytes(big_endian_bytes(sum));
  }

  //! Writes gamma, rendering intent and primaries of sRGB.
  bool write_srgb() {
    std::string chromaticities;
    for (const std::uint32_t number : {31270U, 32900U, 64000U, 33000U, 30000U, 60000U, 15000U, 6000U}) {
      chromaticities += big_endian_bytes(number);
    }
    return write_chunk("gAMA", big_endian_bytes(45'455)) && write_chunk("sRGB", std::string_view("\x03", 1)) &&
           write_chunk("cHRM", chromaticities);
  }

  //! Writes the chunks before the pixels, as libpng and OpenImageIO do.
  bool write_head() {
    std::string shape = big_endian_bytes(static_cast<std::uint32_t>(plan_.width)) +
                        big_endian_bytes(static_cast<std::uint32_t>(plan_.height));
    shape += plan_.sample == ImageSample::whole_16 ? '\x10' : '\x08';
    shape += plan_.channels == 4 ? '\x06' : '\x02';
    shape.append(3, '\0');
    const std::pair<std::string, std::string> srgb("oiio:ColorSpace", "sRGB");
    const bool is_srgb = std::ranges::find(plan_.texts, srgb) != plan_.texts.end();
    bool written = write_bytes(png_signature) && write_chunk("IHDR", shape) && (!is_srgb || write_srgb()) &&
                   write_chunk("oFFs", std::string(9, '\0'));
    for (const auto& [name, value] : plan_.texts) {
      // A text ends at the first zero byte.
      written = written && write_chunk("tEXt", name + '\0' + value.substr(0, value.find('\0')));
    }
    return written;
  }

  //! Filters and compresses all rows, and writes them and the end of the file.
  template <class Row>
  bool write_rows(const Row& row) {
    const std::size_t row_bytes = png_row_bytes(plan_.width, plan_.channels, plan_.sample);
    const RawBytes filtered(static_cast<std::size_t>(plan_.height) * (row_bytes + 1));
    PngRows rows(row_bytes, row_bytes / static_cast<std::size_t>(plan_.width));
    for (int y = 0; y < plan_.height; ++y) {
      rows.filter(row(y), filtered.bytes.get() + static_cast<std::size_t>(y) * (row_bytes + 1));
    }
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(png_compression_level), &libdeflate_free_compressor);
    if (!compressor) {
      throw std::bad_alloc();
    }
    const RawBytes packed(libdeflate_zlib_compress_bound(compressor.get(), filtered.count));
    const std::size_t size = libdeflate_zlib_compress(compressor.get(), filtered.bytes.get(), filtered.count,
                                                      packed.bytes.get(), packed.count);
    return write_head() && write_chunk("IDAT", {reinterpret_cast<const char*>(packed.bytes.get()), size}) &&
           write_chunk("IEND", "");
  }

  ImagePlan plan_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string error_;
};

//! Returns the compressed pixels of a PNG whose chunks are correct.
std::string packed_pixels_of(std::string_view png) {
  std::string packed;
  for (std::size_t at = png_signature.size(); at + 8 <= png.size();) {
    const std::size_t length = big_endian_word(png.substr(at));
    if (png.substr(at + 4, 4) == "IDAT") {
      packed += png.substr(at + 8, length);
    }
    at += length + 12;
  }
  return packed;
}

//! Returns true if compressed pixels have the expected number of bytes, and rows with known
//! filters.
bool are_whole_rows(const std::string& packed, std::size_t rows, std::size_t row_bytes) {
  constexpr unsigned last_filter = 4;
  const RawBytes filtered(rows * (row_bytes + 1));
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) {
    throw std::bad_alloc();
  }
  bool whole = libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), filtered.bytes.get(),
                                          filtered.count, nullptr) == LIBDEFLATE_SUCCESS;
  for (std::size_t y = 0; whole && y < rows; ++y) {
    whole = filtered.bytes[y * (row_bytes + 1)] <= last_filter;
  }
  return whole;
}

}  // namespace

std::unique_ptr<ImageOutput> png_output() { return std::make_unique<PngOutput>(); }

bool is_for_png_output(const ImagePlan& plan) {
  return (plan.sample == ImageSample::whole_8 || plan.sample == ImageSample::whole_16) &&
         (plan.channels == 3 || plan.channels == 4) &&
         static_cast<std::size_t>(plan.height) * png_row_bytes(plan.width, plan.channels, plan.sample) <=
             largest_png_bytes;
}

std::optional<bool> is_whole_png(const std::string& path, int width, int height) {
  constexpr std::size_t head_bytes = 29;
  const ImageBytes file(path, std::nullopt);
  const std::string head = file.head(head_bytes);
  if (head.size() < head_bytes || !head.starts_with(png_signature) || head.substr(12, 4) != "IHDR") {
    return std::nullopt;
  }
  const auto bits = static_cast<unsigned char>(head[24]);
  const auto color_type = static_cast<unsigned char>(head[25]);
  ImagePlan plan;
  plan.width = width;
  plan.height = height;
  plan.channels = color_type == 6 ? 4 : 3;
  plan.sample = bits == 16 ? ImageSample::whole_16 : ImageSample::whole_8;
  if ((bits != 8 && bits != 16) || (color_type != 2 && color_type != 6) || head[28] != 0 || !is_for_png_output(plan)) {
    return std::nullopt;
  }
  if (big_endian_word(std::string_view(head).substr(16)) != static_cast<std::uint32_t>(width) ||
      big_endian_word(std::string_view(head).substr(20)) != static_cast<std::uint32_t>(height)) {
    return false;
  }
  const std::string png = file.all();
  const auto bytes = std::as_bytes(std::span(png));
  if (!problem_of_png(ImageBytes(path, bytes).from_start(), PngExtent::to_end).empty()) {
    return false;
  }
  return are_whole_rows(packed_pixels_of(png), static_cast<std::size_t>(height),
                        png_row_bytes(width, plan.channels, plan.sample));
}

}  // namespace ergodome
