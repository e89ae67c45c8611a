#include "content/images/plain/plain_jpeg.h"

#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "content/images/formats/image_bytes.h"
#include "content/images/formats/jpeg_segments.h"

// Needs the declarations of <cstdio>.
#include <jpeglib.h>

namespace ergodome {

namespace {

//! Decodes a JPEG row by row. The functions of libjpeg report errors by a jump to `failed`, over
//! code without destructors.
class JpegRows {
 public:
  explicit JpegRows(std::string_view bytes) {
    decoder_.err = jpeg_std_error(&errors_.handlers);
    errors_.handlers.error_exit = [](j_common_ptr decoder) {
      auto* const errors = reinterpret_cast<Errors*>(decoder->err);
      std::longjmp(errors->failed, 1);
    };
    errors_.handlers.output_message = [](j_common_ptr /*decoder*/) {};
    is_open_ = start(bytes);
  }
  ~JpegRows() { jpeg_destroy_decompress(&decoder_); }
  JpegRows(const JpegRows&) = delete;
  JpegRows& operator=(const JpegRows&) = delete;

  //! Returns true if the image can be decoded and is plain.
  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] int width() const { return static_cast<int>(decoder_.output_width); }
  [[nodiscard]] int height() const { return static_cast<int>(decoder_.output_height); }
  [[nodiscard]] int next_row() const { return static_cast<int>(decoder_.output_scanline); }

  //! Decodes the next row, three bytes a pixel. Returns false if the file is damaged.
  bool read(unsigned char* to) {
    if (setjmp(errors_.failed) != 0) {
      return false;
    }
    return jpeg_read_scanlines(&decoder_, &to, 1) == 1;
  }

 private:
  //! The handlers of libjpeg, followed by where they return to.
  struct Errors {
    jpeg_error_mgr handlers;
    std::jmp_buf failed;
  };

  bool start(std::string_view bytes) {
    if (setjmp(errors_.failed) != 0) {
      return false;
    }
    jpeg_create_decompress(&decoder_);
    jpeg_mem_src(&decoder_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    return jpeg_read_header(&decoder_, 1) == JPEG_HEADER_OK && decoder_.num_components == 3 &&
           decoder_.jpeg_color_space == JCS_YCbCr && jpeg_start_decompress(&decoder_) != 0 &&
           decoder_.output_components == 3;
  }

  jpeg_decompress_struct decoder_{};
  Errors errors_{};
  bool is_open_ = false;
};

class PlainJpeg final : public ImageInput {
 public:
  explicit PlainJpeg(std::string bytes) : bytes_(std::move(bytes)) {
    if (restart()) {
      shape_.width = rows_->width();
      shape_.height = rows_->height();
      shape_.channels = 3;
      shape_.encoded = true;
    }
  }

  [[nodiscard]] bool is_open() const { return rows_->is_open(); }
  [[nodiscard]] const ImageShape& shape() const override { return shape_; }
  bool go_to_part(int part) override { return part == 0; }

  bool read_rows(int begin, int end, int channels, float* to) override {
    return read_numbers(begin, end, channels, to, [](unsigned char value) { return value * (1.0F / 255.0F); });
  }
  bool read_all(int channels, float* to) override { return read_rows(0, shape_.height, channels, to); }
  bool read_all(int channels, std::uint16_t* to) override {
    return read_numbers(0, shape_.height, channels, to,
                        [](unsigned char value) { return static_cast<std::uint16_t>(value * 257); });
  }
  bool read_through() override {
    std::vector<float> row(3 * static_cast<std::size_t>(shape_.width));
    bool read = true;
    for (int y = 0; read && y < shape_.height; ++y) {
      read = read_rows(y, y + 1, 3, row.data());
    }
    return read;
  }
  [[nodiscard]] std::string text(const std::string& name) const override { return name == "format" ? "jpeg" : ""; }
  std::string error() override { return "the JPEG data are damaged"; }

 private:
  bool restart() {
    rows_ = std::make_unique<JpegRows>(bytes_);
    return rows_->is_open();
  }

  template <class Number, class Convert>
  bool read_numbers(int begin, int end, int channels, Number* to, const Convert& convert) {
    bool read = rows_->next_row() <= begin || restart();
    std::vector<unsigned char> row(3 * static_cast<std::size_t>(shape_.width));
    while (read && rows_->next_row() < end) {
      const bool wanted = rows_->next_row() >= begin;
      read = rows_->read(row.data());
      for (std::size_t i = 0; wanted && i < row.size(); i += 3) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
          *to++ = convert(row[i + c]);
        }
      }
    }
    return read;
  }

  std::string bytes_;
  ImageShape shape_;
  std::unique_ptr<JpegRows> rows_;
};

}  // namespace

std::unique_ptr<ImageInput> open_plain_jpeg(const std::string& path) {
  const ImageBytes file(path, std::nullopt);
  if (!file.head(3).starts_with("\xFF\xD8\xFF")) {
    return nullptr;
  }
  std::string bytes = file.all();
  if (!is_plain_jpeg(bytes) || !has_jpeg_end(bytes)) {
    return nullptr;
  }
  auto input = std::make_unique<PlainJpeg>(std::move(bytes));
  return input->is_open() ? std::move(input) : nullptr;
}

}  // namespace ergodome
