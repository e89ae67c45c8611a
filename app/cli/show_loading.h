#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "render/frame/eye_renderer.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ergodome {

//! Reads a show from a path, or a built-in one by its name ("first-light"), with what --set changes in it. Throws UsageError
//! where that makes no sense.
Show load_show(const std::string& name_or_path, const ShowSettings& settings = {});

//! Adds --set, which may be repeated. `settings` outlive the command.
CLI::Option* add_set_option(CLI::App& command, ShowSettings& settings);

//! The words for ViewProjection, in its order.
std::vector<std::string> projection_names();

//! The words for StereoLayout, in its order.
std::vector<std::string> stereo_names();

//! Puts the projection and stereo layout of the command line (empty: none) in place of the show's.
void override_view(Show& show, const std::string& projection, const std::string& stereo);

//! Puts a distance of the eyes [M] in place of the show's, and of what changes it with time.
void override_baseline(Show& show, const std::optional<double>& baseline);

//! Sets the tilt of a show's dome, over the show and over a dome setup. Throws UsageError without a setup if the
//! show's projection is not a dome.
void override_tilt(Show& show, const std::optional<double>& tilt_deg, bool has_setup);

//! Throws UsageError where `option`, which is about two eyes, is given for pictures that nothing but one eye sees.
void require_two_eyes(const Show& show, const std::string& option, bool given);

//! Says on the terminal where a show has two eyes that see the same all the time.
void tell_equal_eyes(const Show& show);

//! The words for ObjectMethod, in its order.
std::vector<std::string> object_method_names();

//! Draws the show's objects by the command line's method (empty: none) in place of the show's. Throws Error where they cannot be drawn so.
void override_objects(Show& show, const std::string& method);

//! Throws Error where a time is none of the show's; `option` is what asked for it.
void require_time(const std::string& option, const Show& show, double time_s);

//! Throws Error naming what the show asks for and this version cannot draw.
void require_features(const Show& show);

//! The words for ViewMode on the command line, and the mode of a word.
std::vector<std::string> view_mode_names();
ViewMode view_mode(const std::string& name);

//! The ends of a heat map's colours of "MIN:MAX" (empty: the usual ones). Throws UsageError for what is no range, and for a view that has none.
std::optional<ViewRange> view_range(const std::string& text, ViewMode mode, bool logarithmic_steps);

//! The words for how rays of a heat map are followed.
std::vector<std::string> follow_method_names();

//! The method of a word (empty: none). Throws Error where pictures of the view and the show have no rays to follow so.
std::optional<TraceMethod> follow_method(const std::string& name, const std::string& view, const Show& show);

}  // namespace ergodome
