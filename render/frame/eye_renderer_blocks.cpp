#include <algorithm>
#include <utility>

#include "kernels/launch/work_counter.h"
#include "render/frame/eye_renderer.h"

// Renders pictures in host memory, block by block.
namespace ergodome {

//! A picture in progress. The arguments must outlive it.
struct EyeRenderer::Making {
  const EyeCamera& eye;
  const Projection& projection;
  const PictureSettings& settings;
  Picture picture{};
  ShadeBatch shade{};
  std::future<FoundPoints> seeking{};
  FoundPoints stars{};
  std::unique_ptr<LensSource> chosen{};
  const LensSource* source = nullptr;

  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(projection.width_px); }
  float* light(int row) { return picture.rgba.data() + 4 * width() * static_cast<std::size_t>(row); }
};

void EyeRenderer::begin(Making& making, const SkyCube& sky) {
  const Projection& projection = making.projection;
  const PictureSettings& settings = making.settings;
  Picture& picture = making.picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  if (settings.mode != ViewMode::sky) {
    picture.heat_range = heat_range(settings);
  }
  picture.rgba.resize(4 * making.width() * static_cast<std::size_t>(projection.height_px));
  count_work("buffer: finished picture", static_cast<long>(picture.rgba.size() * sizeof(float)));
  making.shade = prepare(projection, sky, settings, block_pixels(projection));
  making.seeking = seek_stars(making.eye, projection, settings);
  if (settings.given == nullptr) {
    making.chosen = lens_for(making.eye, projection, settings);
  }
  making.source = settings.given != nullptr ? settings.given : making.chosen.get();
  picture.lens = making.source->name();
  picture.behind = making.source->behind();
}

void EyeRenderer::make_sky(Making& making, const RowBlock& rows) {
  // Another picture may have used the same memory meanwhile.
  making.shade.lens = channels(block_pixels(making.projection), making.settings);
  making.source->fill(rows.first, rows.count, making.shade.lens);
  light_sky(making, rows);
}

void EyeRenderer::make_sky_of_both(Making (&both)[2], const RowBlock& rows) {
  const auto pixels = static_cast<std::size_t>(both[0].projection.width_px) * static_cast<std::size_t>(rows.count);
  both[0].shade.lens = channels(pixels, both[0].settings);
  both[1].shade.lens = channels(pixels, both[1].settings, true);
  both[0].source->fill_both(*both[1].source, rows.first, rows.count, both[0].shade.lens, both[1].shade.lens);
  light_sky(both[0], rows);
  light_sky(both[1], rows);
}

void EyeRenderer::light_sky(Making& making, const RowBlock& rows) {
  making.shade.rgba = backend_ == Backend::cpu ? making.light(rows.first) : room_for(block_pixels(making.projection));
  shade_rows(making.shade, making.settings.polygons, rows);
  making.picture.unresolved_pixels +=
      count_unresolved(making.shade.lens.error_estimate, making.width() * static_cast<std::size_t>(rows.count));
}

void EyeRenderer::draw_over(Making& making, const RowBlock& rows) {
  if (making.seeking.valid()) {
    making.stars = making.seeking.get();
    if (backend_ != Backend::cpu) {
      place_stars(making.stars, making.projection, making.settings);
    }
  }
  draw_over_rows(making.eye, making.projection, making.settings, making.stars, rows, making.light(rows.first));
}

void EyeRenderer::end(Making& making) {
  const PictureSettings& settings = making.settings;
  if (settings.objects != nullptr) {
    settings.objects->draw(making.eye, making.projection, settings.time_s, making.picture.rgba.data(),
                           settings.turning_view.get());
  }
  finish(making.picture, making.projection, settings);
}

Picture EyeRenderer::render(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                            const PictureSettings& settings) {
  Making making{eye, projection, settings};
  begin(making, sky);
  near_field_ = near_field_of(eye, projection, settings);
  visit_blocks(projection, [&](const RowBlock& rows) {
    make_sky(making, rows);
    draw_over(making, rows);
  });
  end(making);
  return std::move(making.picture);
}

std::vector<Picture> EyeRenderer::render_pair(const EyePair& wanted, const SkyCube& sky) {
  const EyePicture& first = wanted.first;
  const EyePicture& second = wanted.second;
  std::vector<Picture> pictures;
  // Positions of stars (on GPUs) and the disk's grid (everywhere) are stored for one picture only.
  if (backend_ != Backend::cpu || !first.settings.near_field.empty()) {
    pictures.push_back(render(first.eye, first.projection, sky, first.settings));
    pictures.push_back(render(second.eye, second.projection, sky, second.settings));
    return pictures;
  }
  Making both[] = {{first.eye, first.projection, first.settings}, {second.eye, second.projection, second.settings}};
  near_field_ = {};
  for (Making& making : both) {
    begin(making, sky);
  }
  const bool at_once = wanted.one_projection && both[0].source->shares_work_with(*both[1].source);
  visit_blocks(first.projection, [&](const RowBlock& block) {
    visit_rows(block, rows_of_a_strip(first.projection.width_px), [&](const RowBlock& rows) {
      if (at_once) {
        return make_sky_of_both(both, rows);
      }
      make_sky(both[0], rows);
      make_sky(both[1], rows);
    });
    draw_over(both[0], block);
    draw_over(both[1], block);
  });
  for (Making& making : both) {
    end(making);
    pictures.push_back(std::move(making.picture));
  }
  return pictures;
}

void EyeRenderer::draw_over_rows(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings,
                                 const FoundPoints& stars, const RowBlock& rows, float* light) {
  if (backend_ == Backend::cpu) {
    // Rows are rendered directly into the picture.
    if (!stars.empty()) {
      settings.stars->draw(stars.in_host, projection, rows.first, rows.count, light);
    }
    return draw_near_rows(eye, projection, settings, rows, light);
  }
  if (!stars.empty()) {
    tiled_stars_.draw(rows.first, rows.count, rgba_.data());
  }
  draw_near_rows(eye, projection, settings, rows, rgba_.data());
  rgba_.read(light, 4 * static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(rows.count));
}

long EyeRenderer::count_unresolved(const float* estimates, std::size_t pixels) const {
  return backend_ == Backend::cuda ? count_negative_cuda(estimates, static_cast<long>(pixels))
                                   : std::count_if(estimates, estimates + pixels, [](float e) { return e < 0.0F; });
}

std::size_t EyeRenderer::block_pixels(const Projection& projection) const {
  const int rows = rows_of_a_block(backend_, projection.width_px, projection.height_px);
  return static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(rows);
}

template <class Visit>
void EyeRenderer::visit_blocks(const Projection& projection, const Visit& visit) const {
  visit_rows({0, projection.height_px}, rows_of_a_block(backend_, projection.width_px, projection.height_px), visit);
}

}  // namespace ergodome
