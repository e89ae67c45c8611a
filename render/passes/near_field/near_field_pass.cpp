#include "render/passes/near_field/near_field_pass.h"

#include <fmt/format.h>

#include <utility>

#include "content/sky/environment_image.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/objects/object_horizon.h"

namespace ergodome {

namespace {

//! Returns a copy of a show whose shells are drawn as heat maps show them: thin lines over the map.
Show lines_alone(Show show) {
  for (ShellSettings& shell : show.shells) {
    shell.line_opacity = is_visible(shell) ? 0.5 : 0.0;
    shell.line_width_deg = 0.5;
    shell.line_color = {1.0, 1.0, 1.0};
    shell.fill_opacity = 0.0;
    shell.exposure = 1.0;
  }
  show.effects.redshift = false;
  return show;
}

DiskGridRequest grid_request(const EyePicture& picture, const Projection& projection, const DiskAppearance& disk) {
  return {picture.eye,
          disk,
          pixel_angle(projection),
          picture.settings.accuracy.budget_px,
          static_cast<double>(projection.width_px) * projection.height_px,
          picture.settings.lens == LensChoice::live};
}

bool may_read_grid(Backend backend, const NearField& parts, const PictureSettings& settings) {
  return is_disk_without_shells(parts) && may_read_disk_grid(backend, settings.lens, settings.scheme);
}

}  // namespace

//! Draws the near field of one picture.
class NearFieldPass::Drawing : public PassDrawing {
 public:
  Drawing(NearFieldPass& pass, const EyePicture& picture)
      : pass_(pass), picture_(picture), parts_(pass.parts_for(picture)) {}

  void draw(const RowBlock& rows, float* rgba) override {
    // The disk grid is chosen after the lens, which loads the baked stations that both may use.
    if (!std::exchange(has_grid_, true)) {
      find_grid();
    }
    const PictureSettings& settings = picture_.settings;
    const PictureView view = {picture_.eye, settings.omni.get(), picture_.projection, settings.accuracy.tolerance_px,
                              settings.time_s};
    draw_near_field(pass_.backend_, parts_, view, rows, rgba);
  }

 private:
  //! Selects a grid from which the disk is read, if there is one or if building one is cheaper than
  //! rays.
  void find_grid() {
    const PictureSettings& settings = picture_.settings;
    if (settings.given != nullptr || settings.omni != nullptr || !may_read_grid(pass_.backend_, parts_, settings)) {
      return;
    }
    const DiskAppearance disk = parts_.disk->look_at(settings.time_s);
    const DiskGridRequest request = grid_request(picture_, picture_.projection, disk);
    parts_.disk_grid = pass_.streamed_disk_.layers_for(request, settings.lens, settings.moment.time_s);
    if (!parts_.disk_grid) {
      parts_.disk_grid = pass_.grids_->eyes.grid_for(request);
    }
  }

  NearFieldPass& pass_;
  const EyePicture& picture_;
  NearField parts_;
  bool has_grid_ = false;
};

NearFieldPass::SharedCamera::SharedCamera(NearFieldPass& pass, const EyePicture& picture)
    : shadow(picture.settings.shared->shadow),
      parts(pass.parts_for_shared_camera(picture)),
      drawing(pass.backend_, parts, picture.eye, *shadow, pass.flat_rows_) {}

//! The near field of an eye that shares its head's camera.
class NearFieldPass::SharedCameraDrawing : public PassDrawing {
 public:
  SharedCameraDrawing(NearFieldPass& pass, const EyePicture& picture) : pass_(pass), picture_(picture) {}

  void finish(Picture& picture) override {
    const PictureSettings& settings = picture_.settings;
    const SharedCameraEye& eye = *settings.shared;
    std::unique_ptr<SharedCamera>& shared = pass_.shared_camera_;
    if (!shared || shared->shadow != eye.shadow) {
      shared = std::make_unique<SharedCamera>(pass_, picture_);
    }
    shared->drawing.set_eye(eye.offset, eye.edge);
    const PictureView view = {picture_.eye, nullptr, picture_.projection, settings.accuracy.tolerance_px,
                              settings.time_s};
    const int block_rows = rows_of_a_block(pass_.backend_, picture.width, picture.height);
    visit_rows({0, picture.height}, block_rows, [&](const RowBlock& rows) {
      const std::size_t first = 4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(rows.first);
      shared->drawing.draw(view, rows, picture.rgba.data() + first);
    });
  }

