#pragma once

#include <fitsio.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace ergodome::test {

//! Reads a FITS file with CFITSIO. Throws std::runtime_error on any error.
class FitsReader {
 public:
  explicit FitsReader(const std::string& path) { check(fits_open_diskfile(&file_, path.c_str(), READONLY, &status_)); }
  ~FitsReader() {
    int status = 0;
    fits_close_file(file_, &status);
  }
  FitsReader(const FitsReader&) = delete;
  FitsReader& operator=(const FitsReader&) = delete;

  int units() {
    int count = 0;
    check(fits_get_num_hdus(file_, &count, &status_));
    return count;
  }

  //! go_to_primary() goes to the primary header, go_to() to the extension with the given name.
  void go_to_primary() { check(fits_movabs_hdu(file_, 1, nullptr, &status_)); }
  void go_to(const std::string& name) {
    check(fits_movnam_hdu(file_, IMAGE_HDU, const_cast<char*>(name.c_str()), 0, &status_));
  }

  double number(const std::string& key) {
    double value = 0.0;
    check(fits_read_key(file_, TDOUBLE, key.c_str(), &value, nullptr, &status_));
    return value;
  }
  std::string text(const std::string& key) {
    std::array<char, FLEN_VALUE> value{};
    check(fits_read_key(file_, TSTRING, key.c_str(), value.data(), nullptr, &status_));
    return value.data();
  }
  bool has(const std::string& key) {
    int status = 0;
    std::array<char, FLEN_VALUE> value{};
    fits_read_keyword(file_, key.c_str(), value.data(), nullptr, &status);
    return status == 0;
  }
  bool has_right_checksums() {
    int data = 0;
    int all = 0;
    check(fits_verify_chksum(file_, &data, &all, &status_));
    return data == 1 && all == 1;
  }

  //! Returns the pixels of the current image, row by row from the bottom.
  std::vector<double> pixels() {
    std::array<long, 2> axes{};
    int type = 0;
    check(fits_get_img_size(file_, 2, axes.data(), &status_));
    check(fits_get_img_type(file_, &type, &status_));
    if (type != DOUBLE_IMG) {
      throw std::runtime_error("pixels are no doubles");
    }
    std::vector<double> values(static_cast<std::size_t>(axes[0] * axes[1]));
    // If no replacement for undefined pixels is given, CFITSIO returns them as NaN.
    check(fits_read_img(file_, TDOUBLE, 1, static_cast<LONGLONG>(values.size()), nullptr, values.data(), nullptr,
                        &status_));
    return values;
  }

 private:
  void check(int status) {
    if (status != 0) {
      std::array<char, FLEN_STATUS> text{};
      fits_get_errstatus(status, text.data());
      throw std::runtime_error(text.data());
    }
  }

  fitsfile* file_ = nullptr;
  int status_ = 0;
};

}  // namespace ergodome::test
