#pragma once

#include <optional>
#include <string>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "render/picture/picture.h"

namespace CLI {
class App;
}

namespace ergodome {

//! Adds --view: the sky or a heat map.
void add_view_option(CLI::App& command, std::string& view);

//! Adds --method: the integrator that traces the rays of a heat map.
void add_method_option(CLI::App& command, std::string& method);

//! Returns the mode with this name, which must be one that --view accepts.
ViewMode view_mode(const std::string& name);

//! Parses the color range of a heat map, "MIN:MAX"; empty text gives nothing, the default range.
//! `logarithmic_steps`: heat maps of steps have a logarithmic scale. Throws UsageError for
//! malformed text, for the view `sky`, and for a MIN of 0 or less with a logarithmic scale.
std::optional<ViewRange> view_range(const std::string& text, ViewMode mode, bool logarithmic_steps);

//! Returns the method with this name of --method; nothing if the name is empty. Throws UsageError
//! if there is a name but the view is not a heat map of steps or errors, or the show's stereo has a
//! camera for each pixel.
std::optional<TraceMethod> follow_method(const std::string& name, const std::string& view, const Show& show);

}  // namespace ergodome
