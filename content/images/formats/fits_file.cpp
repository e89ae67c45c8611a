#include "content/images/formats/fits_file.h"

#include <fitsio.h>

#include <array>
#include <cstdlib>
#include <fstream>

namespace ergodome {

namespace {

//! A FITS file in memory. It is used because CFITSIO cannot write into an existing file on the
//! disk.
class FitsMemory {
 public:
  explicit FitsMemory(int& status) { fits_create_memfile(&file_, &bytes_, &size_, growth, std::realloc, &status); }
  ~FitsMemory() {
    if (file_ != nullptr) {
      int status = 0;
      fits_close_file(file_, &status);
    }
    std::free(bytes_);
  }
  FitsMemory(const FitsMemory&) = delete;
  FitsMemory& operator=(const FitsMemory&) = delete;

  [[nodiscard]] fitsfile* file() const { return file_; }

  //! Returns the bytes of the current header and its data.
  [[nodiscard]] std::span<const char> unit(int& status) const {
    LONGLONG head = 0;
    LONGLONG data = 0;
    LONGLONG end = 0;
    fits_flush_file(file_, &status);
    fits_get_hduaddrll(file_, &head, &data, &end, &status);
    return status == 0 ? std::span(static_cast<const char*>(bytes_) + head, static_cast<std::size_t>(end - head))
                       : std::span<const char>();
  }

 private:
  static constexpr std::size_t block_bytes = 2880;
  static constexpr std::size_t growth = 1024 * block_bytes;

  std::size_t size_ = block_bytes;
  void* bytes_ = std::malloc(block_bytes);
  fitsfile* file_ = nullptr;
};

void write_cards(fitsfile* file, std::span<const FitsCard> cards, int& status) {
  for (const FitsCard& card : cards) {
    const char* const comment = card.comment.empty() ? nullptr : card.comment.c_str();
    if (const auto* const text = std::get_if<std::string>(&card.value)) {
      fits_write_key_longstr(file, card.name.c_str(), text->c_str(), comment, &status);
    } else if (const int* const whole = std::get_if<int>(&card.value)) {
      fits_write_key_lng(file, card.name.c_str(), *whole, comment, &status);
    } else {
      fits_write_key_dbl(file, card.name.c_str(), std::get<double>(card.value), -15, comment, &status);
    }
  }
}

std::string message_of(int status) {
  std::array<char, FLEN_STATUS> text{};
  fits_get_errstatus(status, text.data());
  fits_clear_errmsg();
  return text.data();
}

//! Adds checksums to the current header and its data, and appends both to an open file.
void append_unit(std::ofstream& to, const FitsMemory& memory, int& status) {
  fits_write_chksum(memory.file(), &status);
  const std::span<const char> bytes = memory.unit(status);
  to.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void append_image(std::ofstream& to, const FitsImage& image, int& status) {
  const FitsMemory memory(status);
  std::array<long, 2> axes = {image.width, image.height};
  // CFITSIO requires a primary header before an extension; only the extension's bytes are appended.
  fits_create_img(memory.file(), BYTE_IMG, 0, nullptr, &status);
  fits_create_img(memory.file(), DOUBLE_IMG, 2, axes.data(), &status);
  write_cards(memory.file(), image.cards, status);
  // CFITSIO takes a non-const pointer but does not change the pixels.
  auto* const pixels = const_cast<double*>(image.pixels.data());
  for (LONGLONG row = 0; row < image.height; ++row) {
    const LONGLONG from = (image.height - 1 - row) * image.width;
    fits_write_img(memory.file(), TDOUBLE, 1 + row * image.width, image.width, pixels + from, &status);
  }
  append_unit(to, memory, status);
}

//! An open FITS file on the disk. The file name is used literally, without CFITSIO's filter syntax.
class FitsInput {
 public:
  explicit FitsInput(const std::string& path) { fits_open_diskfile(&file_, path.c_str(), READONLY, &status_); }
  ~FitsInput() {
    int status = 0;
    if (file_ != nullptr) {
      fits_close_file(file_, &status);
    }
    fits_clear_errmsg();
  }
  FitsInput(const FitsInput&) = delete;
  FitsInput& operator=(const FitsInput&) = delete;

  [[nodiscard]] int units() {
    int count = 0;
    fits_get_num_hdus(file_, &count, &status_);
    return status_ == 0 ? count : 0;
  }

  //! Returns true if both checksums of a header and its data exist and are correct. Headers are
  //! counted from 1.
  [[nodiscard]] bool is_right(int unit) {
    int data = 0;
    int all = 0;
    fits_movabs_hdu(file_, unit, nullptr, &status_);
    fits_verify_chksum(file_, &data, &all, &status_);
    return status_ == 0 && data == 1 && all == 1;
  }

  [[nodiscard]] std::string text(const std::string& name) {
    char* found = nullptr;
    fits_movabs_hdu(file_, 1, nullptr, &status_);
    fits_read_key_longstr(file_, name.c_str(), &found, nullptr, &status_);
    std::string value = status_ == 0 && found != nullptr ? found : "";
    if (found != nullptr) {
      int status = 0;
      fits_free_memory(found, &status);
    }
    return value;
  }

 private:
  fitsfile* file_ = nullptr;
  int status_ = 0;
};

}  // namespace

bool write_fits_file(const std::string& path, std::span<const FitsCard> primary, std::span<const FitsImage> images,
                     std::string& problem) {
  std::ofstream to(path, std::ios::binary);
  int status = 0;
  {
    const FitsMemory memory(status);
    fits_create_img(memory.file(), BYTE_IMG, 0, nullptr, &status);
    write_cards(memory.file(), primary, status);
    append_unit(to, memory, status);
  }
  for (const FitsImage& image : images) {
    append_image(to, image, status);
  }
  to.close();
  if (status != 0) {
    problem = message_of(status);
  }
  return status == 0 && to.good();
}

std::string text_of_whole_fits(const std::string& path, const std::string& name, int images) {
  FitsInput input(path);
  if (input.units() != images + 1) {
    return {};
  }
  for (int unit = 1; unit <= images + 1; ++unit) {
    if (!input.is_right(unit)) {
      return {};
    }
  }
  return input.text(name);
}

}  // namespace ergodome
