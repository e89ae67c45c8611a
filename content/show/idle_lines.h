#pragma once

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! A line of a show's file that changes nothing, as what it is about is not called for.
struct IdleLine {
  std::string key;  //!< by its path ("tone.gamma", "animate.tone.gamma")
  int line = 0;
  std::string why;  //!< "is used only with curve = \"gamma\""
};

//! The lines of a show that belong to a curve, a pattern, a filter, a projection or stars that it does not have, in the order of the file. Lines of a show
//! that came from no file are none.
std::vector<IdleLine> idle_lines(const Show& show);

}  // namespace ergodome
