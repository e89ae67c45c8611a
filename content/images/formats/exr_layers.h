#pragma once

#include <string>
#include <vector>

namespace ergodome {

//! One part of an OpenEXR file.
struct ExrPart {
  std::string name;
  std::string view;  //!< of stereo; empty if none
  std::vector<std::string> channels;
};

//! The channels of a layer: red, green and blue, or one grey one, and alpha if it follows them.
struct ExrLayer {
  std::string name;  //!< empty for plain R, G, B
  int part = 0;
  int first_channel = 0;
  int channels = 0;
  int alpha = -1;  //!< counted from the first channel
};

//! Returns the layers of a file that can be shown, in the file's order. Of a stereo file only the first view counts. In a file
//! of several parts, plain channels form a layer with the name of their part.
std::vector<ExrLayer> exr_layers(const std::vector<ExrPart>& parts);

//! Returns the layer of a name, its last word or its whole name in any case; for an empty name plain R, G, B, or else the
//! layer Combined, rgba or beauty, or else the only one. If none fits or several do, `problem` lists the layers.
ExrLayer choose_exr_layer(const std::vector<ExrLayer>& layers, const std::string& name, std::string& problem);

}  // namespace ergodome
