#include "render/stars/star_finder.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Errors of traced rays on the sky, in float and in double; images move by that over the smaller singular value of the map.
constexpr double float_tolerance = 5e-7;
constexpr double double_tolerance = 1e-9;
//! Newton's last step, after which the image is where it is to a small part of that.
constexpr double step_tolerance_px = 0.02;
//! Images of one star nearer to each other than this, and not turned over, are one.
constexpr double same_image_px = 0.1;
//! Smaller singular value of the map to the sky below which float's rounding is seen in an image's place.
constexpr double steepest = 0.1;
constexpr int step_limit = 400;
//! The coldest and the hottest star that colours tell of: they gain most by a shift to the blue and to the red.
constexpr float log_coldest = 7.38F;
constexpr float log_hottest = 10.4F;

//! Luminance of a blackbody seen with a frequency ratio, over its own.
float shift_gain(const BlackbodyTable& colours, float log_temperature, float frequency_ratio) {
  return std::exp(read_blackbody(colours, log_temperature + std::log(frequency_ratio)).x -
                  read_blackbody(colours, log_temperature).x);
}

//! What the search needs of the observer.
class Observer final : public ImageLight {
 public:
  Observer(const EyeCamera& eye, const LensStation& station, const BlackbodyTable& colours, bool redshift)
      : colours_(colours),
        redshift_(redshift),
        chart_(grid_view(station).chart),
        rain_(make_camera_station(eye.spin, eye.r, eye.theta, 0.0, ObserverMotion::rain)),
        aberration_(aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity)),
        inverse_zamo_{aberration_.zamo_from_observer.axis, 1.0 / aberration_.zamo_from_observer.stretch},
        inverse_rain_{aberration_.rain_from_zamo.axis, 1.0 / aberration_.rain_from_zamo.stretch} {}

  //! The rain-frame direction of a place in the chart.
  [[nodiscard]] Vector3<double> rain_direction(double gamma_turns, double s) const {
    const ChartStretch<double> stretch = chart_stretch(chart_, gamma_turns, s);
    const Vector3<MixedDual<double>> n = chart_direction_at(chart_, gamma_turns, stretch.alpha);
    return {n.x.value, n.y.value, n.z.value};
  }

  //! Seen by the observer.
  [[nodiscard]] Vector3<double> observed(const Vector3<double>& rain) const {
    double energy = 0.0;
    return aberrated(inverse_zamo_, aberrated(inverse_rain_, rain, energy), energy);
  }

  void see(StarPatch& patch) const override {
    const Vector3<double> n =
        rain_direction(static_cast<double>(patch.gamma_turns) + 0.5 * static_cast<double>(patch.width_turns),
                       static_cast<double>(patch.s) + 0.5 * static_cast<double>(patch.height));
    const double scale = observed_scale(aberration_, n);
    const double energy = detail::evaluate(rain_.energy, n) * scale;
    patch.brightening = static_cast<float>(scale * scale);
    patch.frequency_ratio = static_cast<float>(1.0 / std::max(energy, 1e-6));
  }

  [[nodiscard]] float greatest_gain(const StarPatch& patch, float magnification) const override {
    const float from = patch.frequency_ratio >= 1.0F ? log_coldest : log_hottest;
    return gain_at(patch, magnification, from);
  }

  [[nodiscard]] float gain(const StarPatch& patch, float magnification, const FieldStar& star) const override {
    return gain_at(patch, magnification, star.log_temperature);
  }

 private:
  //! A patch is small, its middle stands for it but for a margin.
  [[nodiscard]] float gain_at(const StarPatch& patch, float magnification, float log_temperature) const {
    return 1.2F * magnification * patch.brightening *
           (redshift_ ? shift_gain(colours_, log_temperature, 1.05F * patch.frequency_ratio) : 1.0F);
  }

  BlackbodyTable colours_;
  bool redshift_;
  LensChart chart_;
  CameraStation rain_;
  Aberration aberration_;
  FrameBoost inverse_zamo_;
  FrameBoost inverse_rain_;
};

