#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! The position of an image in an equirectangular panorama [px], as cameras and stitchers write it into XMP.
struct PanoramaCrop {
  int full_width = 0;  //!< 0 if the metadata has none
  int full_height = 0;
  int left = 0;
  int top = 0;
  int width = 0;  //!< of the image when it was cropped; it may have been scaled since
  int height = 0;
  std::string problem;  //!< what is not supported; empty if nothing
};

struct ShownLayout;

//! Makes the window of a layout the whole panorama, with the file's pixels in their position; scaled as the image was.
void place_crop(const PanoramaCrop& crop, ShownLayout& layout);

//! Reads the first XMP packet in an image's bytes. Source: Google, "Photo Sphere XMP Metadata" (GPano).
PanoramaCrop read_panorama_crop(std::string_view bytes);

}  // namespace ergodome
