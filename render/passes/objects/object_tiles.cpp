#include <algorithm>
#include <utility>
#include <vector>

#include "kernels/launch/launch.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/objects/object_pixels.h"
#include "render/passes/stars/drawing/picture_sheets.h"

// Finds the pixels in which objects may be seen, by rays through the centers of tiles.
namespace ergodome {

namespace {

constexpr int object_tile_px = 4;
constexpr int large_tile_px = 16;
constexpr int small_tile_px = 2;
//! Minimum tile size for the width of rays along a line of sight of a flat eye: narrower rays cost
//! more than they save later.
constexpr int least_part_px = 4;

//! Returns whether the image covers any part of a pixel.
bool is_shown(const Projection& projection, int x, int y) { return image_coverage(projection, x + 0.5, y + 0.5) > 0.0; }

//! Returns whether the parts of a tile with this mark are marked individually, because their pixels
//! may need many rays.
bool is_in_parts(TileMark mark, int side_px) {
  const bool by_pixels = mark == TileMark::edge || mark == TileMark::thin;
  return side_px > small_tile_px ? by_pixels || mark == TileMark::fine : by_pixels && side_px > 1;
}

//! Calls each(x, y) for the pixels of a tile that are above `bottom` and in the image.
template <class Each>
void visit_tile(const Projection& projection, int side_px, int left, int top, int bottom, const Each& each) {
  for (int y = top; y < std::min(top + side_px, bottom); ++y) {
    for (int x = left; x < std::min(left + side_px, projection.width_px); ++x) {
      if (is_shown(projection, x, y)) {
        each(x, y);
      }
    }
  }
}

//! Detects tiles that extend across sheets of a picture. The ray through a tile's middle does not
//! represent parts beyond the edge of a cube face.
class Seams {
 public:
  explicit Seams(const Projection& projection) : sheets_(picture_sheets(projection)) {}

  [[nodiscard]] bool tear(int x, int y, int side_px) const {
    return sheets_.size() > 1 && std::ranges::none_of(sheets_, [&](const PictureSheet& sheet) {
             const PixelCell& cell = sheet.cell;
             return x >= cell.left_px && y >= cell.top_px && x + side_px <= cell.left_px + cell.width_px &&
                    y + side_px <= cell.top_px + cell.height_px;
           });
  }

 private:
  std::vector<PictureSheet> sheets_;
};

}  // namespace

void ObjectPixels::look_through(Tiles& tiles, int side_px, std::vector<TileMark>& marks) const {
  const std::size_t count = tiles.places.size() / 2;
  marks.resize(count);
  if (count == 0) {
    return;
  }
  const Buffer<std::int32_t> places(backend_, tiles.places, "objects' tiles");
  const Buffer<TileMark> marked(backend_, count, "objects' tiles");
  const ObjectTileBatch batch = {objects_, places.data(), static_cast<int>(count),
                                 side_px,  turn_per_px_,  marked.data()};
  if (flat_) {
    const Buffer<FlatReach> along(backend_, tiles.reach, "objects' tiles");
    const Buffer<FlatReach> seen(backend_, count, "objects' tiles");
    launch(backend_,
           FlatObjectTileBatch{batch, *flat_, std::max(side_px, least_part_px) * pixel_angle(objects_.projection),
                               along.data(), seen.data()});
    seen.read(tiles.reach.data(), count);
  } else {
    launch(backend_, batch);
  }
  marked.read(marks.data(), count);
}

std::vector<std::int32_t> ObjectPixels::shown_tiles(int left, int right, int top, int bottom, int side_px) const {
  std::vector<std::int32_t> tiles;
  for (int y = top; y < std::min(bottom, bottom_); y += side_px) {
    for (int x = left; x < std::min(right, width_); x += side_px) {
      bool shown = false;
      visit_tile(objects_.projection, side_px, x, y, bottom_, [&](int, int) { shown = true; });
      if (shown) {
        tiles.insert(tiles.end(), {x, y});
      }
    }
  }
  return tiles;
}

ObjectPixels::Tiles ObjectPixels::parts_of(const Tiles& tiles, int side_px, int part_px) const {
  std::vector<TileMark> marks;
  Tiles seen = tiles;
  look_through(seen, side_px, marks);
  const Seams seams(objects_.projection);
  Tiles parts;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const int x = tiles.places[2 * i];
    const int y = tiles.places[2 * i + 1];
    const bool torn = seams.tear(x, y, side_px);
    if (marks[i] == TileMark::nothing && !torn) {
      continue;
    }
    const std::vector<std::int32_t> places = shown_tiles(x, x + side_px, y, y + side_px, part_px);
    parts.places.insert(parts.places.end(), places.begin(), places.end());
    parts.reach.resize(parts.places.size() / 2, torn ? tiles.reach[i] : seen.reach[i]);
  }
  return parts;
}

