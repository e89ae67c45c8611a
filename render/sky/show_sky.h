#pragma once

#include <memory>

#include "content/show.h"
#include "render/sky/polygon_filter.h"
#include "render/sky/sky_cube.h"
#include "render/stars/blackbody_colours.h"

namespace ergodome {

//! The map of a show in the form that its filter and shift read, and nothing else: a cube map or column sums, with temperatures only where
//! the shift calls for them.
class ShowSky {
 public:
  //! Loads the map. Throws Error when it cannot be read.
  ShowSky(const Show& show, Backend backend);

  //! For SkyFilter::polygon a single texel a face, the mean.
  [[nodiscard]] const SkyCube& cube() const { return *cube_; }

  //! nullptr but for SkyFilter::polygon.
  [[nodiscard]] const PolygonFilter* polygons() const { return polygons_.get(); }

  //! What the map's light is shifted by: nothing where the show has no redshift.
  [[nodiscard]] SkyShift shift() const { return shift_; }

  //! For SkyShift::blackbody_fit, in the backend's memory; else without entries.
  [[nodiscard]] BlackbodyTable colours() const { return colours_ ? colours_->view() : BlackbodyTable{}; }

 private:
  SkyShift shift_;
  std::unique_ptr<BlackbodyColours> colours_;
  std::unique_ptr<PolygonFilter> polygons_;
  std::unique_ptr<SkyCube> cube_;
};

}  // namespace ergodome
