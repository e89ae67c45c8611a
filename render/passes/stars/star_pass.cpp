#include "render/passes/stars/star_pass.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <limits>

#include "content/show/animated_show.h"
#include "content/show/show_errors.h"
#include "content/sky/sky_map.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/stars/drawing/picture_regions.h"

namespace ergodome {

namespace {

//! Margin of the search beyond the view, for images that move from their grid position to their
//! exact position [rad].
constexpr double view_margin = 0.05;
//! Returns the illuminance of a star of a magnitude [lx].
float illuminance_of(double magnitude) {
  return static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * magnitude));
}

DiffractionPattern spike_pattern(const Show& show) {
  const DiffractionSettings& spikes = *show.effects.diffraction;
  if (!spikes.pattern.empty()) {
    return read_named(show, "effects.diffraction.pattern", spikes.pattern, load_diffraction_pattern);
  }
  return diffraction_pattern({spikes.blades, spikes.vanes, spikes.obstruction, spikes.size_px, spikes.scale});
}

StarSettings star_settings(const Show& show) {
  StarSettings settings;
  settings.faintest = illuminance_of(show.sky.faintest_mag);
  settings.redshift = show.effects.redshift;
  settings.magnification = show.effects.magnification;
  settings.min_cell_px = min_star_cell_px(show.quality.budget_px);
  return settings;
}

SplatSettings splat_settings(const Show& show, const std::optional<DiffractionPattern>& spikes) {
  // A standard deviation so small that no pixel shows it is treated as zero, because the cutoff
  // would be undefined.
  constexpr double min_sigma_px = 0.01;
  const PointSpreadSettings psf =
      show.effects.psf.sigma_px >= min_sigma_px ? show.effects.psf : PointSpreadSettings{0.0, 0.0};
  SplatSettings splat{psf.sigma_px,
                      static_cast<float>(show.sky.exposure / luminance_of_white),
                      std::numeric_limits<float>::infinity(),
                      0.0F,
                      0.0,
                      psf.cutoff_px};
  if (spikes && shows_spikes(show, ViewMode::sky)) {
    splat.spikes_from = illuminance_of(show.effects.diffraction->brighter_than_mag);
    splat.spike_strength = static_cast<float>(show.effects.diffraction->strength);
    splat.spike_reach_px = 0.5 * spikes->size_px + 1.0;
  }
  return splat;
}

//! Returns whether two settings that differ at most in animatable numbers give the same spike
//! pattern. A pattern from a file does not depend on the aperture settings.
bool same_pattern(const DiffractionSettings& a, const DiffractionSettings& b) {
  return !a.pattern.empty() || (a.obstruction == b.obstruction && a.scale == b.scale);
}

bool same_turn(const SkySettings& a, const SkySettings& b) {
  return a.spin_axis_ra_deg == b.spin_axis_ra_deg && a.spin_axis_dec_deg == b.spin_axis_dec_deg;
}

//! Returns whether two shows' spikes differ at most in animatable numbers.
bool same_spikes(const Show& a, const Show& b) {
  const auto& one = a.effects.diffraction;
  const auto& other = b.effects.diffraction;
  if (!one || !other) {
    return !one && !other;
  }
  const bool ever = shows_spikes(show_at_most(a), ViewMode::sky);
  return ever == shows_spikes(show_at_most(b), ViewMode::sky) && one->pattern == other->pattern &&
         one->blades == other->blades && one->vanes == other->vanes && one->size_px == other->size_px;
}

StarEye eye_of(const EyePicture& picture) {
  return picture.settings.omni ? StarEye(picture.settings.omni) : StarEye(picture.eye);
}

PixelMatch match_of(const EyePicture& picture) {
  const ShowMoment& moment = picture.settings.moment;
  return moment.patience_s < ShowMoment::forever_s && !moment.alike ? PixelMatch::about : PixelMatch::exact;
}

}  // namespace

