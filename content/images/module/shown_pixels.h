#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <vector>

#include "content/images/formats/shown_layout.h"

namespace ergodome {

//! Returns how the selected part of a file is shown.
ShownLayout shown_layout(const OIIO::ImageInput& input);

//! The channels to read of one part of a file.
struct StoredPixels {
  int part = 0;
  int first_channel = 0;
  int channels = 3;

  bool operator==(const StoredPixels&) const = default;
};

//! Reads pixels and puts them at their positions in the shown image; the rest of it is black.
//! Returns false if the file is damaged.
bool read_in_place(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout,
                   std::vector<float>& shown);
bool read_in_place(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout,
                   std::vector<std::uint16_t>& shown);

}  // namespace ergodome
