#pragma once

#include <memory>
#include <string>

#include "content/images/image_library.h"

namespace ergodome {

//! Implements ImageLibrary::open() with OpenImageIO.
std::unique_ptr<ImageInput> open_image(const std::string& name, const ImageLibrary::Wishes& wishes,
                                       std::string& problem);

}  // namespace ergodome
