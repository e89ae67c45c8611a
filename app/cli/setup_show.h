#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "content/show/show.h"
#include "render/output/image_writer.h"
#include "render/patterns/pattern_position.h"
#include "render/present/projectors/headless_projectors.h"

namespace ergodome {

//! Makes a show render the domemaster that the warps of a setup sample: 180°, equidistant,
//! uncropped, from inside, correct as seen from the setup's viewer. A tilt given in the setup
//! replaces the show's, unless the show's tilt is artistic (ViewSettings::artistic_tilt). Throws
//! Error if the show's layout is neither `mono` nor `separate`; the error is a UsageError if the
//! layout was given on the command line, as `stereo` (empty: not given).
void fit_to_setup(Show& show, const DomeSetup& setup, const std::string& stereo = {});

//! Makes a show render the whole sky as a strip of six faces of a cube, with the stereo model of its
//! headset settings.
void fit_to_headset(Show& show);

//! Returns the projectors' names for files: characters other than letters, digits and - become _,
//! and a name that is already taken gets its projector's number added.
std::vector<std::string> plain_names(const DomeSetup& setup);

//! Writes the images that a dome's projectors show of numbered frames, without a display.
class ProjectorFrames {
 public:
  //! Throws Error if HeadlessProjectors does: if OpenGL is requested but not available, or if a GPU
  //! lacks memory.
  ProjectorFrames(const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures,
                  ProjectorDrawer drawer = ProjectorDrawer::automatic);

  //! Writes a PNG for each projector, named after `frame` (FOLDER/NAME_000001.png becomes
  //! FOLDER/NAME_000001_PROJECTOR.png).
  void write(const std::filesystem::path& frame, const Picture& master, const FrameMetadata& metadata = {});

  //! Returns the total number of pixels of all projectors.
  [[nodiscard]] std::uintmax_t pixels() const;

  //! Returns the files that write() writes for a frame.
  [[nodiscard]] std::vector<std::filesystem::path> paths_of(const std::filesystem::path& frame) const;

  //! Returns whether all files of a frame (paths_of()) exist, are complete and have this
  //! fingerprint (FrameMetadata's "request").
  [[nodiscard]] bool are_there(const std::filesystem::path& frame, const std::string& request) const;

 private:
  struct Raster {
    std::string name;
    int width_px;
    int height_px;
  };
  [[nodiscard]] static std::filesystem::path path_of(const std::filesystem::path& frame, const Raster& raster);

  std::vector<Raster> rasters_;
  HeadlessProjectors projectors_;
};

//! Options for writing test patterns for projectors.
struct ProjectedPatterns {
  std::string pattern;                       //!< name of a pattern, or "all"
  StereoLayout layout = StereoLayout::mono;  //!< or `separate`: one for each eye, in L/ and R/
  //! Width of the domemaster; 0: sufficient for the projectors.
  int size_px = 0;
  std::filesystem::path out;
};

//! Writes the projectors' views of test patterns: PATTERN_PROJECTOR.png, and with "all" also a
//! picture with each projector's number, number_PROJECTOR.png. Patterns are upright in a tilted
//! dome. Returns the number of files.
int write_pattern_frames(const ProjectedPatterns& asked, const DomeSetup& setup);

//! Returns the projection of a setup's domemaster, `size_px` wide, with the rotation by which
//! projectors turn it to the right: patterns that are drawn for it are level in the tilted dome.
PatternView upright_master(const DomeSetup& setup, int size_px);

}  // namespace ergodome
