#pragma once

#include <memory>
#include <optional>

#include "content/show/show.h"
#include "content/sky/environment_image.h"
#include "render/passes/sky/polygon_filter.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {

//! The map of a show in the form that its filter and shift read, and nothing else: a cube map or column sums, with temperatures only where
//! the shift calls for them.
class ShowSky {
 public:
  //! Loads the map. Throws Error when it cannot be read.
  ShowSky(const Show& show, Backend backend);

  //! Lays the map out anew as a show turns it that differs from the first in numbers alone. From the first time on its image is kept. Throws Error when it
  //! cannot be read.
  void turn(const Show& show, Backend backend);

  //! For SkyFilter::polygon a single texel a face, the mean.
  [[nodiscard]] const SkyCube& cube() const { return *cube_; }

  //! Of the map's file.
  [[nodiscard]] const RepairedTexels& repaired() const { return repaired_; }

  //! nullptr but for SkyFilter::polygon.
  [[nodiscard]] const PolygonFilter* polygons() const { return polygons_.get(); }

  //! What the map's light is shifted by: nothing where the show has no redshift.
  [[nodiscard]] SkyShift shift() const { return shift_; }

  //! For SkyShift::blackbody_fit, in the backend's memory; else without entries.
  [[nodiscard]] BlackbodyTable colours() const { return colours_ ? colours_->view() : BlackbodyTable{}; }

 private:
  void lay_out(const EnvironmentImage& image, const Show& show, Backend backend, const TemperatureFit* fit);

  SkyShift shift_;
  RepairedTexels repaired_;
  std::optional<EnvironmentImage> image_;  //!< once it has turned
  std::optional<TemperatureFit> fit_;      //!< the same
  std::unique_ptr<BlackbodyColours> colours_;
  std::unique_ptr<PolygonFilter> polygons_;
  std::unique_ptr<SkyCube> cube_;
};

}  // namespace ergodome
