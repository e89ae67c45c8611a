#include "content/images/module/openimageio_input.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "content/images/formats/exr_file.h"
#include "content/images/formats/icc_profile.h"
#include "content/images/formats/image_bytes.h"
#include "content/images/formats/jpeg_segments.h"
#include "content/images/formats/panorama_crop.h"
#include "content/images/formats/png_chunks.h"
#include "content/images/formats/radiance_header.h"
#include "content/images/formats/tiff_directory.h"
#include "content/images/module/color_metadata.h"
#include "content/images/module/color_transform.h"
#include "content/images/module/shown_pixels.h"
#include "content/images/module/stored_rows.h"

namespace ergodome {

namespace {

//! Returns the first line of a message. PNG readers repeat one message in three lines.
std::string first_line(const std::string& message) { return message.substr(0, message.find('\n')); }

std::vector<ExrPart> parts_of(OIIO::ImageInput& input) {
  constexpr int max_parts = 1000;
  std::vector<ExrPart> parts;
  for (int part = 0; part < max_parts && input.seek_subimage(part, 0); ++part) {
    const OIIO::ImageSpec& spec = input.spec();
    parts.push_back({std::string(spec.get_string_attribute("oiio:subimagename")),
                     std::string(spec.get_string_attribute("view")), spec.channelnames});
  }
  input.seek_subimage(0, 0);
  return parts;
}

//! Maximum length of the header of a Radiance file [bytes].
constexpr std::size_t longest_head = std::size_t{1} << 16U;

class Input final : public ImageInput {
 public:
  //! Opens a file, or the image in `asked.bytes`; is_open() returns true if that succeeded. If
  //! `replaced` is not empty, reads these bytes instead.
  Input(const std::string& name, const ImageLibrary::Wishes& asked, std::string replaced)
      : replaced_(std::move(replaced)),
        bytes_(name, asked.bytes),
        asked_(asked),
        memory_(replaced_.empty() ? (asked.bytes ? asked.bytes->data() : nullptr)
                                  : reinterpret_cast<const std::byte*>(replaced_.data()),
                replaced_.empty() ? (asked.bytes ? asked.bytes->size() : 0) : replaced_.size()) {
    OIIO::Filesystem::IOProxy* const memory = asked.bytes || !replaced_.empty() ? &memory_ : nullptr;
    OIIO::ImageSpec wishes;
    if (asked.separate_alpha) {
      wishes.attribute("oiio:UnassociatedAlpha", 1);
      if (memory != nullptr) {
        // If a configuration is passed, readers take the memory proxy only from it, not from the
        // argument of open().
        wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&memory));
      }
    }
    input_ = OIIO::ImageInput::open(name, asked.separate_alpha ? &wishes : nullptr, memory);
    if (input_) {
      prepare();
    }
  }

  [[nodiscard]] bool is_open() const { return input_ != nullptr; }
  [[nodiscard]] bool is_tiff() const { return std::string_view(input_->format_name()) == "tiff"; }
  [[nodiscard]] bool is_jpeg() const { return std::string_view(input_->format_name()) == "jpeg"; }
  [[nodiscard]] bool is_too_large() const { return !layout_.is_plain() && !layout_.is_bounded(); }
  [[nodiscard]] bool has_large_tiles() const { return !StoredRows::is_bounded(input_->spec()); }
  [[nodiscard]] const ImageShape& shape() const override { return shape_; }
  [[nodiscard]] const OIIO::ImageSpec& stored() const { return input_->spec(); }
  //! Returns what cannot be shown correctly; empty if nothing.
  [[nodiscard]] const std::string& problem() const { return problem_; }

  bool go_to_part(int part) override {
    const bool found = input_->seek_subimage(part, 0);
    if (found) {
      part_ = part;
      take_shape();
    }
    return found && !is_too_large();
  }

  bool read_rows(int begin, int end, int channels, float* to) override {
    const bool read = read_stored_rows(begin, end, channels, to);
    if (read) {
      make_light(static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(shape_.width), channels, to);
    }
    return read;
  }

  bool read_all(int channels, float* to) override {
    const bool read = read_shown(channels, to);
    if (read) {
      make_light(static_cast<std::size_t>(shape_.width) * static_cast<std::size_t>(shape_.height), channels, to);
    }
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
    return name == "format" ? std::string(input_->format_name())
                            : std::string(input_->spec().get_string_attribute(name));
  }

  std::string error() override {
    const std::string library = first_line(input_->geterror());
    return torn_.value_or("").empty() ? library : *torn_;
  }

 private:
  //! Checks a PNG to its end. This runs before the first pixels are read and not earlier, because
  //! callers that need only a file's size should not wait for it.
  bool is_whole() {
    if (!torn_) {
      torn_ = is("png") ? problem_of_png(bytes_.from_start(), PngExtent::to_end) : "";
    }
    return torn_->empty();
  }

