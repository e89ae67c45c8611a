#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/movie/movie_sound.h"
#include "app/commands/render/frame_files.h"
#include "app/commands/render/run_cost.h"
#include "render/output/frame_files.h"

namespace ergodome {

//! Renders the frames of one run into files.
class FrameWriter {
 public:
  //! See FrameFiles. The options must outlive the writer.
  FrameWriter(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup,
              FrameRequests requests);

  //! Renders and writes a frame, counted from 0. With --resume, keeps it if FrameFiles::is_there().
  void write(int frame);

  //! Renders a frame, counted from 0, and returns its light for automatic exposure. Writes nothing.
  double meter(int frame);

  //! Encodes the frames first to last as films: one, or one for each eye with its own files. With
  //! --delete-frames, each film is then read back. Throws Error if it does not contain these
  //! frames.
  void write_movies(int first, int last) const;

  //! Removes the frames that this run wrote; see FrameFiles::remove.
  void delete_frames();

  [[nodiscard]] const FrameFiles& files() const { return files_; }
  [[nodiscard]] int written() const { return written_; }
  //! Returns the number of existing frames that were kept.
  [[nodiscard]] int resumed() const { return resumed_; }
  //! With --resume, returns the number of existing frames that were rendered again because their
  //! fingerprints differed.
  [[nodiscard]] int renewed() const { return renewed_; }
  //! Returns the notes that are due before the frames `next` to `last`: once the time and disk
  //! space of the run, and a warning if the disk has no room for the missing frames.
  [[nodiscard]] std::vector<std::string> run_notes(int next, int last);
  //! Returns a warning if the disk has no room for the missing frames of `first` to `last` even if
  //! they compress to a tenth of their size (uncompressed EXR: not at all); otherwise an empty
  //! text. Renders nothing.
  [[nodiscard]] std::string early_room_note(int first, int last) const;
  [[nodiscard]] std::optional<StreamStatistics> stream_statistics() const { return renderer_.stream_statistics(); }

 private:
  //! Prints a note about the first frame whose baseline is reduced.
  void report_reduced_baseline(double time_s);
  [[nodiscard]] std::unique_ptr<MovieSound> sound_of(int first, int last) const;
  [[nodiscard]] std::string cost_note(int next, int last);
  [[nodiscard]] std::string new_room_note(int next, int last);
  //! Returns a warning if the missing frames of `next` to `last`, each of this size, do not fit on
  //! the disk; otherwise an empty text.
  [[nodiscard]] std::string room_note_for(int next, int last, const std::string& what, double frame_bytes) const;

  const RenderOptions& options_;
  Backend backend_;
  std::shared_ptr<StationStream> stream_;  //!< null without a trajectory
  ShowRenderer renderer_;
  FrameFiles files_;
  int written_ = 0;
  bool reported_reduced_baseline_ = false;  //!< whether the note on a reduced baseline was printed
  int resumed_ = 0;
  int renewed_ = 0;
  RunFrameCost frame_cost_;           //!< cost of the last frame written
  bool reported_cost_ = false;        //!< whether the estimate was printed
  std::uintmax_t largest_bytes_ = 0;  //!< largest size of a frame's files so far [bytes]
  int checked_space_after_ = 0;       //!< value of written_ at the last check of disk space
  bool reported_space_ = false;       //!< whether the warning about disk space was printed
};

}  // namespace ergodome
