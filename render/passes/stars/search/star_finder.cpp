#include "render/passes/stars/search/star_finder.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "kernels/launch/parallel_for.h"
#include "kernels/stars/search/search_steps.h"
#include "render/lens/grid/grid_builder.h"
#include "render/passes/stars/image_observer.h"
#include "render/passes/stars/refinement/star_refinement.h"
#include "render/passes/stars/search/moving_patches.h"
#include "render/passes/stars/search/rough_images.h"

namespace ergodome {

namespace {

//! Error budget of star grids. In corrected grids of this accuracy, most images are already at
//! their exact positions, and the grid costs less than rays for these images would. The other
//! images are refined by rays.
constexpr double grid_budget_px = 0.01;
//! Minimum budget of displacements on the screen for star grids [rad]: below it, the rounding
//! errors of single-precision rays dominate.
constexpr double float_budget = 1.2e-5;
//! Range of the minimum cell area [px²]. Cells below the minimum are not split, and rays start from
//! the interpolation in them. At 5 M from a hole of spin 0.999, finer cells found no further images
//! (at smaller distances a few), and coarser cells cost more in rays than they saved.
constexpr double finest_cell_px = 0.5;
constexpr double coarsest_cell_px = 2.0;
//! Minimum cell area per lens budget of a show [px² per px].
constexpr double cell_of_budget = 8.0;

}  // namespace

double min_star_cell_px(double budget_px) {
  return std::clamp(cell_of_budget * budget_px, finest_cell_px, coarsest_cell_px);
}

bool serves_pixel(double found_for, double pixel, bool about) {
  return about ? found_for <= 1.01 * pixel && found_for >= 0.5 * pixel : found_for == pixel;
}

namespace {

GridSettings star_grid(const StarEye& eye, const StarSettings& settings) {
  GridSettings grid;
  grid.pixel = settings.pixel;
  grid.budget_px = std::max(grid_budget_px, float_budget / settings.pixel);
  grid.observer = aberration_of(eye);
  grid.fine = false;
  grid.min_area_px = settings.min_cell_px;
  grid.inverted = true;
  return grid;
}

}  // namespace

LensStation build_star_station(const StarEye& eye, const StarSettings& settings, GridTracer<float>* tracer) {
  const GridSettings grid = star_grid(eye, settings);
  return eye.omni ? build_omni_station(*eye.omni, grid)
                  : build_lens_station(eye.camera.spacetime, eye.camera.r, eye.camera.theta, grid, nullptr, tracer);
}

LensStation build_moving_station(const EyeCamera& eye, const StarSettings& settings, GridTracer<float>* tracer) {
  GridSettings grid = star_grid(eye, settings);
  grid.derivatives = true;
  grid.reach = cell_reach(eye.spacetime, {eye.r, eye.theta});
  return build_lens_station(eye.spacetime, eye.r, eye.theta, grid, nullptr, tracer);
}

StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                         const LensStation& station, const StarSettings& settings, PatchRoom& room) {
  return {station,
          field,
          ImageObserver(eye, station, colours, settings.redshift),
          settings.faintest,
          GridExactness{settings.pixel, settings.grid_px * settings.pixel},
          room};
}

