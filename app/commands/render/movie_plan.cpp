#include "app/commands/render/movie_plan.h"

#include <fmt/format.h>

#include "app/cli/lens_options.h"
#include "app/cli/usage_error.h"
#include "app/commands/movie/movie.h"
#include "kernels/core/error.h"
#include "render/output/frame_files.h"

namespace ergodome {

void require_movie(const RenderOptions& options, const Show& show) {
  if (options.movie.empty()) {
    return;
  }
  const std::string named = "--movie " + options.movie;
  if (options.format == "exr") {
    throw UsageError(named, "cannot be made from EXR frames", "choose --format png, png16 or tiff");
  }
  if (!options.setup.empty()) {
    throw UsageError(named, "cannot be made from projector frames", "leave out --setup");
  }
  if (has_face_files(show.view)) {
    throw Error(named, "cannot be made from separate cube faces", "set cube_layout = \"cross\" in the show");
  }
  if (show.stereo.layout == StereoLayout::rows && movie_ending(options.movie) == ".mp4") {
    throw UsageError(named, "stores one color for two rows, which mixes the eyes of stereo layout rows",
                     "choose .mov or .mkv");
  }
  if (options.alpha && !holds_alpha(movie_ending(options.movie))) {
    throw UsageError(named, "cannot store an alpha channel", "choose .mov or .mkv, or leave out --alpha");
  }
  for (const FramePart part : movie_parts(show)) {
    require_movie_encoder(movie_path(options.movie, part));
  }
}

void report_movie_losses(const RenderOptions& options, const Show& show) {
  const StereoLayout layout = show.stereo.layout;
  const bool by_colour = layout == StereoLayout::anaglyph || layout == StereoLayout::dubois || show.stereo.tint_eyes;
  if (!options.movie.empty() && by_colour && movie_ending(options.movie) == ".mp4") {
    print_note_once(fmt::format(
        "{} stores color at half resolution, which blurs one eye's image in this stereo mode; .mov and .mkv do not",
        options.movie));
  }
  if (!options.movie.empty() && show.view.projection == ViewProjection::equirect && !spherical_film(show)) {
    print_note_once(fmt::format(
        "{} gets no metadata for VR headsets, which describe neither mirror images, nor the right eye first, nor rows "
        "of both eyes",
        options.movie));
  }
}

std::filesystem::path movie_path(const std::filesystem::path& file, FramePart part) {
  const std::string eye = eye_folder(part).string();
  return file.parent_path() / (file.stem().string() + (eye.empty() ? "" : "_" + eye) + file.extension().string());
}

std::vector<FramePart> movie_parts(const Show& show) {
  return show.stereo.layout == StereoLayout::separate ? std::vector<FramePart>{FramePart::left, FramePart::right}
                                                      : std::vector<FramePart>{FramePart::whole};
}

}  // namespace ergodome
