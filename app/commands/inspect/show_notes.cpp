#include "app/commands/inspect/show_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <string>

#include "app/playback/sound/audio_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/mesh/formats/mesh_reader.h"
#include "content/show/animated_show.h"
#include "content/show/reading/show_files.h"
#include "content/show/show_errors.h"
#include "content/sky/environment_image.h"
#include "content/stars/star_catalogue.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/objects/object_horizon.h"
#include "render/passes/objects/object_meshes.h"
#include "render/passes/overlay/caption_notes.h"
#include "render/passes/overlay/overlay_image.h"

namespace ergodome {

namespace {

bool is_opaque(const OverlayImage& image) {
  const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < texels; ++i) {
    if (image.texels[4 * i + 3] != std::numeric_limits<std::uint16_t>::max()) {
      return false;
    }
  }
  return true;
}

Vector3<double> extent_of(const TriangleMesh& mesh) {
  std::array<double, 3> minimum;
  std::array<double, 3> maximum;
  minimum.fill(std::numeric_limits<double>::infinity());
  maximum.fill(-std::numeric_limits<double>::infinity());
  for (const std::uint32_t index : mesh.indices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto position = static_cast<double>(mesh.vertices[index].position[axis]);
      minimum.at(axis) = std::min(minimum.at(axis), position);
      maximum.at(axis) = std::max(maximum.at(axis), position);
    }
  }
  return {maximum[0] - minimum[0], maximum[1] - minimum[1], maximum[2] - minimum[2]};
}

namespace fs = std::filesystem;

void take_stars(const Show& show, ShowNotes& notes) {
  const StarCatalogue catalogue = load_stars(show);
  notes.stars = catalogue.stars.size();
  notes.left_out = catalogue.left_out;
  notes.stars_read_as = catalogue.read_as;
  if (catalogue.stars.empty()) {
    notes.unseen.push_back(note_of_no_stars(show));
  }
}

//! Reads a file as the show's frames need it, by the kind of its key, and adds findings to `notes`.
//! Throws Error if it cannot be used.
void read_as_shown(const Show& show, const NamedFile& file, ShowNotes& notes) {
  if (file.key == "sky.stars") {
    take_stars(show, notes);
    return;
  }
  read_named(show, file.key, file.name, [&](const fs::path& path) {
    if (file.key == "sky.map" || file.key.ends_with(".texture")) {
      const RepairedTexels repaired =
          read_environment_image(path.string() + (file.layer.empty() ? "" : "#" + file.layer)).repaired;
      if (repaired.are_a_mistake()) {
        notes.repaired.push_back(note_of_repair(show, file.key, file.name, repaired));
      }
    } else if (file.key.ends_with(".pattern")) {
      static_cast<void>(load_diffraction_pattern(path));
    } else if (file.key.ends_with(".mesh")) {
      notes.meshes.push_back(summary_of_mesh(file.name, read_mesh(path)));
    } else if (file.key.ends_with(".image")) {
      static_cast<void>(read_overlay_image(path));
    }
    return 0;
  });
}

//! Reads a file, adds findings to `notes`, and returns why it cannot be used; empty if it can.
std::string problem_of(const Show& show, const NamedFile& file, ShowNotes& notes) {
  if (file.key.starts_with("audio")) {
    return sound_problem(fs::path(show.folder) / file.name);
  }
  try {
    read_as_shown(show, file, notes);
  } catch (const Error& problem) {
    return problem.what();
  }
  return "";
}

//! Adds notes about objects inside the horizon. Does nothing if a mesh is missing or could not be
//! read.
void add_objects_in_horizon(const Show& show, ShowNotes& notes) {
  const bool readable = std::ranges::all_of(
      show.objects, [&](const ObjectSettings& object) { return object.mesh.empty() || is_there(show, object.mesh); });
  const bool sound =
      std::ranges::none_of(notes.unusable, [](const auto& each) { return each.first.ends_with(".mesh"); });
  if (show.objects.empty() || !readable || !sound) {
    return;
  }
  try {
    for (const ObjectInHorizon& inside : objects_in_horizon(show, load_meshes(show))) {
      notes.unseen.push_back(note_of(show, inside));
    }
  } catch (const Error& problem) {
    notes.unseen.emplace_back(problem.what());
  }
}

//! Adds a note for the first sampled time at which the convergence distance is smaller than the
//! baseline.
void add_crossed_eyes(const Show& show, ShowNotes& notes) {
  constexpr int times = 33;
  for (int i = 0; i < times && eye_count(show.stereo) > 1; ++i) {
    const double time_s = show.duration_s * i / (times - 1);
    const StereoSettings stereo = show_at(show, time_s).stereo;
    if (stereo.convergence > 0.0 && stereo.convergence < stereo.baseline) {
      const Error note("stereo.convergence",
                       fmt::format("at {:.6g} s the baseline is {:.4g} M but the convergence distance only {:.4g} M, "
                                   "so the eyes' images differ by {:.0f} degrees",
                                   time_s, stereo.baseline, stereo.convergence,
                                   2.0 * std::atan2(0.5 * stereo.baseline, stereo.convergence) / one_degree),
                       "set a convergence distance of at least a few baselines");
      notes.unseen.emplace_back(
          show.lines.contains("stereo.convergence") ? named_by(show, "stereo.convergence", note).what() : note.what());
      return;
    }
  }
}

}  // namespace

