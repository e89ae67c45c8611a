#include "render/output/text_image.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

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

}  // namespace ergodome
