#include "render/output/text_image.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <sstream>

namespace ergodome {

TextImage text_image(const std::string& text, int font_px) {
  const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text, font_px, "DejaVuSans");
  if (!box.defined() || box.width() <= 0 || box.height() <= 0) {
    return {};
  }
  TextImage image{box.width(), box.height(), {}};
  image.coverage.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, 1, OIIO::TypeDesc::FLOAT), image.coverage.data());
  const float white[1] = {1.0F};
  if (!OIIO::ImageBufAlgo::render_text(buffer, -box.xbegin, -box.ybegin, text, font_px, "DejaVuSans", white)) {
    return {};
  }
  return image;
}

TextImage text_lines_image(const std::string& text, int font_px, TextFace face) {
  const char* const font = face == TextFace::monospaced ? "DejaVuSansMono" : "DejaVuSans";
  const int line_px = font_px * 3 / 2;
  const int margin_px = font_px / 2;
  std::vector<std::string> lines;
  std::stringstream stream(text);
  TextImage image{0, 2 * margin_px, {}};
  for (std::string line; std::getline(stream, line);) {
    const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(line, font_px, font);
    image.width = std::max(image.width, (box.defined() ? box.width() : 0) + 2 * margin_px);
    image.height += line_px;
    lines.push_back(line);
  }
  image.coverage.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, 1, OIIO::TypeDesc::FLOAT), image.coverage.data());
  const float white[1] = {1.0F};
  int baseline = margin_px + font_px;
  for (const std::string& line : lines) {
    if (!OIIO::ImageBufAlgo::render_text(buffer, margin_px, baseline, line, font_px, font, white)) {
      return {};
    }
    baseline += line_px;
  }
  return image;
}

}  // namespace ergodome
