#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "render/picture/picture.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ergodome {

//! Reads a show from a path, or a built-in one by its name ("first-light"), with the changes of
//! --set. Throws UsageError if these are invalid.
Show load_show(const std::string& name_or_path, const ShowSettings& settings = {});

//! Adds --set, which may be repeated. `settings` must outlive the command.
CLI::Option* add_set_option(CLI::App& command, ShowSettings& settings);

//! Returns the names of ViewProjection, in its order.
std::vector<std::string> projection_names();

//! Returns the names of StereoLayout, in its order.
std::vector<std::string> stereo_names();

//! Replaces the show's projection and stereo layout by those of the command line (empty: not
//! given).
void override_view(Show& show, const std::string& projection, const std::string& stereo);

//! Replaces the show's baseline [M] and removes its animation.
void override_baseline(Show& show, const std::optional<double>& baseline);

//! Sets the tilt of a show's dome, which overrides the show and a dome setup. Throws UsageError
//! without a setup if the show's projection is not a dome.
void override_tilt(Show& show, const std::optional<double>& tilt_deg, bool has_setup);

//! Throws UsageError if `option`, which is for stereo, is given for a mono show.
void require_two_eyes(const Show& show, const std::string& option, bool given);

//! Prints a note if a show's two eyes always see the same.
void tell_equal_eyes(const Show& show);

//! Returns the names of ObjectMethod, in its order.
std::vector<std::string> object_method_names();

//! Replaces the show's method of drawing objects (empty: not given). Throws Error if they cannot be
//! drawn with it.
void override_objects(Show& show, const std::string& method);

//! Throws Error if a time is outside the show; `option` names it in the message.
void require_time(const std::string& option, const Show& show, double time_s);

//! Throws Error if the show needs a feature that this version cannot draw.
void require_features(const Show& show);

//! Return the names of ViewMode on the command line, and the mode of a name.
std::vector<std::string> view_mode_names();
ViewMode view_mode(const std::string& name);

//! Parses the color range of a heat map, "MIN:MAX" (empty: the default). Throws UsageError for
//! malformed text, and for a view without a range.
std::optional<ViewRange> view_range(const std::string& text, ViewMode mode, bool logarithmic_steps);

//! Returns the names of the methods for tracing the rays of a heat map.
std::vector<std::string> follow_method_names();

//! Returns the method with this name (empty: none). Throws Error if the view and the show trace no
//! rays with it.
std::optional<TraceMethod> follow_method(const std::string& name, const std::string& view, const Show& show);

}  // namespace ergodome
