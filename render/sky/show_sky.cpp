#include "render/sky/show_sky.h"

#include <optional>

#include "content/sky_map.h"

namespace ergodome {

ShowSky::ShowSky(const Show& show, Backend backend) : shift_(show.effects.redshift ? show.sky.shift : SkyShift::none) {
  const EnvironmentImage image = load_sky_map(show);
  const glm::dmat3 turn = sky_from_map(show.sky);
  std::optional<TemperatureFit> fit;
  if (shift_ == SkyShift::blackbody_fit) {
    // The fit is made on the processor, which cannot read a GPU's table.
    fit.emplace(BlackbodyColours(Backend::cpu).view());
    colours_ = std::make_unique<BlackbodyColours>(backend);
  }
  const TemperatureFit* fitted = fit ? &*fit : nullptr;
  if (show.sky.filter == SkyFilter::polygon) {
    polygons_ = std::make_unique<PolygonFilter>(image, turn, fitted);
    const glm::vec3 mean(polygons_->mean());
    cube_ = std::make_unique<SkyCube>(backend, 1, [&](const glm::dvec3&) { return mean; });
  } else {
    cube_ = std::make_unique<SkyCube>(backend, image, turn, fitted);
  }
}

}  // namespace ergodome
