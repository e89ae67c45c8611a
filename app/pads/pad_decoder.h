#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "app/pads/hid/hid_api.h"
#include "app/pads/hid/report_bytes.h"
#include "app/pads/pad_raw.h"

namespace ergodome {

//! What a report was.
enum class PadReport {
  state,    //!< the pad's state
  other,    //!< known, and not about the state: a battery, an answer
  absent,   //!< a receiver says that no pad is with it
  changed,  //!< the layout is another now
  refused   //!< unknown id, wrong length, wrong checksum
};

//! A message that asks a pad for another kind of reports.
struct PadRequest {
  enum class Kind { write, get_feature } kind = Kind::write;
  std::vector<std::uint8_t> bytes;  //!< of get_feature: the id, and room for the answer
};

//! Reads the reports of one kind of pads. Whatever the bytes are, it reads none beyond a report's end.
class PadDecoder {
 public:
  PadDecoder() = default;
  PadDecoder(const PadDecoder&) = delete;
  PadDecoder& operator=(const PadDecoder&) = delete;
  virtual ~PadDecoder() = default;

  //! Returns the model that the decoder is for: "DualSense"; for unknown devices "described by its report descriptor".
  [[nodiscard]] virtual std::string_view model() const = 0;
  [[nodiscard]] virtual const RawLayout& layout() const = 0;
  //! Takes a report into `pad`, which holds what the last ones said; a refused report leaves it as it was.
  virtual PadReport decode(ReportBytes report, RawPad& pad) = 0;
  //! After so long without a report the pad counts as let go [s]; 0: it reports changes alone.
  [[nodiscard]] virtual double silent_after_s() const { return 0.0; }
  //! What asks the pad for its full reports; empty where there is nothing to ask.
  [[nodiscard]] virtual std::vector<PadRequest> mode_switch() const { return {}; }
};

//! All raw axes at rest, no button pressed.
RawPad at_rest(const RawLayout& layout);

//! Whether a device is a pad, joystick, or puck that is read, by its vendor, product and usages.
bool is_pad(const HidDeviceInfo& info);

//! The decoder of a device that is one; empty where its reports cannot be read (`descriptor` is empty or says nothing of axes).
std::unique_ptr<PadDecoder> make_pad_decoder(const HidDeviceInfo& info, std::span<const std::uint8_t> descriptor);

}  // namespace ergodome
