#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

//! Returns what is wrong with the attributes of an OpenEXR file. It finds attributes that claim
//! more bytes than the file has, which OpenEXR would allocate, and sizes that do not fit the
//! attribute's type. Returns an empty text for a correct file and for other formats. Source:
//! OpenEXR, "File Layout".
std::string problem_of_exr(const NextBytes& next, std::uintmax_t file_bytes);

//! One part of an OpenEXR file.
struct ExrPart {
  std::string name;
  std::string view;  //!< the view of a stereo file; empty if it has none
  std::vector<std::string> channels;
};

//! The channels of a layer: red, green and blue, or a single gray one, then alpha if it follows
//! them.
struct ExrLayer {
  std::string name;  //!< name of the layer; empty for plain R, G, B
  int part = 0;
  int first_channel = 0;
  int channels = 0;
  int alpha = -1;  //!< index of the alpha channel relative to `first_channel`; -1: none
};

//! Returns the layers of a file that can be shown, in the file's order, of a stereo file only those
//! of the first view. If several layers have plain channels (R, G, B), each gets the name of its
//! part. A part whose only channel has another name is a gray layer.
std::vector<ExrLayer> exr_layers(const std::vector<ExrPart>& parts);

//! Returns the layer with a name, which may be the layer's full name or its last word; case is
//! ignored. For an empty name, returns the layer of plain R, G, B, or else the layer Combined, rgba
//! or beauty, or else the only layer. If none or several match, sets `problem` to a list of the
//! layers.
ExrLayer choose_exr_layer(const std::vector<ExrLayer>& layers, const std::string& name, std::string& problem);

}  // namespace ergodome
