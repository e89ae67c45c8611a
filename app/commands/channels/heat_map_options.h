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

//! Returns the mode with a name of --view.
ViewMode view_mode(const std::string& name);

//! Parses the color range of a heat map, "MIN:MAX" (empty: the default). Throws UsageError for
//! malformed text, and for a view without a range.
std::optional<ViewRange> view_range(const std::string& text, ViewMode mode, bool logarithmic_steps);

//! Returns the method with this name (empty: none). Throws Error if the view and the show trace no
//! rays with it.
std::optional<TraceMethod> follow_method(const std::string& name, const std::string& view, const Show& show);

}  // namespace ergodome
