#include "content/images/openimageio_input.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "content/images/jpeg_end.h"
#include "content/images/png_chunks.h"
#include "content/images/radiance_header.h"
#include "content/images/shown_pixels.h"
#include "content/images/tiff_strips.h"

namespace ergodome {

namespace {

ImageShape shape_of(const OIIO::ImageSpec& spec, const ShownLayout& layout) {
  ImageShape shape;
  shape.width = layout.width();
  shape.height = layout.height();
  shape.depth = spec.depth;
  shape.channels = spec.nchannels;
  // The reader of GIF counts its four channels from 1.
  shape.alpha_channel = std::min(spec.alpha_channel, spec.nchannels - 1);
  shape.sample_bytes = static_cast<int>(spec.format.size());
  shape.encoded = !spec.format.is_floating_point() && spec.get_string_attribute("oiio:ColorSpace", "sRGB") != "Linear";
  shape.separate_alpha = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  // What is not plain is put together as a whole, whatever its tiles are.
  shape.tiled = spec.tile_width > 0 && layout.is_plain();
  return shape;
}

//! The first line of a message: readers of PNG say one thing in three.
std::string first_line(const std::string& message) { return message.substr(0, message.find('\n')); }

//! What is wrong with a file, or with the bytes that stand for it, if it is a PNG; empty where nothing is.
std::string problem_of_file(const std::string& name, const std::optional<std::span<const std::byte>>& bytes,
                            PngExtent extent) {
  if (bytes) {
    std::span<const std::byte> left = *bytes;
    const auto next = [&](char* to, std::size_t count) {
      const bool enough = count <= left.size();
      if (enough) {
        std::memcpy(to, left.data(), count);
        left = left.subspan(count);
      }
      return enough;
    };
    return problem_of_png(next, extent);
  }
  std::ifstream file(name, std::ios::binary);
  const auto next = [&](char* to, std::size_t count) {
    return static_cast<bool>(file.read(to, static_cast<std::streamsize>(count)));
  };
  return problem_of_png(next, extent);
}

//! The first bytes of a file, or of those that stand for it: headers are shorter.
std::string head_of(const std::string& name, const std::optional<std::span<const std::byte>>& bytes) {
  constexpr std::size_t longest_head = std::size_t{1} << 16U;
  if (bytes) {
    return {reinterpret_cast<const char*>(bytes->data()), std::min(bytes->size(), longest_head)};
  }
  std::string head(longest_head, '\0');
  std::ifstream file(name, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

class Input final : public ImageInput {
 public:
  //! Opens a file, or its bytes; is_open() tells whether it could.
  Input(const std::string& name, const ImageLibrary::Wishes& asked)
      : name_(name),
        bytes_(asked.bytes),
        as_stored_(asked.as_stored),
        memory_(asked.bytes ? asked.bytes->data() : nullptr, asked.bytes ? asked.bytes->size() : 0) {
    OIIO::Filesystem::IOProxy* const memory = asked.bytes ? &memory_ : nullptr;
    OIIO::ImageSpec wishes;
    if (asked.separate_alpha) {
      wishes.attribute("oiio:UnassociatedAlpha", 1);
      if (memory != nullptr) {
        // Readers that are given wishes look for it there alone.
        wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&memory));
      }
    }
    input_ = OIIO::ImageInput::open(name, asked.separate_alpha ? &wishes : nullptr, memory);
    if (input_) {
      take_shape();
    }
    if (input_ && std::string_view(input_->format_name()) == "hdr") {
      radiance_ = read_radiance_header(head_of(name_, bytes_));
    }
  }

  [[nodiscard]] bool is_open() const { return input_ != nullptr; }
  [[nodiscard]] bool is_tiff() const { return std::string_view(input_->format_name()) == "tiff"; }
  [[nodiscard]] bool is_jpeg() const { return std::string_view(input_->format_name()) == "jpeg"; }
  [[nodiscard]] bool is_too_large() const { return !layout_.is_plain() && !layout_.is_bounded(); }
  [[nodiscard]] const ImageShape& shape() const override { return shape_; }
  //! What of the file cannot be shown right; empty if nothing.
  [[nodiscard]] const std::string& problem() const { return radiance_.problem; }

  bool go_to_part(int part) override {
    const bool found = input_->seek_subimage(part, 0);
    if (found) {
      take_shape();
      part_ = part;
    }
    return found && !is_too_large();
  }

  bool read_rows(int begin, int end, int channels, float* to) override {
    const bool read = read_stored_rows(begin, end, channels, to);
    apply_gains(static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(shape_.width), channels, to);
    return read;
  }

  bool read_all(int channels, float* to) override {
    const bool read = read_shown(channels, to);
    apply_gains(static_cast<std::size_t>(shape_.width) * static_cast<std::size_t>(shape_.height), channels, to);
    return read;
  }
  bool read_all(int channels, std::uint16_t* to) override { return read_shown(channels, to); }

  bool read_through() override {
    if (!is_whole()) {
      return false;
    }
    constexpr int rows_at_once = 64;
    const OIIO::ImageSpec spec = input_->spec();
    std::vector<unsigned char> rows(spec.scanline_bytes(true) * rows_at_once);
    for (int y = 0; y < spec.height; y += rows_at_once) {
      if (!input_->read_scanlines(part_, 0, spec.y + y, spec.y + std::min(y + rows_at_once, spec.height), 0, 0,
                                  spec.nchannels, OIIO::TypeDesc::UNKNOWN, rows.data())) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::string text(const std::string& name) const override {
    return std::string(input_->spec().get_string_attribute(name));
  }

  std::string error() override {
    const std::string library = first_line(input_->geterror());
    return torn_.value_or("").empty() ? library : *torn_;
  }

 private:
  //! Looks at a PNG up to its end before the first of its pixels are read, and not earlier: who asks for a file's size alone need not wait for that.
  bool is_whole() {
    if (!torn_) {
      torn_ = std::string_view(input_->format_name()) == "png" ? problem_of_file(name_, bytes_, PngExtent::to_end) : "";
    }
    return torn_->empty();
  }

  bool read_stored_rows(int begin, int end, int channels, float* to) {
    if (!is_whole()) {
      return false;
    }
    if (!layout_.is_plain()) {
      const bool put = shown_channels_ == channels || read_in_place(*input_, part_, layout_, channels, shown_);
      shown_channels_ = put ? channels : 0;
      const auto row = static_cast<std::ptrdiff_t>(shape_.width) * channels;
      if (put) {
        std::copy(shown_.begin() + begin * row, shown_.begin() + end * row, to);
      }
      return put;
    }
    const int top = input_->spec().y;
    return input_->read_scanlines(part_, 0, top + begin, top + end, 0, 0, channels, OIIO::TypeDesc::FLOAT, to);
  }

  //! Takes out the exposure that a Radiance picture was saved with.
  void apply_gains(std::size_t pixels, int channels, float* to) const {
    if (radiance_.gains == RadianceHeader().gains) {
      return;
    }
    for (std::size_t i = 0; i < pixels; ++i) {
      for (int c = 0; c < std::min(channels, 3); ++c) {
        to[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] *=
            radiance_.gains.at(static_cast<std::size_t>(c));
      }
    }
  }

  void take_shape() {
    layout_ = shown_layout(*input_);
    layout_.orientation = as_stored_ ? 1 : layout_.orientation;
    shape_ = shape_of(input_->spec(), layout_);
    shown_channels_ = 0;
  }

  static OIIO::TypeDesc type_of_number(float /*number*/) { return OIIO::TypeDesc::FLOAT; }
  static OIIO::TypeDesc type_of_number(std::uint16_t /*number*/) { return OIIO::TypeDesc::UINT16; }

  template <class Number>
  bool read_shown(int channels, Number* to) {
    if (!is_whole()) {
      return false;
    }
    if (layout_.is_plain()) {
      return input_->read_image(part_, 0, 0, channels, type_of_number(Number{}), to);
    }
    std::vector<Number> shown;
    const bool put = read_in_place(*input_, part_, layout_, channels, shown);
    if (put) {
      std::ranges::copy(shown, to);
    }
    return put;
  }

  std::string name_;
  std::optional<std::span<const std::byte>> bytes_;
  bool as_stored_;
  std::optional<std::string> torn_;  //!< what is wrong with a PNG, once that is known; empty where nothing is
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  ImageShape shape_;
  ShownLayout layout_;
  std::vector<float> shown_;  //!< the picture, of a file whose rows are not its
  int shown_channels_ = 0;    //!< that it has
  int part_ = 0;
  RadianceHeader radiance_;
};

//! The bytes of a file, or those that stand for it.
std::string bytes_of(const std::string& name, const ImageLibrary::Wishes& wishes) {
  if (wishes.bytes) {
    return {reinterpret_cast<const char*>(wishes.bytes->data()), wishes.bytes->size()};
  }
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::uintmax_t size_of(const std::string& name, const ImageLibrary::Wishes& wishes) {
  std::error_code problem;
  const std::uintmax_t size = wishes.bytes ? wishes.bytes->size() : std::filesystem::file_size(name, problem);
  return problem ? 0 : size;
}

//! Returns that an image claims more pixels than a file of so many bytes can hold, empty where it may be so. A plain black
//! image in the formats that pack best has some 10,000 pixels a byte.
std::string problem_of_size(const ImageShape& shape, std::uintmax_t file_bytes) {
  constexpr double most_pixels_a_byte = 100'000.0;
  const double pixels = static_cast<double>(shape.width) * shape.height;
  if (pixels <= most_pixels_a_byte * static_cast<double>(file_bytes)) {
    return "";
  }
  return fmt::format("it claims {} x {} pixels in {} bytes", shape.width, shape.height, file_bytes);
}

}  // namespace

std::unique_ptr<ImageInput> open_image(const std::string& name, const ImageLibrary::Wishes& wishes,
                                       std::string& problem) {
  problem = problem_of_file(name, wishes.bytes, PngExtent::to_pixels);
  if (!problem.empty()) {
    return nullptr;
  }
  auto input = std::make_unique<Input>(name, wishes);
  if (!input->is_open()) {
    problem = first_line(OIIO::geterror());
    return nullptr;
  }
  if (input->is_jpeg() && !has_jpeg_end(bytes_of(name, wishes))) {
    problem = "it is torn, and breaks off before its end";
    return nullptr;
  }
  if (input->is_too_large()) {
    problem = "it shows more than 16384 x 8192 pixels, turned, or in another window than they fill";
    return nullptr;
  }
  problem = input->problem();
  if (problem.empty() && input->is_tiff()) {
    problem = problem_of_tiff(name, wishes.bytes);
  }
  if (problem.empty()) {
    problem = problem_of_size(input->shape(), size_of(name, wishes));
  }
  if (!problem.empty()) {
    return nullptr;
  }
  return input;
}

}  // namespace ergodome
