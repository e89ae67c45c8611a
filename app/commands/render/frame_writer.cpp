#include "app/commands/render/frame_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/cli/backend_choice.h"
#include "app/cli/show_loading.h"
#include "app/commands/movie/movie.h"
#include "app/commands/render/frame_facts.h"
#include "app/commands/render/heat_map_options.h"
#include "app/commands/render/movie_plan.h"
#include "app/commands/render/numbered_frames.h"
#include "app/commands/render/sequence_facts.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "render/output/color_bar.h"
#include "render/output/frame_files.h"
#include "render/output/image_writer.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Metadata key of the automatic exposure of a frame: the stops that were applied [1].
constexpr const char* followed_stops_fact = "followed_stops";
//! Metadata key of the previous frame's stops, from which the exposure continued, or the word for a
//! restart.
constexpr const char* followed_from_fact = "followed_from";
constexpr const char* anew = "anew";

std::string stops_text(double stops) { return fmt::format("{:.17g}", stops); }

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size() && std::isfinite(number) ? std::optional(number)
                                                                                             : std::nullopt;
}

//! Maximum number of other frames to check: on a network disk each takes some milliseconds.
constexpr std::size_t most_asked_otherwise = 4096;

}  // namespace

FrameFormat format_of(const RenderOptions& options) {
  return frame_format(options.format, options.compression, options.alpha);
}

FrameWriter::FrameWriter(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup,
                         FrameRequests requests)
    : options_(options),
      format_(format_of(options)),
      choice_{view_mode(options.view), options.size_px, follow_method(options.method, options.view, show),
              view_range(options.view_range, view_mode(options.view), !options.method.empty()), options.alpha},
      backend_(choose_backend(options.backend)),
      stream_(open_stream(show, options.lens, backend_)),
      renderer_(show, backend_, lens_choice(options.lens), stream_),
      requests_(std::move(requests)) {
  made_.make_folder(options.out);
  format_.rate = frame_rate_of(show.frame_rate_hz);
  renderer_.overlays().set_language(options.language);
  if (setup) {
    const std::vector<ProjectorPicture> pictures = projector_pictures(*setup);
    projectors_.emplace(*setup, pictures,
                        backend_ == Backend::cuda ? ProjectorDrawer::cuda : ProjectorDrawer::automatic);
    choice_.size_px = choice_.size_px > 0 ? choice_.size_px : enough_master_px(pictures);
    print_out("rendering domemasters {} wide for {}\n", counted(choice_.size_px, "pixel"),
              counted(pictures.size(), "projector"));
  }
  for (const std::string& note : renderer_.notes()) {
    tell_on_terminal(note);
  }
  for (const std::string& note : stream_notes(stream_.get(), show, options.lens, backend_, choice_.size_px)) {
    tell_on_terminal(note);
  }
}

void FrameWriter::write(int frame) {
  const Show& show = renderer_.show();
  if (options_.resume && is_there(frame)) {
    ++resumed_;
    return;
  }
  renewed_ += options_.resume && was_asked_otherwise(frame) ? 1 : 0;
  const auto begin = std::chrono::steady_clock::now();
  const double time_s = frame_time_s(show, frame);
  go_on_exposing(frame);
  std::vector<FrameImage> images = renderer_.render(time_s, choice_);
  tell_narrowed_eyes(time_s);
  for (FrameImage& image : images) {
    draw_color_bar(image.picture, choice_.mode);
    tell_missing_legend(image.picture);
    unresolved_ += image.picture.unresolved_pixels;
  }
  const double baseline = renderer_.narrowed_eyes() ? renderer_.narrowed_eyes()->baseline : show.stereo.baseline;
  const bool views = show.stereo.layout == StereoLayout::multiview;
  frame_cost_ = {};
  for (std::size_t i = 0; i < images.size(); i += views ? 2 : 1) {
    const FrameImage& image = images[i];
    const FramePart part = views ? FramePart::whole : image.part;
    const std::filesystem::path path = path_of(frame, part, image.face);
    enter(path.parent_path());
    FrameMetadata metadata = frame_facts(show, {frame, baseline, part, image.face, choice_.mode});
    metadata.emplace_back("request", request_of(frame));
    if (const std::optional<HeatRange>& range = image.picture.heat_range) {
      metadata.emplace_back("view", options_.view);
      metadata.emplace_back("view_range", fmt::format("{:.12g} {:.12g}", range->low, range->high));
    }
    if (followed_stops()) {
      metadata.emplace_back(followed_from_fact, followed_from_);
      metadata.emplace_back(followed_stops_fact, stops_text(*followed_stops()));
    }
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
      frame_cost_.bytes += problem ? 0 : bytes;
      made_.add(file);
    }
  }
  if (followed_stops()) {
    followed_from_ = stops_text(*followed_stops());
  }
  frame_cost_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ++written_;
}