MeshSummary summary_of_mesh(const std::string& file, const TriangleMesh& mesh) {
  MeshSummary summary = {file, mesh.triangle_count(), mesh.dropped_triangles, extent_of(mesh), mesh.remarks};
  std::map<std::string, bool> opaque;
  for (const MeshPart& part : mesh.parts) {
    if (!part.image.empty() && part.image_alpha_counts && !opaque.contains(part.image.name)) {
      opaque[part.image.name] = is_opaque(read_mesh_image(part.image));
    }
  }
  for (const auto& [image, is] : opaque) {
    if (!is) {
      summary.remarks.push_back(fmt::format("has a texture with transparent areas ({}), which are drawn opaque",
                                            std::filesystem::path(image).filename().string()));
    }
  }
  return summary;
}

nlohmann::json summary_of_meshes(const Show& show, const std::vector<MeshSummary>& meshes) {
  nlohmann::json summary = nlohmann::json::array();
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    const ObjectSettings& object = show.objects[i];
    const auto mesh = std::ranges::find(meshes, object.mesh, &MeshSummary::file);
    if (object.form == ObjectForm::mesh && mesh != meshes.end()) {
      const Vector3<double> extent = object.size * mesh->extent;
      summary.push_back({{"key", fmt::format("objects[{}].mesh", i)},
                         {"file", mesh->file},
                         {"triangles", mesh->triangles},
                         {"without_area", mesh->dropped_triangles},
                         {"extent_M", {extent.x, extent.y, extent.z}},
                         {"remarks", mesh->remarks}});
    }
  }
  return summary;
}

void print_meshes(const nlohmann::json& summary) {
  if (!summary.empty()) {
    print_out("\nmeshes\n");
  }
  for (const nlohmann::json& mesh : summary) {
    const long dropped = mesh["without_area"].get<long>();
    const auto& extent = mesh["extent_M"];
    print_out("  {:<40} {}, {}{:.6g} x {:.6g} x {:.6g} M before rotation\n", mesh["file"].get<std::string>(),
              counted(mesh["triangles"].get<long>(), "triangle"),
              dropped > 0 ? fmt::format("{} without area omitted, ", dropped) : "", extent[0].get<double>(),
              extent[1].get<double>(), extent[2].get<double>());
    for (const auto& remark : mesh["remarks"]) {
      print_out("    {}\n", remark.get<std::string>());
    }
  }
}

ShowNotes notes_of_files(const Show& show) {
  ShowNotes notes;
  if (is_built_in_catalogue(show.sky.stars)) {
    try {
      take_stars(show, notes);
    } catch (const Error& problem) {
      notes.unusable["sky.stars"] = problem.what();
    }
  }
  // A file that several keys of the same kind name is read once.
  std::map<std::string, std::string> known;
  for (const NamedFile& file : files_of_show(show)) {
    if (!is_there(show, file.name)) {
      continue;
    }
    const std::string use = file.key.substr(file.key.rfind('.')) + " " + file.name;
    const auto found = known.find(use);
    const std::string problem = found != known.end() ? found->second : problem_of(show, file, notes);
    known[use] = problem;
    if (!problem.empty()) {
      notes.unusable[file.key] = problem;
    }
  }
  add_objects_in_horizon(show, notes);
  std::ranges::copy(notes_of_captions(show), std::back_inserter(notes.unseen));
  add_crossed_eyes(show, notes);
  return notes;
}

nlohmann::json summary_of_stars(const Show& show, const ShowNotes& notes) {
  nlohmann::json summary = {
      {"catalogue", show.sky.stars}, {"count", notes.stars.value_or(0)}, {"left_out", nlohmann::json::array()}};
  for (const RowsLeftOut& rows : notes.left_out) {
    summary["left_out"].push_back({{"why", rows.why}, {"rows", rows.count}, {"first_line", rows.first_line}});
  }
  if (!notes.left_out.empty()) {
    summary["text"] = text_of(notes.left_out);
  }
  if (!notes.stars_read_as.empty()) {
    summary["read_as"] = notes.stars_read_as;
  }
  return summary;
}

void print_stars(const nlohmann::json& summary) {
  print_out("{:<16}{}: {}{}\n", "stars", summary["catalogue"].get<std::string>(),
            counted(summary["count"].get<std::size_t>(), "star"),
            summary.contains("text") ? ", " + summary["text"].get<std::string>() : "");
  if (summary.contains("read_as")) {
    print_out("{:<16}read as {}\n", "", summary["read_as"].get<std::string>());
  }
}

}  // namespace ergodome