std::vector<RoughImage> find_rough(const StarField& field, const Observer& observer, double phi,
                                   const StarPatches& patches, float faintest) {
  std::vector<RoughImage> all;
  std::mutex mutex;
  const auto& list = patches.patches();
  parallel_for(static_cast<int>(list.size()), 32, [&](int begin, int end) {
    std::vector<RoughImage> found;
    for (int i = begin; i < end; ++i) {
      const StarPatch& patch = list[static_cast<std::size_t>(i)];
      patches.search(patch, field, observer, phi, false, faintest, found);
      if (patches.mirrored()) {
        patches.search(patch, field, observer, phi, true, faintest, found);
      }
    }
    const std::lock_guard lock(mutex);
    all.insert(all.end(), found.begin(), found.end());
  });
  // Chunks end in any order; pictures do not depend on it.
  std::ranges::sort(all, [](const RoughImage& a, const RoughImage& b) {
    return std::tie(a.star, a.s, a.gamma_turns) < std::tie(b.star, b.s, b.gamma_turns);
  });
  return all;
}

//! Images on their way from roughly to exactly.
struct Candidate {
  int star;
  Vector3<double> on_sky;     //!< the star, for a camera at φ = 0
  Vector3<double> direction;  //!< of the image, in the observer's frame
  double solid_angle = 0.0;   //!< and the rest as in StarImageBatch
  double stretch = 0.0;
  double frequency_ratio = 1.0;
  double miss = 0.0;
};

//! Finds images exactly, as far as rays in S are exact.
template <class S>
void refine(std::vector<Candidate>& candidates, const EyeCamera& eye, double pixel) {
  constexpr std::size_t channels = 10;
  const std::size_t count = candidates.size();
  std::vector<S> values(channels * count);
  const auto channel = [&](std::size_t i) { return values.data() + i * count; };
  for (std::size_t i = 0; i < count; ++i) {
    const Candidate& c = candidates[i];
    const double parts[6] = {c.on_sky.x, c.on_sky.y, c.on_sky.z, c.direction.x, c.direction.y, c.direction.z};
    for (std::size_t part = 0; part < 6; ++part) {
      channel(part)[i] = static_cast<S>(parts[part]);
    }
  }
  const StarImageBatch<S> batch = {
      converted_station<S>(make_camera_station(eye.spin, eye.r, eye.theta, 0.0, eye.motion, eye.velocity)),
      {sizeof(S) == 4 ? float_tolerance : double_tolerance, step_limit, true},
      static_cast<S>(step_tolerance_px * pixel),
      static_cast<int>(count),
      {channel(0), channel(1), channel(2)},
      {channel(3), channel(4), channel(5)},
      channel(6),
      channel(7),
      channel(8),
      channel(9)};
  find_star_images(batch);
  for (std::size_t i = 0; i < count; ++i) {
    Candidate& c = candidates[i];
    const auto at = [&](std::size_t part) { return static_cast<double>(channel(part)[i]); };
    c.direction = {at(3), at(4), at(5)};
    c.solid_angle = at(6);
    c.stretch = at(7);
    c.frequency_ratio = at(8);
    c.miss = at(9);
  }
}

//! Squares of the singular values of the map from the camera's sky to the stars'.
struct SingularValues {
  double larger_square;
  double smaller_square;
};

SingularValues singular_values(const Candidate& c) {
  const double root = std::sqrt(std::max(c.stretch * c.stretch - 4.0 * c.solid_angle * c.solid_angle, 0.0));
  const double larger = 0.5 * (c.stretch + root);
  return {larger, larger > 0.0 ? c.solid_angle * c.solid_angle / larger : 0.0};
}

