#include "app/cli/tilt_note.h"

#include <fmt/format.h>

namespace ergodome {

std::string tilt_note(const DomeSetup& setup, const Mpcdi& mpcdi) {
  if (setup.tilt_deg == 0.0) {
    return {};
  }
  const bool flat = mpcdi.profile == MpcdiProfile::media_2d;
  // Adding tilt_deg would tilt positions in the dome's axes again, and rotation_deg would rotate
  // warps again.
  const std::string remedy = flat && setup.rotation_deg == 0.0
                                 ? fmt::format("set tilt_deg = {:g} in setups converted from it", setup.tilt_deg)
                                 : std::string("keep the original setup");
  return fmt::format(
      "; its {} include tilt_deg and rotation_deg, which MPCDI does not store: for level test patterns, {}",
      flat ? "warps" : "positions", remedy);
}

}  // namespace ergodome
