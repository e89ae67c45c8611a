#include "render/stars/star_finder.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "render/lens/grid_builder.h"
#include "render/stars/rough_images.h"
#include "render/stars/star_refinement.h"
#include "render/stars/star_twins.h"

namespace ergodome {

namespace {

//! Rays mend what the grid misses: it has to lead them to the right images, no more.
constexpr double grid_budget_px = 0.3;
//! Cells smaller than this are not refined: rays start from what they have.
constexpr double least_star_cell_px = 4.0;
//! The coldest and the hottest star that colours tell of: they gain most by a shift to the blue and to the red.
constexpr float log_coldest = 7.38F;
constexpr float log_hottest = 10.4F;

//! Luminance of a blackbody seen with a frequency ratio, over its own.
float shift_gain(const BlackbodyTable& colours, float log_temperature, float frequency_ratio) {
  return std::exp(read_blackbody(colours, log_temperature + std::log(frequency_ratio)).x -
                  read_blackbody(colours, log_temperature).x);
}

//! From the observer's frame to that of the chart.
Aberration aberration_of(const StarEye& eye) {
  const EyeCamera& c = eye.camera;
  return eye.omni ? no_aberration() : aberration_to_rain(c.spin, c.r, c.theta, c.motion, c.velocity);
}

//! The energy that the camera in the middle of an eye's sees.
DirectionForm<double> middle_energy(const OmniEye& eye) {
  const OmniCameraOf<double> cameras = eye.cameras->exact(eye.side);
  const double* c = cameras.coefficients + omni_energy * omni_terms(cameras.degree);
  const int next = omni_terms(cameras.degree);
  return {c[0], {c[next], c[2 * next], c[3 * next]}};
}

//! The most that the energies which an eye's other cameras see may differ from that: the powers of their places are 1 at the most.
float energy_spread(const OmniEye& eye) {
  const OmniCameraOf<double> cameras = eye.cameras->exact(eye.side);
  const int terms = omni_terms(cameras.degree);
  const double* c = cameras.coefficients + omni_energy * terms;
  double spread = 0.0;
  for (int i = 0; i < 4 * terms; ++i) {
    spread += i % terms > 0 ? std::abs(c[i]) : 0.0;
  }
  // And what converging turns directions by.
  const Vector3<double> along = middle_energy(eye).along;
  return static_cast<float>(spread +
                            std::abs(cameras.offset) * cameras.inverse_convergence * std::sqrt(dot(along, along)));
}

//! What the search needs of the observer.
class Observer final : public ImageLight {
 public:
  Observer(const StarEye& eye, const LensStation& station, const BlackbodyTable& colours, bool redshift)
      : colours_(colours),
        redshift_(redshift),
        chart_(grid_view(station).chart),
        cameras_(eye.omni),
        energy_(eye.omni
                    ? middle_energy(*eye.omni)
                    : make_camera_station(eye.camera.spin, eye.camera.r, eye.camera.theta, 0.0, ObserverMotion::rain)
                          .energy),
        energy_spread_(eye.omni ? energy_spread(*eye.omni) : 0.0F),
        aberration_(aberration_of(eye)),
        inverse_zamo_{aberration_.zamo_from_observer.axis, 1.0 / aberration_.zamo_from_observer.stretch},
        inverse_rain_{aberration_.rain_from_zamo.axis, 1.0 / aberration_.rain_from_zamo.stretch} {}

  //! The rain-frame direction of a place in the chart, and the solid angle there per area of the chart [sr/turn].
  [[nodiscard]] Vector3<double> rain_direction(double gamma_turns, double s, double& per_area) const {
    const ChartStretch<double> stretch = chart_stretch(chart_, gamma_turns, s);
    const Vector3<MixedDual<double>> n = chart_direction_at(chart_, gamma_turns, stretch.alpha);
    per_area = 6.28318530717958647692 * std::abs(std::sin(stretch.alpha.value) * stretch.alpha.along_y);
    return {n.x.value, n.y.value, n.z.value};
  }

  //! Angle between the shadow's edge and a place in the chart, about [rad].
  [[nodiscard]] double edge_distance(float s) const {
    return 3.0 * std::exp((static_cast<double>(s) - 1.0) * static_cast<double>(chart_.range));
  }

  //! Seen by the observer.
  [[nodiscard]] Vector3<double> observed(const Vector3<double>& rain) const {
    double energy = 0.0;
    return aberrated(inverse_zamo_, aberrated(inverse_rain_, rain, energy), energy);
  }

