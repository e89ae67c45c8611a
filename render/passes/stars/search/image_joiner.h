#pragma once

#include <cstdint>
#include <vector>

#include "kernels/stars/search/image_join.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Star images in a backend's memory, ordered by star. Entries whose star is -1 are unused.
struct PlacedImages {
  Buffer<StarImage> images;
  int count = 0;
};

//! Images that a search found and left in a backend's memory. They include duplicates.
struct BackendImages {
  const SeenImage* images = nullptr;
  int count = 0;
};

//! Merges images and removes duplicates in the backend's memory. Reuses its own memory.
class ImageJoiner {
 public:
  //! `stars`: number of stars; all indices are below it.
  ImageJoiner(Backend backend, std::size_t stars);

  //! Merges the images in the backend's memory with `others` in host memory, and returns each image
  //! once, ordered by star. `pixel`: angle of a pixel [rad].
  PlacedImages join(const BackendImages& found, const std::vector<SeenImage>& others, double pixel, ImageOrder order);

 private:
  Backend backend_;
  int stars_;
  Buffer<std::int32_t> counts_;
  Buffer<std::int32_t> first_;
  Buffer<std::int32_t> numbers_;
  Buffer<SeenImage> others_;
};

}  // namespace ergodome
