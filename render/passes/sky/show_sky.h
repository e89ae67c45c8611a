#pragma once

#include <memory>
#include <optional>

#include "content/show/show.h"
#include "content/sky/environment_image.h"
#include "render/passes/sky/polygon_filter.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {

//! The sky map of a show in the form that its filter and redshift setting need: a cube map, or
//! column sums for SkyFilter::polygon. Temperatures are stored only if the setting uses them.
class ShowSky {
 public:
  //! Loads the show's sky map. Throws Error if it cannot be read.
  ShowSky(const Show& show, Backend backend);

  //! Resamples the map for the sky rotation of `show`, which must differ from the first show only
  //! in numbers. The first call loads the image, which is then kept in memory. Throws Error if it
  //! cannot be read.
  void turn(const Show& show, Backend backend);

  //! Returns the cube map. For SkyFilter::polygon it has one texel per face, with the mean of the
  //! sky.
  [[nodiscard]] const SkyCube& cube() const { return *cube_; }

  //! Returns the counts of texels that were repaired when the map's file was read.
  [[nodiscard]] const RepairedTexels& repaired() const { return repaired_; }

  //! Returns the polygon filter, or nullptr unless the show uses SkyFilter::polygon.
  [[nodiscard]] const PolygonFilter* polygons() const { return polygons_.get(); }

  //! Returns how the frequency shift changes the map's light; SkyShift::none if the show has no
  //! redshift.
  [[nodiscard]] SkyShift shift() const { return shift_; }

  //! Returns the table for SkyShift::blackbody_fit, in the backend's memory; otherwise a table
  //! without entries.
  [[nodiscard]] BlackbodyTable colours() const { return colours_ ? colours_->view() : BlackbodyTable{}; }

 private:
  void lay_out(const EnvironmentImage& image, const Show& show, Backend backend, const TemperatureFit* fit);

  SkyShift shift_;
  RepairedTexels repaired_;
  //! The map's image; loaded when the sky is first rotated.
  std::optional<EnvironmentImage> image_;
  std::optional<TemperatureFit> fit_;  //!< loaded when the sky is first rotated
  std::unique_ptr<BlackbodyColours> colours_;
  std::unique_ptr<PolygonFilter> polygons_;
  std::unique_ptr<SkyCube> cube_;
};

}  // namespace ergodome
