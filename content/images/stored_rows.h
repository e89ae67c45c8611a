#pragma once

#include <OpenImageIO/imageio.h>

#include <vector>

#include "content/images/shown_layout.h"
#include "content/images/shown_pixels.h"

namespace ergodome {

//! Reads rows of an image, from scanlines or tiles. Of tiles it keeps the band that was read last, so that rows in order decode
//! each tile once, and an image of any height needs the memory of one band.
class StoredRows {
 public:
  //! Reads rows [begin, end), counted from the first that is stored. Returns false if the file is damaged.
  bool read(OIIO::ImageInput& input, const StoredPixels& stored, int begin, int end, float* to);

  //! Reads rows [begin, end) of the window of an upright layout, black where the file has no pixels.
  bool read_window(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout, int begin, int end,
                   float* to);

  //! Forgets the band: another part is open.
  void forget() { band_end_ = band_begin_ = 0; }

  //! True if a band of an image's tiles needs at most 512 MiB.
  static bool is_bounded(const OIIO::ImageSpec& spec);

 private:
  bool read_band(OIIO::ImageInput& input, const StoredPixels& stored, int row);

  std::vector<float> band_;
  int band_begin_ = 0;
  int band_end_ = 0;
  StoredPixels kept_;  //!< of the band
};

}  // namespace ergodome