  //! What an image of a star in a rain-frame direction gains in brightness, but for its magnification there.
  [[nodiscard]] float gain_towards(const Vector3<double>& rain, const FieldStar& star) const {
    const double scale = observed_scale(aberration_, rain);
    const double energy =
        cameras_ ? energy_of(cameras_->cameras->exact(cameras_->side), rain) : detail::evaluate(energy_, rain) * scale;
    const auto frequency_ratio = static_cast<float>(1.0 / std::max(energy, 1e-6));
    return static_cast<float>(scale * scale) *
           (redshift_ ? shift_gain(colours_, star.log_temperature, frequency_ratio) : 1.0F);
  }

  [[nodiscard]] AberrationOf<float> observer() const override { return converted_aberration<float>(aberration_); }

  [[nodiscard]] DirectionForm<float> energy() const override { return detail::converted<float>(energy_); }

  [[nodiscard]] float greatest_gain(const StarPatch& patch, float magnification) const override {
    const float from = patch.frequency_ratio >= 1.0F ? log_coldest : log_hottest;
    return gain_at(patch, magnification, from);
  }

  [[nodiscard]] float gain(const StarPatch& patch, float magnification, const FieldStar& star) const override {
    return gain_at(patch, magnification, star.log_temperature);
  }

 private:
  //! With a margin for what lies between the places that were asked.
  [[nodiscard]] float gain_at(const StarPatch& patch, float magnification, float log_temperature) const {
    // Cameras beside the middle one may see less energy by so much.
    const float least = std::max(1.0F - energy_spread_ * patch.frequency_ratio, 0.1F);
    return 1.2F * magnification * patch.brightening *
           (redshift_ ? shift_gain(colours_, log_temperature, 1.05F * patch.frequency_ratio / least) : 1.0F);
  }

  BlackbodyTable colours_;
  bool redshift_;
  LensChart chart_;
  std::shared_ptr<const OmniEye>
      cameras_;  //!< of an eye that turns; its chart is in its own frame, and no aberration leads there
  DirectionForm<double> energy_;  //!< at infinity, of directions of the chart
  float energy_spread_;           //!< what that may be off by for an eye's other cameras
  Aberration aberration_;
  FrameBoost inverse_zamo_;
  FrameBoost inverse_rain_;
};

//! Whether a part of the view may lie in a patch, or on its `mirrored` side.
bool may_be_seen(const StarPatch& patch, bool mirrored, const ViewCone& view) {
  const float side = mirrored ? -1.0F : 1.0F;
  const Vector3<double> way = {static_cast<double>(patch.seen.x), static_cast<double>(side * patch.seen.y),
                               static_cast<double>(patch.seen.z)};
  return may_touch(view, way, static_cast<double>(patch.seen_radius));
}

std::vector<RoughImage> find_rough(const StarField& field, const Observer& observer, double phi,
                                   const StarPatches& patches, const ViewCone& view) {
  static WorkCounter counter("search_patches");
  const WorkScope work(counter, static_cast<long>(patches.patches().size()));
  constexpr int chunk = 128;
  const auto& list = patches.patches();
  const int count = static_cast<int>(list.size());
  // In the order of the patches, whatever the threads do: neighbours on the screen are neighbours in the kernel's lanes.
  std::vector<std::vector<RoughImage>> found(static_cast<std::size_t>((count + chunk - 1) / chunk));
  parallel_for(static_cast<int>(found.size()), 1, [&](int begin, int end) {
    RoughImageFinder finder(patches, field, observer, phi);
    for (int part = begin; part < end; ++part) {
      for (int i = part * chunk; i < std::min((part + 1) * chunk, count); ++i) {
        const StarPatch& patch = list[static_cast<std::size_t>(i)];
        for (const bool mirrored : {false, true}) {
          if ((!mirrored || patches.mirrored()) && may_be_seen(patch, mirrored, view)) {
            finder.look_in(patch, mirrored);
          }
        }
      }
      finder.finish(found[static_cast<std::size_t>(part)]);
    }
  });
  std::vector<RoughImage> all;
  for (const std::vector<RoughImage>& part : found) {
    all.insert(all.end(), part.begin(), part.end());
  }
  // Guesses take many rounds: they shall not hold the others up.
  std::stable_partition(all.begin(), all.end(), [](const RoughImage& image) { return !image.guessed; });
  return all;
}

}  // namespace

LensStation build_star_station(const StarEye& eye, double pixel, GridTracer<float>* tracer) {
  GridSettings settings;
  settings.pixel = pixel;
  settings.budget_px = grid_budget_px;
  settings.observer = aberration_of(eye);
  settings.fine = false;
  settings.least_area_px = least_star_cell_px;
  return eye.omni ? build_omni_station(*eye.omni, settings)
                  : build_lens_station(eye.camera.spin, eye.camera.r, eye.camera.theta, settings, nullptr, tracer);
}

StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                         const LensStation& station, const StarSettings& settings) {
  return {station, field, Observer(eye, station, colours, settings.redshift), settings.faintest,
          static_cast<float>(settings.grid_px * settings.pixel)};
}

