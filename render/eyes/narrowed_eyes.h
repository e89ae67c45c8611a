#pragma once

#include <optional>
#include <string>

#include "content/camera/camera_path.h"
#include "content/show/show.h"

namespace ergodome {

//! Eyes that are less far apart than was asked for: more does not fit where the camera is (render/lens/eye_distance.h).
struct NarrowedEyes {
  StereoModel model = StereoModel::physical;
  double r = 0.0;         //!< of the head [M]
  double asked = 0.0;     //!< [M]
  double baseline = 0.0;  //!< [M]
};

//! Where on a show's camera path eyes stand closer than the show asks.
struct NarrowedPath {
  double first_s = 0.0;  //!< show time at which that begins
  NarrowedEyes first;
  double least_s = 0.0;  //!< and at which they are closest, of the times that were looked at
  NarrowedEyes least;
};

//! Looks through a show's path, at 33 times and where it turns; nothing where eyes stand as the show asks, for one eye and for the model `physical`.
std::optional<NarrowedPath> narrowed_path(const Show& show);

//! A sentence about a picture at a time of the show, for the person who made it, with the baseline's line if the show has one.
std::string note_of(const Show& show, double time_s, const NarrowedEyes& eyes);

//! The same about the whole path.
std::string note_of(const Show& show, const NarrowedPath& path);

}  // namespace ergodome
