#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/backend_choice.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/lens_options.h"
#include "app/movie.h"
#include "app/pattern_frames.h"
#include "app/progress.h"
#include "app/sequence_facts.h"
#include "app/setup_show.h"
#include "app/show_loading.h"
#include "content/files/atomic_file.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"
#include "render/output/color_bar.h"
#include "render/output/frame_names.h"
#include "render/output/image_writer.h"
#include "render/output/stereo_layout.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

namespace {

struct RenderOptions {
  std::string show;
  std::string out = "frames";
  std::string frames;
  int size_px = 0;
  std::string projection;
  std::string stereo;
  bool tint_eyes = false;
  bool from_outside = false;
  std::string backend = "auto";
  std::string format = "png";
  std::string compression;
  bool alpha = false;
  double frame_rate_hz = 0.0;
  std::string movie;
  std::string view = "sky";
  std::string setup;
  LensOptions lens;
  bool resume = false;
  std::string pattern;
};

//! First and last frame, counted from 0, of "A:B", "A:" , ":B" or "A", which count from 1.
std::pair<int, int> frame_range(const std::string& text, int count) {
  if (text.empty()) {
    return {0, count - 1};
  }
  const auto number = [&](const std::string& part, int otherwise) {
    if (part.empty()) {
      return otherwise;
    }
    std::size_t used = 0;
    int value = 0;
    try {
      value = std::stoi(part, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != part.size() || value < 1 || value > count) {
      throw Error("--frames " + text, fmt::format("\"{}\" is not a frame of this show", part),
                  fmt::format("choose from 1:{}", count));
    }
    return value;
  };
  const std::size_t colon = text.find(':');
  const int first = number(text.substr(0, colon), 1);
  const int last = colon == std::string::npos ? first : number(text.substr(colon + 1), count);
  if (last < first) {
    throw Error("--frames " + text, "ends before it begins", "write FIRST:LAST");
  }
  return {first - 1, last - 1};
}

FrameMetadata metadata_of(const Show& show, double time_s, FramePart part, std::optional<CubeFace> face) {
  constexpr const char* observers[] = {"zamo", "static", "geodesic", "retrograde", "rain", "velocity"};
  constexpr const char* parts[] = {"whole", "left", "right"};
  const CameraPose pose = camera_pose(show, time_s);
  return {{"show", show.title},
          {"time_s", fmt::format("{:.6f}", time_s)},
          {"spin", fmt::format("{:.12g}", show.spin)},
          {"r", fmt::format("{:.12g}", pose.r)},
          {"theta_deg", fmt::format("{:.12g}", pose.theta * 180.0 / 3.14159265358979323846)},
          {"observer", observers[static_cast<int>(show.camera.motion)]},
          {"projection", projection_names()[static_cast<std::size_t>(show.view.projection)]},
          {"from_outside", show.view.from_outside ? "true" : "false"},
          {"part", parts[static_cast<int>(part)]},
          {"face", face ? cube_face_name(*face) : "none"},
          {"stereo", stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)]},
          {"version", ERGODOME_VERSION}};
}

FrameFormat format_of(const RenderOptions& options) {
  return frame_format(options.format, options.compression, options.alpha);
}

//! Renders and writes the frames of one run.
class FrameWriter {
 public:
  //! `setup`: the dome whose projectors' frames are written instead of the master's.
  FrameWriter(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup)
      : options_(options),
        format_(format_of(options)),
        choice_{view_mode(options.view), options.size_px},
        backend_(choose_backend(options.backend)),
        renderer_(show, backend_, lens_choice(options.lens), open_stream(show, options.lens, backend_)) {
    if (setup) {
      const std::vector<ProjectorPicture> pictures = projector_pictures(*setup);
      projectors_.emplace(*setup, pictures);
      choice_.size_px = choice_.size_px > 0 ? choice_.size_px : enough_master_px(pictures);
      fmt::print("domemasters of {} pixels for {} projectors\n", choice_.size_px, pictures.size());
    }
  }

  void write(int frame) {
    const Show& show = renderer_.show();
    if (options_.resume && is_there(frame)) {
      return;
    }
    const double time_s = frame_time_s(show, frame);
    std::vector<FrameImage> images = renderer_.render(time_s, choice_);
    for (FrameImage& image : images) {
      draw_color_bar(image.picture, choice_.mode);
      unresolved_ += image.picture.unresolved_pixels;
    }
    const bool views = show.stereo.layout == StereoLayout::multiview;
    for (std::size_t i = 0; i < images.size(); i += views ? 2 : 1) {
      const FrameImage& image = images[i];
      const FramePart part = views ? FramePart::whole : image.part;
      const std::filesystem::path path = path_of(frame, part, image.face);
      make_folder(path.parent_path());
      const FrameMetadata metadata = metadata_of(show, time_s, part, image.face);
      if (projectors_) {
        projectors_->write(path, image.picture);
      } else if (views) {
        write_views(path, format_, image.picture, images[i + 1].picture, metadata);
      } else {
        write_picture(path, format_, image.picture, metadata);
      }
    }
    ++written_;
  }

