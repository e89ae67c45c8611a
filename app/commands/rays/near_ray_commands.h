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

//! What stands near the hole and `trace` may follow rays to, in place of the sky.
struct NearRayOptions {
  bool disk = false;
  bool plunging = false;
  std::optional<double> shell_r;
  std::string objects;  //!< a show whose objects are looked for; empty: none
  ShowSettings set;     //!< keys of that show that --set changes
  double time_s = 0.0;  //!< of that show
};

//! Tables to read and to write.
struct RayFiles {
  std::string rays;
  std::string out;
  double tolerance;  //!< 0: the finest
};

//! Adds --disk, --shell and --objects to a command; each excludes the others, and the options that are named.
std::shared_ptr<NearRayOptions> add_near_ray_options(CLI::App& command, const std::vector<CLI::Option*>& excluded);

//! Follows the rays to what was asked for; false where nothing was.
bool run_near_rays(const NearRayOptions& options, const RayFiles& files);

}  // namespace ergodome
