#include "app/frame_request.h"

#include <fmt/format.h>

#include <filesystem>

#include "calibration/mpcdi_reader.h"
#include "content/fingerprint.h"
#include "content/mesh/mesh_files.h"
#include "content/show_files.h"
#include "content/show_reader.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Names of files, with what tells one state of each from another.
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

}  // namespace

std::string frame_request(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup) {
  const std::string written = fmt::format("{} {} {} {} {} {} {}", options.format, options.compression, options.alpha,
                                          options.size_px, options.view, options.method, options.language);
  const std::string light = fmt::format("{} {}", options.lens.lens, fmt::join(options.budget, " "));
  return fingerprint(fmt::format("{}\n{}\n{}\n{}\n{}\n{}", ERGODOME_VERSION, to_toml(show),
                                 setup ? to_toml(*setup) : "", written, light, states_of_files(options, show, setup)));
}

}  // namespace ergodome
