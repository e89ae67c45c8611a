#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "app/pads/decoders/report_bytes.h"
#include "app/pads/hid/hid_api.h"
#include "app/pads/state/pad_state.h"

namespace ergodome {

//! Result of decoding a report.
enum class PadReport {
  state,    //!< the controller's state
  other,    //!< a known report without a state, such as a battery level or the answer to a request
  absent,   //!< a receiver reports that it has no controller
  changed,  //!< the controller's state, and the ranges in layout() changed
  refused   //!< unknown id, wrong length or wrong checksum
};

//! A message that makes a controller send another kind of report.
struct PadRequest {
  enum class Kind { write, get_feature } kind = Kind::write;
  std::vector<std::uint8_t> bytes;  //!< for get_feature: the id, and space for the answer
};

//! Reads the reports of one kind of controller. Never reads beyond the end of a report, whatever
//! its bytes are.
class PadDecoder {
 public:
  PadDecoder() = default;
  PadDecoder(const PadDecoder&) = delete;
  PadDecoder& operator=(const PadDecoder&) = delete;
  virtual ~PadDecoder() = default;

  //! Returns the model that the decoder is for: "DualSense"; for unknown devices "described by its
  //! report descriptor".
  [[nodiscard]] virtual std::string_view model() const = 0;
  [[nodiscard]] virtual const RawLayout& layout() const = 0;
  //! Updates `pad`, which holds the state after earlier reports. A refused report leaves it
  //! unchanged.
  virtual PadReport decode(ReportBytes report, RawPad& pad) = 0;
  //! Returns the time without reports [s] after which the controller counts as released; 0 if it
  //! reports only changes.
  [[nodiscard]] virtual double silent_after_s() const { return 0.0; }
  //! Returns the messages that request full reports; empty if none are needed.
  [[nodiscard]] virtual std::vector<PadRequest> mode_switch() const { return {}; }
};

//! Returns a state with all raw axes at rest and no button pressed.
RawPad at_rest(const RawLayout& layout);

//! Returns whether a device is a controller, joystick or 3D mouse by its usages; if these are not
//! reported, whether its vendor and product are known.
bool is_pad(const HidDeviceInfo& info);

//! Makes the decoder of a controller: that of its model if vendor and product are known, otherwise
//! one from `descriptor`. Returns null if the device is not a controller, or if the descriptor is
//! needed and is malformed or has no axis or button of a controller.
std::unique_ptr<PadDecoder> make_pad_decoder(const HidDeviceInfo& info, std::span<const std::uint8_t> descriptor);

}  // namespace ergodome
