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
                                 ? fmt::format("write tilt_deg = {:g} into a setup that is made of it", setup.tilt_deg)
                                 : std::string("keep this setup");
  return fmt::format(
      "; tilt_deg and rotation_deg are in its {}, and MPCDI does not tell them: for level test patterns {}",
      flat ? "warps" : "places", remedy);
}

}  // namespace ergodome
