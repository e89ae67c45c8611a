#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <vector>

#include "content/images/shown_layout.h"

namespace ergodome {

//! How the part of a file that is open is shown.
ShownLayout shown_layout(const OIIO::ImageInput& input);

//! Reads the first `channels` of a part's pixels, and puts them where its picture shows them; what they leave of it is black. False where the file is torn.
bool read_in_place(OIIO::ImageInput& input, int part, const ShownLayout& layout, int channels,
                   std::vector<float>& shown);
bool read_in_place(OIIO::ImageInput& input, int part, const ShownLayout& layout, int channels,
                   std::vector<std::uint16_t>& shown);

}  // namespace ergodome
