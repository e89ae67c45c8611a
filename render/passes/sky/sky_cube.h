#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "content/sky/environment_image.h"
#include "kernels/sky/cube_map.h"
#include "render/backend/buffer.h"
#include "render/passes/sky/image_rows.h"
#include "render/passes/sky/temperature_fit.h"

namespace ergodome {

//! The sky as a cube map with mip levels, in the memory of a backend.
class SkyCube {
 public:
  //! Resamples an equirectangular image, rotated to the hole's sky axes. The width of a face is a
  //! quarter of the image's, rounded up to a power of two and limited to 2048. If `fit` is not
  //! null, each texel also stores the temperature of its color (kernels/sky/cube_map.h), for
  //! SkyShift::blackbody_fit. `name`: name of the memory in the work counters.
  SkyCube(Backend backend, const EnvironmentImage& image, const glm::dmat3& sky_from_map,
          const TemperatureFit* fit = nullptr, const char* name = "sky map");

  //! Samples a function that returns the light of a direction (unit vector), for tests and
  //! procedural skies. `face_size` is a power of two.
  SkyCube(Backend backend, int face_size, const std::function<glm::vec3(const glm::dvec3&)>& light,
          const TemperatureFit* fit = nullptr);

  [[nodiscard]] CubeMap view() const;

  //! Returns the size of the cube map for an image of a given width [bytes].
  static std::size_t bytes_for(int map_width);

 private:
  using LightOfRow = std::function<void(const DirectionRow&, std::span<glm::vec3>)>;

  //! `brightest`: upper limit of the light of all rows.
  void build(Backend backend, int face_size, const LightOfRow& light, float brightest, const TemperatureFit* fit,
             const char* name);

  CubeMap map_{};
  Buffer<HalfQuad> texels_;
};

}  // namespace ergodome