  bool read_stored_rows(int begin, int end, int channels, float* to) {
    if (!is_whole()) {
      return false;
    }
    if (layout_.orientation == 1) {
      return layout_.is_plain() ? rows_.read(*input_, stored_pixels(channels), begin, end, to)
                                : rows_.read_window(*input_, stored_pixels(channels), layout_, begin, end, to);
    }
    const bool put = shown_channels_ == channels || read_in_place(*input_, stored_pixels(channels), layout_, shown_);
    shown_channels_ = put ? channels : 0;
    const auto row = static_cast<std::ptrdiff_t>(shape_.width) * channels;
    if (put) {
      std::copy(shown_.begin() + begin * row, shown_.begin() + end * row, to);
    }
    return put;
  }

  [[nodiscard]] bool is(std::string_view format) const { return input_->format_name() == format; }
  [[nodiscard]] StoredPixels stored_pixels(int channels) const { return {part_, layer_.first_channel, channels}; }

  //! Chooses the layer, the crop and the color conversion before the first pixels are read.
  void prepare() {
    if (is("openexr") && asked_.as_light) {
      layer_ = choose_exr_layer(exr_layers(parts_of(*input_)), asked_.layer, problem_);
      part_ = layer_.part;
      input_->seek_subimage(part_, 0);
    } else if (!asked_.layer.empty()) {
      problem_ = "it is not an OpenEXR file, so it has no layers";
    }
    if (is("hdr")) {
      radiance_ = read_radiance_header(bytes_.head(longest_head));
    }
    if (asked_.as_panorama && !is("openexr")) {
      constexpr std::size_t longest_metadata = std::size_t{4} << 20U;
      crop_ = read_panorama_crop(bytes_.head(longest_metadata));
      problem_ = problem_.empty() ? crop_.problem : problem_;
    }
    take_shape();
    if (asked_.as_light && problem_.empty()) {
      take_colors();
    }
  }

  //! Chooses the color conversion. Leaves sRGB to the caller (ImageShape::encoded).
  void take_colors() {
    ColorMetadata metadata = color_metadata(*input_, is("png") ? bytes_.from_start() : NextBytes());
    metadata.primaries = radiance_.primaries ? radiance_.primaries : metadata.primaries;
    metadata.adapts_xyz = radiance_.is_xyz;
    problem_ = metadata.problem;
    if (!problem_.empty()) {
      return;
    }
    const ColorTransform colors(metadata, shape_.channels >= 3 ? 3 : 1, problem_);
    shape_.encoded = colors.is_srgb();
    if (!colors.is_srgb() && !colors.is_identity()) {
      colors_ = colors;
      // The transfer curve applies to unpremultiplied colors, so premultiplied ones must first be
      // divided by alpha.
      divides_by_alpha_ = !colors.is_linear() && shape_.alpha_channel >= 0 && !shape_.separate_alpha;
      shape_.separate_alpha = shape_.separate_alpha || divides_by_alpha_;
    }
  }

  //! Removes the exposure with which a Radiance file was saved, and converts colors.
  void make_light(std::size_t pixels, int channels, float* to) const {
    if (radiance_.gains != RadianceHeader().gains) {
      for (std::size_t i = 0; i < pixels; ++i) {
        for (int c = 0; c < std::min(channels, 3); ++c) {
          to[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] *=
              radiance_.gains.at(static_cast<std::size_t>(c));
        }
      }
    }
    if (colors_) {
      colors_->apply(to, pixels, channels, divides_by_alpha_ ? shape_.alpha_channel : -1);
    }
  }

  void take_shape() {
    const OIIO::ImageSpec& spec = input_->spec();
    layout_ = shown_layout(*input_);
    layout_.orientation = asked_.as_stored ? 1 : layout_.orientation;
    if (crop_.full_width > 0) {
      place_crop(crop_, layout_);
    }
    shape_ = ImageShape();
    shape_.width = layout_.width();
    shape_.height = layout_.height();
    shape_.depth = spec.depth;
    shape_.channels = layer_.channels > 0 ? layer_.channels : spec.nchannels;
    // OpenImageIO's GIF reader counts its four channels from 1, so its index of the alpha channel
    // is limited to the last channel.
    shape_.alpha_channel = layer_.channels > 0 ? layer_.alpha : std::min(spec.alpha_channel, spec.nchannels - 1);
    shape_.sample_bytes = static_cast<int>(spec.format.size());
    // Color metadata of a texture's file is ignored (glTF 2.0, 3.8.2).
    const bool is_marked_linear =
        OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace", "sRGB"), "linear");
    shape_.encoded = !spec.format.is_floating_point() && (asked_.as_stored || !is_marked_linear);
    shape_.separate_alpha = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
    shown_channels_ = 0;
    rows_.forget();
  }

