#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/commands/render/frame_range.h"
#include "content/camera/camera_path.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "render/diagram/diagram.h"
#include "render/diagram/diagram_picture.h"
#include "render/output/frame_files.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

struct DiagramOptions {
  std::string show;
  ShowSettings set;
  std::string out;
  double time_s = 0.0;
  std::string frames;
  std::string from;
  std::string size = "1280x720";
  std::string images;
  int rays = 24;
};

constexpr int min_diagram_px = 64;
constexpr int max_diagram_px = 8192;
//! Number of frames, evenly spaced over a film, in which the scene must fit into the picture.
constexpr int framed_moments = 9;

//! Parses a list of finite numbers separated by `between`. Returns an empty list if the text is
//! malformed.
std::vector<double> numbers_of(const std::string& text, char between) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(between, at), text.size());
    const std::string part = text.substr(at, end - at);
    std::size_t used = 0;
    try {
      numbers.push_back(std::stod(part, &used));
    } catch (const std::exception&) {
      used = 0;
    }
    if (part.empty() || used != part.size() || !std::isfinite(numbers.back())) {
      return {};
    }
    at = end + 1;
  }
  return numbers;
}

std::pair<int, int> size_of(const std::string& text) {
  const std::vector<double> sides = numbers_of(text, 'x');
  const auto fits = [](double side) {
    return side == std::floor(side) && side >= min_diagram_px && side <= max_diagram_px;
  };
  const double height = sides.size() == 2 ? sides[1] : sides.size() == 1 ? std::round(sides[0] * 9.0 / 16.0) : 0.0;
  if (sides.empty() || !fits(sides[0]) || !fits(height)) {
    throw UsageError(
        "--size " + text, "is not a picture size",
        fmt::format("write WIDTHxHEIGHT or a width, with sides of {} to {} pixels", min_diagram_px, max_diagram_px));
  }
  return {static_cast<int>(sides[0]), static_cast<int>(height)};
}

//! Parses the image orders of --images; removes duplicates and sorts. Throws UsageError if the list
//! is malformed or has other numbers than 1 to max_polygon_images.
std::vector<int> images_of(const std::string& text) {
  std::vector<int> images;
  if (text.empty()) {
    return images;
  }
  const std::vector<double> numbers = numbers_of(text, ',');
  for (const double number : numbers) {
    if (number == std::floor(number) && number >= 1.0 && number <= max_polygon_images) {
      images.push_back(static_cast<int>(number));
    }
  }
  if (numbers.empty() || images.size() != numbers.size()) {
    throw UsageError("--images " + text, "is not a list of image orders",
                     fmt::format("write numbers from 1 to {}, separated by commas", max_polygon_images));
  }
  std::ranges::sort(images);
  images.erase(std::unique(images.begin(), images.end()), images.end());
  return images;
}

//! Returns the direction of the diagram's camera from the hole. The default is 65 degrees to the
//! side of the observer and 24 above the equatorial plane, where the distance between observer and
//! hole is hardly foreshortened. Throws UsageError if --from is malformed.
OutsideDirection outside_direction_of(const DiagramOptions& options, const Show& show, double time_s) {
  constexpr double beside = 65.0 * one_degree;
  constexpr double above = 24.0 * one_degree;
  constexpr double nearest = 2.5;  // farther out than any horizon
  if (options.from.empty()) {
    return {camera_pose(show, time_s).phi - beside, above, std::nullopt};
  }
  const std::vector<double> numbers = numbers_of(options.from, ',');
  if (numbers.size() < 2 || numbers.size() > 3 || std::abs(numbers[1]) > 90.0 ||
      (numbers.size() == 3 && !(numbers[2] >= nearest && numbers[2] <= 1e7))) {
    throw UsageError(
        "--from " + options.from, "is not a camera position",
        fmt::format("write AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,DISTANCE: degrees (elevation -90 to 90), and a "
                    "distance of at least {} M",
                    nearest));
  }
  return {one_degree * numbers[0], one_degree * numbers[1],
          numbers.size() == 3 ? std::optional(numbers[2]) : std::nullopt};
}

void draw_picture(const DiagramOptions& options, const Show& show, const Diagram& diagram, DiagramPicture& picture) {
  require_time("diagram --at", show, options.time_s);
  const std::filesystem::path out = options.out;
  if (out.extension() != ".png") {
    throw UsageError("--out " + options.out, "does not end in .png",
                     "choose a name that ends in .png, or add --frames to write to a folder");
  }
  const DiagramScene scene = diagram.at(options.time_s);
  const OutsideCamera camera =
      picture.camera_for(outside_direction_of(options, show, options.time_s), scene.framed, scene.legend.size());
  const DiagramImage image = picture.draw(scene, camera);
  write_png(out, image.rgb, image.width_px, image.height_px);
  print_out("{}: {} x {} pixels, {}\n", options.out, image.width_px, image.height_px,
            counted(scene.ray_count, "light ray"));
  for (const LegendLine& line : scene.legend) {
    print_out("  {}\n", line.text);
  }
}