namespace {

//! What becomes of a rough image; star -1 where it is too faint or out of view.
StarCandidate candidate_of(const RoughImage& image, const FieldStar& star, const Observer& observer,
                           const Vector3<double>& on_sky, const StarSettings& settings) {
  double per_area = 0.0;
  const Vector3<double> rain =
      observer.rain_direction(static_cast<double>(image.gamma_turns), static_cast<double>(image.s), per_area);
  StarCandidate candidate{image.star, on_sky, observer.observed(rain), static_cast<double>(star.radius),
                          observer.edge_distance(image.s)};
  const float magnification = static_cast<float>(per_area) / image.sky;
  const float most = most_grid_error(image.shape) * magnification * observer.gain_towards(rain, star);
  if (!image.guessed &&
      (star.illuminance * most < settings.faintest || !may_touch(settings.view, candidate.direction, 0.0))) {
    candidate.star = -1;
  }
  return candidate;
}

std::vector<StarCandidate> candidates_of(const std::vector<RoughImage>& rough, const StarField& field,
                                         const Observer& observer, double phi, const StarSettings& settings) {
  std::vector<StarCandidate> candidates(rough.size());
  const double sine = std::sin(phi);
  const double cosine = std::cos(phi);
  parallel_for(static_cast<int>(rough.size()), 1024, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const FieldStar& star = field.stars()[static_cast<std::size_t>(rough[i].star)];
      const Vector3<double>& d = star.direction;
      candidates[i] =
          candidate_of(rough[i], star, observer, {cosine * d.x + sine * d.y, cosine * d.y - sine * d.x, d.z}, settings);
    }
  });
  std::erase_if(candidates, [](const StarCandidate& candidate) { return candidate.star < 0; });
  return candidates;
}

//! The image that a candidate has become; star -1 where it is none, or too faint.
StarImage image_of(const StarCandidate& c, const FieldStar& star, const BlackbodyTable& colours,
                   const StarSettings& settings) {
  StarImage image{};
  image.star = -1;
  if (!(c.miss <= image_tolerance_px * settings.pixel)) {
    return image;
  }
  const auto solid_angle = static_cast<float>(capped_solid_angle(c));
  const auto g = static_cast<float>(c.frequency_ratio);
  const Vector3<float> light =
      star_light(colours, star.log_temperature, star.illuminance, settings.redshift ? g : 1.0F, 1.0F / solid_angle);
  if (!(0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z >= settings.faintest)) {
    return image;
  }
  return {c.star,
          {static_cast<float>(c.direction.x), static_cast<float>(c.direction.y), static_cast<float>(c.direction.z)},
          (c.solid_angle < 0.0 ? -1.0F : 1.0F) / solid_angle,
          g,
          settings.magnification ? light : solid_angle * light};
}

}  // namespace

std::vector<StarImage> find_star_images(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                        const LensStation& station, const StarPatches& patches,
                                        const StarSettings& settings) {
  const Observer observer(eye, station, colours, settings.redshift);
  const double phi = eye.camera.phi;
  std::vector<StarCandidate> candidates =
      candidates_of(find_rough(field, observer, phi, patches, settings.view), field, observer, phi, settings);
  StarSettings fainter = settings;
  fainter.faintest *= 0.9F;
  refine_images(candidates, eye, settings.pixel, [&](const StarCandidate& c) {
    return may_touch(settings.view, c.direction, 0.0) &&
           image_of(c, field.stars()[static_cast<std::size_t>(c.star)], colours, fainter).star >= 0;
  });
  std::vector<StarImage> found(candidates.size());
  parallel_for(static_cast<int>(candidates.size()), 1024, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const StarCandidate& c = candidates[i];
      found[i] = image_of(c, field.stars()[static_cast<std::size_t>(c.star)], colours, settings);
    }
  });
  return without_twins(found, candidates, field.stars().size(), settings.pixel);
}

}  // namespace ergodome
