#include "render/output/text_image.h"

#include "content/images/image_library.h"

namespace ergodome {

TextImage text_image(const std::string& text, int font_px) {
  const TextBox box = image_library().text_box(text, font_px);
  if (box.width <= 0 || box.height <= 0) {
    return {};
  }
  TextImage image{box.width, box.height, {}};
  image.coverage.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const float white[1] = {1.0F};
  if (!image_library().draw_text({image.coverage.data(), image.width, image.height, 1}, -box.left, -box.top, text,
                                 {font_px, white})) {
    return {};
  }
  return image;
}

}  // namespace ergodome
