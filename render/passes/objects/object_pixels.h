#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/objects/draw_objects.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Traces the objects in a block of rows of a picture. Also traces one more row above and below the
//! block, because a pixel whose neighbors differ from it gets more samples.
class ObjectPixels {
 public:
  //! `first_row` and `row_count`: the block without the additional rows, within the image.
  //! `flat`: for an eye of the stereo model `flat`; `objects` is then the scene of its head.
  ObjectPixels(Backend backend, const ObjectScene& objects, int first_row, int row_count,
               const std::optional<FlatEyeSight>& flat = {});

  //! Traces the pixels that may see objects with the kernels; the others stay 0.
  void draw();

  //! For each pixel of the block, in host memory: rgba() returns the light and coverage of objects,
  //! time() the Mino time of this light to the camera or, for eyes of the model `flat`, minus the
  //! nearness of the object. See ObjectLayer.
  [[nodiscard]] const std::vector<float>& rgba() const { return rgba_; }
  [[nodiscard]] const std::vector<float>& time() const { return time_; }

 private:
  struct Seen {
    float brightness = 0.0F;
    std::int32_t content = pixel_of_nothing;
  };

  //! A list of square tiles of the picture.
  struct Tiles {
    std::vector<std::int32_t> positions;  //!< x and y of each tile's first pixel
    //! For eyes of the model `flat`: range of nearness in which each tile's objects are searched
    //! for, or were found.
    std::vector<FlatReach> reach;
  };

  //! Returns the tiles that divide a rectangle of the picture, without those outside the image.
  [[nodiscard]] std::vector<std::int32_t> shown_tiles(int left, int right, int top, int bottom, int side_px) const;

  //! Determines whether the pixels of each tile may see objects, and how they are then sampled
  //! (TileMark). For eyes of the model `flat`, reduces each tile's reach to the range in which it
  //! sees objects.
  void trace_marks(Tiles& tiles, int side_px, std::vector<TileMark>& marks) const;

  //! Pixels to be traced (x and y of each), sorted by how they are sampled.
  struct Wanted {
    std::vector<std::int32_t> coarse;     //!< pixels that are first sampled with four rays
    std::vector<std::int32_t> stretched;  //!< first sampled with four rays; outlines with slices
    std::vector<std::int32_t> fine;       //!< sampled with sixteen rays
    std::vector<std::int32_t> thin;       //!< first sampled with sixteen slices
    //! First sampled with 36 slices; with 144 if these, or a neighbor's, hit an image that may be
    //! thinner than a slice.
    std::vector<std::int32_t> edge;

    //! Returns the list to which pixels of tiles with a mark belong. Also accepts `nothing`, for
    //! tiles across several cube faces: their pixels are coarse.
    [[nodiscard]] std::vector<std::int32_t>& of(TileMark mark);
  };

  //! Divides tiles for an eye of the model `flat` into smaller tiles with a reduced reach. Omits
  //! tiles that cannot see objects; keeps tiles across several cube faces with their reach.
  [[nodiscard]] Tiles parts_of(const Tiles& tiles, int side_px, int part_px) const;

  //! Collects the pixels that may see objects.
  void mark_pixels(Wanted& wanted) const;
  void mark_flat_pixels(Wanted& wanted);

  //! Determines the marks of tiles. Adds the pixels of tiles that may see objects, or that are
  //! across several cube faces, to `wanted`. If the parts of a tile have to be marked separately,
  //! returns them as smaller tiles instead.
  [[nodiscard]] std::vector<std::int32_t> mark_tiles(std::vector<std::int32_t> positions, int side_px,
                                                     Wanted& wanted) const;

  //! Determines the marks of tiles for an eye of the model `flat`, and adds the pixels of tiles
  //! that see anything to `wanted`, with their reach. Returns the tiles whose pixels have to be
  //! marked individually.
  Tiles add_seen(Tiles& tiles, int side_px, Wanted& wanted);

  //! Returns for each pixel the range of nearness in which it may see objects.
  [[nodiscard]] std::vector<FlatReach> reach_of(const std::vector<std::int32_t>& pixels) const;

  //! Traces pixels with samples² rays or slices each, and stores the results.
  void look_at(const std::vector<std::int32_t>& pixels, PixelPattern pattern, int samples);

  //! Returns those pixels of the list that are within the block and satisfy a condition.
  template <class Is>
  [[nodiscard]] std::vector<std::int32_t> pixels_of_block(const std::vector<std::int32_t>& visited, const Is& is) const;

  //! Returns those pixels of the list within the block that need finer slices: their own slices, or
  //! those of a neighbor, hit an image that may be thinner than a slice.
  [[nodiscard]] std::vector<std::int32_t> pixels_of_thin_images(const std::vector<std::int32_t>& visited) const;
  [[nodiscard]] bool is_by_thin_image(int x, int y) const;

  //! Returns those pixels of the list within the block that need more samples: their own samples
  //! differ, or a neighbor shows another object or differs visibly in brightness.
  [[nodiscard]] std::vector<std::int32_t> uneven_pixels(const std::vector<std::int32_t>& visited) const;

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
  //! First and last row of the picture that is traced, including the additional ones.
  int top_, bottom_;
  double turn_per_px_;  //!< rotation between adjacent pixels' rays [rad]; see ObjectTileBatch
  std::vector<Seen> seen_;
  std::vector<FlatReach> reach_;  //!< reach of each pixel, for an eye of the model `flat`
  std::vector<float> rgba_;
  std::vector<float> time_;
};

}  // namespace ergodome
