#include "render/passes/objects/object_pixels.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/passes/stars/drawing/picture_regions.h"

namespace ergodome {

namespace {

//! Relative difference in brightness between neighboring pixels above which they get more samples.
constexpr float visible_step = 0.2F;
//! Square roots of the number of slices in a pixel that contains or touches the shadow's edge:
//! first for all such pixels, then for those whose own or neighboring slices hit an image that may
//! be thinner than a slice. With sixteen slices, images of the third order have gaps; with
//! sixty-four they look like beads.
constexpr int first_edge_slices = 6;
constexpr int edge_slices = 12;
//! Square roots of the number of slices in pixels with thin images away from the shadow's edge
//! (TileMark::thin): first for all, then for those whose own or neighboring slices hit an image
//! that may be thinner than a slice.
constexpr int first_thin_slices = 4;
constexpr int thin_slices = 8;
//! Square root of the number of slices in pixels whose images are only stretched
//! (TileMark::stretched), if four rays are not enough (uneven_pixels()).
constexpr int stretched_slices = 6;

//! Returns the size of a pixel as a fraction of the smallest radius of the shadow.
double part_of_shadow(const ObjectScene& objects) {
  constexpr int sides = 4;
  const ShadowChart chart = make_shadow_chart(objects.camera);
  double minimum = 1.0;
  for (int i = 0; i < sides; ++i) {
    minimum = std::min(minimum, std::sin(edge_polar_angle(objects.camera, chart, 0.5 * pi * i)));
  }
  return pixel_angle(objects.projection) / std::max(minimum, 1e-3);
}

}  // namespace

ObjectPixels::ObjectPixels(Backend backend, const ObjectScene& objects, int first_row, int row_count,
                           const std::optional<FlatEyeSight>& flat)
    : backend_(backend),
      objects_(objects),
      width_(objects.projection.width_px),
      flat_(flat),
      first_row_(first_row),
      row_count_(row_count),
      top_(std::max(first_row - 1, 0)),
      bottom_(std::min(first_row + row_count + 1, objects.projection.height_px)),
      turn_per_px_(part_of_shadow(objects)),
      seen_(static_cast<std::size_t>(bottom_ - top_) * static_cast<std::size_t>(width_)),
      rgba_(4 * static_cast<std::size_t>(row_count) * static_cast<std::size_t>(width_)),
      time_(static_cast<std::size_t>(row_count) * static_cast<std::size_t>(width_)) {}

std::vector<std::int32_t>& ObjectPixels::Wanted::of(TileMark mark) {
  switch (mark) {
    case TileMark::stretched:
      return stretched;
    case TileMark::fine:
      return fine;
    case TileMark::thin:
      return thin;
    case TileMark::edge:
      return edge;
    default:
      return coarse;
  }
}

void ObjectPixels::draw() {
  Wanted wanted;
  if (flat_) {
    mark_flat_pixels(wanted);
  } else {
    mark_pixels(wanted);
  }
  look_at(wanted.coarse, PixelPattern::grid, 2);
  look_at(wanted.stretched, PixelPattern::grid, 2);
  look_at(wanted.fine, PixelPattern::grid, 4);
  look_at(wanted.thin, PixelPattern::slices, first_thin_slices);
  look_at(wanted.edge, PixelPattern::slices, first_edge_slices);
  // Neighbors are compared by their first results, before any pixel is refined.
  const std::vector<std::int32_t> uneven = uneven_pixels(wanted.coarse);
  const std::vector<std::int32_t> uneven_stretched = uneven_pixels(wanted.stretched);
  const std::vector<std::int32_t> more_thin = pixels_of_thin_images(wanted.thin);
  const std::vector<std::int32_t> more_edge = pixels_of_thin_images(wanted.edge);
  look_at(uneven, PixelPattern::grid, 4);
  look_at(uneven_stretched, PixelPattern::slices, stretched_slices);
  look_at(more_thin, PixelPattern::slices, thin_slices);
  look_at(more_edge, PixelPattern::slices, edge_slices);
}

std::vector<FlatReach> ObjectPixels::reach_of(const std::vector<std::int32_t>& pixels) const {
  std::vector<FlatReach> reach;
  reach.reserve(pixels.size() / 2);
  for (std::size_t i = 0; i < pixels.size(); i += 2) {
    reach.push_back(reach_[index_of(pixels[i], pixels[i + 1])]);
  }
  return reach;
}

void ObjectPixels::look_at(const std::vector<std::int32_t>& pixels, PixelPattern pattern, int samples) {
  const std::size_t count = pixels.size() / 2;
  if (count == 0) {
    return;
  }
  const Buffer<std::int32_t> positions(backend_, pixels, "objects' pixels");
  const Buffer<float> rgba(backend_, 4 * count, "objects' pixels");
  const Buffer<float> time(backend_, count, "objects' pixels");
  const Buffer<std::int32_t> content(backend_, count, "objects' pixels");
  const ObjectPixelBatch batch = {objects_,    positions.data(), static_cast<int>(count), pattern, samples,
                                  rgba.data(), time.data(),      content.data()};
  if (flat_) {
    const Buffer<FlatReach> reach(backend_, reach_of(pixels), "objects' pixels");
    launch(backend_, FlatObjectPixelBatch{batch, *flat_, reach.data()});
  } else {
    launch(backend_, batch);
  }
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

bool ObjectPixels::is_by_thin_image(int x, int y) const {
  for (int row = std::max(y - 1, top_); row <= std::min(y + 1, bottom_ - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width_ - 1); ++column) {
      if (seen(column, row).content == pixel_of_several) {
        return true;
      }
    }
  }
  return false;
}

template <class Is>
std::vector<std::int32_t> ObjectPixels::pixels_of_block(const std::vector<std::int32_t>& visited, const Is& is) const {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < visited.size(); i += 2) {
    const int x = visited[i];
    const int y = visited[i + 1];
    if (y >= first_row_ && y < first_row_ + row_count_ && is(x, y)) {
      found.insert(found.end(), {x, y});
    }
  }
  return found;
}