  //! Puts the frames first to last together as films: one, or one for each eye that has files of its own.
  void write_movies(int first, int last) const {
    const Show& show = renderer_.show();
    const std::filesystem::path file = options_.movie;
    const bool separate = show.stereo.layout == StereoLayout::separate;
    const std::vector<FramePart> parts =
        separate ? std::vector<FramePart>{FramePart::left, FramePart::right} : std::vector<FramePart>{FramePart::whole};
    for (const FramePart part : parts) {
      Movie movie;
      movie.file = file.parent_path() / (file.stem().string() + (separate ? "_" : "") + eye_folder(part).string() +
                                         file.extension().string());
      movie.frame_rate_hz = show.frame_rate_hz;
      for (int frame = first; frame <= last; ++frame) {
        movie.pictures.push_back(path_of(frame, part, std::nullopt));
      }
      write_movie(movie);
      fmt::print("written to {}\n", movie.file.string());
    }
  }

  void write_facts() const { write_sequence_facts(options_.out, renderer_.show(), format_, eye_width_px()); }

  [[nodiscard]] int written() const { return written_; }
  [[nodiscard]] std::optional<StreamStatistics> stream_statistics() const { return renderer_.stream_statistics(); }
  [[nodiscard]] long unresolved() const { return unresolved_; }

 private:
  [[nodiscard]] int eye_width_px() const {
    return choice_.size_px > 0 ? choice_.size_px : renderer_.show().view.size_px;
  }

  [[nodiscard]] std::filesystem::path path_of(int frame, FramePart part, std::optional<CubeFace> face) const {
    return std::filesystem::path(options_.out) / frame_path(renderer_.show().name, frame, frame_count(renderer_.show()),
                                                            part, file_ending(format_.image), face);
  }

  [[nodiscard]] bool is_there(int frame) const {
    const Show& show = renderer_.show();
    if (show.stereo.layout == StereoLayout::separate) {
      return is_there(frame, FramePart::left) && is_there(frame, FramePart::right);
    }
    return is_there(frame, FramePart::whole);
  }

  [[nodiscard]] bool is_there(int frame, FramePart part) const {
    const Show& show = renderer_.show();
    if (projectors_) {
      return projectors_->are_there(path_of(frame, part, std::nullopt));
    }
    const Projection eye = make_projection(show.view, eye_width_px(), 0.0);
    const bool faces = has_face_files(show.view);
    const ImageSize size =
        layout_size(show.stereo.layout, {faces ? eye.width_px / cube_faces : eye.width_px, eye.height_px});
    const int parts = show.stereo.layout == StereoLayout::multiview ? 2 : 1;
    const auto complete = [&](std::optional<CubeFace> face) {
      return is_complete_image(path_of(frame, part, face), size.width, size.height, parts);
    };
    if (!faces) {
      return complete(std::nullopt);
    }
    for (int face = 0; face < cube_faces; ++face) {
      if (!complete(static_cast<CubeFace>(face))) {
        return false;
      }
    }
    return true;
  }

  const RenderOptions& options_;
  FrameFormat format_;
  ViewChoice choice_;
  Backend backend_;
  ShowRenderer renderer_;
  std::optional<ProjectorFrames> projectors_;
  int written_ = 0;
  long unresolved_ = 0;
};

//! Whether files can hold what the layout makes.
void require_file_layout(const RenderOptions& options, const Show& show) {
  if (show.stereo.layout == StereoLayout::multiview && options.format != "exr") {
    throw Error("stereo layout multiview", "is two views in one EXR, which no other format holds", "add --format exr");
  }
  if (show.stereo.layout == StereoLayout::quad_buffer) {
    throw Error("stereo layout quad_buffer", "is for a window with two buffers; files have none",
                "choose another with --stereo, for instance side_by_side");
  }
}

//! The show, or for patterns without one a dome of 180°, with what the command line says instead.
Show chosen_show(const RenderOptions& options) {
  if (options.show.empty() && options.pattern.empty()) {
    throw Error("render", "needs a show, or --pattern", "name a show file or a built-in show");
  }
  Show show = options.show.empty() ? Show{} : load_show(options.show);
  override_view(show, options.projection, options.stereo);
  show.view.from_outside = show.view.from_outside || options.from_outside;
  show.stereo.tint_eyes = show.stereo.tint_eyes || options.tint_eyes;
  if (options.frame_rate_hz > 0.0) {
    show.frame_rate_hz = options.frame_rate_hz;
  }
  return show;
}

//! Throws Error where no film could be made of the frames, before any is rendered.
void require_movie(const RenderOptions& options, const Show& show) {
  if (options.movie.empty()) {
    return;
  }
  if (options.format == "exr") {
    throw Error("--movie " + options.movie, "is not made of linear light", "choose --format png, png16 or tiff");
  }
  if (has_face_files(show.view)) {
    throw Error("--movie " + options.movie, "is not made of a cube's single faces", "choose cube_layout = \"cross\"");
  }
  require_movie_encoder(options.movie);
}

