#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/eye_distance.h"
#include "render/frame/frame_passes.h"
#include "render/frame/show_renderer.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/output/stereo_layout.h"
#include "render/passes/flat_shadow/shadow_mask.h"
#include "render/passes/near_field/near_field_pass.h"
#include "render/passes/objects/object_kind.h"

// Renders two eyes with each stereo model.
namespace ergodome {

namespace {

//! Draws disk, shells and objects over an eye's picture, a block of rows at a time.
void draw_flat_rows(Backend backend, FlatNearField& near_field, const PictureView& view, Picture& picture) {
  const int block = rows_of_a_block(backend, picture.width, picture.height);
  for (int row = 0; row < picture.height; row += block) {
    const int rows = std::min(block, picture.height - row);
    const std::size_t first = 4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(row);
    near_field.draw(view, {row, rows}, picture.rgba.data() + first);
  }
}

//! Returns the passes up to a stage.
std::vector<Pass*> passes_until(std::vector<Pass*> passes, PassStage last) {
  std::erase_if(passes, [&](const Pass* pass) { return pass->kind().stage > last; });
  return passes;
}

//! Returns the passes after a stage.
std::vector<Pass*> passes_after(std::vector<Pass*> passes, PassStage last) {
  std::erase_if(passes, [&](const Pass* pass) { return pass->kind().stage <= last; });
  return passes;
}

}  // namespace

std::vector<Picture> ShowRenderer::render_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                               const ShowMoment& moment) {
  const StereoSettings& stereo = show_.stereo;
  note_baseline(pose, stereo.baseline);
  std::vector<Picture> eyes;
  if (eye_count(stereo) < 2) {
    eyes.push_back(render_eye(pose, 0.0, projection, mode, moment));
    return eyes;
  }
  switch (stereo.model) {
    case StereoModel::flat:
      return render_flat_eyes(pose, projection, mode, moment);
    case StereoModel::omni:
      return render_omni_eyes(pose, projection, mode, moment);
    case StereoModel::physical:
      break;
  }
  const auto wanted = [&](double side) {
    const double offset = side * stereo.baseline;
    return EyePicture{eye_camera(show_, pose, offset), converged_projection(projection, offset, stereo.convergence),
                      picture_settings(pose, mode, moment, offset)};
  };
  const bool one_projection = !(stereo.convergence > 0.0) || stereo.baseline == 0.0;
  return renderer_.render_pair({wanted(-0.5), wanted(0.5), one_projection}, sky_.cube());
}

std::vector<Picture> ShowRenderer::render_flat_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                                    const ShowMoment& moment) {
  const StereoSettings& stereo = show_.stereo;
  const EyeCamera head = eye_camera(show_, pose, 0.0);
  PictureSettings settings = picture_settings(pose, mode, moment, 0.0);
  const bool apart = stereo.baseline > 0.0;
  std::optional<FlatShadow> shadow;
  if (apart) {
    shadow.emplace(head);
    note_baseline(pose, std::min(stereo.baseline, shadow->greatest_baseline()));
  }
  // Light is spread only after the shadow, and everything with its own parallax, has been drawn.
  PictureSettings sharp = settings;
  sharp.passes = passes_until(settings.passes, apart ? PassStage::distant : PassStage::near);
  std::vector<Picture> eyes;
  for (const double side : {-0.5, 0.5}) {
    if (eyes.empty() || flat_pictures(stereo) > 1) {
      const Projection own = converged_projection(projection, side * baseline_, stereo.convergence);
      eyes.push_back(renderer_.render(head, own, sky_.cube(), sharp));
    } else {
      eyes.push_back(copied_picture(eyes.front()));
    }
  }
  const EyePicture of_head{head, projection, settings};
  NearField parts;
  std::optional<FlatNearField> near_field;
  if (apart && near_field_needs(show_, mode).any()) {
    auto* const pass = passes_.find<NearFieldPass>();
    parts = pass->parts_for_head(of_head);
    near_field.emplace(pass->flat_eyes(parts, head, *shadow));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double offset = (i == 0 ? -0.5 : 0.5) * baseline_;
    const Projection own = converged_projection(projection, offset, stereo.convergence);
    if (shadow) {
      const std::vector<float> edge = shadow->eye_edge(offset);
      mask_shadow(eyes[i], own, edge_view(shadow->chart(), shadow->head_edge()), edge_view(shadow->chart(), edge));
      if (near_field) {
        near_field->set_eye(offset, edge);
        draw_flat_rows(backend(), *near_field, {head, nullptr, own, settings.accuracy.tolerance_px, settings.time_s},
                       eyes[i]);
      }
    }
    EyePicture over{head, own, settings};
    over.settings.beside = offset;
    over.settings.passes = passes_after(settings.passes, apart ? PassStage::distant : PassStage::near);
    EyeRenderer::finish(eyes[i], over);
  }
  return eyes;
}

void ShowRenderer::note_baseline(const CameraPose& pose, double baseline) {
  const StereoSettings& stereo = show_.stereo;
  baseline_ = baseline;
  narrowed_.reset();
  if (baseline < stereo.baseline) {
    narrowed_ = {stereo.model, pose.r, stereo.baseline, baseline};
  }
}