std::vector<std::int32_t> ObjectPixels::uneven_pixels(const std::vector<std::int32_t>& visited) const {
  return pixels_of_block(visited, [this](int x, int y) { return is_uneven(x, y); });
}

std::vector<std::int32_t> ObjectPixels::pixels_of_thin_images(const std::vector<std::int32_t>& visited) const {
  return pixels_of_block(visited, [this](int x, int y) { return is_by_thin_image(x, y); });
}

namespace {

constexpr int object_tile_px = 4;
constexpr int large_tile_px = 16;
constexpr int small_tile_px = 2;
//! Minimum length [px], as the head sees it, of the part of a flat eye's line of sight that one ray
//! represents; for larger tiles it is the tile's side. Shorter parts cost more than they save
//! later.
constexpr int min_part_px = 4;

//! Returns whether the image covers any part of a pixel.
bool is_shown(const Projection& projection, int x, int y) { return image_coverage(projection, x + 0.5, y + 0.5) > 0.0; }

//! Returns whether a tile with this mark is divided and its parts are marked separately, because
//! their pixels may need many rays.
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

//! Finds tiles that extend across several regions of a picture (PictureRegion: cube faces). For
//! such a tile, the ray through its center does not represent the part beyond the edge of a face.
class Seams {
 public:
  explicit Seams(const Projection& projection) : sheets_(picture_regions(projection)) {}

  [[nodiscard]] bool tear(int x, int y, int side_px) const {
    return sheets_.size() > 1 && std::ranges::none_of(sheets_, [&](const PictureRegion& sheet) {
             const PixelCell& cell = sheet.cell;
             return x >= cell.left_px && y >= cell.top_px && x + side_px <= cell.left_px + cell.width_px &&
                    y + side_px <= cell.top_px + cell.height_px;
           });
  }

 private:
  std::vector<PictureRegion> sheets_;
};

}  // namespace

