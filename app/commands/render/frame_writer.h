#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/cli/setup_show.h"
#include "app/commands/movie/movie_sound.h"
#include "app/commands/render/frame_request.h"
#include "app/commands/render/made_files.h"
#include "app/commands/render/render_options.h"
#include "app/commands/render/run_cost.h"
#include "render/frame/show_renderer.h"
#include "render/output/frame_files.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

//! Returns the format of the files. Throws Error if the format does not support the compression.
FrameFormat format_of(const RenderOptions& options);

//! Renders and writes the frames of one run.
class FrameWriter {
 public:
  //! `setup` is the dome whose projectors' frames are written instead of the domemaster's;
  //! `requests` are the fingerprints stored in the files. The options must outlive the writer.
  FrameWriter(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup,
              FrameRequests requests);

  //! Renders and writes a frame, counted from 0. With --resume, keeps a frame that has the same
  //! fingerprint.
  void write(int frame);

  //! Encodes the frames first to last as films: one, or one for each eye with its own files. With
  //! --delete-frames, each film is then read back. Throws Error if it does not contain these
  //! frames.
  void write_movies(int first, int last) const;

  //! Removes the frames that this run wrote, and the summary in their folder unless other frames of
  //! the sequence remain.
  void delete_frames();

  //! Writes the metadata summary of the frames first to last, extended to adjacent frames with the
  //! same fingerprints.
  void write_facts(int first, int last) const;

  [[nodiscard]] int written() const { return written_; }
  //! Returns the number of existing frames that were kept.
  [[nodiscard]] int resumed() const { return resumed_; }
  //! With --resume, returns the number of existing frames that were rendered again because their
  //! fingerprints differed.
  [[nodiscard]] int renewed() const { return renewed_; }
  //! Returns the existing frames, from 0, before `first` and after `last` that have other
  //! fingerprints or are beyond the end of the show. Checks at most a few thousand frames.
  [[nodiscard]] std::vector<int> asked_otherwise(int first, int last) const;
  //! Returns the notes that are due before the frames `next` to `last`: once the time and disk
  //! space of the run, and a warning if the disk has no room for the missing frames.
  [[nodiscard]] std::vector<std::string> run_notes(int next, int last);
  //! Returns a warning if the disk has no room for the missing frames of `first` to `last` even if
  //! they compress well; otherwise an empty text. Renders nothing.
  [[nodiscard]] std::string early_room_note(int first, int last) const;
  [[nodiscard]] std::optional<StreamStatistics> stream_statistics() const { return renderer_.stream_statistics(); }
  [[nodiscard]] long unresolved() const { return unresolved_; }

 private:
  [[nodiscard]] int eye_width_px() const;
  [[nodiscard]] std::filesystem::path path_of(int frame, FramePart part, std::optional<CubeFace> face) const;
  //! Returns the stops of automatic exposure; nothing for heat maps and for EXR files, which are
  //! linear.
  [[nodiscard]] std::optional<double> followed_stops() const;
  //! Continues the automatic exposure from the stops stored in the frame before, unless this run
  //! has just rendered that frame.
  void go_on_exposing(int frame);
  //! Returns the stops of the frame before, as text; the word for a restart if that frame is
  //! missing or has another fingerprint.
  [[nodiscard]] std::string stops_before(int frame) const;
  //! Returns the first file of a frame.
  [[nodiscard]] std::filesystem::path first_file_of(int frame) const;
  //! Prints a note about the first frame whose baseline is reduced.
  void tell_narrowed_eyes(double time_s);
  //! Prints a note, once, if heat maps are too small for their legend.
  void tell_missing_legend(const Picture& picture);
  //! Creates a folder of frames and removes temporary files that killed programs left there.
  void enter(const std::filesystem::path& folder);
  [[nodiscard]] std::unique_ptr<MovieSound> sound_of(int first, int last) const;
  [[nodiscard]] bool is_there(int frame) const;
  [[nodiscard]] bool is_there(int frame, FramePart part) const;
  //! Returns the fingerprint of a frame's request.
  [[nodiscard]] std::string request_of(int frame) const;
  [[nodiscard]] bool was_asked_alike(int frame) const;
  //! Returns whether a frame of the show exists that has another fingerprint.
  [[nodiscard]] bool was_asked_otherwise(int frame) const;
  //! Returns the numbers of the existing frames of this show.
  [[nodiscard]] std::vector<int> lying_there() const;
  [[nodiscard]] std::string cost_note(int next, int last);
  [[nodiscard]] std::string new_room_note(int next, int last);
  //! Returns the size of each image file of the domemaster.
  [[nodiscard]] ImageSize picture_size() const;
  //! Returns the number of pixels in all files of a frame.
  [[nodiscard]] std::uintmax_t frame_pixels() const;
  //! Warns if the missing frames of `next` to `last`, each of this size, do not fit on the disk.
  [[nodiscard]] std::string room_note_for(int next, int last, const std::string& what, double frame_bytes) const;
  //! Returns how many of the frames `next` to `last` do not exist.
  [[nodiscard]] long missing(int next, int last) const;

  const RenderOptions& options_;
  MadeFiles made_;
  FrameFormat format_;
  ViewChoice choice_;
  Backend backend_;
  std::shared_ptr<StationStream> stream_;  //!< null without a trajectory
  ShowRenderer renderer_;
  FrameRequests requests_;
  std::optional<ProjectorFrames> projectors_;
  int written_ = 0;
  int exposed_ = -1;            //!< the next frame that continues the automatic exposure
  std::string followed_from_;   //!< stops of the frame before, as stored in files
  bool told_narrowed_ = false;  //!< whether the note on a reduced baseline was printed
  int resumed_ = 0;
  int renewed_ = 0;
  RunFrameCost frame_cost_;           //!< of the last frame written
  bool told_cost_ = false;            //!< whether the estimate was printed
  std::uintmax_t largest_bytes_ = 0;  //!< of the largest frame so far
  int looked_at_room_after_ = 0;      //!< value of written_ at the last check of disk space
  bool told_room_ = false;            //!< whether the warning about disk space was printed
  //! Folders already cleared of files that killed programs left.
  std::set<std::filesystem::path> cleared_;
  long unresolved_ = 0;
  bool told_no_legend_ = false;
};

}  // namespace ergodome
