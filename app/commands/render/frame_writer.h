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
#include "app/commands/run_cost.h"
#include "render/frame/show_renderer.h"
#include "render/output/frame_format.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

//! The format of the files that are asked for. Throws Error for a compression that the format has not.
FrameFormat format_of(const RenderOptions& options);

//! Renders and writes the frames of one run.
class FrameWriter {
 public:
  //! `setup`: the dome whose projectors' frames are written instead of the master's; `requests`: what each frame's file says that it was asked for as. The
  //! options have to outlive the writer.
  FrameWriter(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup,
              FrameRequests requests);

  //! Renders and writes a frame, counted from 0; with --resume only where none is there that was asked for alike.
  void write(int frame);

  //! Puts the frames first to last together as films: one, or one for each eye that has files of its own. With --delete-frames each
  //! film is then read back. Throws Error where it does not hold these frames.
  void write_movies(int first, int last) const;

  //! Removes the frames that this run has written, and the summary beside them unless other frames of the sequence remain.
  void delete_frames();

  //! The sheet of facts beside the frames first to last, and beside those that were asked for alike and lie there without a gap before and after them.
  void write_facts(int first, int last) const;

  [[nodiscard]] int written() const { return written_; }
  //! Frames that were there, and were not made again.
  [[nodiscard]] int resumed() const { return resumed_; }
  //! With --resume: frames that were there and were made again, as they had been asked for otherwise.
  [[nodiscard]] int renewed() const { return renewed_; }
  //! Numbers, from 0, of frames that lie there before `first` and after `last` and were asked for otherwise, or are beyond the show's end; of many some thousands
  //! are looked at.
  [[nodiscard]] std::vector<int> asked_otherwise(int first, int last) const;
  //! Returns the notes that are due before the frames `next` to `last`: once the time and disk space of the run, and a warning if the
  //! disk has no room for the missing frames.
  [[nodiscard]] std::vector<std::string> run_notes(int next, int last);
  //! Returns a warning if the disk has no room for the missing frames of `first` to `last` even if they compress well; else an empty text.
  //! Renders nothing.
  [[nodiscard]] std::string early_room_note(int first, int last) const;
  [[nodiscard]] std::optional<StreamStatistics> stream_statistics() const { return renderer_.stream_statistics(); }
  [[nodiscard]] long unresolved() const { return unresolved_; }

 private:
  [[nodiscard]] int eye_width_px() const;
  [[nodiscard]] std::filesystem::path path_of(int frame, FramePart part, std::optional<CubeFace> face) const;
  //! Stops of exposure that follows the light, in files that are shown as they are.
  [[nodiscard]] std::optional<double> followed_stops() const;
  //! Has that exposure go on from the frame before, where that was not this run's.
  void go_on_exposing(int frame);
  //! What a frame has to go on from: the stops of the frame before, where that is there and was asked for alike.
  [[nodiscard]] std::string stops_before(int frame) const;
  //! One of a frame's files.
  [[nodiscard]] std::filesystem::path first_file_of(int frame) const;
  //! Tells of the first frame whose eyes stand closer than the show asks.
  void tell_narrowed_eyes(double time_s);
  //! Says once that heat maps are too small for their legend.
  void tell_missing_legend(const Picture& picture);
  //! Makes a frame's folder, and clears it of what killed programs have left.
  void enter(const std::filesystem::path& folder);
  [[nodiscard]] std::unique_ptr<MovieSound> sound_of(int first, int last) const;
  [[nodiscard]] bool is_there(int frame) const;
  [[nodiscard]] bool is_there(int frame, FramePart part) const;
  //! What a frame is asked for as, and whether one of its files says so.
  [[nodiscard]] std::string request_of(int frame) const;
  [[nodiscard]] bool was_asked_alike(int frame) const;
  //! Whether a frame of the show lies there that was asked for otherwise.
  [[nodiscard]] bool was_asked_otherwise(int frame) const;
  //! Numbers of the frames of this name that lie there.
  [[nodiscard]] std::vector<int> lying_there() const;
  [[nodiscard]] std::string cost_note(int next, int last);
  [[nodiscard]] std::string new_room_note(int next, int last);
  //! Size of each picture file of the master.
  [[nodiscard]] ImageSize picture_size() const;
  //! Pixels of all files of a frame.
  [[nodiscard]] std::uintmax_t frame_pixels() const;
  //! Warns if the missing frames of `next` to `last`, each of this size, do not fit on the disk.
  [[nodiscard]] std::string room_note_for(int next, int last, const std::string& what, double frame_bytes) const;
  //! How many of the frames `next` to `last` are not there.
  [[nodiscard]] long missing(int next, int last) const;

  const RenderOptions& options_;
  MadeFiles made_;
  FrameFormat format_;
  ViewChoice choice_;
  Backend backend_;
  std::shared_ptr<StationStream> stream_;  //!< none: no trajectory
  ShowRenderer renderer_;
  FrameRequests requests_;
  std::optional<ProjectorFrames> projectors_;
  int written_ = 0;
  int exposed_ = -1;            //!< the frame that exposure goes on to
  std::string followed_from_;   //!< its stops, as a file has them
  bool told_narrowed_ = false;  //!< that eyes stand closer than the show asks
  int resumed_ = 0;
  int renewed_ = 0;
  RunFrameCost frame_cost_;                  //!< of the frame that was written last
  bool told_cost_ = false;                   //!< whether the estimate was printed
  std::uintmax_t largest_bytes_ = 0;         //!< of the largest frame so far
  int looked_at_room_after_ = 0;             //!< frames that were written
  bool told_room_ = false;                   //!< that the disk has no room
  std::set<std::filesystem::path> cleared_;  //!< folders of frames, without what killed programs have left there
  long unresolved_ = 0;
  bool told_no_legend_ = false;
};

}  // namespace ergodome
