#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/formats/mpcdi/xml_element.h"

namespace ergodome {

//! Reads a <region> of a display, without its files. Adds unsupported features (color tables) to
//! `left_out`.
MpcdiRegion read_mpcdi_region(const XmlElement& element, std::vector<std::string>& left_out);

//! Returns the lens in a <region> of Christie's BufferExtension; nothing if it has none.
std::optional<MpcdiFisheye> read_mpcdi_lens(const XmlElement& element);

//! Throws Error if a region lacks what its profile requires (VESA MPCDI 2.0, 3.5), or its frustum
//! is impossible.
void check_mpcdi_region(const MpcdiRegion& region, MpcdiProfile profile, const XmlElement& element);

}  // namespace ergodome