std::optional<double> FrameWriter::followed_stops() const {
  const bool shown = choice_.mode == ViewMode::sky && format_.image != ImageFormat::exr;
  return shown ? renderer_.followed_stops() : std::nullopt;
}

std::filesystem::path FrameWriter::first_file_of(int frame) const {
  const Show& show = renderer_.show();
  const FramePart part = show.stereo.layout == StereoLayout::separate ? FramePart::left : FramePart::whole;
  const auto face = has_face_files(show.view) ? std::optional(CubeFace{}) : std::nullopt;
  const std::filesystem::path path = path_of(frame, part, face);
  return projectors_ ? projectors_->paths_of(path).front() : path;
}

std::string FrameWriter::stops_before(int frame) const {
  const bool alike = frame > 0 && was_asked_alike(frame - 1);
  const std::string stops = alike ? fact_of_image(first_file_of(frame - 1), followed_stops_fact) : "";
  return number_of(stops) ? stops : anew;
}

void FrameWriter::go_on_exposing(int frame) {
  if (!followed_stops() || std::exchange(exposed_, frame + 1) == frame) {
    return;
  }
  followed_from_ = stops_before(frame);
  if (const std::optional<double> stops = number_of(followed_from_)) {
    renderer_.follow_from(*stops, frame_time_s(renderer_.show(), frame - 1));
  } else if (frame > 0) {
    tell_on_terminal(fmt::format(
        "automatic exposure (tone.auto) starts again at frame {}, because the frame before it is missing or was "
        "rendered with other options; render that frame, then use --resume",
        frame + 1));
  }
}

void FrameWriter::tell_missing_legend(const Picture& picture) {
  if (picture.heat_range && !has_color_bar(picture.width, picture.height) && !std::exchange(told_no_legend_, true)) {
    tell_on_terminal(
        fmt::format("frames of {} x {} pixels are too small for the legend of a heat map; it needs 160 x 100",
                    picture.width, picture.height));
  }
}

void FrameWriter::tell_narrowed_eyes(double time_s) {
  if (renderer_.narrowed_eyes() && !std::exchange(told_narrowed_, true)) {
    tell_on_terminal(note_of(renderer_.show(), time_s, *renderer_.narrowed_eyes()));
  }
}

void FrameWriter::enter(const std::filesystem::path& folder) {
  made_.make_folder(folder);
  if (cleared_.insert(folder).second) {
    remove_abandoned_files(folder);
  }
}

std::unique_ptr<MovieSound> FrameWriter::sound_of(int first, int last) const {
  const Show& show = renderer_.show();
  if (show.timeline.audio.empty()) {
    return nullptr;
  }
  return std::make_unique<MovieSound>(show, options_.language, frame_time_s(show, first),
                                      frame_time_s(show, last + 1 - first),
                                      std::filesystem::path(options_.movie).parent_path());
}

void FrameWriter::write_movies(int first, int last) const {
  const Show& show = renderer_.show();
  const std::filesystem::path folder = std::filesystem::path(options_.movie).parent_path();
  make_folder(folder.empty() ? "." : folder);
  const std::unique_ptr<MovieSound> sound = sound_of(first, last);
  for (const FramePart part : movie_parts(show)) {
    Movie movie;
    movie.file = movie_path(options_.movie, part);
    movie.frame_rate_hz = show.frame_rate_hz;
    movie.sound = sound.get();
    movie.alpha = options_.alpha;
    for (int frame = first; frame <= last; ++frame) {
      movie.pictures.push_back(path_of(frame, part, std::nullopt));
    }
    write_movie(movie);
    if (options_.delete_frames) {
      check_movie(movie);
    }
    print_out("written to {}\n", movie.file.string());
  }
}

void FrameWriter::delete_frames() {
  const int deleted = made_.remove_files();
  const std::vector<int> left = lying_there();
  const auto alike = std::ranges::find_if(left, [&](int frame) { return was_asked_alike(frame); });
  if (alike != left.end()) {
    write_facts(*alike, *alike);
  } else {
    for (const char* ending : {".txt", ".json"}) {
      std::error_code problem;
      fs::remove(fs::path(options_.out) / (renderer_.show().name + ending), problem);
    }
  }
  made_.remove_folders();
  print_out("deleted {} from {}{}\n", counted(deleted, "frame file"), options_.out,
            resumed_ > 0 ? fmt::format("; kept {} from an earlier run", counted(resumed_, "frame")) : "");
}

void FrameWriter::write_facts(int first, int last) const {
  const Show& show = renderer_.show();
  // Long shows may be rendered in several adjacent parts.
  while (first > 0 && was_asked_alike(first - 1)) {
    --first;
  }
  while (last + 1 < frame_count(show) && was_asked_alike(last + 1)) {
    ++last;
  }
  write_sequence_facts(options_.out, show, format_, {first, last}, eye_width_px());
}

std::string FrameWriter::request_of(int frame) const { return requests_.at(frame_time_s(renderer_.show(), frame)); }

