#include "content/images/module/stored_rows.h"

#include <algorithm>
#include <cstddef>

namespace ergodome {

bool StoredRows::is_bounded(const OIIO::ImageSpec& spec) {
  constexpr double max_bytes = 512.0 * 1024.0 * 1024.0;
  constexpr double pixel_bytes = 4.0 * sizeof(float);
  const int rows = std::min(spec.tile_height, spec.height);
  return spec.tile_width <= 0 || pixel_bytes * spec.width * rows <= max_bytes;
}

bool StoredRows::read(OIIO::ImageInput& input, const StoredPixels& stored, int begin, int end, float* to) {
  const OIIO::ImageSpec spec = input.spec();
  if (spec.tile_width <= 0) {
    return input.read_scanlines(stored.part, 0, spec.y + begin, spec.y + end, 0, stored.first_channel,
                                stored.first_channel + stored.channels, OIIO::TypeDesc::FLOAT, to);
  }
  const auto row_floats = static_cast<std::ptrdiff_t>(spec.width) * stored.channels;
  for (int row = begin; row < end;) {
    const bool kept = row >= band_begin_ && row < band_end_ && stored == kept_;
    if (!kept && !read_band(input, stored, row)) {
      return false;
    }
    const int last = std::min(end, band_end_);
    std::copy(band_.begin() + (row - band_begin_) * row_floats, band_.begin() + (last - band_begin_) * row_floats,
              to + (row - begin) * row_floats);
    row = last;
  }
  return true;
}

bool StoredRows::read_window(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout, int begin,
                             int end, float* to) {
  const auto width = static_cast<std::ptrdiff_t>(layout.window_width) * stored.channels;
  std::fill_n(to, width * (end - begin), 0.0F);
  const long first = std::max(begin - layout.data_top, 0L);
  const long last = std::min(end - layout.data_top, static_cast<long>(layout.data_height));
  const long left = std::max(layout.data_left, 0L);
  const long right = std::min(layout.data_left + layout.data_width, static_cast<long>(layout.window_width));
  if (first >= last || left >= right) {
    return true;
  }
  const auto stored_width = static_cast<std::ptrdiff_t>(layout.data_width) * stored.channels;
  std::vector<float> rows(static_cast<std::size_t>(stored_width * (last - first)));
  if (!read(input, stored, static_cast<int>(first), static_cast<int>(last), rows.data())) {
    return false;
  }
  for (long row = first; row < last; ++row) {
    std::copy_n(rows.begin() + (row - first) * stored_width + (left - layout.data_left) * stored.channels,
                (right - left) * stored.channels,
                to + (row + layout.data_top - begin) * width + left * stored.channels);
  }
  return true;
}

bool StoredRows::read_band(OIIO::ImageInput& input, const StoredPixels& stored, int row) {
  const OIIO::ImageSpec spec = input.spec();
  forget();
  const int begin = row / spec.tile_height * spec.tile_height;
  const int end = std::min(begin + spec.tile_height, spec.height);
  band_.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(stored.channels) *
               static_cast<std::size_t>(end - begin));
  if (!input.read_tiles(stored.part, 0, spec.x, spec.x + spec.width, spec.y + begin, spec.y + end, spec.z, spec.z + 1,
                        stored.first_channel, stored.first_channel + stored.channels, OIIO::TypeDesc::FLOAT,
                        band_.data())) {
    return false;
  }
  band_begin_ = begin;
  band_end_ = end;
  kept_ = stored;
  return true;
}

}  // namespace ergodome