//! Images that float does not place: where the sky hardly moves when the camera turns, its rounding is many pixels' worth.
void refine_steep(std::vector<Candidate>& candidates, const EyeCamera& eye, double pixel) {
  std::vector<std::size_t> places;
  std::vector<Candidate> steep;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].miss < 1e29 && singular_values(candidates[i]).smaller_square < steepest * steepest) {
      places.push_back(i);
      steep.push_back(candidates[i]);
    }
  }
  refine<double>(steep, eye, pixel);
  for (std::size_t i = 0; i < places.size(); ++i) {
    candidates[places[i]] = steep[i];
  }
}

//! Solid angle on the sky over that on the camera, no smaller than the star's disk allows: where the map is degenerate in one direction,
//! the image is an arc whose length the disk sets.
double capped_solid_angle(const Candidate& c, float radius) {
  return std::max(std::abs(c.solid_angle),
                  0.5 * static_cast<double>(radius) * std::sqrt(singular_values(c).larger_square));
}

//! Whether an image was there already: `images` of the same star stand at the end, from `first` on.
bool is_twin(const std::vector<StarImage>& images, std::size_t first, const StarImage& image, double pixel) {
  const auto limit = static_cast<float>(same_image_px * pixel);
  for (std::size_t i = first; i < images.size(); ++i) {
    const Vector3<float> apart = images[i].direction - image.direction;
    if (dot(apart, apart) < limit * limit && (images[i].magnification < 0.0F) == (image.magnification < 0.0F)) {
      return true;
    }
  }
  return false;
}

}  // namespace

StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const EyeCamera& eye,
                         const LensStation& station, const StarSettings& settings) {
  return {station, Observer(eye, station, colours, settings.redshift),
          settings.faintest / std::max(field.brightest(), 1e-30F)};
}

std::vector<StarImage> find_star_images(const StarField& field, const BlackbodyTable& colours, const EyeCamera& eye,
                                        const LensStation& station, const StarPatches& patches,
                                        const StarSettings& settings) {
  const Observer observer(eye, station, colours, settings.redshift);
  const std::vector<RoughImage> rough = find_rough(field, observer, eye.phi, patches, settings.faintest);
  std::vector<Candidate> candidates;
  candidates.reserve(rough.size());
  const double sine_phi = std::sin(eye.phi);
  const double cosine_phi = std::cos(eye.phi);
  for (const RoughImage& image : rough) {
    const Vector3<double>& d = field.stars()[static_cast<std::size_t>(image.star)].direction;
    const Vector3<double> near =
        observer.rain_direction(static_cast<double>(image.gamma_turns), static_cast<double>(image.s));
    candidates.push_back({image.star,
                          {cosine_phi * d.x + sine_phi * d.y, cosine_phi * d.y - sine_phi * d.x, d.z},
                          observer.observed(near)});
  }
  refine<float>(candidates, eye, settings.pixel);
  refine_steep(candidates, eye, settings.pixel);
  std::vector<StarImage> images;
  std::size_t first = 0;
  for (const Candidate& c : candidates) {
    if (!(c.miss <= step_tolerance_px * settings.pixel)) {
      continue;
    }
    const FieldStar& star = field.stars()[static_cast<std::size_t>(c.star)];
    const auto solid_angle = static_cast<float>(capped_solid_angle(c, star.radius));
    const auto g = static_cast<float>(c.frequency_ratio);
    const Vector3<float> light =
        star_light(colours, star.log_temperature, star.illuminance, settings.redshift ? g : 1.0F, 1.0F / solid_angle);
    if (!(0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z >= settings.faintest)) {
      continue;
    }
    first = !images.empty() && images.back().star == c.star ? first : images.size();
    const StarImage image = {
        c.star,
        {static_cast<float>(c.direction.x), static_cast<float>(c.direction.y), static_cast<float>(c.direction.z)},
        (c.solid_angle < 0.0 ? -1.0F : 1.0F) / solid_angle,
        g,
        settings.magnification ? light : solid_angle * light};
    if (!is_twin(images, first, image, settings.pixel)) {
      images.push_back(image);
    }
  }
  return images;
}

}  // namespace ergodome
