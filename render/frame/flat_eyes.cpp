#include "render/frame/flat_eyes.h"

#include <algorithm>
#include <optional>

#include "render/eyes/view_projection.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/output/stereo_layout.h"
#include "render/passes/flat_shadow/shadow_mask.h"

namespace ergodome {

namespace {

//! Draws disk, shells and objects over an eye's picture, a block of rows at a time.
void draw_flat_rows(Backend backend, FlatNearField& near_field, const PictureView& view, Picture& picture) {
  visit_rows({0, picture.height}, rows_of_a_block(backend, picture.width, picture.height), [&](const RowBlock& rows) {
    const std::size_t first = 4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(rows.first);
    near_field.draw(view, rows, picture.rgba.data() + first);
  });
}

//! Returns the passes up to a stage, or those after it.
std::vector<Pass*> passes_until(std::vector<Pass*> passes, PassStage last) {
  std::erase_if(passes, [&](const Pass* pass) { return pass->kind().stage > last; });
  return passes;
}
std::vector<Pass*> passes_after(std::vector<Pass*> passes, PassStage last) {
  std::erase_if(passes, [&](const Pass* pass) { return pass->kind().stage <= last; });
  return passes;
}

}  // namespace

StereoPictures render_flat_eyes(EyeRenderer& renderer, const EyePicture& head, const SkyCube& sky,
                                NearFieldPass* near_field) {
  const PictureSettings& settings = head.settings;
  const StereoSettings& stereo = settings.show->stereo;
  StereoPictures made{{}, stereo.baseline};
  const bool apart = stereo.baseline > 0.0;
  std::optional<FlatShadow> shadow;
  if (apart) {
    shadow.emplace(head.eye);
    made.baseline = std::min(stereo.baseline, shadow->greatest_baseline());
  }
  // Light is spread only after the shadow, and everything with its own parallax, has been drawn.
  const PassStage shared = apart ? PassStage::distant : PassStage::near;
  PictureSettings sharp = settings;
  sharp.passes = passes_until(settings.passes, shared);
  for (const double side : {-0.5, 0.5}) {
    if (made.eyes.empty() || flat_pictures(stereo) > 1) {
      const Projection own = converged_projection(head.projection, side * made.baseline, stereo.convergence);
      made.eyes.push_back(renderer.render(head.eye, own, sky, sharp));
    } else {
      made.eyes.push_back(copied_picture(made.eyes.front()));
    }
  }
  NearField parts;
  std::optional<FlatNearField> drawing;
  if (apart && near_field_needs(*settings.show, settings.mode).any()) {
    parts = near_field->parts_for_head(head);
    drawing.emplace(near_field->flat_eyes(parts, head.eye, *shadow));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    Picture& eye = made.eyes[i];
    EyePicture own{head.eye, head.projection, settings};
    own.settings.beside = (i == 0 ? -0.5 : 0.5) * made.baseline;
    own.settings.passes = passes_after(settings.passes, shared);
    own.projection = converged_projection(head.projection, own.settings.beside, stereo.convergence);
    if (shadow) {
      const std::vector<float> edge = shadow->eye_edge(own.settings.beside);
      mask_shadow(eye, own.projection, edge_view(shadow->chart(), shadow->head_edge()),
                  edge_view(shadow->chart(), edge));
      if (drawing) {
        drawing->set_eye(own.settings.beside, edge);
        draw_flat_rows(renderer.backend(), *drawing,
                       {head.eye, nullptr, own.projection, settings.accuracy.tolerance_px, settings.time_s}, eye);
      }
    }
    EyeRenderer::finish(eye, own);
  }
  return made;
}

}  // namespace ergodome
