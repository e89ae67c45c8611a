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

//! Owns the sky as a cube map with its mip pyramid, on the backend that reads it.
class SkyCube {
 public:
  //! Resamples an equirectangular image, turned into the hole's sky axes; about as many texels as the image has.
  //!
  //! `fit`, where given: texels keep the temperature of their colour (kernels/sky/cube_map.h), for SkyShift::blackbody_fit. `name` is what its
  //! bytes are counted by.
  SkyCube(Backend backend, const EnvironmentImage& image, const glm::dmat3& sky_from_map,
          const TemperatureFit* fit = nullptr, const char* name = "sky map");

  //! A sky from a function of the direction (unit vector): for tests and procedural skies. `face_size` is a power of two.
  SkyCube(Backend backend, int face_size, const std::function<glm::vec3(const glm::dvec3&)>& light,
          const TemperatureFit* fit = nullptr);

  [[nodiscard]] CubeMap view() const;

  //! Memory of the cube that an image of a width becomes.
  static std::size_t bytes_for(int map_width);

 private:
  using LightOfRow = std::function<void(const DirectionRow&, std::span<glm::vec3>)>;

  void build(Backend backend, int face_size, const LightOfRow& light, const TemperatureFit* fit, const char* name);

  CubeMap map_{};
  Buffer<float> texels_;
};

}  // namespace ergodome