namespace {

StarAppearance appearance_of(const StarSettings& settings) {
  return {settings.faintest, settings.redshift, settings.magnification};
}

//! Converts an approximate image to a candidate, using what the observer sees at its position. Sets
//! the candidate's star to -1 if the image is too faint or out of view, unless the image's position
//! is only a guess.
StarCandidate candidate_of(const RoughImage& image, const FieldStar& star, const ImageObserver& observer,
                           const ObservedPositions& positions, std::size_t i, const StarSettings& settings) {
  const float g = positions.frequency_ratio[i];
  // Ratio of the solid angle on the sky to that seen by the observer.
  const float solid_angle = image.sky / positions.area[i];
  StarCandidate candidate;
  candidate.star = image.star;
  candidate.direction = {static_cast<double>(positions.direction[0][i]), static_cast<double>(positions.direction[1][i]),
                         static_cast<double>(positions.direction[2][i])};
  const float maximum = image.brighter / std::abs(solid_angle) * observer.shift_gain(star, g);
  if (!image.guessed &&
      (star.illuminance * maximum < settings.faintest || !may_touch(settings.view, candidate.direction, 0.0))) {
    candidate.star = -1;
    return candidate;
  }
  candidate.radius = static_cast<double>(star.radius);
  candidate.edge_distance = observer.edge_distance(image.s);
  return candidate;
}

//! Returns the light of a candidate at its last ray [lx], in linear sRGB.
Vector3<float> light_of(const StarCandidate& c, const FieldStar& star, const BlackbodyTable& colours, bool redshift) {
  return star_light(colours, star.log_temperature, star.illuminance,
                    redshift ? static_cast<float>(c.frequency_ratio) : 1.0F,
                    1.0F / static_cast<float>(capped_solid_angle(c)));
}

//! Converts a candidate to an image. The image's star is -1 if the candidate is not an image or is
//! too faint.
StarImage image_of(const StarCandidate& c, const FieldStar& star, const BlackbodyTable& colours,
                   const StarSettings& settings) {
  StarImage image{};
  image.star = -1;
  if (!(c.miss <= image_tolerance_px * settings.pixel)) {
    return image;
  }
  const Vector3<float> direction = {static_cast<float>(c.direction.x), static_cast<float>(c.direction.y),
                                    static_cast<float>(c.direction.z)};
  shining_image(colours, appearance_of(settings), c.star, star, direction, static_cast<float>(c.frequency_ratio),
                static_cast<float>(c.solid_angle), static_cast<float>(capped_solid_angle(c)), image);
  return image;
}

//! Approximate images, sorted by how they are processed.
struct Sought {
  std::vector<StarCandidate> rays;  //!< candidates to be refined by rays
  //! Candidates to be refined by rays, many of which are not images.
  std::vector<StarCandidate> guesses;
  std::vector<SeenImage> exact;
};

//! Common parameters of a search.
struct Search {
  const StarField& field;
  const BlackbodyTable& colours;
  const ImageObserver& observer;
  double phi;
  const StarSettings& settings;
};

//! Converts approximate images to candidates, and images in patches of an exact grid to final
//! images.
void sort_out(const Search& search, std::span<const RoughImage> rough, Sought& sought) {
  const SkyRotation turn = sky_rotation(search.phi);
  const ObservedPositions positions = search.observer.observe(rough);
  for (std::size_t i = 0; i < rough.size(); ++i) {
    const FieldStar& star = search.field.stars()[static_cast<std::size_t>(rough[i].star)];
    if (rough[i].exact) {
      SeenImage found{};
      if (complete_image(search.settings.view, search.colours, appearance_of(search.settings), rough[i].star, star,
                         {positions.direction[0][i], positions.direction[1][i], positions.direction[2][i]},
                         positions.frequency_ratio[i], rough[i].sky / positions.area[i], found)) {
        sought.exact.push_back(found);
      }
      continue;
    }
    StarCandidate candidate = candidate_of(rough[i], star, search.observer, positions, i, search.settings);
    if (candidate.star < 0) {
      continue;
    }
    candidate.on_sky = as_patches_see(turn, star.direction, false);
    (rough[i].guessed ? sought.guesses : sought.rays).push_back(candidate);
  }
}

//! Sorts the images that a GPU found, whose order is nondeterministic, by distance to the shadow's
//! edge, and removes non-finite ones. Rays in adjacent SIMD lanes then take similar numbers of
//! steps, which reduces the time by a quarter.
void put_in_order(std::vector<RoughImage>& rough) {
  // NaN cannot be sorted.
  std::erase_if(rough,
                [](const RoughImage& image) { return !std::isfinite(image.s) || !std::isfinite(image.gamma_turns); });
  std::ranges::sort(rough, [](const RoughImage& a, const RoughImage& b) {
    return std::tie(a.s, a.star, a.gamma_turns) < std::tie(b.s, b.star, b.gamma_turns);
  });
}

//! Finds approximate images. On the CPU they are in the order of the patches, whatever the number
//! of threads, so that neighbors on the screen are neighbors in SIMD lanes. On a GPU, images that
//! need no rays stay in GPU memory; `in_place` describes them.
std::vector<Sought> seek(const Search& search, const StarPatches& patches, const DeviceSearch* device,
                         BackendImages& in_place) {
  if (device == nullptr) {
    SearchInputs inputs = patches.view(host_data);
    inputs.field = search.field.view(host_data);
    inputs.view = search.settings.view;
    inputs.turn = sky_rotation(search.phi);
    std::vector<Sought> parts(static_cast<std::size_t>(rough_parts(inputs.patch_count)));
    find_rough_images(inputs, search.field.stars().size(), [&](int part, const std::vector<RoughImage>& rough) {
      sort_out(search, rough, parts[static_cast<std::size_t>(part)]);
    });
    return parts;
  }
  const StarSettings& settings = search.settings;
  PatchSearch::Result result =
      device->search.find(device->patches, {search.phi, settings.view, search.observer, appearance_of(settings)});
  put_in_order(result.rough);
  const std::vector<RoughImage>& rough = result.rough;
  constexpr std::size_t chunk = 512;
  const std::size_t chunks = (rough.size() + chunk - 1) / chunk;
  std::vector<Sought> parts(chunks);
  in_place = result.exact;
  parallel_for(static_cast<int>(chunks), 1, [&](int begin, int end) {
    for (auto part = static_cast<std::size_t>(begin); part < static_cast<std::size_t>(end); ++part) {
      const std::size_t first = part * chunk;
      sort_out(search, std::span(rough).subspan(first, std::min(chunk, rough.size() - first)), parts[part]);
    }
  });
  return parts;
}

//! Appends the list that `list` selects of all parts to `to`.
template <class T>
void append(const std::vector<Sought>& parts, std::vector<T> Sought::*list, std::vector<T>& to) {
  std::size_t count = to.size();
  for (const Sought& part : parts) {
    count += (part.*list).size();
  }
  to.reserve(count);
  for (const Sought& part : parts) {
    to.insert(to.end(), (part.*list).begin(), (part.*list).end());
  }
}

//! All images found, including duplicates.
struct FoundImages {
  BackendImages in_place;
  std::vector<SeenImage> in_host;
};

FoundImages found_images(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                         const LensStation& station, const StarPatches& patches, const StarSettings& settings,
                         const DeviceSearch* device) {
  const ImageObserver observer(eye, station, colours, settings.redshift);
  FoundImages found;
  const std::vector<Sought> parts =
      seek({field, colours, observer, eye.camera.phi, settings}, patches, device, found.in_place);
  std::vector<StarCandidate> candidates;
  append(parts, &Sought::rays, candidates);
  // Guesses come last, because they take many rounds and would delay the others.
  append(parts, &Sought::guesses, candidates);
  StarSettings fainter = settings;
  fainter.faintest *= 0.9F;
  const auto star_of = [&](const StarCandidate& c) -> const FieldStar& {
    return field.stars()[static_cast<std::size_t>(c.star)];
  };
  const auto brightness = [&](const StarCandidate& c) {
    return static_cast<double>(luminance_of(light_of(c, star_of(c), colours, settings.redshift)) / settings.faintest);
  };
  const auto wanted = [&](const StarCandidate& c) {
    return may_touch(settings.view, c.direction, 0.0) && image_of(c, star_of(c), colours, fainter).star >= 0;
  };
  refine_images(candidates, {eye, observer.chart(), settings.pixel, brightness, wanted});
  found.in_host.resize(candidates.size());
  parallel_for(static_cast<int>(candidates.size()), 1024, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      found.in_host[i] = seen_image(image_of(candidates[i], star_of(candidates[i]), colours, settings), candidates[i]);
    }
  });
  append(parts, &Sought::exact, found.in_host);
  return found;
}

}  // namespace

std::vector<StarImage> find_star_images(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                        const LensStation& station, const StarPatches& patches,
                                        const StarSettings& settings, const DeviceSearch* device) {
  const FoundImages found = found_images(field, colours, eye, station, patches, settings, device);
  const PlacedImages placed =
      device == nullptr ? ImageJoiner(Backend::cpu, field.stars().size())
                              .join({found.in_host.data(), static_cast<int>(found.in_host.size())}, {}, settings.pixel,
                                    ImageOrder::as_found)
                        : device->joiner.join(found.in_place, found.in_host, settings.pixel, ImageOrder::by_position);
  std::vector<StarImage> images(static_cast<std::size_t>(placed.count));
  placed.images.read(images.data(), images.size());
  std::erase_if(images, [](const StarImage& image) { return image.star < 0; });
  return images;
}

PlacedImages find_star_images_in_place(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                       const LensStation& station, const StarPatches& patches,
                                       const StarSettings& settings, const DeviceSearch& device) {
  const FoundImages found = found_images(field, colours, eye, station, patches, settings, &device);
  return device.joiner.join(found.in_place, found.in_host, settings.pixel, ImageOrder::by_position);
}

}  // namespace ergodome
