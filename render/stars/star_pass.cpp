#include "render/stars/star_pass.h"

#include <algorithm>
#include <cmath>

#include "content/sky_map.h"
#include "render/lens/grid_builder.h"

namespace ergodome {

namespace {

//! Rays mend what the grid misses: it has to lead them to the right image, no more.
constexpr double grid_budget_px = 1.0;
//! Cells smaller than this are not refined: rays start from what they have.
constexpr double least_area_px = 4.0;
//! Both eyes.
constexpr std::size_t kept = 2;

StarSettings star_settings(const Show& show) {
  StarSettings settings;
  settings.faintest = static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * show.sky.faintest_mag));
  settings.redshift = show.effects.redshift;
  settings.magnification = show.effects.magnification;
  return settings;
}

}  // namespace

StarPass::StarPass(const Show& show)
    : colours_(Backend::cpu),
      field_(load_stars(show), sky_from_map(show.sky), colours_.view()),
      settings_(star_settings(show)),
      splat_{show.effects.psf ? show.effects.psf->sigma_px : 0.0,
             static_cast<float>(show.sky.exposure / luminance_of_white)} {}

const StarPass::Turned& StarPass::patches_for(const EyeCamera& eye, const StarSettings& asked) {
  const double pixel = asked.pixel;
  const auto found = std::ranges::find_if(turned_, [&](const Turned& each) {
    return each.spin == eye.spin && each.r == eye.r && each.theta == eye.theta && each.pixel == pixel &&
           each.motion == eye.motion && dot(eye.velocity - each.velocity, eye.velocity - each.velocity) < 1e-12;
  });
  if (found != turned_.end()) {
    std::rotate(turned_.begin(), found, found + 1);
    return turned_.front();
  }
  GridSettings settings;
  settings.pixel = pixel;
  settings.budget_px = grid_budget_px;
  settings.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  settings.fine = false;
  settings.least_area_px = least_area_px;
  LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, settings, nullptr, &tracer_);
  StarPatches patches = star_patches(field_, colours_.view(), eye, station, asked);
  turned_.insert(turned_.begin(), Turned{eye.spin, eye.r, eye.theta, pixel, eye.motion, eye.velocity,
                                         std::move(station), std::move(patches)});
  if (turned_.size() > kept) {
    turned_.pop_back();
  }
  return turned_.front();
}

std::vector<StarImage> StarPass::find(const EyeCamera& eye, const Projection& projection) {
  if (field_.stars().empty()) {
    return {};
  }
  StarSettings settings = settings_;
  settings.pixel = pixel_angle(projection);
  const Turned& turned = patches_for(eye, settings);
  return find_star_images(field_, colours_.view(), eye, turned.station, turned.patches, settings);
}

void StarPass::draw(const std::vector<StarImage>& images, const EyeCamera& eye, const Projection& projection,
                    int first_row, int row_count, float* rgba) const {
  splat_stars(images, eye, projection, splat_, first_row, row_count, rgba);
}

}  // namespace ergodome
