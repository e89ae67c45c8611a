#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/usage_error.h"
#include "app/commands/calibrate/saved_calibration.h"
#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/projectors/setup_conversion.h"
#include "calibration/warps/warp_conversion.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Marks that no size is given: a mesh keeps its size, if it has one.
constexpr std::pair<int, int> own_size = {std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};

struct ConvertOptions {
  std::string from;
  std::string to;
  double radius_m = 5.0;
  double aspect = 16.0 / 9.0;
  std::pair<int, int> size = own_size;
};

//! Kinds of files. A name without an ending is a folder. `bourke` and `map` are warps (.data,
//! .pfm); `foreign` is a warp of another program, and only kind_of_source() returns it.
enum class FileKind { setup, mpcdi, bourke, map, foreign, folder, other };

FileKind kind_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".toml") {
    return FileKind::setup;
  }
  if (ending == ".mpcdi" || ending == ".xml") {
    return FileKind::mpcdi;
  }
  if (ending == ".data") {
    return FileKind::bourke;
  }
  if (ending == ".pfm") {
    return FileKind::map;
  }
  return ending.empty() ? FileKind::folder : FileKind::other;
}

//! Returns the kind of the source file: by its content if that shows a warp format, otherwise by
//! its ending. A setup is always recognized by its ending.
FileKind kind_of_source(const std::filesystem::path& path) {
  if (kind_of(path) == FileKind::setup) {
    return FileKind::setup;
  }
  if (const auto format = warp_format_of(path)) {
    constexpr FileKind kinds[] = {FileKind::bourke, FileKind::map, FileKind::mpcdi};
    return is_foreign(*format) ? FileKind::foreign : kinds[static_cast<int>(*format)];
  }
  return kind_of(path);
}

void convert_setup(const ConvertOptions& options, const DomeSetup& setup) {
  const std::filesystem::path to = options.to;
  if (kind_of(to) == FileKind::folder) {
    const std::filesystem::path name = std::filesystem::path(options.from).stem().string() + ".toml";
    const bool not_level = setup.tilt_deg != 0.0 && setup.rotation_deg != 0.0;
    print_out(
        "written to {}{}\n", write_projector_folder(to, name, setup, projector_pictures(setup)).string(),
        not_level ? "; its meshes include rotation_deg, so test patterns are level only with the original setup" : "");
    return;
  }
  const auto now = fmt::gmtime(std::time(nullptr));
  const Mpcdi mpcdi = mpcdi_from_setup(setup, fmt::format("{:%Y-%m-%d %H:%M:%S}", now));
  write_mpcdi(to, mpcdi);
  print_out("written to {}{}\n", to.string(), tilt_note(setup, mpcdi));
}

void convert_mpcdi(const ConvertOptions& options) {
  const std::filesystem::path to = options.to;
  const std::filesystem::path from = options.from;
  const Mpcdi mpcdi = read_mpcdi(from);
  for (const std::string& what : mpcdi.left_out) {
    print_note("{}: skipped {}", from.string(), what);
  }
  const std::filesystem::path folder = kind_of(to) == FileKind::folder ? from.parent_path() : to.parent_path();
  const std::filesystem::path beside = folder.empty() ? "." : folder;
  DomeSetup setup = setup_from_mpcdi(mpcdi, std::filesystem::relative(from, beside).string(), options.radius_m);
  setup.folder = beside;
  if (kind_of(to) == FileKind::folder) {
    return convert_setup(options, setup);
  }
  write_dome_setup(to, setup);
  const bool flat = mpcdi.profile == MpcdiProfile::media_2d;
  print_out(
      "written to {}; MPCDI does not contain the dome's radius (assumed: {:g} m), the viewer's position or the dome's "
      "tilt: {}\n",
      to.string(), options.radius_m,
      flat ? "shows are correct without them; set tilt_deg to make test patterns level (rotation_deg is already in the "
             "warps)"
           : "if y is vertical in the positions in the file, set tilt_deg; if y is the axis of the tilted dome, as in "
             "files from Ergodome, keep tilt_deg and rotation_deg at 0: shows are then correct, but test patterns are "
             "level only if the dome has no tilt");
}

//! Returns columns and rows of the map made from a mesh.
std::pair<int, int> map_size(const ConvertOptions& options, const WarpMesh& mesh) {
  if (options.size != own_size) {
    return options.size;
  }
  if (mesh.topology == MeshTopology::rectangular) {
    return {mesh.columns, mesh.rows};
  }
  // Triangle and polar meshes have no columns and rows, so the map gets 720 samples on its shorter
  // side. A map shows nothing beyond its outermost valid samples: with 720 rows, a circle as high
  // as the raster loses about 0.3 % of its area at the edge.
  constexpr double shorter_side = 720.0;
  const auto side = [](double samples) {
    return static_cast<int>(std::lround(std::min(samples, static_cast<double>(max_mesh_side))));
  };
  return {side(shorter_side * std::max(options.aspect, 1.0)), side(shorter_side * std::max(1.0 / options.aspect, 1.0))};
}

//! Prints a note if a mesh has intensities, which a map cannot store.
void report_lost_intensities(const ConvertOptions& options, const WarpMesh& mesh) {
  float minimum = 1.0F;
  float maximum = 1.0F;
  for (const WarpNode& node : mesh.nodes) {
    minimum = node.valid ? std::min(minimum, node.intensity) : minimum;
    maximum = node.valid ? std::max(maximum, node.intensity) : maximum;
  }
  if (minimum < 1.0F || maximum > 1.0F) {
    print_note(
        "{}: a .pfm file stores no intensities, but {} contains some from {:.3g} to {:.3g}; to keep them, use "
        "{} as a warp in a dome setup and convert that to MPCDI or a folder",
        options.to, options.from, minimum, maximum, options.from);
  }
}

