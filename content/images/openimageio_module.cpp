#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "content/images/image_library.h"
#include "content/images/jpeg_end.h"
#include "content/images/png_chunks.h"
#include "content/images/shown_pixels.h"

namespace ergodome {

namespace {

constexpr const char* font = "DejaVuSans";

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
  }

  [[nodiscard]] bool is_open() const { return input_ != nullptr; }
  [[nodiscard]] bool is_jpeg() const { return std::string_view(input_->format_name()) == "jpeg"; }
  [[nodiscard]] bool is_too_large() const { return !layout_.is_plain() && !layout_.is_bounded(); }
  [[nodiscard]] const ImageShape& shape() const override { return shape_; }

  bool go_to_part(int part) override {
    const bool found = input_->seek_subimage(part, 0);
    if (found) {
      take_shape();
      part_ = part;
    }
    return found && !is_too_large();
  }

  bool read_rows(int begin, int end, int channels, float* to) override {
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

  bool read_all(int channels, float* to) override { return read_shown(channels, to); }
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
};

OIIO::TypeDesc type_of(ImageSample sample) {
  switch (sample) {
    case ImageSample::half:
      return OIIO::TypeDesc::HALF;
    case ImageSample::whole_16:
      return OIIO::TypeDesc::UINT16;
    case ImageSample::whole_8:
      break;
  }
  return OIIO::TypeDesc::UINT8;
}

OIIO::ImageSpec spec_of(const ImagePlan& plan) {
  OIIO::ImageSpec spec(plan.width, plan.height, plan.channels, type_of(plan.sample));
  for (const auto& [name, text] : plan.texts) {
    spec.attribute(name, text);
  }
  for (const auto& [name, number] : plan.numbers) {
    spec.attribute(name, number);
  }
  for (const auto& [name, ratio] : plan.ratios) {
    spec.attribute(name, OIIO::TypeRational, ratio.data());
  }
  if (!plan.chromaticities.empty()) {
    spec.attribute("chromaticities",
                   OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(plan.chromaticities.size())),
                   plan.chromaticities.data());
  }
  return spec;
}

class Output final : public ImageOutput {
 public:
  Output(const std::string& format, std::vector<unsigned char>* bytes) {
    if (bytes != nullptr) {
      memory_ = std::make_unique<OIIO::Filesystem::IOVecOutput>(*bytes);
    }
    output_ = OIIO::ImageOutput::create(format, memory_.get());
  }

  [[nodiscard]] bool is_known() const { return output_ != nullptr; }

  bool open(const std::string& path, std::span<const ImagePlan> parts) override {
    std::vector<OIIO::ImageSpec> specs;
    std::ranges::transform(parts, std::back_inserter(specs), spec_of);
    return specs.size() == 1 ? output_->open(path, specs[0])
                             : output_->open(path, static_cast<int>(specs.size()), specs.data());
  }

  bool open_next(const std::string& path, const ImagePlan& part) override {
    return output_->open(path, spec_of(part), OIIO::ImageOutput::AppendSubimage);
  }

  bool write(const float* pixels) override { return output_->write_image(OIIO::TypeDesc::FLOAT, pixels); }
  bool write(const std::uint8_t* pixels) override { return output_->write_image(OIIO::TypeDesc::UINT8, pixels); }
  bool write(const std::uint16_t* pixels) override { return output_->write_image(OIIO::TypeDesc::UINT16, pixels); }
  bool close() override { return output_->close(); }
  std::string error() override { return output_->has_error() ? output_->geterror() : std::string(); }

 private:
  std::unique_ptr<OIIO::Filesystem::IOVecOutput> memory_;
  std::unique_ptr<OIIO::ImageOutput> output_;
};

//! A canvas as OpenImageIO draws on it.
OIIO::ImageBuf buffer_of(const ImageCanvas& canvas) {
  return {OIIO::ImageSpec(canvas.width, canvas.height, canvas.channels, OIIO::TypeDesc::FLOAT), canvas.pixels};
}

OIIO::cspan<float> span_of(std::span<const float> values) {
  return {values.data(), static_cast<std::ptrdiff_t>(values.size())};
}

//! The bytes of a file, or those that stand for it.
std::string bytes_of(const std::string& name, const ImageLibrary::Wishes& wishes) {
  if (wishes.bytes) {
    return {reinterpret_cast<const char*>(wishes.bytes->data()), wishes.bytes->size()};
  }
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Library final : public ImageLibrary {
 public:
  std::unique_ptr<ImageInput> open(const std::string& name, const Wishes& wishes, std::string& problem) const override {
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
    return input;
  }

  std::unique_ptr<ImageOutput> create(const std::string& format, std::vector<unsigned char>* bytes,
                                      std::string& problem) const override {
    auto output = std::make_unique<Output>(format, bytes);
    if (!output->is_known()) {
      problem = OIIO::geterror();
      return nullptr;
    }
    return output;
  }

  [[nodiscard]] TextBox text_box(const std::string& text, int font_px) const override {
    const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text, font_px, font);
    return box.defined() ? TextBox{box.xbegin, box.ybegin, box.width(), box.height()} : TextBox{};
  }

  bool draw_text(const ImageCanvas& canvas, int x, int y, const std::string& text,
                 const TextStyle& style) const override {
    using Across = OIIO::ImageBufAlgo::TextAlignX;
    using Down = OIIO::ImageBufAlgo::TextAlignY;
    const bool centred = style.place != TextPlace::baseline_start;
    const Down down = style.place == TextPlace::baseline_start ? Down::Baseline
                      : style.place == TextPlace::top_centre   ? Down::Top
                                                               : Down::Center;
    OIIO::ImageBuf image = buffer_of(canvas);
    return OIIO::ImageBufAlgo::render_text(image, x, y, text, style.font_px, font, span_of(style.colour),
                                           centred ? Across::Center : Across::Left, down, style.shadow_px);
  }

  void draw_line(const ImageCanvas& canvas, int x0, int y0, int x1, int y1,
                 std::span<const float> colour) const override {
    OIIO::ImageBuf image = buffer_of(canvas);
    OIIO::ImageBufAlgo::render_line(image, x0, y0, x1, y1, span_of(colour));
  }

  void draw_box(const ImageCanvas& canvas, int x0, int y0, int x1, int y1,
                std::span<const float> colour) const override {
    OIIO::ImageBuf image = buffer_of(canvas);
    OIIO::ImageBufAlgo::render_box(image, x0, y0, x1, y1, span_of(colour));
  }

  std::vector<float> transform(const float* cells, int side, std::string& problem) const override {
    OIIO::ImageBuf mask(OIIO::ImageSpec(side, side, 1, OIIO::TypeDesc::FLOAT));
    const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::copy_n(cells, count, static_cast<float*>(mask.localpixels()));
    const OIIO::ImageBuf field = OIIO::ImageBufAlgo::fft(mask);
    if (field.has_error() || field.nchannels() != 2 || field.spec().format != OIIO::TypeDesc::FLOAT) {
      problem = field.geterror();
      return {};
    }
    const auto* const numbers = static_cast<const float*>(field.localpixels());
    return {numbers, numbers + 2 * count};
  }
};

}  // namespace

}  // namespace ergodome

extern "C" const ergodome::ImageLibrary* ergodome_openimageio() {
  static const ergodome::Library library;
  return &library;
}
