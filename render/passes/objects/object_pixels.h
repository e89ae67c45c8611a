#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/objects/draw_objects.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Traces the objects in a block of rows of a picture. Includes one more row on each side, because
//! pixels whose neighbors differ get finer samples.
class ObjectPixels {
 public:
  //! `first_row` and `row_count`: the block without the additional rows, within the image.
  //! `flat`: for an eye of the stereo model `flat`; `objects` is then the scene of its head.
  ObjectPixels(Backend backend, const ObjectScene& objects, int first_row, int row_count,
               const std::optional<FlatEyeSight>& flat = {});

  //! Traces the pixels with the kernels.
  void look();

  //! Returns the light, and the time, of the block's rows in host memory; see ObjectLayer.
  [[nodiscard]] const std::vector<float>& rgba() const { return rgba_; }
  [[nodiscard]] const std::vector<float>& time() const { return time_; }

 private:
  struct Seen {
    float brightness = 0.0F;
    std::int32_t content = pixel_of_nothing;
  };

  //! A list of tiles.
  struct Tiles {
    std::vector<std::int32_t> places;  //!< x and y of the first pixel of each
    std::vector<FlatReach> reach;      //!< flat eyes only: range in which objects are sought, or seen
  };

  //! Returns the tiles of a rectangle that are in the image.
  [[nodiscard]] std::vector<std::int32_t> shown_tiles(int left, int right, int top, int bottom, int side_px) const;

  //! Determines what tiles see. For flat eyes, narrows each tile's reach to the range in which it
  //! sees objects.
  void look_through(Tiles& tiles, int side_px, std::vector<TileMark>& marks) const;

  //! Pixels to be traced (x and y of each), by the sampling that they need.
  struct Wanted {
    std::vector<std::int32_t> coarse;     //!< four rays at first
    std::vector<std::int32_t> stretched;  //!< the same; outlines by slices
    std::vector<std::int32_t> fine;       //!< sixteen rays
    std::vector<std::int32_t> thin;       //!< sixteen slices at first
    std::vector<std::int32_t> edge;       //!< more slices; many where anything is seen

    //! Returns the list for tiles or pixels with a mark other than `nothing`.
    [[nodiscard]] std::vector<std::int32_t>& of(TileMark mark);
  };

  //! Divides those tiles of a flat eye that may see objects into smaller ones.
  [[nodiscard]] Tiles parts_of(const Tiles& tiles, int side_px, int part_px) const;

  //! Collects the pixels that may see objects.
  void mark_pixels(Wanted& wanted) const;
  void mark_flat_pixels(Wanted& wanted);

  //! Marks tiles and collects the pixels of those that may see objects. Returns the parts of the
  //! tiles that must be marked at a finer level.
  [[nodiscard]] std::vector<std::int32_t> mark_tiles(std::vector<std::int32_t> places, int side_px,
                                                     Wanted& wanted) const;

  //! Marks tiles of a flat eye, and collects the pixels of those that see anything together with
  //! their reach. Returns the tiles whose pixels must be marked individually.
  Tiles add_seen(Tiles& tiles, int side_px, Wanted& wanted);

  //! Returns the range in which each pixel may see objects.
  [[nodiscard]] std::vector<FlatReach> reach_of(const std::vector<std::int32_t>& pixels) const;

  //! Traces pixels and stores the result.
  void look_at(const std::vector<std::int32_t>& pixels, PixelPattern pattern, int samples);

  //! Returns those pixels within the block that satisfy a condition.
  template <class Is>
  [[nodiscard]] std::vector<std::int32_t> pixels_of_block(const std::vector<std::int32_t>& looked_at,
                                                          const Is& is) const;

  //! Returns the pixels within the block whose slices, or whose neighbors' slices, hit images that
  //! may be thinner than a slice.
  [[nodiscard]] std::vector<std::int32_t> pixels_of_thin_images(const std::vector<std::int32_t>& looked_at) const;
  [[nodiscard]] bool is_by_thin_image(int x, int y) const;

  //! Returns the pixels within the block that need more samples.
  [[nodiscard]] std::vector<std::int32_t> uneven_pixels(const std::vector<std::int32_t>& looked_at) const;

  [[nodiscard]] bool is_uneven(int x, int y) const;
  [[nodiscard]] const Seen& seen(int x, int y) const { return seen_[index_of(x, y)]; }
  [[nodiscard]] std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  Backend backend_;
  ObjectScene objects_;
  int width_;
  std::optional<FlatEyeSight> flat_;
  int first_row_, row_count_;
  int top_, bottom_;    //!< including the additional rows
  double turn_per_px_;  //!< see ObjectTileBatch
  std::vector<Seen> seen_;
  std::vector<FlatReach> reach_;  //!< reach of a flat eye's pixels
  std::vector<float> rgba_;
  std::vector<float> time_;
};

}  // namespace ergodome
