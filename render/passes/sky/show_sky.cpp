#include "render/passes/sky/show_sky.h"

#include "content/sky/sky_map.h"

namespace ergodome {

namespace {

//! Returns the temperature fit, if a setting shifts the map's light by temperature. It uses a table
//! in host memory, because the CPU cannot read that of a GPU.
std::optional<TemperatureFit> fit_for(SkyShift shift) {
  std::optional<TemperatureFit> fit;
  if (shift == SkyShift::blackbody_fit) {
    fit.emplace(BlackbodyColours(Backend::cpu).view());
  }
  return fit;
}

}  // namespace

ShowSky::ShowSky(const Show& show, Backend backend) : shift_(show.effects.redshift ? show.sky.shift : SkyShift::none) {
  const std::optional<TemperatureFit> fit = fit_for(shift_);
  if (fit) {
    colours_ = std::make_unique<BlackbodyColours>(backend);
  }
  lay_out(load_sky_map(show), show, backend, fit ? &*fit : nullptr);
}

void ShowSky::turn(const Show& show, Backend backend) {
  if (!image_) {
    fit_ = fit_for(shift_);
    image_ = load_sky_map(show);
  }
  lay_out(*image_, show, backend, fit_ ? &*fit_ : nullptr);
}

void ShowSky::lay_out(const EnvironmentImage& image, const Show& show, Backend backend, const TemperatureFit* fit) {
  repaired_ = image.repaired;
  const glm::dmat3 turn = sky_from_map(show.sky);
  if (show.sky.filter == SkyFilter::polygon) {
    polygons_ = std::make_unique<PolygonFilter>(image, turn, fit);
    const glm::vec3 mean(polygons_->mean());
    cube_ = std::make_unique<SkyCube>(backend, 1, [&](const glm::dvec3&) { return mean; });
  } else {
    cube_ = std::make_unique<SkyCube>(backend, image, turn, fit);
  }
}

}  // namespace ergodome
