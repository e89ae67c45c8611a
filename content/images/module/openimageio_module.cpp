#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <iterator>

#include "content/images/formats/fits_file.h"
#include "content/images/image_library.h"
#include "content/images/module/openimageio_input.h"

namespace ergodome {

namespace {

constexpr const char* font = "DejaVuSans";

OIIO::TypeDesc type_of(ImageSample sample) {
  switch (sample) {
    case ImageSample::half:
      return OIIO::TypeDesc::HALF;
    case ImageSample::real:
      return OIIO::TypeDesc::FLOAT;
    case ImageSample::whole_16:
      return OIIO::TypeDesc::UINT16;
    case ImageSample::whole_8:
      break;
  }
  return OIIO::TypeDesc::UINT8;
}

OIIO::ImageSpec spec_of(const ImagePlan& plan) {
  OIIO::ImageSpec spec(plan.width, plan.height, plan.channels, type_of(plan.sample));
  if (!plan.channel_names.empty()) {
    spec.channelnames = plan.channel_names;
  }
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

//! Wraps a canvas for OpenImageIO's drawing functions.
OIIO::ImageBuf buffer_of(const ImageCanvas& canvas) {
  return {OIIO::ImageSpec(canvas.width, canvas.height, canvas.channels, OIIO::TypeDesc::FLOAT), canvas.pixels};
}

OIIO::cspan<float> span_of(std::span<const float> values) {
  return {values.data(), static_cast<std::ptrdiff_t>(values.size())};
}

class Library final : public ImageLibrary {
 public:
  std::unique_ptr<ImageInput> open(const std::string& name, const Wishes& wishes, std::string& problem) const override {
    return open_image(name, wishes, problem);
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
    const bool centred = style.anchor != TextAnchor::baseline_start;
    const Down down = style.anchor == TextAnchor::baseline_start ? Down::Baseline
                      : style.anchor == TextAnchor::top_centre   ? Down::Top
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

  bool write_fits(const std::string& path, std::span<const FitsCard> primary, std::span<const FitsImage> images,
                  std::string& problem) const override {
    return write_fits_file(path, primary, images, problem);
  }

  [[nodiscard]] std::string whole_fits_text(const std::string& path, const std::string& name,
                                            int images) const override {
    return text_of_whole_fits(path, name, images);
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

extern "C" const ergodome::ImageLibrary* ergodome_openimageio(std::uint64_t interface) {
  static const ergodome::Library library;
  return interface == ergodome::image_interface ? &library : nullptr;
}