//! The dome whose projectors' frames are asked for, if any are.
std::optional<DomeSetup> chosen_setup(const RenderOptions& options) {
  if (options.setup.empty()) {
    return std::nullopt;
  }
  if (options.format != "png" || options.alpha || !options.movie.empty()) {
    throw Error("--setup " + options.setup, "writes the 8 bits that projectors are sent, as PNG alone",
                "leave out --format, --alpha and --movie");
  }
  return read_dome_setup(options.setup);
}

void run(const RenderOptions& options) {
  Show show = chosen_show(options);
  const std::optional<DomeSetup> setup = chosen_setup(options);
  if (setup) {
    fit_to_setup(show, *setup);
  }
  if (!options.pattern.empty() && setup) {
    const int files = write_pattern_frames(options.pattern, *setup, options.size_px, options.out);
    fmt::print("{} files in {}\n", files, options.out);
    return;
  }
  if (!options.pattern.empty()) {
    const int files = write_pattern_frames({options.pattern, options.out, format_of(options), options.size_px}, show);
    fmt::print("{} files in {}\n", files, options.out);
    return;
  }
  require_features(show);
  require_file_layout(options, show);
  require_movie(options, show);
  const auto [first, last] = frame_range(options.frames, frame_count(show));
  make_folder(options.out);
  FrameWriter writer(options, show, setup);
  {
    Progress progress("rendering", last - first + 1);
    for (int frame = first; frame <= last; ++frame) {
      if (interrupted()) {
        throw Error("render", fmt::format("stopped after {} frames", writer.written()), "go on with --resume");
      }
      writer.write(frame);
      progress.advance_to(frame - first + 1);
    }
  }
  if (!setup) {
    writer.write_facts();
  }
  fmt::print("{} frames in {}\n", writer.written(), options.out);
  if (!options.movie.empty()) {
    writer.write_movies(first, last);
  }
  if (const auto streamed = writer.stream_statistics()) {
    print_statistics(*streamed);
  }
  if (writer.unresolved() > 0) {
    fmt::print(stderr, "ergodome: {} pixels did not converge and show the mean of the sky\n", writer.unresolved());
  }
}

//! What --pattern takes.
std::vector<std::string> pattern_choices() {
  std::vector<std::string> choices = test_pattern_names();
  choices.emplace_back("all");
  return choices;
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a show to numbered frames, without a display");
  command->add_option("show", options->show, "show file (.toml), or the name of a built-in show");
  command->add_option("--out", options->out, "folder for the frames")->capture_default_str();
  command->add_option("--frames", options->frames, "FIRST:LAST, counted from 1 (default: all)");
  command->add_option("--size", options->size_px, "width of one eye's image in pixels")->check(CLI::Range(1, 16384));
  command
      ->add_option("--projection", options->projection,
                   "dome, equirect, cube, cylinder or pinhole, instead of the show's")
      ->check(CLI::IsMember(projection_names()));
  command->add_flag("--from-outside", options->from_outside, "the mirror image: a dome as it is seen from outside");
  command->add_option("--stereo", options->stereo, "stereo layout, instead of the show's")
      ->check(CLI::IsMember(stereo_names()));
  command->add_flag("--tint-eyes", options->tint_eyes, "the left eye's picture reddish, the right one's cyan");
  command->add_option("--backend", options->backend, "auto, cpu or cuda")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->capture_default_str();
  command->add_option("--format", options->format, "png (8 bits), png16, tiff (16 bits) or exr (linear light)")
      ->check(CLI::IsMember(image_format_names()))
      ->capture_default_str();
  command->add_option("--compression", options->compression, "of EXR: zip (default), none, or dwaa, which is lossy")
      ->check(CLI::IsMember(exr_compression_names()));
  command->add_flag("--alpha", options->alpha, "a fourth channel: what the image covers, a dome's circle for instance");
  command->add_option("--fps", options->frame_rate_hz, "frames a second, instead of the show's")
      ->check(CLI::Range(0.1, 1000.0));
  command->add_option("--movie", options->movie, "puts the frames together with ffmpeg: FILE.mp4, .mov or .mkv");
  command->add_option("--view", options->view, "sky, or a heat map: steps, error, order, g, magnification")
      ->check(CLI::IsMember(view_mode_names()))
      ->capture_default_str();
  add_lens_options(*command, options->lens);
  command->add_option("--pattern", options->pattern, "a test pattern, or all of them, instead of the show's frames")
      ->check(CLI::IsMember(pattern_choices()));
  command->add_option("--setup", options->setup,
                      "dome setup (.toml): write what each of its projectors shows, as NAME_000001_PROJECTOR.png");
  command->add_flag("--resume", options->resume, "skip frames that are there and complete");
  command->callback([options] { run(*options); });
}

}  // namespace ergodome
