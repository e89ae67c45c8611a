#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "content/show/show.h"
#include "render/output/image_writer.h"
#include "render/patterns/pattern_place.h"
#include "render/present/projectors/headless_projectors.h"

namespace ergodome {

//! Makes a show render the domemaster that warps of a setup look up: 180°, equidistant, uncut, from
//! inside, correct as seen from the setup's viewer. A tilt that the setup states replaces the show's,
//! unless that is artistic. Throws Error for layouts that put two eyes into one picture, and UsageError if
//! the command line's `stereo` (empty: none) asked for one.
void fit_to_setup(Show& show, const DomeSetup& setup, const std::string& stereo = {});

//! The projectors' names for files: what of them is plain, and different for each.
std::vector<std::string> plain_names(const DomeSetup& setup);

//! Writes what the projectors show of numbered frames, without a display.
class ProjectorFrames {
 public:
  //! Throws Error as HeadlessProjectors does.
  ProjectorFrames(const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures,
                  ProjectorDrawer drawer = ProjectorDrawer::automatic);

  //! Writes a PNG for each projector, named after `frame` (FOLDER/NAME_000001.png becomes FOLDER/NAME_000001_PROJECTOR.png).
  void write(const std::filesystem::path& frame, const Picture& master, const FrameMetadata& metadata = {});

  //! Pixels of all projectors.
  [[nodiscard]] std::uintmax_t pixels() const;

  //! These files.
  [[nodiscard]] std::vector<std::filesystem::path> paths_of(const std::filesystem::path& frame) const;

  //! Whether all of these files are there and complete, and were asked for alike (FrameMetadata's "request").
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

//! Test patterns that projectors are to show.
struct ProjectedPatterns {
  std::string pattern;                       //!< its name, or "all"
  StereoLayout layout = StereoLayout::mono;  //!< or `separate`: each eye's own, in L/ and R/
  int size_px = 0;                           //!< width of the domemaster; 0: enough
  std::filesystem::path out;
};

//! Writes what the projectors show of them: PATTERN_PROJECTOR.png, and with all of them a sheet with its number for each,
//! number_PROJECTOR.png. Patterns stand upright in the dome as it is tilted. Returns how many files.
int write_pattern_frames(const ProjectedPatterns& asked, const DomeSetup& setup);

//! A setup's domemaster whose up is straight up where the dome shows it, tilted and turned as it is. Its front is the setup's rotation to the right of the
//! dome's.
PatternView upright_master(const DomeSetup& setup, int size_px);

}  // namespace ergodome
