#pragma once

namespace ergodome {

//! How the pixels of a file lie in the picture that it shows: somewhere in a window that they need not fill, or reach beyond, and all of it turned.
struct ShownLayout {
  long data_left = 0;  //!< where the file's pixels begin, from the window's corner
  long data_top = 0;
  int data_width = 0;
  int data_height = 0;
  int window_width = 0;
  int window_height = 0;
  int orientation =
      1;  //!< of the window, as TIFF and Exif count: 1 is upright, 3 upside down, 6 to be turned right by a quarter

  //! Whether the file's pixels are the picture's, row by row.
  [[nodiscard]] bool is_plain() const;

  //! Size of the picture as it is shown.
  [[nodiscard]] int width() const { return orientation > 4 ? window_height : window_width; }
  [[nodiscard]] int height() const { return orientation > 4 ? window_width : window_height; }

  //! Whether picture and file have no more pixels than are put in place in memory, 16384 x 8192.
  [[nodiscard]] bool is_bounded() const;
};

//! Puts rows [begin, end) of a file's pixels, of `channels` numbers each, where the picture shows them; what lies outside of its window is left out.
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
