#include "render/passes/near_field/flat_near_field.h"

#include <algorithm>
#include <cmath>

#include "kernels/projection/pixel_measure.h"
#include "render/lens/direct_lens.h"
#include "render/passes/disk/disk_camera.h"

namespace ergodome {

namespace {

//! A thing is not drawn if its affine distance from the head is less than the eye's distance from
//! the head, divided by this.
constexpr double nearest_part = 0.9;
//! Light approaches the hole in r by at most this times the affine distance times its energy at
//! infinity.
constexpr double fastest_approach = 2.0;

//! Radius outside of which rays of adjacent pixels stay close together [M]: circular photon orbits
//! have radii of at most 4 M.
constexpr double parting_r = 6.0;

//! Returns the maximum energy at infinity of light that the observer sees with energy 1.
double max_energy(const CameraStation& station) {
  return station.energy.constant + std::sqrt(dot(station.energy.along, station.energy.along));
}

}  // namespace

FlatNearField::FlatNearField(Backend backend, const NearField& near_field, const EyeCamera& head,
                             const FlatShadow& shadow, Buffer<float>& rows)
    : backend_(backend),
      near_field_(near_field),
      shadow_(shadow),
      station_(station_of(head)),
      edge_(backend, shadow.head_edge().size(), "flat shadow"),
      nearness_(backend, static_cast<std::size_t>(FlatShadow::spokes) * FlatShadow::depths, "flat shadow"),
      rows_(rows) {}

void FlatNearField::set_eye(double offset, const std::vector<float>& edge) {
  offset_ = offset;
  const std::vector<float> nearness = shadow_.eye_nearness(offset, edge);
  edge_.write(edge.data(), edge.size());
  nearness_.write(nearness.data(), nearness.size());
  horizon_.edge = edge_view(shadow_.frame_chart(), edge);
  horizon_.cosine_largest = std::cos(horizon_.edge.largest);
  horizon_.edge.polar_angle = edge_.data();
  horizon_.nearness = nearness_.data();
  horizon_.spokes = FlatShadow::spokes;
  horizon_.depths = FlatShadow::depths;
  horizon_.depth_step = static_cast<float>(FlatShadow::depth_step);
}

double FlatNearField::farthest_r() const {
  double r = 0.0;
  if (near_field_.disk != nullptr) {
    r = static_cast<double>(near_field_.disk->look_at(0.0).outer_r);
  }
  if (near_field_.shells != nullptr) {
    r = std::max(r, near_field_.shells->outermost_r());
  }
  return r;
}

FlatEyeBatch FlatNearField::batch_for(const PictureView& view) const {
  FlatEyeBatch batch{
      {pixel_batch(view.eye, view.projection, view.tolerance_px), DiskDrawing::none, {}, {}, nullptr, {}, false, {}},
      {},
      0.0F,
      {},
      horizon_};
  NearFieldBatch& scene = batch.near_field;
  if (near_field_.disk != nullptr && near_field_.disk->is_visible()) {
    scene.disk = near_field_.disk->look_at(view.time_s, view.eye.clock_lead);
    scene.drawing = has_pattern(scene.disk) ? DiskDrawing::pattern : DiskDrawing::plain;
    const LayerLimits<double> limits = layer_limits(view.eye.spacetime, static_cast<double>(scene.disk.inner_r),
                                                    static_cast<double>(scene.disk.outer_r));
    batch.limits = {static_cast<float>(limits.near_u),
                    static_cast<float>(limits.far_u),
                    static_cast<float>(limits.highest_u),
                    static_cast<float>(limits.lowest_u),
                    static_cast<float>(scene.pixels.settings.tolerance),
                    limits.step_limit};
  }
  if (near_field_.shells != nullptr) {
    scene.shells = near_field_.shells->table();
  }
  const double(&m)[3][3] = view.eye.frame_from_view;
  batch.eye = {static_cast<float>(offset_ * m[0][0]), static_cast<float>(offset_ * m[1][0]),
               static_cast<float>(offset_ * m[2][0])};
  batch.max_w = static_cast<float>(max_nearness(farthest_r()));
  return batch;
}

double FlatNearField::max_nearness(double farthest_r) const {
  const double max_w = nearest_part / std::abs(offset_);
  const double way = 1.0 / station_.u - farthest_r;
  return way > 0.0 ? std::min(max_w, fastest_approach * max_energy(station_) / way) : max_w;
}

ObjectLayer FlatNearField::look_at_objects(const PictureView& view, const RowBlock& rows) const {
  const double(&m)[3][3] = view.eye.frame_from_view;
  const Vector3<double> eye = {offset_ * m[0][0], offset_ * m[1][0], offset_ * m[2][0]};
  return near_field_.objects->draw(
      view, rows,
      {eye, max_nearness(near_field_.objects->farthest_r(view.time_s)), max_nearness(parting_r),
       pixel_angle(view.projection), view.tolerance_px, horizon_});
}

void FlatNearField::draw_over(const PictureView& view, const RowBlock& rows, float* rgba) {
  FlatEyeBatch batch = batch_for(view);
  NearFieldBatch& scene = batch.near_field;
  scene.pixels.first_row = rows.first;
  scene.pixels.row_count = rows.count;
  scene.rgba = rgba;
  if (near_field_.objects != nullptr) {
    scene.objects = look_at_objects(view, rows);
    if (scene.drawing == DiskDrawing::none && scene.shells.count == 0) {
      return launch(backend_, LayObjectsBatch{scene.objects, scene.pixels.projection, rows.first, rows.count, rgba});
    }
  }
  if (near_field_.disk_grid) {
    const EyeCamera& head = view.eye;
    launch(FlatEyeLookUpBatch{batch, *near_field_.disk_grid,
                              converted_aberration<float>(
                                  aberration_to_rain(head.spacetime, head.r, head.theta, head.motion, head.velocity))});
    if (near_field_.objects == nullptr) {
      return;
    }
    scene.objects_alone = true;
  }
  launch(backend_, batch);
}

void FlatNearField::draw(const PictureView& view, const RowBlock& rows, float* rgba) {
  if (backend_ == Backend::cpu) {
    return draw_over(view, rows, rgba);
  }
  const std::size_t floats =
      4 * static_cast<std::size_t>(view.projection.width_px) * static_cast<std::size_t>(rows.count);
  if (rows_.size() < floats) {
    rows_ = Buffer<float>(backend_, floats, "flat eye's picture");
  }
  rows_.write(rgba, floats);
  draw_over(view, rows, rows_.data());
  rows_.read(rgba, floats);
}

}  // namespace ergodome
