#include "app/commands/farm/film_bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/usage_error.h"
#include "app/commands/bake_settings.h"
#include "app/commands/farm/farm_folder.h"
#include "app/commands/render/render_request.h"
#include "content/files/fingerprint.h"
#include "content/show/animatable_number.h"
#include "content/show/animated_show.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Number of frames for each part of a bake, and the maximum number of parts that is chosen.
constexpr int frames_of_part = 300;
constexpr int max_chosen_parts = 16;

//! Returns why a film is not baked, or an empty text if it can be.
std::string reason_against_bake(const RenderOptions& options, const Show& show) {
  std::error_code problem;
  if (!options.budget.empty()) {
    return "--budget measures settings, which needs the finished trajectory";
  }
  if (options.lens.lens == "live" || options.lens.lens == "direct") {
    return "--lens " + options.lens.lens + " uses no trajectory";
  }
  if (!options.lens.trajectory.empty()) {
    return "--trajectory names a trajectory";
  }
  if (fs::exists(fs::path(show.folder) / (show.name + ".trajectory"), problem)) {
    return "the show has a trajectory beside it";
  }
  if (!options.projection.empty() || !options.setup.empty()) {
    return "bake takes the projection from the show";
  }
  if (find_animation(show, "hole.spin") != nullptr) {
    return "the spin changes with time (hole.spin)";
  }
  if (show.grid_scheme != GridScheme::conforming) {
    return "grid.scheme of the show is only for comparisons";
  }
  if (show.stereo.model == StereoModel::omni && show.stereo.layout != StereoLayout::mono) {
    return "the stereo model omni uses no trajectory";
  }
  return "";
}

//! Returns a fingerprint of all that a trajectory depends on.
std::string bake_fingerprint(const Show& show, const BakeSettings& settings) {
  const Bytes bytes = to_bytes(provenance_of(show, settings));
  return fingerprint({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

std::optional<FilmBake> film_bake(const FarmOptions& options, const Show& show, int frames) {
  if (options.bake_parts == 0) {
    return std::nullopt;
  }
  const std::string reason = reason_against_bake(options.render, show);
  if (!reason.empty() && options.bake_parts > 0) {
    throw UsageError(fmt::format("--bake {}", options.bake_parts), "is not possible: " + reason,
                     "leave it out, or bake the show first with ergodome bake");
  }
  const bool moves = show.camera.keys.size() > 1 || show.camera.fall;
  if (!reason.empty() || (options.bake_parts < 0 && !moves)) {
    return std::nullopt;
  }
  // The same show as `bake` loads: it does not have the options for pictures.
  RenderOptions of_bake;
  of_bake.show = options.render.show;
  of_bake.set = options.render.set;
  const std::string state =
      bake_fingerprint(chosen_show(of_bake), bake_settings(chosen_show(of_bake), options.render.size_px, 0.0));
  FilmBake bake;
  bake.trajectory = FarmFolder(options.render.out).path() / fmt::format("{}-{}.trajectory", show.name, state);
  bake.parts = options.bake_parts > 0 ? options.bake_parts
                                      : std::clamp((frames + frames_of_part - 1) / frames_of_part, 1, max_chosen_parts);
  bake.words = {"bake", options.render.show, "--out=" + bake.trajectory.string()};
  for (const std::string& setting : options.render.set) {
    bake.words.push_back("--set=" + setting);
  }
  if (options.render.size_px > 0) {
    bake.words.push_back(fmt::format("--size={}", options.render.size_px));
  }
  return bake;
}

}  // namespace ergodome
