#include "app/commands/render/frame_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "app/cli/backend_choice.h"
#include "app/cli/show_loading.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/movie/movie.h"
#include "app/commands/render/movie_plan.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "render/output/frame_files.h"

namespace ergodome {

FrameWriter::FrameWriter(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup,
                         FrameRequests requests)
    : options_(options),
      backend_(choose_backend(options.backend)),
      stream_(open_stream(show, options.lens, backend_)),
      renderer_(show, backend_, lens_choice(options.lens), stream_),
      files_(options, renderer_,
             {view_mode(options.view), options.size_px, follow_method(options.method, options.view, show),
              view_range(options.view_range, view_mode(options.view), !options.method.empty()), options.alpha},
             setup, std::move(requests)) {
  renderer_.overlays().set_language(options.language);
  for (const std::string& note : renderer_.notes()) {
    print_note_once(note);
  }
  for (const std::string& note : stream_notes(stream_.get(), show, options.lens, backend_, files_.choice().size_px)) {
    print_note_once(note);
  }
}

void FrameWriter::write(int frame) {
  if (options_.resume && files_.is_there(frame)) {
    ++resumed_;
    return;
  }
  renewed_ += options_.resume && files_.was_asked_otherwise(frame) ? 1 : 0;
  const auto begin = std::chrono::steady_clock::now();
  files_.go_to(frame);
  const OutputWish wish = files_.wish();
  if (wish.stops_before) {
    renderer_.follow_from(*wish.stops_before, frame_time_s(renderer_.show(), frame - 1));
  }
  const double time_s = *wish.show_time_s;
  std::vector<Picture> eyes = renderer_.render_frame(time_s, files_.choice());
  report_reduced_baseline(time_s);
  OutputFrame made;
  made.picture = std::move(eyes.front());
  if (eyes.size() > 1) {
    made.right_eye = std::move(eyes.back());
  }
  files_.take(made);
  frame_cost_ = {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), files_.bytes()};
  ++written_;
}

double FrameWriter::meter(int frame) {
  static_cast<void>(renderer_.render_frame(frame_time_s(renderer_.show(), frame), files_.choice()));
  return renderer_.metered_light().value_or(0.0);
}

void FrameWriter::report_reduced_baseline(double time_s) {
  if (renderer_.reduced_baseline() && !std::exchange(reported_reduced_baseline_, true)) {
    print_note_once(note_of(renderer_.show(), time_s, *renderer_.reduced_baseline()));
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
    movie.sphere = spherical_film(show);
    for (int frame = first; frame <= last; ++frame) {
      movie.pictures.push_back(files_.path_of(frame, part, std::nullopt));
    }
    write_movie(movie);
    if (options_.delete_frames) {
      check_movie(movie);
    }
    print_out("written to {}\n", movie.file.string());
  }
}

void FrameWriter::delete_frames() {
  const int deleted = files_.remove();
  print_out("deleted {} from {}{}\n", counted(deleted, "frame file"), options_.out,
            resumed_ > 0 ? fmt::format("; kept {} from an earlier run", counted(resumed_, "frame")) : "");
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
  if (!measured || next > last || std::exchange(reported_cost_, true)) {
    return "";
  }
  const long left = options_.resume ? files_.missing(next, last) : last + 1L - next;
  return left > 0
             ? run_cost_text(written_ + left, frame_cost_) + (options_.movie.empty() ? "" : ", not counting the film")
             : "";
}

std::string FrameWriter::new_room_note(int next, int last) {
  largest_bytes_ = std::max(largest_bytes_, frame_cost_.bytes);
  // Checks again after 1, 2, 4, 8, ... frames: the first frames of many shows are black, and their
  // files small.
  if (reported_space_ || !std::has_single_bit(static_cast<unsigned>(written_)) ||
      std::exchange(checked_space_after_, written_) == written_) {
    return "";
  }
  std::string note = room_note_for(next, last, "the rest of the run", static_cast<double>(largest_bytes_));
  reported_space_ = !note.empty();
  return note;
}

std::string FrameWriter::early_room_note(int first, int last) const {
  const double part = min_compressed_part(files_.format());
  return room_note_for(first, last, part < 1.0 ? "the run, even if its frames compress to a tenth," : "the run",
                       part * static_cast<double>(uncompressed_bytes(files_.format(), files_.frame_pixels())));
}

std::string FrameWriter::room_note_for(int next, int last, const std::string& what, double frame_bytes) const {
  std::error_code problem;
  const std::filesystem::space_info space = std::filesystem::space(options_.out, problem);
  // Existing frames are overwritten, so only missing frames need additional space.
  const double needed = problem ? 0.0 : frame_bytes * static_cast<double>(files_.missing(next, last));
  return room_note(options_.out, what, static_cast<std::uintmax_t>(std::min(needed, 1e18)), space.available);
}

}  // namespace ergodome
