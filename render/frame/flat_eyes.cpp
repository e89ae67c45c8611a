#include "render/frame/flat_eyes.h"

#include <algorithm>
#include <memory>

#include "render/eyes/view_projection.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

//! passes_until() returns the passes whose stage is at most `last`, passes_after() the others.
std::vector<Pass*> passes_until(std::vector<Pass*> passes, PassStage last) {
  std::erase_if(passes, [&](const Pass* pass) { return pass->kind().stage > last; });
  return passes;
}
std::vector<Pass*> passes_after(std::vector<Pass*> passes, PassStage last) {
  std::erase_if(passes, [&](const Pass* pass) { return pass->kind().stage <= last; });
  return passes;
}

}  // namespace

StereoPictures render_flat_eyes(EyeRenderer& renderer, const EyePicture& head, const SkyCube& sky) {
  const PictureSettings& settings = head.settings;
  const StereoSettings& stereo = settings.show->stereo;
  StereoPictures made{{}, stereo.baseline};
  std::shared_ptr<const FlatShadow> shadow;
  if (stereo.baseline > 0.0) {
    shadow = std::make_shared<const FlatShadow>(head.eye);
    made.baseline = std::min(stereo.baseline, shadow->max_baseline());
  }
  // With a baseline, only passes of infinitely distant things draw with the head's lens. The others
  // draw over each eye's picture afterwards: the shadow, things with their own parallax, and then
  // passes that spread light (bloom).
  const PassStage shared = shadow ? PassStage::distant : PassStage::near;
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
  for (std::size_t i = 0; i < 2; ++i) {
    const double offset = (i == 0 ? -0.5 : 0.5) * made.baseline;
    EyePicture own{head.eye, converged_projection(head.projection, offset, stereo.convergence), settings};
    own.settings.passes = passes_after(settings.passes, shared);
    if (shadow) {
      own.settings.shared = {shadow, head.projection, offset, shadow->eye_edge(offset)};
    }
    EyeRenderer::finish(made.eyes[i], own);
  }
  return made;
}

}  // namespace ergodome
