#include "app/cli/setup_show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "app/cli/usage_error.h"
#include "content/files/atomic_file.h"
#include "content/show/stereo_eyes.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "render/eyes/view_projection.h"
#include "render/output/frame_files.h"
#include "render/output/image_writer.h"
#include "render/output/tone_map.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

namespace {

//! Converts a position to axes that are tilted to the front by an angle [deg].
Vector3<double> leaned(const Vector3<double>& position, double angle_deg) {
  const double cosine = std::cos(angle_deg * one_degree);
  const double sine = std::sin(angle_deg * one_degree);
  return {position.x, cosine * position.y + sine * position.z, cosine * position.z - sine * position.y};
}

//! Returns the position of the setup's viewer in radii of the dome, in the axes of the picture,
//! which is rotated by the setup's rotation_deg and tilted by `tilt_deg`.
Vector3<double> viewer_of(const DomeSetup& setup, double tilt_deg) {
  // The viewer is fixed in the dome, and the picture rotates to the right about the dome's axis.
  const Vector3<double> own = leaned((1.0 / setup.radius_m) * setup.viewer_m, -setup.tilt_deg);
  const double cosine = std::cos(setup.rotation_deg * one_degree);
  const double sine = std::sin(setup.rotation_deg * one_degree);
  return leaned({cosine * own.x + sine * own.z, own.y, cosine * own.z - sine * own.x}, tilt_deg);
}

}  // namespace

void fit_to_setup(Show& show, const DomeSetup& setup, const std::string& stereo) {
  if (show.stereo.layout != StereoLayout::mono && show.stereo.layout != StereoLayout::separate) {
    constexpr const char* problem = "puts both eyes into one picture, which projectors cannot separate";
    if (!stereo.empty()) {
      throw UsageError("--stereo " + stereo, problem, "choose mono, or separate for one file per eye");
    }
    throw Error(show.name + ".toml", problem, "add --stereo mono, or --stereo separate for one file per eye");
  }
  ViewSettings view;
  view.size_px = show.view.size_px;
  view.artistic_tilt = show.view.artistic_tilt;
  view.tilt_deg = setup.tilt_known && !view.artistic_tilt ? setup.tilt_deg : show.view.tilt_deg;
  view.viewer = viewer_of(setup, view.tilt_deg);
  show.view = view;
  // Projectors do not move, so the view must not change.
  std::erase_if(show.timeline.animations, [](const Animation& each) { return each.path.starts_with("view."); });
}

void fit_to_headset(Show& show) {
  ViewSettings view;
  view.projection = ViewProjection::cube;
  view.cube_files = CubeFiles::strip;
  view.field_of_view_deg = usual_field_of_view_deg(view.projection);
  view.size_px = show.view.size_px;
  show.view = view;
  const std::optional<StereoModel> model = stereo_model(show.headset.stereo);
  const double comfort_deg = show.stereo.comfort_deg;
  show.stereo = {};
  show.stereo.comfort_deg = comfort_deg;
  show.stereo.layout = model ? StereoLayout::separate : StereoLayout::mono;
  show.stereo.model = model.value_or(show.stereo.model);
  std::erase_if(show.timeline.animations, [](const Animation& each) {
    return each.path.starts_with("view.") || each.path.starts_with("stereo.");
  });
}

std::vector<std::string> plain_names(const DomeSetup& setup) {
  std::vector<std::string> names;
  for (const ProjectorSetup& projector : setup.projectors) {
    std::string plain;
    for (const char c : projector.name) {
      plain += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    }
    const bool taken = std::ranges::find(names, plain) != names.end();
    names.push_back(taken ? fmt::format("{}_{}", plain, names.size() + 1) : plain);
  }
  return names;
}

ProjectorFrames::ProjectorFrames(const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures,
                                 ProjectorDrawer drawer)
    : projectors_(pictures, drawer) {
  const std::vector<std::string> names = plain_names(setup);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    rasters_.push_back({names[i], pictures[i].width_px, pictures[i].height_px});
  }
}

std::filesystem::path ProjectorFrames::path_of(const std::filesystem::path& frame, const Raster& raster) {
  std::filesystem::path path = frame;
  path.replace_filename(fmt::format("{}_{}.png", frame.stem().string(), raster.name));
  return path;
}

void ProjectorFrames::write(const std::filesystem::path& frame, const Picture& master, const FrameMetadata& metadata) {
  projectors_.show(master);
  for (std::size_t i = 0; i < rasters_.size(); ++i) {
    write_png(path_of(frame, rasters_[i]), projectors_.frame(i), rasters_[i].width_px, rasters_[i].height_px, metadata);
  }
}

PatternView upright_master(const DomeSetup& setup, int size_px) {
  Show show;
  show.view.tilt_deg = setup.tilt_deg;
  // Patterns are evaluated in the rotated picture, in which the viewer's position is that of an
  // unrotated setup.
  DomeSetup unturned = setup;
  unturned.rotation_deg = 0.0;
  fit_to_setup(show, unturned);
  return {make_projection(show.view, size_px, 0.0), one_degree * setup.rotation_deg};
}

int write_pattern_frames(const ProjectedPatterns& asked, const DomeSetup& setup) {
  const std::vector<ProjectorPicture> pictures = projector_pictures(setup);
  ProjectorFrames frames(setup, pictures);
  const PatternView master = upright_master(setup, asked.size_px > 0 ? asked.size_px : enough_master_px(pictures));
  const bool all = asked.pattern == "all";
  const std::vector<std::string> patterns = all ? test_pattern_names() : std::vector<std::string>{asked.pattern};
  const std::vector<FramePart> parts = asked.layout == StereoLayout::separate
                                           ? std::vector<FramePart>{FramePart::left, FramePart::right}
                                           : std::vector<FramePart>{FramePart::whole};
  for (const FramePart part : parts) {
    const std::filesystem::path folder = asked.out / eye_folder(part);
    make_folder(folder);
    for (const std::string& name : patterns) {
      frames.write(folder / (name + ".png"), draw_test_pattern(test_pattern(name), master, part));
    }
  }
  const std::vector<std::string> names = plain_names(setup);
  for (std::size_t i = 0; all && i < names.size(); ++i) {
    const ProjectorPicture& raster = pictures[i];
    const Picture page = draw_projector_number(static_cast<int>(i) + 1, raster.name, raster.width_px, raster.height_px);
    write_png(asked.out / fmt::format("number_{}.png", names[i]), tone_mapped(page), raster.width_px, raster.height_px);
  }
  return static_cast<int>(names.size() * (parts.size() * patterns.size() + (all ? 1 : 0)));
}

std::uintmax_t ProjectorFrames::pixels() const {
  std::uintmax_t all = 0;
  for (const Raster& raster : rasters_) {
    all += static_cast<std::uintmax_t>(raster.width_px) * static_cast<std::uintmax_t>(raster.height_px);
  }
  return all;
}

std::vector<std::filesystem::path> ProjectorFrames::paths_of(const std::filesystem::path& frame) const {
  std::vector<std::filesystem::path> paths;
  paths.reserve(rasters_.size());
  for (const Raster& raster : rasters_) {
    paths.push_back(path_of(frame, raster));
  }
  return paths;
}

bool ProjectorFrames::are_there(const std::filesystem::path& frame, const std::string& request) const {
  return std::ranges::all_of(rasters_, [&](const Raster& raster) {
    const std::filesystem::path path = path_of(frame, raster);
    return metadata_of_image(path, "request") == request && is_complete_image(path, raster.width_px, raster.height_px);
  });
}

}  // namespace ergodome
