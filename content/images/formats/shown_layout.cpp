#include "content/images/formats/shown_layout.h"

namespace ergodome {

bool ShownLayout::is_plain() const {
  return orientation == 1 && data_left == 0 && data_top == 0 && data_width == window_width &&
         data_height == window_height;
}

bool ShownLayout::is_bounded() const {
  constexpr long max_pixels = 16'384L * 8'192L;
  return data_width > 0 && data_height > 0 && window_width > 0 && window_height > 0 &&
         static_cast<long>(data_width) * data_height <= max_pixels &&
         static_cast<long>(window_width) * window_height <= max_pixels;
}

}  // namespace ergodome
