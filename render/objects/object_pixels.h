#pragma once

#include <cstdint>
#include <vector>

#include "kernels/mesh/draw_objects.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Pixels of a block of rows that objects are looked for in, and what came of it. One row more on each side is looked at: outlines are
//! finer where neighbours differ.
class ObjectPixels {
 public:
  //! `first_row` and `row_count`: of the block itself, within the image.
  ObjectPixels(Backend backend, const ObjectScene& objects, int first_row, int row_count);

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

  //! The pixels of tiles that may see objects; `fine`: of those where these are small.
  void mark_tiles(std::vector<std::int32_t>& coarse, std::vector<std::int32_t>& fine) const;

  //! Looks at pixels, and keeps what they show.
  void look_at(const std::vector<std::int32_t>& pixels, int samples);

  //! Pixels of the block whose four samples tell less than sixteen would.
  [[nodiscard]] std::vector<std::int32_t> uneven_pixels(const std::vector<std::int32_t>& looked_at) const;

  [[nodiscard]] bool is_uneven(int x, int y) const;
  [[nodiscard]] const Seen& seen(int x, int y) const { return seen_[index_of(x, y)]; }
  [[nodiscard]] std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  Backend backend_;
  ObjectScene objects_;
  int width_;
  int first_row_, row_count_;
  int top_, bottom_;  //!< with the rows beside
  std::vector<Seen> seen_;
  std::vector<float> rgba_;
  std::vector<float> time_;
};

}  // namespace ergodome