void write_map(const ConvertOptions& options, const WarpMesh& mesh) {
  const auto [columns, rows] = map_size(options, mesh);
  check_mesh_size(columns, rows, "--size");
  const FloatMap map = map_from_warp(mesh, columns, rows, TextureDirection::downwards);
  write_text_atomically(options.to, to_float_map_file(map, RowOrder::bottom_up));
  const bool chosen = options.size == own_size && mesh.topology != MeshTopology::rectangular;
  print_out(
      "written to {}{}\n", options.to,
      chosen
          ? fmt::format(", with {} x {} samples, because {} mesh has no raster of its own; --size chooses another size",
                        columns, rows, mesh.topology == MeshTopology::polar ? "a polar" : "this")
          : "");
  report_lost_intensities(options, mesh);
}

FloatMap read_map(const std::filesystem::path& file) {
  FloatMap map = read_float_map(file, RowOrder::bottom_up);
  const std::size_t samples = map.samples.size() / 3;
  if (const std::size_t unknown = samples - known_samples(map); unknown > 0) {
    print_note("{}: {} of {} samples are not finite; nothing is drawn there", file.string(), unknown, samples);
  }
  return map;
}

//! Reads a warp of another program. If the file is for a perspective view, converts the warp to one
//! for the domemaster.
WarpMesh read_foreign(const std::filesystem::path& file) {
  ForeignWarp warp = read_foreign_warp(file, warp_format_of(file).value());
  for (const std::string& note : warp.notes) {
    print_note("{}: {}", file.string(), note);
  }
  if (!warp.view) {
    return std::move(warp.mesh);
  }
  print_note(
      "{}: is for a view at {}; the converted mesh is for a domemaster in a dome without tilt; for a tilted dome, use "
      "the file as a warp in a setup with tilt_deg and convert that to a folder",
      file.string(), words_of(*warp.view));
  return through_lens(0.0, warp.mesh, warp.view->orientation, warp.view->frustum);
}

WarpMesh read_warp_mesh(const ConvertOptions& options) {
  const std::filesystem::path from = options.from;
  switch (kind_of_source(from)) {
    case FileKind::bourke:
      return read_bourke_mesh(from, options.aspect);
    case FileKind::foreign:
      return read_foreign(from);
    default:
      return with_rim(warp_from_map(read_map(from), TextureDirection::downwards));
  }
}

void convert_mesh(const ConvertOptions& options) {
  const WarpMesh mesh = read_warp_mesh(options);
  if (kind_of(options.to) == FileKind::map) {
    return write_map(options, mesh);
  }
  write_text_atomically(options.to, to_bourke_mesh(mesh, options.aspect));
  print_out("written to {}\n", options.to);
}

void run(const ConvertOptions& options) {
  const FileKind from = kind_of_source(options.from);
  const FileKind to = kind_of(options.to);
  (to == FileKind::folder ? require_other_file : require_output_file)("TO", options.to, {options.from});
  if (from == FileKind::setup && (to == FileKind::mpcdi || to == FileKind::folder)) {
    return convert_setup(options, read_dome_setup(options.from));
  }
  if (from == FileKind::mpcdi && (to == FileKind::setup || to == FileKind::folder)) {
    return convert_mpcdi(options);
  }
  const auto is_mesh = [](FileKind kind) { return kind == FileKind::bourke || kind == FileKind::map; };
  if ((is_mesh(from) || from == FileKind::foreign) && is_mesh(to)) {
    return convert_mesh(options);
  }
  throw UsageError("convert", fmt::format("cannot make \"{}\" from \"{}\"", options.to, options.from),
                   "convert a setup (.toml) to .mpcdi or a folder, MPCDI (.mpcdi, .xml) to a setup or a folder, "
                   "or a warp (.data, .pfm, .csv, .obj, .sgc, .ol, .simcad, .txt) to .data or .pfm");
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  auto* command =
      app.add_subcommand("convert", "Convert dome setups, MPCDI calibrations and warp meshes to each other");
  command
      ->add_option(
          "from", options->from,
          "dome setup (.toml), MPCDI (.mpcdi, .xml), or warp (.data, .pfm, .csv, .obj, .sgc, .ol, .simcad, .txt)")
      ->required();
  command
      ->add_option("to", options->to,
                   "from a setup: .mpcdi, or a folder for Bourke meshes and masks; from MPCDI: a setup or such a "
                   "folder; from a warp: .data or .pfm")
      ->required();
  command->add_option("--radius", options->radius_m, "radius of the dome [m], which MPCDI does not contain")
      ->check(number_between(0.1, 1000.0))
      ->capture_default_str();
  command->add_option("--aspect", options->aspect, "width over height of the raster of a .data mesh")
      ->check(number_between(0.01, 100.0))
      ->capture_default_str();
  command
      ->add_option("--size", options->size,
                   "columns and rows of a .pfm (default: the mesh's own; for polar meshes and triangles, 720 on the "
                   "shorter side)")
      ->delimiter('x')
      ->check(CLI::Range(2, 16384))
      ->type_name("WxH");
  IgnoredOptions ignored(*command);
  ignored.add("unless FROM is an MPCDI file", [options] { return kind_of_source(options->from) != FileKind::mpcdi; },
              {"--radius"});
  ignored.add("unless FROM or TO is a .data mesh",
              [options] {
                return kind_of_source(options->from) != FileKind::bourke && kind_of(options->to) != FileKind::bourke;
              },
              {"--aspect"});
  ignored.add("unless TO is a .pfm file", [options] { return kind_of(options->to) != FileKind::map; }, {"--size"});
  command->callback([options, ignored] {
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
