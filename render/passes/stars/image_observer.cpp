#include "render/passes/stars/image_observer.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/launch.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "kernels/stars/observed_positions.h"
#include "render/passes/stars/drawing/edge_rounding.h"

namespace ergodome {

namespace {

//! Returns the factor by which a frequency ratio changes the luminance of a blackbody.
float gain_of_shift(const BlackbodyTable& colours, float log_temperature, float frequency_ratio) {
  return std::exp(read_blackbody(colours, log_temperature + std::log(frequency_ratio)).x -
                  read_blackbody(colours, log_temperature).x);
}

//! Returns the energy at infinity of light that the camera at the center of an ODS eye's positions
//! sees with energy 1, as a function of the direction in the view's axes.
DirectionForm<double> middle_energy(const OmniEye& eye) {
  const OmniCameraOf<double> cameras = eye.cameras->exact(eye.side);
  const double* c = cameras.coefficients + omni_energy * omni_terms(cameras.degree);
  const int next = omni_terms(cameras.degree);
  return {c[0], {c[next], c[2 * next], c[3 * next]}};
}

//! Returns a bound of the difference between the energies seen by the other cameras of an ODS eye
//! and that at the center. Each monomial of the camera position is at most 1, so the bound is a sum
//! of coefficients.
float energy_spread(const OmniEye& eye) {
  const OmniCameraOf<double> cameras = eye.cameras->exact(eye.side);
  const int terms = omni_terms(cameras.degree);
  const double* c = cameras.coefficients + omni_energy * terms;
  double spread = 0.0;
  for (int i = 0; i < 4 * terms; ++i) {
    spread += i % terms > 0 ? std::abs(c[i]) : 0.0;
  }
  // Convergence also rotates the view directions of the cameras.
  const Vector3<double> along = middle_energy(eye).along;
  return static_cast<float>(spread +
                            std::abs(cameras.offset) * cameras.inverse_convergence * std::sqrt(dot(along, along)));
}

}  // namespace

Aberration aberration_of(const StarEye& eye) {
  const EyeCamera& c = eye.camera;
  return eye.omni ? no_aberration() : aberration_to_rain(c.spacetime, c.r, c.theta, c.motion, c.velocity);
}

ImageObserver::ImageObserver(const StarEye& eye, const LensStation& station, const BlackbodyTable& colours,
                             bool redshift)
    : colours_(colours),
      redshift_(redshift),
      chart_(grid_view(station).chart),
      cameras_(eye.omni),
      energy_(eye.omni
                  ? middle_energy(*eye.omni)
                  : make_camera_station(eye.camera.spacetime, eye.camera.r, eye.camera.theta, 0.0, ObserverMotion::rain)
                        .energy),
      energy_spread_(eye.omni ? energy_spread(*eye.omni) : 0.0F),
      aberration_(aberration_of(eye)) {}

double ImageObserver::edge_distance(float s) const { return ergodome::edge_distance(chart_, static_cast<double>(s)); }

ObservedPositions ImageObserver::observe(std::span<const RoughImage> images) const {
  std::vector<float> gamma_turns(images.size());
  std::vector<float> s(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    gamma_turns[i] = images[i].gamma_turns;
    s[i] = images[i].s;
  }
  ObservedPositions positions;
  for (std::vector<float>* part : {&positions.direction[0], &positions.direction[1], &positions.direction[2],
                                   &positions.area, &positions.frequency_ratio}) {
    part->resize(images.size());
  }
  run_on_this_thread(ObservedPositionBatch{
      chart_,
      energy(),
      observer(),
      static_cast<int>(images.size()),
      gamma_turns.data(),
      s.data(),
      {positions.direction[0].data(), positions.direction[1].data(), positions.direction[2].data()},
      positions.area.data(),
      positions.frequency_ratio.data()});
  if (cameras_) {
    // The frequency ratio is that of the camera which an ODS eye has for the direction. Directions
    // are in the chart's frame.
    const OmniCameraOf<double> cameras = cameras_->cameras->exact(cameras_->side);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const Vector3<double> direction = {static_cast<double>(positions.direction[0][i]),
                                         static_cast<double>(positions.direction[1][i]),
                                         static_cast<double>(positions.direction[2][i])};
      positions.frequency_ratio[i] = static_cast<float>(1.0 / std::max(energy_of(cameras, direction), 1e-6));
    }
  }
  return positions;
}

float ImageObserver::shift_gain(const FieldStar& star, float frequency_ratio) const {
  return redshift_ ? gain_of_shift(colours_, star.log_temperature, frequency_ratio) : 1.0F;
}

//! Enlarges the bounds by margins, because values between the sampled positions may be larger.
PatchLight ImageObserver::light_in(float brightening, float frequency_ratio) const {
  // Cameras beside the central one may see an energy that is smaller by up to this bound.
  const float minimum = std::max(1.0F - energy_spread_ * frequency_ratio, 0.1F);
  return {1.05F * brightening,
          redshift_ ? ShiftGains::row_of(1.01F * frequency_ratio / minimum) : ShiftGains::unshifted_row()};
}

}  // namespace ergodome
