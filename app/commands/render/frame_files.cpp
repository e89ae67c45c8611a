#include "app/commands/render/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "app/commands/render/frame_metadata.h"
#include "app/commands/render/numbered_frames.h"
#include "app/commands/render/sequence_metadata.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "render/frame/frame_images.h"
#include "render/output/color_bar.h"
#include "render/output/frame_files.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Metadata key of the stops that automatic exposure applied to a frame.
constexpr const char* followed_stops_metadata = "followed_stops";
//! Metadata key of the previous frame's stops, from which the exposure continued. The value is
//! `anew` if the exposure started again.
constexpr const char* followed_from_metadata = "followed_from";
constexpr const char* anew = "anew";

std::string stops_text(double stops) { return fmt::format("{:.17g}", stops); }

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size() && std::isfinite(number) ? std::optional(number)
                                                                                             : std::nullopt;
}

//! Maximum number of frames that asked_otherwise() checks: on a network disk each takes some
//! milliseconds.
constexpr std::size_t max_asked_otherwise = 4096;

}  // namespace

FrameFormat format_of(const RenderOptions& options) {
  return frame_format(options.format, options.compression, options.alpha);
}

FrameFiles::FrameFiles(const RenderOptions& options, const ShowRenderer& renderer, const ViewChoice& choice,
                       const std::optional<DomeSetup>& setup, FrameRequests requests)
    : options_(options),
      renderer_(renderer),
      choice_(choice),
      format_(format_of(options)),
      requests_(std::move(requests)) {
  if (!options.light.empty()) {
    light_.emplace(options.light, renderer.show(), requests_);
  }
  if (options.meter.empty()) {
    made_.make_folder(options.out);
  }
  format_.rate = frame_rate_of(renderer.show().frame_rate_hz);
  if (setup) {
    const std::vector<ProjectorPicture> pictures = projector_pictures(*setup);
    projectors_.emplace(*setup, pictures,
                        renderer.backend() == Backend::cuda ? ProjectorDrawer::cuda : ProjectorDrawer::automatic);
    choice_.size_px = choice_.size_px > 0 ? choice_.size_px : enough_master_px(pictures);
    print_out("rendering domemasters {} wide for {}\n", counted(choice_.size_px, "pixel"),
              counted(pictures.size(), "projector"));
  }
}

OutputWish FrameFiles::wish() {
  OutputWish wish;
  wish.show_time_s = frame_time_s(renderer_.show(), frame_);
  if (followed_stops() && std::exchange(exposed_, frame_ + 1) != frame_) {
    followed_from_ = stops_before(frame_);
    wish.stops_before = number_of(followed_from_);
    if (!wish.stops_before && frame_ > 0) {
      print_note_once(fmt::format(
          "automatic exposure (tone.auto) starts again at frame {}, because the frame before it is missing or was "
          "rendered with other options; render that frame, then use --resume",
          frame_ + 1));
    }
  }
  return wish;
}

void FrameFiles::take(OutputFrame& frame) {
  const Show& show = renderer_.show();
  std::vector<Picture> eyes;
  eyes.push_back(std::move(frame.picture));
  if (frame.right_eye) {
    eyes.push_back(std::move(*frame.right_eye));
  }
  std::vector<FrameImage> images = frame_images(std::move(eyes), renderer_.frame_projection(choice_), show);
  for (FrameImage& image : images) {
    draw_color_bar(image.picture, choice_.mode);
    report_missing_legend(image.picture);
    unresolved_ += image.picture.unresolved_pixels;
  }
  const bool views = show.stereo.layout == StereoLayout::multiview;
  bytes_ = 0;
  for (std::size_t i = 0; i < images.size(); i += views ? 2 : 1) {
    const FrameImage& image = images[i];
    const FramePart part = views ? FramePart::whole : image.part;
    const fs::path path = path_of(frame_, part, image.face);
    enter(path.parent_path());
    const FrameMetadata metadata = metadata_of(image, part);
    if (projectors_) {
      projectors_->write(path, image.picture, metadata);
    } else if (views) {
      write_views(path, format_, image.picture, images[i + 1].picture, metadata);
    } else {
      write_picture(path, format_, image.picture, metadata);
    }
    for (const fs::path& file : projectors_ ? projectors_->paths_of(path) : std::vector<fs::path>{path}) {
      std::error_code problem;
      const std::uintmax_t bytes = fs::file_size(file, problem);
      bytes_ += problem ? 0 : bytes;
      made_.add(file);
    }
  }
  if (followed_stops()) {
    followed_from_ = stops_text(*followed_stops());
  }
}

