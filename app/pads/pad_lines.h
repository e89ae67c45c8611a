#pragma once

#include <string>

#include "app/pads/pad_hub.h"

namespace ergodome {

//! Formats a controller's live values on a line: "1 Wireless Controller (USB): left -0.12 +0.98
//! right +0.00 +0.00  triggers 0.00 0.50  south".
std::string live_line(const PadView& pad);

}  // namespace ergodome