void ObjectPixels::trace_marks(Tiles& tiles, int side_px, std::vector<TileMark>& marks) const {
  const std::size_t count = tiles.positions.size() / 2;
  marks.resize(count);
  if (count == 0) {
    return;
  }
  const Buffer<std::int32_t> positions(backend_, tiles.positions, "objects' tiles");
  const Buffer<TileMark> marked(backend_, count, "objects' tiles");
  const ObjectTileBatch batch = {objects_, positions.data(), static_cast<int>(count),
                                 side_px,  turn_per_px_,     marked.data()};
  if (flat_) {
    const Buffer<FlatReach> along(backend_, tiles.reach, "objects' tiles");
    const Buffer<FlatReach> seen(backend_, count, "objects' tiles");
    launch(backend_,
           FlatObjectTileBatch{batch, *flat_, std::max(side_px, min_part_px) * pixel_angle(objects_.projection),
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
  trace_marks(seen, side_px, marks);
  const Seams seams(objects_.projection);
  Tiles parts;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const int x = tiles.positions[2 * i];
    const int y = tiles.positions[2 * i + 1];
    const bool torn = seams.tear(x, y, side_px);
    if (marks[i] == TileMark::nothing && !torn) {
      continue;
    }
    const std::vector<std::int32_t> positions = shown_tiles(x, x + side_px, y, y + side_px, part_px);
    parts.positions.insert(parts.positions.end(), positions.begin(), positions.end());
    parts.reach.resize(parts.positions.size() / 2, torn ? tiles.reach[i] : seen.reach[i]);
  }
  return parts;
}

void ObjectPixels::mark_flat_pixels(Wanted& wanted) {
  // A flat eye's line of sight takes many rays. Large tiles are examined first, to reduce the range
  // along it in which smaller tiles search.
  Tiles tiles = {shown_tiles(0, width_, top_, bottom_, large_tile_px), {}};
  tiles.reach.assign(tiles.positions.size() / 2, {0.0F, static_cast<float>(flat_->max_w), 0.0F});
  tiles = parts_of(tiles, large_tile_px, object_tile_px);
  tiles = parts_of(tiles, object_tile_px, small_tile_px);
  Tiles whole;
  Tiles single_pixels;
  const Seams seams(objects_.projection);
  for (std::size_t i = 0; i < tiles.reach.size(); ++i) {
    const int left = tiles.positions[2 * i];
    const int top = tiles.positions[2 * i + 1];
    const auto add = [&tiles, i](Tiles& to, int x, int y) {
      to.positions.insert(to.positions.end(), {x, y});
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
    visit_tile(objects_.projection, small_tile_px, thin.positions[2 * i], thin.positions[2 * i + 1], bottom_,
               [&](int x, int y) {
                 single_pixels.positions.insert(single_pixels.positions.end(), {x, y});
                 single_pixels.reach.push_back(thin.reach[i]);
               });
  }
  add_seen(single_pixels, 1, wanted);
}

ObjectPixels::Tiles ObjectPixels::add_seen(Tiles& tiles, int side_px, Wanted& wanted) {
  std::vector<TileMark> marks;
  trace_marks(tiles, side_px, marks);
  Tiles thin;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == TileMark::nothing) {
      continue;
    }
    if (is_in_parts(marks[i], side_px)) {
      thin.positions.insert(thin.positions.end(), {tiles.positions[2 * i], tiles.positions[2 * i + 1]});
      thin.reach.push_back(tiles.reach[i]);
      continue;
    }
    std::vector<std::int32_t>& to = wanted.of(marks[i]);
    visit_tile(objects_.projection, side_px, tiles.positions[2 * i], tiles.positions[2 * i + 1], bottom_,
               [&](int x, int y) {
                 to.insert(to.end(), {x, y});
                 reach_[index_of(x, y)] = tiles.reach[i];
               });
  }
  return thin;
}

void ObjectPixels::mark_pixels(Wanted& wanted) const {
  std::vector<std::int32_t> tiles = shown_tiles(0, width_, top_, bottom_, object_tile_px);
  // Where pixels would need many rays, smaller tiles determine which pixels really do.
  for (const int side_px : {object_tile_px, small_tile_px, 1}) {
    tiles = mark_tiles(std::move(tiles), side_px, wanted);
  }
}

std::vector<std::int32_t> ObjectPixels::mark_tiles(std::vector<std::int32_t> positions, int side_px,
                                                   Wanted& wanted) const {
  Tiles tiles = {std::move(positions), {}};
  std::vector<TileMark> marks;
  trace_marks(tiles, side_px, marks);
  const Seams seams(objects_.projection);
  std::vector<std::int32_t> parts;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const int left = tiles.positions[2 * i];
    const int top = tiles.positions[2 * i + 1];
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
