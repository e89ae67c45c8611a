#pragma once

namespace ergodome {

//! Position of a file's pixels in the image that is shown. They lie in a window, which they may
//! leave partly empty or exceed. The window, rotated or mirrored by `orientation`, is the image.
struct ShownLayout {
  long data_left = 0;  //!< left edge of the file's pixels, relative to that of the window
  long data_top = 0;
  int data_width = 0;
  int data_height = 0;
  int window_width = 0;
  int window_height = 0;
  //! Orientation of the window, as in TIFF and Exif: 1 is upright, 3 upside down, 6 must be rotated
  //! right by 90°.
  int orientation = 1;

  //! Returns true if the file's pixels are those of the shown image, row by row.
  [[nodiscard]] bool is_plain() const;

  //! Size of the image as it is shown.
  [[nodiscard]] int width() const { return orientation > 4 ? window_height : window_width; }
  [[nodiscard]] int height() const { return orientation > 4 ? window_width : window_height; }

  //! Returns true if neither the shown image nor the file has more than 16384 x 8192 pixels, the
  //! limit for rearranging pixels in memory.
  [[nodiscard]] bool is_bounded() const;
};

//! Copies rows [begin, end) of a file's pixels, of `channels` numbers each, to their positions in
//! the shown image. Skips pixels outside the window.
template <class Number>
void put_rows(const ShownLayout& layout, int begin, int end, int channels, const Number* rows, Number* shown) {
  const long width = layout.width();
  const long last_x = layout.window_width - 1;
  const long last_y = layout.window_height - 1;
  for (int row = begin; row < end; ++row) {
    const long y = layout.data_top + row;
    for (int column = 0; column < layout.data_width; ++column) {
      const long x = layout.data_left + column;
      const Number* const from = rows + (static_cast<long>(row - begin) * layout.data_width + column) * channels;
      if (x < 0 || x > last_x || y < 0 || y > last_y) {
        continue;
      }
      const bool across = layout.orientation > 4;
      const bool mirrored_x = layout.orientation == 2 || layout.orientation == 3 || layout.orientation > 6;
      const bool mirrored_y =
          layout.orientation == 3 || layout.orientation == 4 || layout.orientation == 6 || layout.orientation == 7;
      const long u = mirrored_x ? last_x - x : x;
      const long v = mirrored_y ? last_y - y : y;
      Number* const to = shown + (across ? u * width + v : v * width + u) * channels;
      for (int c = 0; c < channels; ++c) {
        to[c] = from[c];
      }
    }
  }
}

}  // namespace ergodome
