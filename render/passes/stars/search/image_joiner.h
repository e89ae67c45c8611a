#pragma once

#include <cstdint>
#include <vector>

#include "kernels/stars/seen_image.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Images of stars in a backend's memory, star by star; those whose star is -1 are none.
struct PlacedImages {
  Buffer<StarImage> images;
  int count = 0;
};

//! Images that a search has left in a backend's memory, some of them twice.
struct FoundInPlace {
  const SeenImage* images = nullptr;
  int count = 0;
};

//! Puts together what is found, where pictures are made: without_twins() for devices. Keeps its memory.
class ImageJoiner {
 public:
  //! Stars are numbered below `stars`.
  ImageJoiner(Backend backend, std::size_t stars);

  //! The images there are, star by star, each once, in the same order whatever chance has done: those in place and `others`. `pixel`: its angle [rad].
  PlacedImages join(const FoundInPlace& found, const std::vector<SeenImage>& others, double pixel);

 private:
  Backend backend_;
  int stars_;
  Buffer<std::int32_t> counts_;
  Buffer<std::int32_t> first_;
  Buffer<std::int32_t> numbers_;
  Buffer<SeenImage> others_;
};

}  // namespace ergodome
