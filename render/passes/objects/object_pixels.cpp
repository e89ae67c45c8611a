#include "render/passes/objects/object_pixels.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/shadow/critical_curve.h"

namespace ergodome {

namespace {

//! Relative difference in brightness between pixels that requires finer samples.
constexpr float visible_step = 0.2F;
//! Square roots of the numbers of slices in a pixel that contains or touches the shadow's edge:
//! initially, and where its own or its neighbors' slices hit anything. Sixteen slices leave gaps in
//! images of the third order, sixty-four leave beads.
constexpr int first_edge_slices = 6;
constexpr int edge_slices = 12;
//! The same for other pixels with thin images.
constexpr int first_thin_slices = 4;
constexpr int thin_slices = 8;
//! The same for pixels whose images are only stretched, after four rays.
constexpr int stretched_slices = 6;

//! Returns the size of a pixel relative to the smallest radius of the shadow.
double part_of_shadow(const ObjectScene& objects) {
  constexpr int sides = 4;
  const ShadowChart chart = make_shadow_chart(objects.camera);
  double least = 1.0;
  for (int i = 0; i < sides; ++i) {
    least = std::min(least, std::sin(edge_polar_angle(objects.camera, chart, 0.5 * pi * i)));
  }
  return pixel_angle(objects.projection) / std::max(least, 1e-3);
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

void ObjectPixels::look() {
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
  const Buffer<std::int32_t> places(backend_, pixels, "objects' pixels");
  const Buffer<float> rgba(backend_, 4 * count, "objects' pixels");
  const Buffer<float> time(backend_, count, "objects' pixels");
  const Buffer<std::int32_t> content(backend_, count, "objects' pixels");
  const ObjectPixelBatch batch = {objects_,    places.data(), static_cast<int>(count), pattern, samples,
                                  rgba.data(), time.data(),   content.data()};
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
std::vector<std::int32_t> ObjectPixels::pixels_of_block(const std::vector<std::int32_t>& looked_at,
                                                        const Is& is) const {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < looked_at.size(); i += 2) {
    const int x = looked_at[i];
    const int y = looked_at[i + 1];
    if (y >= first_row_ && y < first_row_ + row_count_ && is(x, y)) {
      found.insert(found.end(), {x, y});
    }
  }
  return found;
}

std::vector<std::int32_t> ObjectPixels::uneven_pixels(const std::vector<std::int32_t>& looked_at) const {
  return pixels_of_block(looked_at, [this](int x, int y) { return is_uneven(x, y); });
}

std::vector<std::int32_t> ObjectPixels::pixels_of_thin_images(const std::vector<std::int32_t>& looked_at) const {
  return pixels_of_block(looked_at, [this](int x, int y) { return is_by_thin_image(x, y); });
}

}  // namespace ergodome
