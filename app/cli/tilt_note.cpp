#include "app/cli/tilt_note.h"

#include <fmt/format.h>

namespace ergodome {

std::string tilt_note(const DomeSetup& setup, const Mpcdi& mpcdi) {
  if (setup.tilt_deg == 0.0) {
    return {};
  }
  const bool flat = mpcdi.profile == MpcdiProfile::media_2d;
  // A tilt that is written beside places in the dome's own axes would tilt them again, and a rotation beside warps turn these again.
  const std::string remedy = flat && setup.rotation_deg == 0.0
                                 ? fmt::format("set tilt_deg = {:g} in setups converted from it", setup.tilt_deg)
                                 : std::string("keep the original setup");
  return fmt::format(
      "; its {} include tilt_deg and rotation_deg, which MPCDI does not store: for level test patterns, {}",
      flat ? "warps" : "positions", remedy);
}

}  // namespace ergodome
