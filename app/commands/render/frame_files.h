#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/cli/setup_show.h"
#include "app/commands/render/created_files.h"
#include "app/commands/render/followed_light.h"
#include "app/commands/render/frame_request.h"
#include "app/commands/render/render_options.h"
#include "render/frame/show_renderer.h"
#include "render/output/frame_files.h"
#include "render/output/stereo_layout.h"
#include "render/present/output.h"

namespace ergodome {

//! Returns the format of the files. Throws Error if the format does not support the compression.
FrameFormat format_of(const RenderOptions& options);

//! Writes the frames of a run to numbered files. For each frame, call go_to(), render what wish()
//! returns, and pass it to take().
class FrameFiles : public Output {
 public:
  //! `renderer` renders the frames; its show and exposure go into the files' metadata. With
  //! `setup`, the pictures of that dome's projectors are written instead of the domemaster.
  //! `requests` are the fingerprints stored in the files. Creates the output folder. Options and
  //! renderer must outlive this.
  FrameFiles(const RenderOptions& options, const ShowRenderer& renderer, const ViewChoice& choice,
             const std::optional<DomeSetup>& setup, FrameRequests requests);

  //! Selects the frame, counted from 0, for wish() and take().
  void go_to(int frame) { frame_ = frame; }
  //! Returns the show time of the selected frame. With automatic exposure, if the frame before was
  //! not the last one wished for, also returns the stops in its file; if that frame is missing or
  //! has another fingerprint, prints a note.
  [[nodiscard]] OutputWish wish() override;
  //! Writes the files of the selected frame, with a color bar for heat maps.
  void take(OutputFrame& frame) override;

  //! Returns the constructor's choice for the pictures. For projectors without a given size, its
  //! size is that of the domemaster that they need.
  [[nodiscard]] const ViewChoice& choice() const { return choice_; }
  [[nodiscard]] const FrameFormat& format() const { return format_; }
  [[nodiscard]] std::filesystem::path path_of(int frame, FramePart part, std::optional<CubeFace> face) const;

  //! Returns whether the files of a frame exist, are complete and have its fingerprint, and whether
  //! its automatic exposure continues from the stops that the file of the frame before has.
  [[nodiscard]] bool is_there(int frame) const;
  //! Returns whether a frame of the show exists that has another fingerprint.
  [[nodiscard]] bool was_asked_otherwise(int frame) const;
  //! Returns the existing frames, from 0, before `first` and after `last` that have other
  //! fingerprints or are beyond the end of the show. Checks at most a few thousand frames.
  [[nodiscard]] std::vector<int> asked_otherwise(int first, int last) const;
  //! Returns the fingerprint of a frame's request.
  [[nodiscard]] std::string request_of(int frame) const;
  //! Returns how many of the frames `next` to `last` do not exist.
  [[nodiscard]] long missing(int next, int last) const;

  //! Writes the metadata summary of the frames first to last, extended to adjacent frames with the
  //! same fingerprints.
  void write_metadata(int first, int last) const;
  //! Removes the files that this run wrote and that have not changed since. If frames with this
  //! run's fingerprints remain, the metadata summary is rewritten for the first of them and those
  //! adjacent to it, otherwise removed. Returns the number of removed image files.
  int remove();

  //! Returns the size of all files of the last frame written [bytes].
  [[nodiscard]] std::uintmax_t bytes() const { return bytes_; }
  //! Returns the total number of pixels in the files of one frame.
  [[nodiscard]] std::uintmax_t frame_pixels() const;
  //! Returns the number of pixels, in all frames written, whose rays did not converge.
  [[nodiscard]] long unresolved() const { return unresolved_; }

 private:
  [[nodiscard]] int eye_width_px() const;
  //! Returns the stops that automatic exposure applied to the last picture; nothing without it, for
  //! heat maps, and for EXR files, which are linear.
  [[nodiscard]] std::optional<double> followed_stops() const;
  //! Returns the stops of the frame before `frame`, as text: with --light those that follow from
  //! the light, otherwise those in the frame's file. Returns the constant `anew` if there is no such
  //! light, or if that frame is missing, has another fingerprint or stores no stops.
  [[nodiscard]] std::string stops_before(int frame) const;
  //! Returns the first file of a frame: that of the left eye, the first cube face or the first
  //! projector, if these have files of their own.
  [[nodiscard]] std::filesystem::path first_file_of(int frame) const;
  [[nodiscard]] FrameMetadata metadata_of(const FrameImage& image, FramePart part) const;
  //! Prints a note, once, if heat maps are too small for their legend.
  void report_missing_legend(const Picture& picture);
  //! Creates a folder of frames and removes temporary files that killed programs left there.
  void enter(const std::filesystem::path& folder);
  [[nodiscard]] bool is_there(int frame, FramePart part) const;
  [[nodiscard]] bool was_asked_alike(int frame) const;
  //! Returns the numbers of the existing frames of this show.
  [[nodiscard]] std::vector<int> lying_there() const;
  //! Returns the size of each image file, if no projectors' pictures are written.
  [[nodiscard]] ImageSize picture_size() const;

  const RenderOptions& options_;
  const ShowRenderer& renderer_;
  ViewChoice choice_;
  FrameFormat format_;
  FrameRequests requests_;
  std::optional<ProjectorFrames> projectors_;
  std::optional<FollowedLight> light_;  //!< of --light
  CreatedFiles made_;
  int frame_ = 0;
  int exposed_ = -1;           //!< frame after the last one of wish(); its exposure needs no stops from files
  std::string followed_from_;  //!< exposure stops of the previous frame, as the text in its file
  std::uintmax_t bytes_ = 0;
  //! Folders already cleared of files that killed programs left.
  std::set<std::filesystem::path> cleared_;
  long unresolved_ = 0;
  bool reported_no_legend_ = false;
};

}  // namespace ergodome
