#include "content/images/image_library.h"

#include <dlfcn.h>

#include <algorithm>

#include "kernels/core/error.h"
#include "kernels/image/color_map.h"

namespace ergodome {

namespace {

const ImageLibrary& load() {
  constexpr const char* file = ERGODOME_IMAGE_MODULE;
  // The module is never closed: its objects may be in use until the program ends.
  void* const module = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  void* const entry = module != nullptr ? dlsym(module, "ergodome_openimageio") : nullptr;
  if (entry == nullptr) {
    const char* const reason = dlerror();
    throw Error(
        file,
        std::string("cannot be loaded: ") + (reason != nullptr ? reason : "it is not an image library of Ergodome"),
        "run app/setup and build again");
  }
  const ImageLibrary* const library = reinterpret_cast<const ImageLibrary* (*)(std::uint64_t)>(entry)(image_interface);
  if (library == nullptr) {
    throw Error(file, "comes from another build than the program", "build everything again, or reinstall");
  }
  return *library;
}

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load();
  return library;
}

float LightCoding::alpha_of(const float* pixel) const {
  return alpha >= 0 ? std::clamp(pixel[alpha], 0.0F, 1.0F) : 1.0F;
}

int LightCoding::light_channels() const {
  const int colours = channels >= 3 ? 3 : 1;
  return decoded || separate ? std::max(colours, alpha + 1) : colours;
}

void LightCoding::put_light(const float* pixel, float* rgb) const {
  const float part = decoded || separate ? alpha_of(pixel) : 1.0F;
  const bool grey = channels < 3;
  for (int c = 0; c < 3; ++c) {
    float value = pixel[grey ? 0 : c];
    if (decoded) {
      const float colour = separate || part <= 0.0F ? value : value / part;
      value = srgb_decoded(colour) * part;
    } else if (separate) {
      value *= part;
    }
    rgb[c] = value;
  }
}

LightCoding light_coding(const ImageShape& shape) {
  return {shape.channels, shape.alpha_channel, shape.encoded, shape.separate_alpha};
}

}  // namespace ergodome
