#pragma once

#include <OpenImageIO/imageio.h>

#include <vector>

#include "content/images/formats/shown_layout.h"
#include "content/images/module/shown_pixels.h"

namespace ergodome {

//! Reads rows of an image that is stored in scanlines or tiles. Keeps the last band of tiles, so
//! that reading rows in order decodes each tile once, with the memory of one band for any height.
class StoredRows {
 public:
  //! Reads rows [begin, end), counted from the first stored one. Returns false if the file is
  //! damaged.
  bool read(OIIO::ImageInput& input, const StoredPixels& stored, int begin, int end, float* to);

  //! Reads rows [begin, end) of the window of an upright layout, black where the file has no
  //! pixels. Returns false if the file is damaged.
  bool read_window(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout, int begin, int end,
                   float* to);

  //! Discards the kept band; call it after selecting another part.
  void forget() { band_end_ = band_begin_ = 0; }

  //! Returns true if a band of the image's tiles needs at most 512 MiB.
  static bool is_bounded(const OIIO::ImageSpec& spec);

 private:
  bool read_band(OIIO::ImageInput& input, const StoredPixels& stored, int row);

  std::vector<float> band_;
  int band_begin_ = 0;
  int band_end_ = 0;
  StoredPixels kept_;  //!< the channels that the kept band of tiles contains
};

}  // namespace ergodome