//! The stars of one picture.
class StarPass::Drawing : public PassDrawing {
 public:
  Drawing(StarPass& pass, const EyePicture& picture)
      : pass_(pass),
        picture_(picture),
        // The CPU part of the search overlaps GPU rendering.
        seeking_(std::async(on_cpu() ? std::launch::deferred : std::launch::async, [this] { return find(); })) {}

  void draw(const RowBlock& rows, float* rgba) override {
    if (seeking_.valid()) {
      points_ = seeking_.get();
      if (!on_cpu() && !points_.empty()) {
        place();
      }
    }
    if (points_.empty()) {
      return;
    }
    if (on_cpu()) {
      return pass_.draw(points_.in_host, picture_.projection, rows.first, rows.count, rgba);
    }
    pass_.tiled_.draw(rows.first, rows.count, rgba);
  }

 private:
  [[nodiscard]] bool on_cpu() const { return pass_.backend_ == Backend::cpu; }

  FoundPoints find() const {
    const UrgentDeviceWork urgent(pass_.backend_);
    return pass_.find_points(eye_of(picture_), picture_.projection, picture_.settings.shutter, match_of(picture_),
                             course_of(picture_));
  }

  //! Passes the points to TiledStars, which draws on a GPU. Points in host memory are copied to the
  //! GPU.
  void place() {
    const SplatSettings splat = pass_.splat_for(picture_.projection);
    if (points_.in_place.count > 0) {
      pass_.tiled_.set(points_.in_place, picture_.projection, splat, pass_.spikes());
    } else {
      pass_.tiled_.set(points_.in_host, picture_.projection, splat, pass_.spikes());
    }
  }

  StarPass& pass_;
  const EyePicture& picture_;
  FoundPoints points_;
  std::future<FoundPoints> seeking_;
};

//! The stars of one picture that an output draws.
class StarPass::ApartDrawing : public PassDrawing {
 public:
  ApartDrawing(StarPass& pass, const EyePicture& picture)
      : lights_(*picture.settings.stars_apart),
        seeking_(std::async(pass.backend_ == Backend::cpu ? std::launch::deferred : std::launch::async,
                            [&pass, &picture, pixel = lights_.pixel] {
                              const UrgentDeviceWork urgent(pass.backend_);
                              return pass.lights(eye_of(picture), picture.projection, pixel, match_of(picture),
                                                 course_of(picture));
                            })) {}

  void draw(const RowBlock& /*rows*/, float* /*rgba*/) override {
    if (seeking_.valid()) {
      lights_ = seeking_.get();
    }
  }

 private:
  StarLights& lights_;
  std::future<StarLights> seeking_;
};

std::unique_ptr<Pass> make_star_pass(const PassInput& input) {
  return input.show.sky.stars.empty() ? nullptr : std::make_unique<StarPass>(input.show, input.backend);
}

std::unique_ptr<PassDrawing> StarPass::prepare(const EyePicture& picture) {
  if (picture.settings.stars_apart) {
    return std::make_unique<ApartDrawing>(*this, picture);
  }
  return std::make_unique<Drawing>(*this, picture);
}

void StarPass::apply(const Show& show, const NumberChange& change) {
  if (change.sky) {
    turn_sky(show);
  }
  if (change.stars) {
    set_numbers(show);
  }
}

bool StarPass::serves(const Show& now, const Show& next) const {
  return now.folder == next.folder && now.sky.stars == next.sky.stars && now.sky.star_method == next.sky.star_method &&
         same_turn(now.sky, next.sky) && now.effects.redshift == next.effects.redshift && same_spikes(now, next);
}

std::vector<std::string> StarPass::notes(const Show& show) const {
  std::vector<std::string> notes;
  if (empty()) {
    notes.push_back(note_of_no_stars(show));
  }
  if (lacks_stars(left_out_)) {
    notes.push_back(note_of_left_out(show, left_out_));
  }
  return notes;
}

StarPass::StarPass(const Show& show, Backend backend) : StarPass(show, backend, load_stars(show)) {}