 private:
  NearFieldPass& pass_;
  const EyePicture& picture_;
};

NearFieldPass::NearFieldPass(const PassInput& input) : backend_(input.backend), streamed_disk_(input.stream) {
  const Show& show = input.show;
  const auto* const previous = static_cast<const NearFieldPass*>(input.previous);
  if (show.disk) {
    disk_ = previous != nullptr && previous->disk_ ? previous->disk_ : std::make_shared<DiskPass>(show, backend_);
  }
  if (!show.shells.empty()) {
    const bool shared = previous != nullptr && previous->shells_ && same_shell_textures(*input.previous_show, show);
    shells_ = shared ? previous->shells_ : std::make_shared<ShellPass>(show, backend_);
  }
  objects_ = traced_objects_of(show, backend_);
  grids_ = previous != nullptr ? previous->grids_ : std::make_shared<Grids>();
}

std::unique_ptr<Pass> make_near_field_pass(const PassInput& input) {
  const Show& show = input.show;
  const bool any = show.disk || !show.shells.empty() || has_objects(show, ObjectMethod::trace);
  return any ? std::make_unique<NearFieldPass>(input) : nullptr;
}

std::unique_ptr<PassDrawing> NearFieldPass::prepare(const EyePicture& picture) {
  if (picture.settings.shared) {
    return std::make_unique<SharedCameraDrawing>(*this, picture);
  }
  return std::make_unique<Drawing>(*this, picture);
}

NearField NearFieldPass::parts_for(const EyePicture& picture) const {
  const Show& show = *picture.settings.show;
  const ViewMode mode = picture.settings.mode;
  const NearFieldNeeds needs = near_field_needs(show, mode);
  if (needs.shells) {
    shells_->set_numbers(mode == ViewMode::sky ? show : lines_alone(show));
  }
  return {needs.disk ? disk_.get() : nullptr, needs.shells ? shells_.get() : nullptr,
          needs.traced_objects ? objects_.get() : nullptr};
}

NearField NearFieldPass::parts_for_shared_camera(const EyePicture& picture) {
  NearField parts = parts_for(picture);
  if (may_read_grid(backend_, parts, picture.settings)) {
    const DiskAppearance disk = parts.disk->look_at(picture.settings.time_s);
    DiskGridRequest request = grid_request(picture, picture.settings.shared->head_projection, disk);
    request.nearness = true;
    parts.disk_grid = grids_->heads.grid_for(request);
  }
  return parts;
}

void NearFieldPass::apply(const Show& show, const NumberChange& /*change*/) {
  if (disk_) {
    disk_->set_numbers(show);
  }
  if (shells_) {
    shells_->set_numbers(show);
  }
}

bool NearFieldPass::serves(const Show& /*now*/, const Show& /*next*/) const {
  // A changed show always gets a new pass, which reads the meshes again, because their files may
  // have changed. The new pass shares everything else with the previous pass.
  return false;
}

std::vector<std::string> NearFieldPass::notes(const Show& show) const {
  std::vector<std::string> notes;
  for (std::size_t i = 0; shells_ && i < shells_->repaired().size(); ++i) {
    if (shells_->repaired()[i].are_a_mistake()) {
      notes.push_back(
          note_of_repair(show, fmt::format("shells[{}].texture", i), show.shells[i].texture, shells_->repaired()[i]));
    }
  }
  for (const ObjectInHorizon& inside : objects_ ? objects_->in_horizon() : std::vector<ObjectInHorizon>{}) {
    notes.push_back(note_of(show, inside));
  }
  return notes;
}

}  // namespace ergodome
