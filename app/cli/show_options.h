#pragma once

#include <optional>
#include <string>

#include "content/show/show.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ergodome {

//! Options that replace settings of a show; empty: not given.
struct ShowOverrides {
  ShowSettings set;  //!< keys changed by --set
  std::string projection;
  std::string objects;  //!< method of drawing objects
  std::string stereo;   //!< stereo layout
  std::optional<double> tilt_deg;
  std::optional<double> baseline;  //!< interocular distance [M]
};

// Add options to a command; `overrides` must outlive it.

//! Adds --set, which may be repeated.
CLI::Option* add_set_option(CLI::App& command, ShowSettings& settings);
//! Begins the group "Picture" with --projection and --tilt. `tilt_source` says where the tilt comes
//! from by default: "the show's".
void add_projection_options(CLI::App& command, ShowOverrides& overrides, const char* tilt_source);
//! Adds --objects.
void add_objects_option(CLI::App& command, ShowOverrides& overrides);
//! Begins the group "Stereo" with --stereo and --baseline.
void add_stereo_options(CLI::App& command, ShowOverrides& overrides);

//! Applies all overrides but those of --set, and removes animations of the overridden keys. Another
//! projection also gets its default field of view. Throws UsageError for a tilt without a dome
//! (`has_setup`: the show's projection is replaced by a dome setup's), and if the method is for
//! objects that the show lacks or that cannot be drawn with it.
void apply_overrides(Show& show, const ShowOverrides& overrides, bool has_setup);

}  // namespace ergodome
