#pragma once

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! An unused key of a show file: it belongs to a feature that the show does not use.
struct UnusedKey {
  std::string key;  //!< path of the key ("tone.gamma", "animate.tone.gamma")
  int line = 0;
  std::string why;  //!< text for a message, such as "is used only with curve = \"gamma\""
};

//! Returns the unused keys of a show, in the order of its file: those for which ShowKey::unused
//! returns a reason, such as keys of a tone curve or projection that the show does not use. Empty
//! for a show that was not read from a file.
std::vector<UnusedKey> unused_keys(const Show& show);

}  // namespace ergodome