std::shared_ptr<const OmniCamera> ShowRenderer::omni_cameras(const CameraPose& pose, double baseline,
                                                             double tolerance) const {
  return std::make_shared<const OmniCamera>(
      backend(), [&](const Vector3<double>& offset) { return eye_camera(show_, pose, offset); },
      omni_settings(show_.stereo, baseline, tolerance));
}

OmniPair ShowRenderer::fitting_omni_pair(const CameraPose& pose, double tolerance) {
  const EyePlace eye_at = [&](const Vector3<double>& offset) { return eye_camera(show_, pose, offset); };
  const auto pair_at = [&](double apart) {
    return make_omni_pair(backend(), eye_at, omni_settings(show_.stereo, apart, tolerance));
  };
  double baseline = std::min(show_.stereo.baseline, omni_room(show_.spin, pose));
  std::optional<OmniPair> pair = pair_at(baseline);
  if (!pair) {
    baseline = fitting_baseline(show_, pose);
    pair = pair_at(baseline);
  }
  if (!pair) {
    throw Error("stereo.model", fmt::format("the model omni cannot be drawn at r = {:.6g} M", pose.r),
                "choose model = \"physical\"");
  }
  note_baseline(pose, baseline);
  return *pair;
}

std::shared_ptr<const OmniCamera> ShowRenderer::fitting_omni_cameras(const CameraPose& pose, double tolerance) const {
  try {
    return omni_cameras(pose, std::min(show_.stereo.baseline, omni_room(show_.spin, pose)), tolerance);
  } catch (const Error&) {
    return omni_cameras(pose, fitting_baseline(show_, pose), tolerance);
  }
}

std::vector<Picture> ShowRenderer::render_omni_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                                    const ShowMoment& moment) {
  const EyePlace eye_at = [&](const Vector3<double>& offset) { return eye_camera(show_, pose, offset); };
  PictureSettings settings = picture_settings(pose, mode, moment, 0.0);
  const double tolerance = settings.accuracy.tolerance_px * pixel_angle(projection);
  const OmniPair pair = fitting_omni_pair(pose, tolerance);
  // Without a baseline, stars and the near field are bit-identical to the head's.
  const bool turns = baseline_ > 0.0;
  std::vector<CameraPose> shutter;
  std::vector<std::shared_ptr<const OmniCamera>> shutter_cameras;
  if (turns && settings.shutter) {
    shutter = shutter_poses(pose, *moment.time_s);
    for (const CameraPose& each : shutter) {
      shutter_cameras.push_back(fitting_omni_cameras(each, tolerance));
    }
  }
  std::vector<Picture> eyes;
  for (const std::shared_ptr<const OmniEye>& eye : pair) {
    const auto lens = omni_lenses_.choose(eye, projection, mode, settings.lens, settings.accuracy);
    settings.given = lens.get();
    if (turns) {
      settings.turning = eye;
      if (needs_polygons(show_, mode)) {
        settings.turning_view = std::make_shared<const TurningView>(turning_view(*eye, eye_at));
      }
    }
    for (std::size_t i = 0; i < shutter.size(); ++i) {
      const auto there = [&](const Vector3<double>& offset) { return eye_camera(show_, shutter[i], offset); };
      settings.shutter->eyes[i] = StarEye(make_omni_eye_for_trails(shutter_cameras[i], eye->side, there));
    }
    eyes.push_back(renderer_.render(eye_at({0.0, 0.0, 0.0}), projection, sky_.cube(), settings));
  }
  return eyes;
}

bool ShowRenderer::may_stay_in_place(ViewMode mode) const {
  const auto keeps_from_gpu = [&](const PassKind& kind) {
    return kind.stage >= PassStage::finished && kind.in_host_memory && kind.draws(show_, ViewMode::sky);
  };
  if (backend() == Backend::cpu || std::ranges::any_of(frame_passes(), keeps_from_gpu)) {
    return false;
  }
  const StereoSettings& stereo = show_.stereo;
  // Color bars span both eyes.
  return eye_count(stereo) < 2 || (stereo.model == StereoModel::physical && mode == ViewMode::sky &&
                                   shows_eyes_whole(stereo.layout) && !stereo.tint_eyes);
}

EyesInPlace ShowRenderer::render_eyes_in_place(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                               const ShowMoment& moment) {
  const StereoSettings& stereo = show_.stereo;
  note_baseline(pose, stereo.baseline);
  if (eye_count(stereo) < 2) {
    return {render_eye_in_place(pose, 0.0, projection, mode, moment), {}};
  }
  const auto render = [&](double side) {
    const double offset = side * stereo.baseline;
    return render_eye_in_place(pose, offset, converged_projection(projection, offset, stereo.convergence), mode,
                               moment);
  };
  const PictureInPlace left = render(-0.5);
  renderer_.set_aside();
  const PictureInPlace right = render(0.5);
  return stereo.swap_eyes ? EyesInPlace{right, left} : EyesInPlace{left, right};
}

}  // namespace ergodome