FrameMetadata FrameFiles::metadata_of(const FrameImage& image, FramePart part) const {
  const Show& show = renderer_.show();
  const double baseline = renderer_.reduced_baseline() ? renderer_.reduced_baseline()->baseline : show.stereo.baseline;
  FrameMetadata metadata = frame_metadata(show, {frame_, baseline, part, image.face, choice_.mode});
  metadata.emplace_back("request", request_of(frame_));
  if (const std::optional<HeatRange>& range = image.picture.heat_range) {
    metadata.emplace_back("view", options_.view);
    metadata.emplace_back("view_range", fmt::format("{:.12g} {:.12g}", range->low, range->high));
  }
  if (followed_stops()) {
    metadata.emplace_back(followed_from_metadata, followed_from_);
    metadata.emplace_back(followed_stops_metadata, stops_text(*followed_stops()));
  }
  return metadata;
}

std::optional<double> FrameFiles::followed_stops() const {
  const bool shown = choice_.mode == ViewMode::sky && format_.image != ImageFormat::exr;
  return shown ? renderer_.followed_stops() : std::nullopt;
}

std::filesystem::path FrameFiles::first_file_of(int frame) const {
  const Show& show = renderer_.show();
  const FramePart part = show.stereo.layout == StereoLayout::separate ? FramePart::left : FramePart::whole;
  const auto face = has_face_files(show.view) ? std::optional(CubeFace{}) : std::nullopt;
  const std::filesystem::path path = path_of(frame, part, face);
  return projectors_ ? projectors_->paths_of(path).front() : path;
}

std::string FrameFiles::stops_before(int frame) const {
  if (light_) {
    const std::optional<double> stops = light_->stops_at(frame - 1);
    return stops ? stops_text(*stops) : anew;
  }
  const bool alike = frame > 0 && was_asked_alike(frame - 1);
  const std::string stops = alike ? metadata_of_image(first_file_of(frame - 1), followed_stops_metadata) : "";
  return number_of(stops) ? stops : anew;
}

void FrameFiles::report_missing_legend(const Picture& picture) {
  if (picture.heat_range && !has_color_bar(picture.width, picture.height) &&
      !std::exchange(reported_no_legend_, true)) {
    print_note_once(
        fmt::format("frames of {} x {} pixels are too small for the legend of a heat map; it needs 160 x 100",
                    picture.width, picture.height));
  }
}

void FrameFiles::enter(const std::filesystem::path& folder) {
  made_.make_folder(folder);
  if (cleared_.insert(folder).second) {
    remove_abandoned_files(folder);
  }
}

int FrameFiles::remove() {
  const int removed = made_.remove_files();
  const std::vector<int> left = lying_there();
  const auto alike = std::ranges::find_if(left, [&](int frame) { return was_asked_alike(frame); });
  if (alike != left.end()) {
    write_metadata(*alike, *alike);
  } else {
    for (const char* ending : {".txt", ".json"}) {
      std::error_code problem;
      fs::remove(fs::path(options_.out) / (renderer_.show().name + ending), problem);
    }
  }
  made_.remove_folders();
  return removed;
}

void FrameFiles::write_metadata(int first, int last) const {
  const Show& show = renderer_.show();
  // Long shows may be rendered in several adjacent parts.
  while (first > 0 && was_asked_alike(first - 1)) {
    --first;
  }
  while (last + 1 < frame_count(show) && was_asked_alike(last + 1)) {
    ++last;
  }
  write_sequence_metadata(options_.out, show, format_, {first, last}, eye_width_px());
}

