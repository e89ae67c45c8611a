#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/objects/draw_objects.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Pixels of a block of rows that objects are looked for in, and what came of it. One row more on each side is looked at: outlines are
//! finer where neighbours differ.
class ObjectPixels {
 public:
  //! `first_row` and `row_count`: of the block itself, within the image.
  //! `flat`: of an eye of that stereo model, beside the head whose objects' scene that is; else nothing.
  ObjectPixels(Backend backend, const ObjectScene& objects, int first_row, int row_count,
               const std::optional<FlatEyeSight>& flat = {});

  //! Finds out what there is to see, as kernels do it.
  void look();

  //! Of the block's rows: see ObjectLayer. In host memory.
  [[nodiscard]] const std::vector<float>& rgba() const { return rgba_; }
  [[nodiscard]] const std::vector<float>& time() const { return time_; }

 private:
  struct Seen {
    float brightness = 0.0F;
    std::int32_t content = pixel_of_nothing;
  };

  //! Tiles of the picture.
  struct Tiles {
    std::vector<std::int32_t> places;  //!< two numbers each: their first pixel, x and y
    std::vector<FlatReach> reach;      //!< of a flat eye: where objects are looked for, or seen
  };

  //! The tiles of a rectangle that are in the image.
  [[nodiscard]] std::vector<std::int32_t> shown_tiles(int left, int right, int top, int bottom, int side_px) const;

  //! What tiles see, and of a flat eye where.
  void look_through(Tiles& tiles, int side_px, std::vector<TileMark>& marks) const;

  //! Pixels to be looked at, two numbers each, by how they are.
  struct Wanted {
    std::vector<std::int32_t> coarse;     //!< by four rays at first
    std::vector<std::int32_t> stretched;  //!< the same, and outlines by slices
    std::vector<std::int32_t> fine;       //!< by sixteen rays
    std::vector<std::int32_t> thin;       //!< by sixteen slices at first
    std::vector<std::int32_t> edge;       //!< by more, and where anything is seen by many

    //! Those that tiles or pixels of a mark belong to; of others than `nothing`.
    [[nodiscard]] std::vector<std::int32_t>& of(TileMark mark);
  };

  //! The smaller tiles of those of a flat eye that may see objects.
  [[nodiscard]] Tiles parts_of(const Tiles& tiles, int side_px, int part_px) const;

  //! The pixels that may see objects.
  void mark_pixels(Wanted& wanted) const;
  void mark_flat_pixels(Wanted& wanted);

  //! Marks tiles, and adds the pixels of those that may see objects. Gives back the parts of those that are to be marked by themselves.
  [[nodiscard]] std::vector<std::int32_t> mark_tiles(std::vector<std::int32_t> places, int side_px,
                                                     Wanted& wanted) const;

  //! Looks through tiles of a flat eye, and adds the pixels of those that see anything, which they tell where. Gives back those whose pixels are to be marked
  //! one by one.
  Tiles add_seen(Tiles& tiles, int side_px, Wanted& wanted);

  //! Where pixels may show objects.
  [[nodiscard]] std::vector<FlatReach> reach_of(const std::vector<std::int32_t>& pixels) const;

  //! Looks at pixels, and keeps what they show.
  void look_at(const std::vector<std::int32_t>& pixels, PixelPattern pattern, int samples);

  //! Those of the block, of some pixels, that are so.
  template <class Is>
  [[nodiscard]] std::vector<std::int32_t> pixels_of_block(const std::vector<std::int32_t>& looked_at,
                                                          const Is& is) const;

  //! Those with slices that have met what may be thinner than these, or with such neighbours.
  [[nodiscard]] std::vector<std::int32_t> pixels_of_thin_images(const std::vector<std::int32_t>& looked_at) const;
  [[nodiscard]] bool is_by_thin_image(int x, int y) const;

  //! Pixels of the block whose samples tell less than more of them would.
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
  int top_, bottom_;    //!< with the rows beside
  double turn_per_px_;  //!< see ObjectTileBatch
  std::vector<Seen> seen_;
  std::vector<FlatReach> reach_;  //!< of a flat eye's pixels
  std::vector<float> rgba_;
  std::vector<float> time_;
};

}  // namespace ergodome
