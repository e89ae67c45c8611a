#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! The position of an image in an equirectangular panorama [px], from the XMP metadata that cameras
//! and stitchers write.
struct PanoramaCrop {
  int full_width = 0;  //!< width of the whole panorama [px]; 0 if the metadata has no crop
  int full_height = 0;
  int left = 0;
  int top = 0;
  int width = 0;  //!< width of the image when it was cropped; it may have been scaled later
  int height = 0;
  std::string problem;  //!< what is not supported; empty if everything is
};

struct ShownLayout;

//! Makes the panorama the window of a layout, with the file's pixels at their position in it.
//! Scales the panorama as the image was scaled.
void place_crop(const PanoramaCrop& crop, ShownLayout& layout);

//! Reads the first XMP packet in an image's bytes. Source: Google, "Photo Sphere XMP Metadata"
//! (GPano).
PanoramaCrop read_panorama_crop(std::string_view bytes);

}  // namespace ergodome
