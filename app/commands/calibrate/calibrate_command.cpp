#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/progress.h"
#include "app/cli/setup_show.h"
#include "app/cli/usage_error.h"
#include "app/commands/calibrate/calibration_keys.h"
#include "app/commands/calibrate/calibration_window.h"
#include "app/commands/calibrate/saved_calibration.h"
#include "app/commands/inspect/inspect_setup.h"
#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/projector_files.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/projectors/setup_conversion.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "kernels/core/error.h"
#include "render/patterns/setup_picture.h"

namespace ergodome {

namespace {

struct CalibrateOptions {
  std::string setup;
  std::string out;
  std::string mpcdi;
  int master_px = 4096;
  double tolerance_px = 0.25;
  BlendSettings blend;
  bool live = false;
  bool size_given = false;
  LiveOptions shown;  //!< options of the live calibration (--live)
};

//! Converts a file name relative to the old setup's folder into one relative to the new setup's
//! folder.
std::string moved(const std::string& file, const std::filesystem::path& from, const std::filesystem::path& to) {
  return file.empty() ? file : std::filesystem::relative(from / file, to).string();
}

void run_live(const CalibrateOptions& options) {
  LiveOptions live = options.shown;
  live.setup = options.setup;
  live.master_px = options.size_given ? options.master_px : 0;
  CalibrationWindow(live).run();
}

//! The files of a projector, computed but not yet written.
struct ComputedProjector {
  std::string name;  //!< prefix of the names of the projector's files
  std::string mesh;
  std::string mask;
};

//! Checks everything that can be checked before writing: that files named by the new setup can be
//! read, and that output files can be written.
void require_files(const CalibrateOptions& options, const DomeSetup& setup) {
  const std::filesystem::path out = options.out;
  for (std::size_t i = 0; i < setup.projectors.size(); ++i) {
    // The warp and the blend mask are recomputed; the mask of the black level is kept.
    ProjectorSetup stays = setup.projectors[i];
    stays.warp.reset();
    stays.blend_mask.clear();
    load_projector(setup, stays);
    const std::string name = projector_file_name(i, stays.name);
    require_writable(out / (name + ".data"));
    require_writable(out / (name + "_blend.png"));
  }
  require_writable(out / std::filesystem::path(options.setup).filename());
  if (!options.mpcdi.empty()) {
    require_writable(options.mpcdi);
  }
}

//! Prints how much of the dome each projector lights, from the computed meshes and masks (as
//! `inspect` does).
void print_lit_parts(const std::vector<ProjectorPicture>& pictures) {
  const std::vector<double> lit = lit_parts(pictures);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const ProjectorPicture& picture = pictures[i];
    print_out("{}: {} x {} nodes, {:.1f} % of the dome\n", picture.name, picture.warp.columns, picture.warp.rows,
              100.0 * lit[i]);
    if (lit[i] < 0.005) {
      print_note("{} lights almost none of the dome; check position_m, yaw_deg and pitch_deg", picture.name);
    }
  }
  print_out("{:.1f} % of the dome is lit by no projector\n", 100.0 * lit.back());
}

std::vector<ComputedProjector> compute(const CalibrateOptions& options, const DomeSetup& setup) {
  const DomeScreen screen = {setup.tilt_deg, 180.0};
  std::vector<ProjectorOptics> projectors;
  projectors.reserve(setup.projectors.size());
  for (const ProjectorSetup& projector : setup.projectors) {
    projectors.emplace_back(setup, projector);
    if (projectors.back().outside()) {
      print_note("{}{}", projector.name, outside_note);
    }
  }
  const DomeBlend blend(projectors, screen, options.blend);
  std::vector<ComputedProjector> computed;
  std::vector<ProjectorPicture> pictures;
  pictures.reserve(projectors.size());
  Progress progress("warps and masks", static_cast<long>(projectors.size()));
  for (std::size_t i = 0; i < projectors.size(); ++i) {
    const ProjectorSetup& projector = setup.projectors[i];
    ProjectorPicture picture;
    picture.name = projector.name;
    picture.width_px = projector.width_px;
    picture.height_px = projector.height_px;
    picture.warp = dome_warp(projectors[i], screen, options.master_px, options.tolerance_px);
    picture.blend = blend.mask(i, projector.width_px, projector.height_px);
    const std::string name = projector_file_name(i, projector.name);
    computed.push_back({name,
                        to_bourke_mesh(picture.warp, static_cast<double>(projector.width_px) / projector.height_px),
                        to_png(picture.blend, name + "_blend.png")});
    pictures.push_back(std::move(picture));
    progress.advance_to(static_cast<long>(i) + 1);
  }
  print_lit_parts(pictures);
  return computed;
}

//! Returns the calibration as MPCDI, with warps recomputed from the lenses: the straight edges of a
//! mesh would need more samples than the curves that they approximate.
Mpcdi exact_mpcdi(DomeSetup setup) {
  constexpr double tolerance_px = 0.02;
  for (ProjectorSetup& projector : setup.projectors) {
    projector.warp.reset();
  }
  Progress progress("MPCDI", static_cast<long>(setup.projectors.size()));
  const auto now = fmt::gmtime(std::time(nullptr));
  return mpcdi_from_pictures(projector_pictures(setup, tolerance_px), fmt::format("{:%Y-%m-%d %H:%M:%S}", now),
                             [&](long done) { progress.advance_to(done); });
}

//! Writes warps and masks, then a setup that names them.
void write_calibration(const CalibrateOptions& options, DomeSetup setup,
                       const std::vector<ComputedProjector>& computed) {
  const std::filesystem::path out = options.out;
  make_folder(out);
  for (std::size_t i = 0; i < computed.size(); ++i) {
    ProjectorSetup& projector = setup.projectors[i];
    const std::string& name = computed[i].name;
    write_text_keeping_older(out / (name + ".data"), computed[i].mesh);
    write_text_keeping_older(out / (name + "_blend.png"), computed[i].mask);
    projector.warp.emplace();
    projector.warp->file = name + ".data";
    projector.blend_mask = name + "_blend.png";
    projector.blend_mask_gamma = 1.0;
    projector.black_level_mask = moved(projector.black_level_mask, setup.folder, out);
  }
  setup.folder = out;
  const std::filesystem::path file = out / std::filesystem::path(options.setup).filename();
  write_dome_setup(file, setup);
  print_out("written to {}\n", file.string());
  if (!options.mpcdi.empty()) {
    const Mpcdi mpcdi = exact_mpcdi(setup);
    write_mpcdi(options.mpcdi, mpcdi);
    print_out("written to {}{}\n", options.mpcdi, tilt_note(setup, mpcdi));
  }
}

//! Returns whether the folder of a file will exist once the folder `out` is created, because it is
//! that folder or one of its parents. False if `out` is empty.
bool is_made_with(const std::filesystem::path& file, const std::filesystem::path& out) {
  const auto plain = [](const std::filesystem::path& folder) {
    return (std::filesystem::absolute(folder) / "").lexically_normal().parent_path();
  };
  if (out.empty()) {
    return false;
  }
  const std::filesystem::path folder = plain(std::filesystem::absolute(file).parent_path());
  std::filesystem::path made = plain(out);
  while (made != folder && made.has_relative_path()) {
    made = made.parent_path();
  }
  return made == folder;
}

void run(const CalibrateOptions& options) {
  const std::filesystem::path mpcdi = options.mpcdi;
  (mpcdi.empty() || is_made_with(mpcdi, options.out) ? require_other_file : require_output_file)("--mpcdi", mpcdi,
                                                                                                 {options.setup});
  require_other_png("--screenshot", options.shown.screenshot, {});
  if (options.live) {
    if (!options.shown.screenshot.empty()) {
      require_writable(options.shown.screenshot);
    }
    run_live(options);
    return;
  }
  if (options.out.empty()) {
    throw UsageError("calibrate", "has nothing to do", "add --out DIR for warps and masks, or --live");
  }
  end_on_interrupts();
  const DomeSetup setup = read_dome_setup(options.setup);
  require_files(options, setup);
  write_calibration(options, setup, compute(options, setup));
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("calibrate", "Compute warps and blend masks of a dome's projectors from their positions");
  auto options = std::make_shared<CalibrateOptions>();
  command->add_option("setup", options->setup, "dome setup (.toml) that gives each projector's lens")->required();
  CLI::Option* const out = command
                               ->add_option("--out", options->out,
                                            "folder for warps (Bourke meshes), masks (PNG) and a setup that uses them")
                               ->type_name("DIR");
  CLI::Option* const mpcdi =
      command->add_option("--mpcdi", options->mpcdi, "also write the calibration as MPCDI")->type_name("FILE");
  const CLI::Option* const size = command->add_option("--size", options->master_px, "width of the domemaster in pixels")
                                      ->check(CLI::Range(64, 16'384));
  CLI::Option* const tolerance =
      command->add_option("--tolerance", options->tolerance_px, "accepted error of a warp in pixels of the domemaster")
          ->check(number_between(0.01, 10.0))
          ->capture_default_str();
  CLI::Option* const softness = command
                                    ->add_option("--softness", options->blend.softness,
                                                 "how masks fade across an overlap: 1 is linear, 2 or more is smooth")
                                    ->check(number_between(0.5, 8.0))
                                    ->capture_default_str();
  CLI::Option* const evenness = command
                                    ->add_option("--evenness", options->blend.evenness,
                                                 "compensation of brightness across the dome: 0 none, 1 full")
                                    ->check(number_between(0.0, 1.0))
                                    ->capture_default_str();
  CLI::Option* const live =
      command->add_flag("--live", options->live,
                        "show test patterns on the projectors and adjust the setup with keys; computes no warps");
  command->add_flag("--no-control", options->shown.hide_control, "with --live: open only the projectors' windows")
      ->needs(live);
  command
      ->add_flag("--cluster", options->shown.cluster,
                 "with --live: nodes (ergodome node) show their projectors; this computer those without a node")
      ->needs(live);
  command->add_option("--for", options->shown.for_seconds, "with --live: quit after this many seconds")
      ->check(number_between(0.0, 1e9))
      ->needs(live);
  command
      ->add_option("--screenshot", options->shown.screenshot,
                   "with --live: save the last picture of each window; FILE.png becomes FILE_PROJECTOR.png")
      ->type_name("FILE")
      ->needs(live);
  for (CLI::Option* const computing : {out, mpcdi, tolerance, softness, evenness}) {
    live->excludes(computing);
  }
  command->footer("Keys with --live:\n" + calibration_key_lines("  "));
  command->callback([options, size] {
    options->size_given = size->count() > 0;
    run(*options);
  });
}

}  // namespace ergodome