//! Returns one camera for a whole film, in the direction for its first frame. The camera shows the
//! scenes of several frames completely, above their legends.
OutsideCamera film_camera(const DiagramOptions& options, const Show& show, const Diagram& diagram,
                          const DiagramPicture& picture, std::pair<int, int> frames) {
  std::vector<Vector3<double>> framed;
  std::size_t legend_lines = 0;
  for (int i = 0; i < framed_moments; ++i) {
    const int frame = frames.first + (frames.second - frames.first) * i / (framed_moments - 1);
    const DiagramScene scene = diagram.at(frame_time_s(show, frame));
    framed.insert(framed.end(), scene.framed.begin(), scene.framed.end());
    legend_lines = std::max(legend_lines, scene.legend.size());
  }
  return picture.camera_for(outside_direction_of(options, show, frame_time_s(show, frames.first)), framed,
                            legend_lines);
}

void draw_film(const DiagramOptions& options, const Show& show, const Diagram& diagram, DiagramPicture& picture) {
  const int count = frame_count(show);
  const auto [first, last] = frame_range(options.frames, count);
  const OutsideCamera camera = film_camera(options, show, diagram, picture, {first, last});
  make_folder(options.out);
  Progress progress("drawing", last - first + 1);
  for (int frame = first; frame <= last; ++frame) {
    if (interrupted()) {
      throw Error("diagram", fmt::format("stopped after {}", counted(frame - first, "frame")),
                  "continue with --frames");
    }
    const DiagramImage image = picture.draw(diagram.at(frame_time_s(show, frame)), camera);
    const std::filesystem::path path =
        std::filesystem::path(options.out) / frame_path(show.name + "_diagram", frame, count, FramePart::whole, "png");
    make_folder(path.parent_path());
    write_png(path, image.rgb, image.width_px, image.height_px);
    progress.advance_to(frame - first + 1);
  }
  print_out("{} in {}\n", counted(last - first + 1, "frame"), options.out);
}

void run_diagram(const DiagramOptions& options) {
  const Show show = load_show(options.show, options.set);
  const auto [width_px, height_px] = size_of(options.size);
  const DiagramSettings settings{images_of(options.images), options.rays};
  static_cast<void>(outside_direction_of(options, show, 0.0));
  const Diagram diagram(show, settings);
  DiagramPicture picture(width_px, height_px);
  if (options.frames.empty()) {
    draw_picture(options, show, diagram, picture);
  } else {
    draw_film(options, show, diagram, picture);
  }
}

}  // namespace

void add_diagram_command(CLI::App& app) {
  auto options = std::make_shared<DiagramOptions>();
  CLI::App* command =
      app.add_subcommand("diagram", "Draw a show's hole, observer, objects and their light rays as seen from outside");
  command->add_option("show", options->show, "show with objects: file (.toml) or name of a built-in show")->required();
  add_set_option(*command, options->set);
  command->add_option("--out", options->out, "picture to write (.png); with --frames: folder for the pictures")
      ->required()
      ->type_name("FILE");
  CLI::Option* at = command->add_option("--at", options->time_s, "time of the show [s]")->capture_default_str();
  command->add_option("--frames", options->frames, std::string("draw these frames: ") + frame_range_words)
      ->type_name("RANGE")
      ->excludes(at);
  command
      ->add_option("--from", options->from,
                   "camera position: AZIMUTH,ELEVATION[,DISTANCE] in degrees and M (default: beside the observer, with "
                   "everything in view)")
      ->type_name("POSITION");
  command->add_option("--size", options->size, "size of the picture in pixels: WIDTHxHEIGHT, or only the width")
      ->type_name("SIZE")
      ->capture_default_str();
  command
      ->add_option(
          "--images", options->images,
          "orders of images to draw, 1 to 5, for holes without spin: 1 is direct light; each order above adds half "
          "a turn around the hole (default: 1,2)")
      ->type_name("LIST");
  command->add_option("--rays", options->rays, "approximate number of light rays")
      ->check(CLI::Range(0, 2000))
      ->capture_default_str();
  command->callback([options] { run_diagram(*options); });
}

}  // namespace ergodome
