#include "render/objects/object_pixels.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/launch.h"

namespace ergodome {

namespace {

constexpr int object_tile_px = 4;
//! A step in brightness from pixel to pixel that is worth finer samples.
constexpr float visible_step = 0.2F;

//! Whether the image covers any of a pixel.
bool is_shown(const Projection& projection, int x, int y) { return image_coverage(projection, x + 0.5, y + 0.5) > 0.0; }

//! Calls each(x, y) for the pixels of a tile that are in the rows and in the image.
template <class Each>
void visit_tile(const Projection& projection, int left, int top, int bottom, const Each& each) {
  for (int y = top; y < std::min(top + object_tile_px, bottom); ++y) {
    for (int x = left; x < std::min(left + object_tile_px, projection.width_px); ++x) {
      if (is_shown(projection, x, y)) {
        each(x, y);
      }
    }
  }
}

}  // namespace

ObjectPixels::ObjectPixels(Backend backend, const ObjectScene& objects, int first_row, int row_count)
    : backend_(backend),
      objects_(objects),
      width_(objects.projection.width_px),
      first_row_(first_row),
      row_count_(row_count),
      top_(std::max(first_row - 1, 0)),
      bottom_(std::min(first_row + row_count + 1, objects.projection.height_px)),
      seen_(static_cast<std::size_t>(bottom_ - top_) * static_cast<std::size_t>(width_)),
      rgba_(4 * static_cast<std::size_t>(row_count) * static_cast<std::size_t>(width_)),
      time_(static_cast<std::size_t>(row_count) * static_cast<std::size_t>(width_)) {}

void ObjectPixels::look() {
  std::vector<std::int32_t> coarse;
  std::vector<std::int32_t> fine;
  mark_tiles(coarse, fine);
  look_at(coarse, 2);
  look_at(fine, 4);
  look_at(uneven_pixels(coarse), 4);
}

void ObjectPixels::mark_tiles(std::vector<std::int32_t>& coarse, std::vector<std::int32_t>& fine) const {
  std::vector<std::int32_t> tiles;
  for (int y = top_; y < bottom_; y += object_tile_px) {
    for (int x = 0; x < width_; x += object_tile_px) {
      bool shown = false;
      visit_tile(objects_.projection, x, y, bottom_, [&](int, int) { shown = true; });
      if (shown) {
        tiles.insert(tiles.end(), {x, y});
      }
    }
  }
  const std::size_t count = tiles.size() / 2;
  const Buffer<std::int32_t> places(backend_, tiles, "objects' tiles");
  const Buffer<TileMark> marks(backend_, count, "objects' tiles");
  mark_object_tiles(backend_, {objects_, places.data(), static_cast<int>(count), object_tile_px, marks.data()});
  std::vector<TileMark> marked(count);
  marks.read(marked.data(), count);
  for (std::size_t i = 0; i < count; ++i) {
    if (marked[i] != TileMark::nothing) {
      std::vector<std::int32_t>& to = marked[i] == TileMark::fine ? fine : coarse;
      visit_tile(objects_.projection, tiles[2 * i], tiles[2 * i + 1], bottom_, [&](int x, int y) {
        to.insert(to.end(), {x, y});
      });
    }
  }
}

void ObjectPixels::look_at(const std::vector<std::int32_t>& pixels, int samples) {
  const std::size_t count = pixels.size() / 2;
  if (count == 0) {
    return;
  }
  const Buffer<std::int32_t> places(backend_, pixels, "objects' pixels");
  const Buffer<float> rgba(backend_, 4 * count, "objects' pixels");
  const Buffer<float> time(backend_, count, "objects' pixels");
  const Buffer<std::int32_t> content(backend_, count, "objects' pixels");
  look_at_objects(
      backend_, {objects_, places.data(), static_cast<int>(count), samples, rgba.data(), time.data(), content.data()});
  std::vector<float> light(4 * count);
  std::vector<float> times(count);
  std::vector<std::int32_t> contents(count);
  rgba.read(light.data(), light.size());
  time.read(times.data(), count);
  content.read(contents.data(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const int x = pixels[2 * i];
    const int y = pixels[2 * i + 1];
    const float* const own = light.data() + 4 * i;
    seen_[index_of(x, y)] = {own[0] + own[1] + own[2], contents[i]};
    if (y >= first_row_ && y < first_row_ + row_count_) {
      const std::size_t at =
          static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
      std::copy_n(own, 4, rgba_.begin() + static_cast<long>(4 * at));
      time_[at] = times[i];
    }
  }
}

bool ObjectPixels::is_uneven(int x, int y) const {
  const Seen& own = seen(x, y);
  if (own.content == pixel_of_several) {
    return true;
  }
  for (int row = std::max(y - 1, top_); row <= std::min(y + 1, bottom_ - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width_ - 1); ++column) {
      const Seen& other = seen(column, row);
      const float step = std::abs(own.brightness - other.brightness);
      if (own.content != other.content || step > visible_step * std::max(own.brightness, other.brightness)) {
        return true;
      }
    }
  }
  return false;
}

std::vector<std::int32_t> ObjectPixels::uneven_pixels(const std::vector<std::int32_t>& looked_at) const {
  std::vector<std::int32_t> uneven;
  for (std::size_t i = 0; i < looked_at.size(); i += 2) {
    const int x = looked_at[i];
    const int y = looked_at[i + 1];
    if (y >= first_row_ && y < first_row_ + row_count_ && is_uneven(x, y)) {
      uneven.insert(uneven.end(), {x, y});
    }
  }
  return uneven;
}

}  // namespace ergodome
