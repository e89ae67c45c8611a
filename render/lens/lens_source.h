#pragma once

#include "kernels/image/lens_pixels.h"

namespace ergodome {

//! Where the lens of a picture may come from; `automatic` takes what is cheapest at the asked accuracy.
enum class LensChoice { automatic, streamed, live, direct };

//! What maps the pixels of one eye's image to the sky.
class LensSource {
 public:
  LensSource() = default;
  virtual ~LensSource() = default;
  LensSource(const LensSource&) = delete;
  LensSource& operator=(const LensSource&) = delete;

  //! Fills the channels of rows [first_row, first_row + row_count): row_count * width elements each, in the backend's memory.
  virtual void fill(int first_row, int row_count, const LensPixels& out) const = 0;

  //! Whether two eyes' images, whose projections are the same, can be filled with less work together.
  [[nodiscard]] virtual bool shares_work_with(const LensSource& other) const {
    static_cast<void>(other);
    return false;
  }

  //! Fills the same rows of both.
  virtual void fill_both(const LensSource& other, int first_row, int row_count, const LensPixels& out,
                         const LensPixels& of_other) const {
    fill(first_row, row_count, out);
    other.fill(first_row, row_count, of_other);
  }

  //! A word for the display: "direct", "live", "streamed".
  [[nodiscard]] virtual const char* name() const = 0;

  //! Whether the lens is that of a place where the camera was a moment ago, because its own was not ready in time.
  [[nodiscard]] virtual bool behind() const { return false; }
};

}  // namespace ergodome