StarPass::StarPass(const Show& show, Backend backend, const StarCatalogue& catalogue)
    : backend_(backend),
      colours_(Backend::cpu),
      left_out_(catalogue.left_out),
      field_(catalogue, sky_from_equatorial(show.sky), colours_.view()),
      all_gathered_(show.sky.star_method == StarMethod::gather),
      settings_(star_settings(show)),
      order_(backend == Backend::cpu ? PointOrder::by_row : PointOrder::of_images),
      cells_([this](const StarEye& middle, const StarSettings& asked, MotionRoom& room) {
        GridTracer<float> tracer;
        LensStation station = build_moving_station(middle.camera, asked, &tracer);
        StarPatches patches = star_patches(field_, colours_.view(), middle, station, asked, room.patches);
        return MovingPatches(std::move(station), std::move(patches), room);
      }),
      tiled_(backend) {
  if (all_gathered_) {
    tree_.emplace(field_);
  }
  search_field();
  // Computes the pattern in advance, so that spikes that appear later do not delay a picture.
  if (shows_spikes(show_at_most(show), ViewMode::sky)) {
    make_pattern(show);
  }
  splat_ = splat_settings(show, spikes_);
}

//! Uploads the star field for the search on a GPU, if the backend is one. Does nothing if there is
//! no star, or if every pixel gathers its stars.
void StarPass::search_field() {
  if (backend_ != Backend::cpu && !all_gathered_ && !field_.stars().empty()) {
    search_.emplace(backend_, field_, colours_.view());
    joiner_.emplace(backend_, field_.stars().size());
    placer_.emplace(backend_);
  }
}

void StarPass::turn_sky(const Show& show) {
  if (!catalogue_) {
    catalogue_ = load_stars(show);
  }
  cells_.wait();
  field_ = StarField(*catalogue_, sky_from_equatorial(show.sky), colours_.view());
  images_ = {};
  images_in_place_ = {};
  tree_.reset();
  if (all_gathered_) {
    tree_.emplace(field_);
  }
  search_field();
}

void StarPass::make_pattern(const Show& show) {
  spikes_ = spike_pattern(show);
  pattern_ = show.effects.diffraction;
  count_work("buffer: diffraction pattern", static_cast<long>(spikes_->rgb.size() * sizeof(float)));
}

void StarPass::set_numbers(const Show& show) {
  settings_ = star_settings(show);
  if (spikes_ && show.effects.diffraction && !same_pattern(*pattern_, *show.effects.diffraction)) {
    make_pattern(show);
  }
  splat_ = splat_settings(show, spikes_);
}

const StarPass::InvertedGrid& StarPass::patches_for(const StarEye& eye, const StarSettings& asked) {
  const double pixel = asked.pixel;
  const std::optional<StarEye> middle = search_ ? std::nullopt : cell_of(eye, asked.course);
  if (middle) {
    cells_.prepare_next(eye, asked);
  }
  const auto found = std::ranges::find_if(turned_, [&](const InvertedGrid& each) {
    return serves_pixel(each.pixel, pixel, asked.about) && each.min_cell_px == asked.min_cell_px &&
           served_alike(each.eye, eye) && each.moved == middle.has_value() &&
           !(each.moved && each.faintest != asked.faintest);
  });
  if (found != turned_.end()) {
    if (found->faintest != asked.faintest) {
      // Removes the entry from the list while it changes, and inserts it again when it is complete.
      // If an allocation throws, the entry stays removed.
      InvertedGrid changed = std::move(*found);
      turned_.erase(found);
      changed.faintest = asked.faintest;
      room_.patches = std::move(changed.patches).given_up();
      changed.patches = star_patches(field_, colours_.view(), eye, changed.station, asked, room_);
      place(changed);
      turned_.insert(turned_.begin(), std::move(changed));
    } else {
      std::rotate(turned_.begin(), found, found + 1);
    }
    return turned_.front();
  }
  std::unique_ptr<PlacedPatches> on_device;
  if (turned_.size() == max_eyes) {
    // Uses the memory of the entry that is removed from the cache.
    room_.patches = std::move(turned_.back().patches).given_up();
    on_device = std::move(turned_.back().on_device);
    turned_.pop_back();
  }
  const MovingPatches* const cell = middle ? &cells_.patches(*middle, asked) : nullptr;
  LensStation station =
      cell != nullptr ? cell->station_at({eye.camera.r, eye.camera.theta}) : build_star_station(eye, asked, &tracer_);
  StarPatches patches = cell != nullptr ? cell->patches_at(station, room_)
                                        : star_patches(field_, colours_.view(), eye, station, asked, room_);
  InvertedGrid turned{eye,
                      pixel,
                      asked.min_cell_px,
                      asked.faintest,
                      std::move(station),
                      std::move(patches),
                      cell != nullptr,
                      std::move(on_device)};
  place(turned);
  turned_.insert(turned_.begin(), std::move(turned));
  return turned_.front();
}

