#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/show/show.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ergodome {

//! Options of `trace` for targets near the hole instead of the sky.
struct NearRayOptions {
  bool disk = false;
  bool plunging = false;
  std::optional<double> shell_r;
  std::string objects;  //!< a show whose objects are hit; empty: none
  ShowSettings set;     //!< keys of the show in `objects` changed by --set
  double time_s = 0.0;  //!< time in the show in `objects` [s]
};

//! Input and output tables of `trace`.
struct RayFiles {
  std::string rays;
  std::string out;
  double tolerance;  //!< tolerance of the integrator; 0: the default, 1e-15
};

//! Adds --disk, --shell and --objects to a command. Each excludes the others and the options in
//! `excluded`.
std::shared_ptr<NearRayOptions> add_near_ray_options(CLI::App& command, const std::vector<CLI::Option*>& excluded);

//! Traces the rays to the requested target. Returns false if none was requested.
bool run_near_rays(const NearRayOptions& options, const RayFiles& files);

}  // namespace ergodome