std::string FrameFiles::request_of(int frame) const { return requests_.at(frame_time_s(renderer_.show(), frame)); }

bool FrameFiles::was_asked_alike(int frame) const {
  return metadata_of_image(first_file_of(frame), "request") == request_of(frame);
}

bool FrameFiles::was_asked_otherwise(int frame) const {
  const std::string request = metadata_of_image(first_file_of(frame), "request");
  return !request.empty() && request != request_of(frame);
}

std::vector<int> FrameFiles::lying_there() const {
  const bool separate = renderer_.show().stereo.layout == StereoLayout::separate;
  return numbered_frames(fs::path(options_.out) / eye_folder(separate ? FramePart::left : FramePart::whole),
                         renderer_.show().name, [&](int frame) { return first_file_of(frame); });
}

std::vector<int> FrameFiles::asked_otherwise(int first, int last) const {
  std::vector<int> frames = lying_there();
  std::erase_if(frames, [&](int frame) { return frame >= first && frame <= last; });
  frames.resize(std::min(frames.size(), max_asked_otherwise));
  const int count = frame_count(renderer_.show());
  std::erase_if(frames, [&](int frame) { return frame < count && !was_asked_otherwise(frame); });
  return frames;
}

long FrameFiles::missing(int next, int last) const {
  const auto there = std::ranges::count_if(lying_there(), [&](int frame) { return frame >= next && frame <= last; });
  return last + 1L - next - there;
}

ImageSize FrameFiles::picture_size() const {
  const Show& show = renderer_.show();
  const Projection eye = make_projection(show.view, eye_width_px(), 0.0);
  return layout_size(show.stereo.layout,
                     {has_face_files(show.view) ? eye.width_px / cube_faces : eye.width_px, eye.height_px});
}

std::uintmax_t FrameFiles::frame_pixels() const {
  const Show& show = renderer_.show();
  const StereoLayout layout = show.stereo.layout;
  const bool twice = layout == StereoLayout::separate || layout == StereoLayout::multiview;
  if (projectors_) {
    return projectors_->pixels() * (twice ? 2 : 1);
  }
  const ImageSize size = picture_size();
  const std::uintmax_t pictures = (twice ? 2 : 1) * (has_face_files(show.view) ? cube_faces : 1);
  return pictures * static_cast<std::uintmax_t>(size.width) * static_cast<std::uintmax_t>(size.height);
}

int FrameFiles::eye_width_px() const { return choice_.size_px > 0 ? choice_.size_px : renderer_.show().view.size_px; }

std::filesystem::path FrameFiles::path_of(int frame, FramePart part, std::optional<CubeFace> face) const {
  return std::filesystem::path(options_.out) / frame_path(renderer_.show().name, frame, frame_count(renderer_.show()),
                                                          part, file_ending(format_.image), face);
}

bool FrameFiles::is_there(int frame) const {
  const Show& show = renderer_.show();
  // A frame whose exposure continued from other stops than those that the frame before now has
  // would make the exposure jump, so it counts as missing.
  if (followed_stops() && metadata_of_image(first_file_of(frame), followed_from_metadata) != stops_before(frame)) {
    return false;
  }
  if (show.stereo.layout == StereoLayout::separate) {
    return is_there(frame, FramePart::left) && is_there(frame, FramePart::right);
  }
  return is_there(frame, FramePart::whole);
}

bool FrameFiles::is_there(int frame, FramePart part) const {
  const Show& show = renderer_.show();
  if (projectors_) {
    return projectors_->are_there(path_of(frame, part, std::nullopt), request_of(frame));
  }
  const bool faces = has_face_files(show.view);
  const ImageSize size = picture_size();
  const int parts = show.stereo.layout == StereoLayout::multiview ? 2 : 1;
  const std::string request = request_of(frame);
  const auto complete = [&](std::optional<CubeFace> face) {
    const std::filesystem::path path = path_of(frame, part, face);
    return metadata_of_image(path, "request") == request && is_complete_image(path, size.width, size.height, parts);
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

}  // namespace ergodome
