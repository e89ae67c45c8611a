#include "content/images/image_library.h"

#include <dlfcn.h>

#include "kernels/core/error.h"

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

}  // namespace ergodome