void ObjectPixels::mark_flat_pixels(Wanted& wanted) {
  // A line of sight takes many rays: large tiles narrow the range along it in which smaller tiles
  // search.
  Tiles tiles = {shown_tiles(0, width_, top_, bottom_, large_tile_px), {}};
  tiles.reach.assign(tiles.places.size() / 2, {0.0F, static_cast<float>(flat_->most_w), 0.0F});
  tiles = parts_of(tiles, large_tile_px, object_tile_px);
  tiles = parts_of(tiles, object_tile_px, small_tile_px);
  Tiles whole;
  Tiles single_pixels;
  const Seams seams(objects_.projection);
  for (std::size_t i = 0; i < tiles.reach.size(); ++i) {
    const int left = tiles.places[2 * i];
    const int top = tiles.places[2 * i + 1];
    const auto add = [&tiles, i](Tiles& to, int x, int y) {
      to.places.insert(to.places.end(), {x, y});
      to.reach.push_back(tiles.reach[i]);
    };
    if (seams.tear(left, top, small_tile_px)) {
      visit_tile(objects_.projection, small_tile_px, left, top, bottom_,
                 [&](int x, int y) { add(single_pixels, x, y); });
    } else {
      add(whole, left, top);
    }
  }
  reach_.resize(seen_.size());
  const Tiles thin = add_seen(whole, small_tile_px, wanted);
  for (std::size_t i = 0; i < thin.reach.size(); ++i) {
    visit_tile(objects_.projection, small_tile_px, thin.places[2 * i], thin.places[2 * i + 1], bottom_,
               [&](int x, int y) {
                 single_pixels.places.insert(single_pixels.places.end(), {x, y});
                 single_pixels.reach.push_back(thin.reach[i]);
               });
  }
  add_seen(single_pixels, 1, wanted);
}

ObjectPixels::Tiles ObjectPixels::add_seen(Tiles& tiles, int side_px, Wanted& wanted) {
  std::vector<TileMark> marks;
  look_through(tiles, side_px, marks);
  Tiles thin;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == TileMark::nothing) {
      continue;
    }
    if (is_in_parts(marks[i], side_px)) {
      thin.places.insert(thin.places.end(), {tiles.places[2 * i], tiles.places[2 * i + 1]});
      thin.reach.push_back(tiles.reach[i]);
      continue;
    }
    std::vector<std::int32_t>& to = wanted.of(marks[i]);
    visit_tile(objects_.projection, side_px, tiles.places[2 * i], tiles.places[2 * i + 1], bottom_, [&](int x, int y) {
      to.insert(to.end(), {x, y});
      reach_[index_of(x, y)] = tiles.reach[i];
    });
  }
  return thin;
}

void ObjectPixels::mark_pixels(Wanted& wanted) const {
  std::vector<std::int32_t> tiles = shown_tiles(0, width_, top_, bottom_, object_tile_px);
  // Where pixels would need many rays, smaller tiles narrow down which of them do.
  for (const int side_px : {object_tile_px, small_tile_px, 1}) {
    tiles = mark_tiles(std::move(tiles), side_px, wanted);
  }
}

std::vector<std::int32_t> ObjectPixels::mark_tiles(std::vector<std::int32_t> places, int side_px,
                                                   Wanted& wanted) const {
  Tiles tiles = {std::move(places), {}};
  std::vector<TileMark> marks;
  look_through(tiles, side_px, marks);
  const Seams seams(objects_.projection);
  std::vector<std::int32_t> parts;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const int left = tiles.places[2 * i];
    const int top = tiles.places[2 * i + 1];
    if (marks[i] == TileMark::nothing && !seams.tear(left, top, side_px)) {
      continue;
    }
    if (is_in_parts(marks[i], side_px)) {
      const std::vector<std::int32_t> own =
          shown_tiles(left, left + side_px, top, top + side_px, side_px > small_tile_px ? small_tile_px : 1);
      parts.insert(parts.end(), own.begin(), own.end());
    } else {
      std::vector<std::int32_t>& to = wanted.of(marks[i]);
      visit_tile(objects_.projection, side_px, left, top, bottom_, [&](int x, int y) { to.insert(to.end(), {x, y}); });
    }
  }
  return parts;
}

}  // namespace ergodome
