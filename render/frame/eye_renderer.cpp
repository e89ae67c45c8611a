#include "render/frame/eye_renderer.h"

#include <algorithm>

#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {

std::size_t picture_pixels(const Projection& projection, int rows) {
  return static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(rows);
}

std::vector<std::unique_ptr<PassDrawing>> prepare_passes(const EyePicture& wanted) {
  std::vector<std::unique_ptr<PassDrawing>> drawings;
  drawings.reserve(wanted.settings.passes.size());
  for (Pass* pass : wanted.settings.passes) {
    drawings.push_back(pass->prepare(wanted));
  }
  return drawings;
}

}  // namespace

//! A picture in progress, rendered block by block into host memory.
class EyeRenderer::Making {
 public:
  //! `wanted` and `sky` must outlive this object. Prepares the passes before it chooses the lens,
  //! because passes may work in other threads meanwhile.
  Making(EyeRenderer& renderer, const EyePicture& wanted, const SkyCube& sky)
      : renderer_(renderer),
        wanted_(wanted),
        block_rows_(rows_of_a_block(renderer.backend_, wanted.projection.width_px, wanted.projection.height_px)),
        drawings_(prepare_passes(wanted)),
        sky_(renderer.sky_, wanted, sky, block_rows_) {
    picture_.width = wanted.projection.width_px;
    picture_.height = wanted.projection.height_px;
    if (wanted.settings.mode != ViewMode::sky) {
      picture_.heat_range = heat_range(wanted.settings);
    }
    picture_.rgba.resize(4 * picture_pixels(wanted.projection, picture_.height));
    count_work("buffer: finished picture", static_cast<long>(picture_.rgba.size() * sizeof(float)));
    picture_.lens = sky_.lens().name();
    picture_.behind = sky_.lens().behind();
    picture_.stars = wanted.settings.stars_apart;
  }

  [[nodiscard]] int block_rows() const { return block_rows_; }

  void make_sky(const RowBlock& rows) {
    sky_.draw(rows, memory_of(rows));
    picture_.unresolved_pixels += sky_.count_unresolved();
  }

  //! Draws the passes over picture rows that hold the sky. On a GPU, then copies these rows to the
  //! picture.
  void draw_over(const RowBlock& rows) {
    float* const memory = memory_of(rows);
    for (const std::unique_ptr<PassDrawing>& drawing : drawings_) {
      drawing->draw(rows, memory);
    }
    if (renderer_.backend_ != Backend::cpu) {
      renderer_.rgba_.read(light(rows), 4 * picture_pixels(wanted_.projection, rows.count));
    }
  }

  Picture finish() {
    for (const std::unique_ptr<PassDrawing>& drawing : drawings_) {
      drawing->finish(picture_);
    }
    return std::move(picture_);
  }

 private:
  float* light(const RowBlock& rows) {
    return picture_.rgba.data() + 4 * picture_pixels(wanted_.projection, rows.first);
  }
  //! Returns the memory of the backend in which rows are rendered. On the CPU, this is the picture
  //! itself.
  float* memory_of(const RowBlock& rows) {
    return renderer_.backend_ == Backend::cpu ? light(rows)
                                              : renderer_.room_for(picture_pixels(wanted_.projection, block_rows_));
  }

  EyeRenderer& renderer_;
  const EyePicture& wanted_;
  int block_rows_;
  Picture picture_;
  Drawings drawings_;
  SkyDrawing sky_;
};

float* EyeRenderer::room_for(std::size_t pixels) {
  if (rgba_.size() < 4 * pixels) {
    rgba_ = Buffer<float>(backend_, 4 * pixels, "picture");
  }
  return rgba_.data();
}

Picture EyeRenderer::render(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                            const PictureSettings& settings) {
  const EyePicture wanted{eye, projection, settings};
  Making making(*this, wanted, sky);
  visit_rows({0, projection.height_px}, making.block_rows(), [&](const RowBlock& rows) {
    making.make_sky(rows);
    making.draw_over(rows);
  });
  return making.finish();
}

std::vector<Picture> EyeRenderer::render_pair(const EyePair& wanted, const SkyCube& sky) {
  const EyePicture& first = wanted.first;
  const EyePicture& second = wanted.second;
  std::vector<Picture> pictures;
  // Renders one eye after the other on GPUs, where rows and stars are stored for one picture only,
  // and if one of the passes prepares only one picture at a time.
  if (backend_ != Backend::cpu ||
      std::ranges::any_of(first.settings.passes, [](const Pass* pass) { return pass->kind().serves_one_picture; })) {
    pictures.push_back(render(first.eye, first.projection, sky, first.settings));
    pictures.push_back(render(second.eye, second.projection, sky, second.settings));
    return pictures;
  }
  Making both[] = {{*this, first, sky}, {*this, second, sky}};
  visit_rows({0, first.projection.height_px}, both[0].block_rows(), [&](const RowBlock& block) {
    visit_rows(block, rows_of_a_strip(first.projection.width_px), [&](const RowBlock& rows) {
      both[0].make_sky(rows);
      both[1].make_sky(rows);
    });
    both[0].draw_over(block);
    both[1].draw_over(block);
  });
  for (Making& making : both) {
    pictures.push_back(making.finish());
  }
  return pictures;
}

void EyeRenderer::finish_in_place(const EyePicture& wanted, const Drawings& drawings) {
  const std::vector<Pass*>& passes = wanted.settings.passes;
  Picture picture;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const PassKind& kind = passes[i]->kind();
    if (kind.stage != PassStage::near || !kind.in_host_memory) {
      continue;
    }
    if (picture.rgba.empty()) {
      picture.width = wanted.projection.width_px;
      picture.height = wanted.projection.height_px;
      picture.rgba.resize(4 * picture_pixels(wanted.projection, picture.height));
      rgba_.read(picture.rgba.data(), picture.rgba.size());
    }
    drawings[i]->finish(picture);
  }
  if (!picture.rgba.empty()) {
    rgba_.write(picture.rgba.data(), picture.rgba.size());
  }
}

BackendPicture EyeRenderer::render_in_place(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                                            const PictureSettings& settings) {
  const DeviceWorkInOrder in_order(backend_);
  const EyePicture wanted{eye, projection, settings};
  const Drawings drawings = prepare_passes(wanted);
  SkyDrawing lens_and_sky(sky_, wanted, sky, projection.height_px);
  const RowBlock all = {0, projection.height_px};
  float* const memory = room_for(picture_pixels(projection, all.count));
  lens_and_sky.draw(all, memory);
  for (const std::unique_ptr<PassDrawing>& drawing : drawings) {
    drawing->draw(all, memory);
  }
  finish_in_place(wanted, drawings);
  return {rgba_.data(), lens_and_sky.lens().name(), lens_and_sky.lens().behind(), settings.stars_apart};
}

void EyeRenderer::finish(Picture& picture, const EyePicture& wanted) {
  for (const std::unique_ptr<PassDrawing>& drawing : prepare_passes(wanted)) {
    drawing->finish(picture);
  }
}

}  // namespace ergodome
