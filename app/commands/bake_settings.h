#pragma once

#include "content/show/show.h"
#include "render/bake/trajectory_baker.h"

namespace ergodome {

//! Returns the settings with which a show is baked in one part for frames of this width (0: the
//! show's) and this error budget in pixels (0: the show's).
BakeSettings bake_settings(const Show& show, int size_px, double budget_px);

}  // namespace ergodome
