#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "content/show/show.h"
#include "kernels/launch/large_memory.h"

namespace ergodome {

//! Light above this value, which is far above the Sun in any unit, is clamped to it.
inline constexpr float brightest_texel = 1e9F;
//! Replaces infinite light: the maximum of half floats, from whose overflow it usually results. A
//! larger value would outshine the sky.
inline constexpr float infinite_texel = 65504.0F;

//! Numbers of invalid texels that were repaired. Each texel is counted once.
struct RepairedTexels {
  //! Texels above brightest_texel, clamped to it, and infinite ones, set to infinite_texel.
  long too_bright = 0;
  long below_zero = 0;   //!< texels with a negative color component, which was set to 0
  long not_numbers = 0;  //!< texels with a NaN color component, which were set to black

  [[nodiscard]] long all() const { return too_bright + below_zero + not_numbers; }

  //! Returns true if the user should be warned. Negative values are normal results of filters and
  //! gamut conversions.
  [[nodiscard]] bool are_a_mistake() const { return too_bright + not_numbers > 0; }
};

//! Returns a text such as "3 texels infinite or brighter than 1e+09 (clamped), 1 texel with a
//! negative color (set to 0)"; empty without repaired texels.
std::string repair_text(const RepairedTexels& texels);

//! Returns a note about repaired texels of a show's map, with its key ("sky.map") and its path in
//! the show.
std::string note_of_repair(const Show& show, const std::string& key, const std::string& name,
                           const RepairedTexels& texels);

//! A sky as an equirectangular image: linear light, three floats per texel, top row first.
struct EnvironmentImage {
  std::string name;
  int width = 0;
  int height = 0;           //!< width / 2
  int file_width = 0;       //!< width of the image in the file, which may be larger; 0 if there is no file
  LargeVector<float> rgb;   //!< 3 * width * height, finite and >= 0
  RepairedTexels repaired;  //!< statistics of invalid texels in the file
};

//! A file, and the layer that a name such as "sky.exr#ViewLayer.Emit" selects.
struct LayeredFile {
  std::filesystem::path path;
  std::string layer;  //!< empty if the name does not select one
};

//! Splits a name at its last "#", unless a file with the full name exists.
LayeredFile layered_file(const std::filesystem::path& name);

//! Reads an equirectangular image (2:1) or a cube map (CubeMapLayout), which becomes
//! equirectangular; EXR, HDR, PNG, TIFF, JPEG and others, through OpenImageIO. The name may select
//! an OpenEXR layer. Averages an image wider than `largest_width` texels down to that width.
EnvironmentImage read_environment_image(const std::filesystem::path& name, int largest_width = 8192);

//! Reads a sky image, as the function above does, from the bytes of a file; the ending of `name`
//! gives its format.
EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name,
                                        int largest_width = 8192);

}  // namespace ergodome