bool FrameWriter::was_asked_alike(int frame) const {
  return fact_of_image(first_file_of(frame), "request") == request_of(frame);
}

bool FrameWriter::was_asked_otherwise(int frame) const {
  const std::string request = fact_of_image(first_file_of(frame), "request");
  return !request.empty() && request != request_of(frame);
}

std::vector<int> FrameWriter::lying_there() const {
  const bool separate = renderer_.show().stereo.layout == StereoLayout::separate;
  return numbered_frames(fs::path(options_.out) / eye_folder(separate ? FramePart::left : FramePart::whole),
                         renderer_.show().name, [&](int frame) { return first_file_of(frame); });
}

std::vector<int> FrameWriter::asked_otherwise(int first, int last) const {
  std::vector<int> frames = lying_there();
  std::erase_if(frames, [&](int frame) { return frame >= first && frame <= last; });
  frames.resize(std::min(frames.size(), most_asked_otherwise));
  const int count = frame_count(renderer_.show());
  std::erase_if(frames, [&](int frame) { return frame < count && !was_asked_otherwise(frame); });
  return frames;
}

long FrameWriter::missing(int next, int last) const {
  const auto there = std::ranges::count_if(lying_there(), [&](int frame) { return frame >= next && frame <= last; });
  return last + 1L - next - there;
}

std::vector<std::string> FrameWriter::run_notes(int next, int last) {
  std::vector<std::string> notes = {cost_note(next, last), new_room_note(next, last)};
  std::erase(notes, "");
  return notes;
}

std::string FrameWriter::cost_note(int next, int last) {
  // The first frame also prepares data that all frames share. Unless it is slow, the second one
  // gives a better estimate.
  const bool measured = written_ > 1 || (written_ == 1 && frame_cost_.seconds >= slow_frame_s);
  if (!measured || next > last || std::exchange(told_cost_, true)) {
    return "";
  }
  const long left = options_.resume ? missing(next, last) : last + 1L - next;
  return left > 0
             ? run_cost_text(written_ + left, frame_cost_) + (options_.movie.empty() ? "" : ", not counting the film")
             : "";
}

std::string FrameWriter::new_room_note(int next, int last) {
  largest_bytes_ = std::max(largest_bytes_, frame_cost_.bytes);
  // Checks again after 1, 2, 4, 8, ... frames: the first frames of many shows are black, and their
  // files small.
  if (told_room_ || !std::has_single_bit(static_cast<unsigned>(written_)) ||
      std::exchange(looked_at_room_after_, written_) == written_) {
    return "";
  }
  std::string note = room_note_for(next, last, "the rest of the run", static_cast<double>(largest_bytes_));
  told_room_ = !note.empty();
  return note;
}

std::string FrameWriter::early_room_note(int first, int last) const {
  const double part = least_compressed_part(format_);
  return room_note_for(first, last, part < 1.0 ? "the run, even if its frames compress to a tenth," : "the run",
                       part * static_cast<double>(uncompressed_bytes(format_, frame_pixels())));
}

std::string FrameWriter::room_note_for(int next, int last, const std::string& what, double frame_bytes) const {
  std::error_code problem;
  const fs::space_info space = fs::space(options_.out, problem);
  // Existing frames are overwritten.
  const double needed = problem ? 0.0 : frame_bytes * static_cast<double>(missing(next, last));
  return room_note(options_.out, what, static_cast<std::uintmax_t>(std::min(needed, 1e18)), space.available);
}

ImageSize FrameWriter::picture_size() const {
  const Show& show = renderer_.show();
  const Projection eye = make_projection(show.view, eye_width_px(), 0.0);
  return layout_size(show.stereo.layout,
                     {has_face_files(show.view) ? eye.width_px / cube_faces : eye.width_px, eye.height_px});
}

std::uintmax_t FrameWriter::frame_pixels() const {
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

int FrameWriter::eye_width_px() const { return choice_.size_px > 0 ? choice_.size_px : renderer_.show().view.size_px; }

std::filesystem::path FrameWriter::path_of(int frame, FramePart part, std::optional<CubeFace> face) const {
  return std::filesystem::path(options_.out) / frame_path(renderer_.show().name, frame, frame_count(renderer_.show()),
                                                          part, file_ending(format_.image), face);
}

bool FrameWriter::is_there(int frame) const {
  const Show& show = renderer_.show();
  // The exposure would jump if the frame continued from other stops than those of the frame before
  // it.
  if (followed_stops() && fact_of_image(first_file_of(frame), followed_from_fact) != stops_before(frame)) {
    return false;
  }
  if (show.stereo.layout == StereoLayout::separate) {
    return is_there(frame, FramePart::left) && is_there(frame, FramePart::right);
  }
  return is_there(frame, FramePart::whole);
}

bool FrameWriter::is_there(int frame, FramePart part) const {
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
    return fact_of_image(path, "request") == request && is_complete_image(path, size.width, size.height, parts);
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
