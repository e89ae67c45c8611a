#include "app/commands/render/frame_request.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/cli/show_loading.h"
#include "app/commands/channels/heat_map_options.h"
#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "content/files/fingerprint.h"
#include "content/mesh/formats/mesh_reader.h"
#include "content/show/reading/show_files.h"
#include "content/show/reading/show_reader.h"
#include "render/passes/overlay/camera_readout.h"
#include "render/passes/overlay/overlay_position.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Returns the names of all files that the show, the options and the setup name or imply, each with
//! a fingerprint of its contents.
std::string states_of_files(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup) {
  std::string states;
  const auto add = [&](const fs::path& folder, const fs::path& name) {
    if (!name.empty()) {
      states += fmt::format("{} {}\n", name.string(), fingerprint_of_file(folder / name));
    }
  };
  for (const NamedFile& file : files_of_pictures(show)) {
    add(show.folder, file.name);
    if (file.key.ends_with(".mesh")) {
      for (const fs::path& beside : files_of_mesh(fs::path(show.folder) / file.name)) {
        add(beside.parent_path(), beside.filename());
      }
    }
  }
  for (const Overlay& overlay : show.timeline.overlays) {
    add(show.folder, overlay.image);
  }
  add("", options.lens.trajectory);
  add(show.folder, show.name + ".trajectory");
  for (const ProjectorSetup& projector : setup ? setup->projectors : std::vector<ProjectorSetup>()) {
    add(setup->folder, projector.warp ? projector.warp->file : "");
    if (projector.warp && projector.warp->format == WarpFormat::mpcdi) {
      for (const fs::path& beside : files_of_mpcdi(setup->folder / projector.warp->file)) {
        add(beside.parent_path(), beside.filename());
      }
    }
    add(setup->folder, projector.blend_mask);
    add(setup->folder, projector.black_level_mask);
  }
  return states;
}

//! Returns whether frames may depend on the length of the show: falls are followed to its end,
//! budgets are measured over all of it, and a trajectory of another length is ignored.
bool length_counts(const RenderOptions& options, const Show& show) {
  std::error_code problem;
  return show.camera.fall || !options.budget.empty() || !options.lens.trajectory.empty() ||
         std::filesystem::exists(fs::path(show.folder) / (show.name + ".trajectory"), problem);
}

//! Returns the show without the parts that frames do not show (chapters, sound), or that only some
//! frames show (captions), and without its length unless length_counts().
Show drawn_part(const RenderOptions& options, Show show) {
  show.timeline.captions.clear();
  show.timeline.chapters.clear();
  show.timeline.audio.clear();
  if (!length_counts(options, show)) {
    show.duration_s = 0.0;
  }
  return show;
}

}  // namespace

FrameRequests::FrameRequests(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup)
    : language_(options.language) {
  const std::string written =
      fmt::format("{} {} {} {} {} {} {} {}", options.format, options.compression, options.alpha, options.size_px,
                  options.view, options.view_range, options.method, options.channels);
  // The text of a readout depends on the language.
  const std::string words = show.readout ? text_in(readout_text(Spacetime{}, 0.0, 0.0), options.language) : "";
  const std::string light = fmt::format("{} {}", options.lens.lens, fmt::join(options.budget, " "));
  of_all_ = fingerprint(fmt::format("{}\n{}\n{}\n{}\n{}\n{}{}", ERGODOME_VERSION, to_toml(drawn_part(options, show)),
                                    setup ? to_toml(*setup) : "", written, light, states_of_files(options, show, setup),
                                    words));
  // Heat maps have no captions.
  if (view_mode(options.view) == ViewMode::sky) {
    captions_ = show.timeline.captions;
  }
}

std::string FrameRequests::at(double time_s) const {
  std::string seen = of_all_;
  for (const Caption& caption : captions_) {
    const double opacity = presence_at(caption.presence, time_s);
    const std::string& text = text_in(caption.text, language_);
    if (opacity > 0.0 && !text.empty()) {
      seen += fmt::format("\n{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {} {}", opacity,
                          caption.position.azimuth_deg, caption.position.elevation_deg, caption.position.roll_deg,
                          caption.letter_deg, caption.width_deg, fmt::join(caption.color, " "), text);
    }
  }
  return seen == of_all_ ? of_all_ : fingerprint(seen);
}

}  // namespace ergodome