void StarPass::place(InvertedGrid& turned) const {
  if (!search_) {
    return;
  }
  if (turned.on_device) {
    turned.on_device->set(turned.patches, turned.station);
  } else {
    turned.on_device = std::make_unique<PlacedPatches>(search_->backend(), turned.patches, turned.station);
  }
}

std::vector<StarImage> StarPass::gathered_images(const StarEye& eye, const Projection& projection,
                                                 const StarSettings& settings) {
  if (!tree_) {
    tree_.emplace(field_);
  }
  std::vector<StarImage> images;
  for (const PictureRegion& region : picture_regions(projection)) {
    const auto stars = gather_stars(field_, *tree_, colours_.view(), eye, region.projection, settings).stars;
    const std::vector<StarImage> in_region = star_images(stars, eye.camera, region.projection);
    images.insert(images.end(), in_region.begin(), in_region.end());
  }
  return images;
}

bool StarPass::gathers(const StarEye& eye, double pixel) {
  // Maximum error of the shadow's edge for which star images are found with a grid [px]. Rays make
  // images exact only if the grid is about right; with larger errors images are missing or inside
  // the shadow.
  constexpr double max_miss_px = 0.5;
  return all_gathered_ || (!eye.omni && edge_miss_.of(eye.camera) > max_miss_px * pixel);
}

std::vector<StarImage> StarPass::sought_images(const StarEye& eye, const StarSettings& settings) {
  const InvertedGrid& turned = patches_for(eye, settings);
  if (!search_) {
    return find_star_images(field_, colours_.view(), eye, turned.station, turned.patches, settings);
  }
  const DeviceSearch device = {*search_, *turned.on_device, *joiner_};
  return find_star_images(field_, colours_.view(), eye, turned.station, turned.patches, settings, &device);
}

PlacedImages StarPass::sought_in_place(const StarEye& eye, const StarSettings& settings) {
  const InvertedGrid& turned = patches_for(eye, settings);
  return find_star_images_in_place(field_, colours_.view(), eye, turned.station, turned.patches, settings,
                                   {*search_, *turned.on_device, *joiner_});
}

StarSettings StarPass::settings_for(const StarEye& eye, const Projection& projection, bool leaves_trails,
                                    PixelMatch match, const CameraCourse& course) const {
  StarSettings settings = settings_;
  settings.pixel = pixel_angle(projection);
  settings.about = match == PixelMatch::about;
  settings.course = course;
  // With trails, images from anywhere may enter the view.
  if (!leaves_trails) {
    const SplatSettings splat = scaled_to(splat_, projection);
    const double reach_px = std::max(splat.reach_px(), splat.spike_reach_px);
    settings.view = view_cone(eye.camera, projection, view_margin + reach_px * largest_pixel_angle(projection));
  }
  return settings;
}

FoundPoints StarPass::find_points(const StarEye& eye, const Projection& projection,
                                  const std::optional<Shutter>& shutter, PixelMatch match, const CameraCourse& course) {
  if (!search_ || shutter || gathers(eye, pixel_angle(projection))) {
    return {find(eye, projection, shutter, match, course), {}};
  }
  const DeviceWorkInOrder in_order(backend_);
  const PlacedImages& images =
      images_in_place_.images(eye, settings_for(eye, projection, false, match, course),
                              [&](const StarSettings& asked) { return sought_in_place(eye, asked); });
  return {{}, placer_->place(images, eye.camera, projection, scaled_to(splat_, projection))};
}