  static OIIO::TypeDesc type_of_number(float /*number*/) { return OIIO::TypeDesc::FLOAT; }
  static OIIO::TypeDesc type_of_number(std::uint16_t /*number*/) { return OIIO::TypeDesc::UINT16; }

  template <class Number>
  bool read_shown(int channels, Number* to) {
    if (!is_whole()) {
      return false;
    }
    if (layout_.is_plain()) {
      return input_->read_image(part_, 0, layer_.first_channel, layer_.first_channel + channels,
                                type_of_number(Number{}), to);
    }
    std::vector<Number> shown;
    const bool put = read_in_place(*input_, stored_pixels(channels), layout_, shown);
    if (put) {
      std::ranges::copy(shown, to);
    }
    return put;
  }

  std::string replaced_;
  ImageBytes bytes_;
  ImageLibrary::Wishes asked_;
  //! The problem with a PNG: empty if there is none, nullopt if not yet checked.
  std::optional<std::string> torn_;
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  std::string problem_;
  ImageShape shape_;
  ShownLayout layout_;
  StoredRows rows_;
  std::vector<float> shown_;  //!< all pixels of an image that must be rotated or mirrored
  int shown_channels_ = 0;    //!< channels in shown_; 0 if it is empty
  int part_ = 0;
  ExrLayer layer_;
  PanoramaCrop crop_;
  RadianceHeader radiance_;
  std::optional<ColorTransform> colors_;
  bool divides_by_alpha_ = false;
};

//! Returns an error if an image claims more pixels than a file of `file_bytes` bytes can hold,
//! otherwise an empty text. The formats with the best compression store some 10,000 black pixels in
//! a byte.
std::string problem_of_size(int width, int height, std::uintmax_t file_bytes) {
  constexpr double max_pixels_a_byte = 100'000.0;
  const double pixels = static_cast<double>(width) * height;
  if (pixels <= max_pixels_a_byte * static_cast<double>(file_bytes)) {
    return "";
  }
  return fmt::format("it claims {} x {} pixels in {} bytes", width, height, file_bytes);
}

//! Returns a Radiance file in CIE XYZ with a header that declares RGB. Both formats store three
//! channels in the same way, but OpenImageIO opens only RGB.
std::string as_rgbe(std::string bytes) {
  constexpr std::string_view xyz = "\nFORMAT=32-bit_rle_xyze";
  const std::size_t at = bytes.find(xyz);
  return at == std::string::npos ? bytes : bytes.replace(at, xyz.size(), "\nFORMAT=32-bit_rle_rgbe");
}

}  // namespace

std::unique_ptr<ImageInput> open_image(const std::string& name, const ImageLibrary::Wishes& wishes,
                                       std::string& problem) {
  const ImageBytes bytes(name, wishes.bytes);
  problem = problem_of_png(bytes.from_start(), PngExtent::to_pixels);
  problem = problem.empty() ? problem_of_exr(bytes.from_start(), bytes.size()) : problem;
  const RadianceHeader radiance = read_radiance_header(bytes.head(longest_head));
  problem = problem.empty() ? radiance.problem : problem;
  problem = problem.empty() ? problem_of_icc_profiles(bytes) : problem;
  if (!problem.empty()) {
    return nullptr;
  }
  auto input = std::make_unique<Input>(name, wishes, radiance.is_xyz ? as_rgbe(bytes.all()) : "");
  if (!input->is_open()) {
    problem = first_line(OIIO::geterror());
    return nullptr;
  }
  if (input->is_jpeg() && !has_jpeg_end(bytes.all())) {
    problem = "it is truncated";
    return nullptr;
  }
  if (input->is_too_large()) {
    problem =
        "it has more than 16384 x 8192 pixels together with a rotation or a display window, which is not supported";
    return nullptr;
  }
  if (input->has_large_tiles()) {
    problem = "its tiles are too large; save it in scanlines or in smaller tiles";
    return nullptr;
  }
  problem = input->problem();
  if (problem.empty() && input->is_tiff()) {
    problem = problem_of_tiff(name, wishes.bytes);
  }
  if (problem.empty()) {
    problem = problem_of_size(input->stored().width, input->stored().height, bytes.size());
  }
  if (problem.empty()) {
    // Checks the size of the shown window, too: one that is larger than the pixels takes memory as
    // well.
    problem = problem_of_size(input->shape().width, input->shape().height, bytes.size());
  }
  if (!problem.empty()) {
    return nullptr;
  }
  return input;
}

}  // namespace ergodome
