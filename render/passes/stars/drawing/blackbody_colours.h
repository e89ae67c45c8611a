#pragma once

#include "kernels/sky/blackbody.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Colors of blackbodies from 300 K to 10 million K, in the memory of a backend. Planck's law is
//! integrated with the color matching functions. Interpolation between entries changes the
//! luminance by at most 3e-4, at the cold end.
class BlackbodyColours {
 public:
  explicit BlackbodyColours(Backend backend);

  //! Returns the table; it points into this object.
  [[nodiscard]] BlackbodyTable view() const { return {entries_.data(), count, first_, step_}; }

  static constexpr int count = 2048;
  static constexpr long bytes = 4L * count * static_cast<long>(sizeof(float));

 private:
  float first_;
  float step_;
  Buffer<float> entries_;
};

}  // namespace ergodome