std::vector<StarPoint> StarPass::find(const StarEye& eye, const Projection& projection,
                                      const std::optional<Shutter>& shutter, PixelMatch match,
                                      const CameraCourse& course) {
  if (field_.stars().empty()) {
    return {};
  }
  const StarSettings settings = settings_for(eye, projection, shutter.has_value(), match, course);
  const SplatSettings splat = scaled_to(splat_, projection);
  const auto points_of = [&](const std::vector<StarImage>& found) {
    return shutter
               ? trail_points(star_trails(found, field_, *shutter, settings.pixel), *shutter, projection, splat, order_)
               : star_points(found, eye.camera, projection, splat, order_);
  };
  return points_of(images_of(eye, projection, settings));
}

const std::vector<StarImage>& StarPass::images_of(const StarEye& eye, const Projection& projection,
                                                  const StarSettings& settings) {
  if (gathers(eye, settings.pixel)) {
    gathered_ = gathered_images(eye, projection, settings);
    return gathered_;
  }
  return images_.images(eye, settings, [&](const StarSettings& asked) { return sought_images(eye, asked); });
}

StarLights StarPass::lights(const StarEye& eye, const Projection& projection, double pixel, PixelMatch match,
                            const CameraCourse& course) {
  StarLights lights{pixel, splat_.sigma_px, splat_.reach_px() - 1.0, {}};
  if (field_.stars().empty()) {
    return lights;
  }
  StarSettings settings = settings_for(eye, projection, false, match, course);
  settings.pixel = pixel;
  const std::vector<StarImage>& images = images_of(eye, projection, settings);
  lights.stars.reserve(images.size());
  for (const StarImage& image : images) {
    const Vector3<float>& n = image.direction;
    const Vector3<double> view = in_view(eye.camera, {n.x, n.y, n.z});
    lights.stars.push_back({{static_cast<float>(view.x), static_cast<float>(view.y), static_cast<float>(view.z)},
                            splat_.scale * image.illuminance});
  }
  return lights;
}

void StarPass::draw(const std::vector<StarPoint>& points, const Projection& projection, int first_row, int row_count,
                    float* rgba) const {
  splat_points(points, projection, scaled_to(splat_, projection), first_row, row_count, rgba);
  if (spikes_) {
    draw_spikes(points, projection, first_row, row_count, rgba);
  }
}

void StarPass::draw_spikes(const std::vector<StarPoint>& points, const Projection& projection, int first_row,
                           int row_count, float* rgba) const {
  static WorkCounter counter("draw_spikes");
  const WorkScope work(counter, static_cast<long>(points.size()));
  const int width = projection.width_px;
  const bool wraps = wraps_around(projection);
  const std::vector<PictureRegion> regions = picture_regions(projection);
  constexpr int band = 64;
  parallel_for((row_count + band - 1) / band, 1, [&](int begin, int end) {
    const int top = begin * band;
    const int rows = std::min(end * band, row_count) - top;
    for (const StarPoint& point : points) {
      if (!(point.spikes.x + point.spikes.y + point.spikes.z > 0.0F)) {
        continue;
      }
      const PixelCell& cell = regions[static_cast<std::size_t>(point.region)].cell;
      const int first = std::max(first_row + top, cell.top_px);
      const int count = std::min(first_row + top + rows, cell.top_px + cell.height_px) - first;
      const PixelBlock block = {width, count, cell.left_px, cell.left_px + cell.width_px,
                                rgba + 4 * static_cast<std::ptrdiff_t>(first - first_row) * width};
      for (int turn = wraps ? -1 : 0; turn <= (wraps ? 1 : 0); ++turn) {
        add_diffraction(*spikes_, point.x_px + turn * width, point.y_px - first, point.spikes, block);
      }
    }
  });
}

}  // namespace ergodome
