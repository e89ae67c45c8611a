#include "app/pads/pad_session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ergodome {

namespace {

//! Thresholds for stuck axes, in PadResponse::position(): the minimum deflection, and the minimum
//! motion that ends being stuck.
constexpr double deflected = 0.2;
constexpr double moved = 0.05;

}  // namespace

PadSession::PadSession(PadIdentity identity, std::unique_ptr<HidDevice> device, std::unique_ptr<PadDecoder> decoder,
                       const PadProfile& profile, double stuck_after_s, double now_s)
    : identity_(std::make_shared<const PadIdentity>(std::move(identity))),
      device_(std::move(device)),
      decoder_(std::move(decoder)),
      profile_(profile),
      stuck_after_s_(stuck_after_s),
      response_(decoder_->layout(), profile_),
      raw_(at_rest(decoder_->layout())),
      last_report_s_(now_s),
      last_input_s_(-std::numeric_limits<double>::infinity()) {
  for (std::size_t i = 0; i < still_.size(); ++i) {
    still_[i] = {raw_.values[i], now_s};
  }
  switch_mode();
}

void PadSession::switch_mode() {
  if (!profile_.mode_switch) {
    return;
  }
  for (PadRequest& request : decoder_->mode_switch()) {
    if (request.kind == PadRequest::Kind::get_feature) {
      device_->get_feature(request.bytes);
    } else {
      device_->write(request.bytes);
    }
  }
}

int PadSession::pump(std::span<std::uint8_t> buffer, const std::function<double()>& now_s, int wait_ms) {
  int count = 0;
  while (count < max_reports) {
    const int got = device_->read_timeout(buffer, count == 0 ? wait_ms : 0);
    if (got < 0) {
      return -1;
    }
    if (got == 0) {
      break;
    }
    take(ReportBytes(buffer).first(std::min(static_cast<std::size_t>(got), buffer.size())), now_s());
    ++count;
  }
  return count;
}

void PadSession::take(ReportBytes report, double now_s) {
  ++reports_;
  const PadReport kind = decoder_->decode(report, raw_);
  if (kind == PadReport::refused) {
    ++refused_;
    return;
  }
  if (kind == PadReport::other) {
    return;
  }
  last_report_s_ = now_s;
  silent_ = false;
  absent_ = kind == PadReport::absent;
  if (kind == PadReport::changed) {
    response_ = PadResponse(decoder_->layout(), profile_);
  }
  if (absent_) {
    raw_ = at_rest(decoder_->layout());
  }
  note_motion(now_s);
  update(now_s);
}

void PadSession::note_motion(double now_s) {
  for (std::size_t i = 0; i < std::min(layout().axes.size(), max_raw_axes); ++i) {
    Still& still = still_[i];
    if (raw_.values[i] == still.value) {
      continue;
    }
    // A stuck axis that jitters is still stuck, so its reference value is kept.
    if (ignored_[i] && std::abs(response_.position(i, raw_.values[i]) - response_.position(i, still.value)) < moved) {
      continue;
    }
    ignored_.reset(i);
    still = {raw_.values[i], now_s};
  }
}

void PadSession::update(double now_s) {
  const PadState before = state_;
  state_ = response_.apply(raw_, ignored_, before);
  if (state_ == before) {
    return;
  }
  last_input_s_ = now_s;
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    if (state_.buttons[i] && !before.buttons[i] && presses_[i] < std::numeric_limits<std::uint16_t>::max()) {
      ++presses_[i];
    }
  }
}

bool PadSession::check_axis(std::size_t axis, double now_s) {
  const Still& still = still_[axis];
  if (ignored_[axis] || now_s - still.since_s < stuck_after_s_ ||
      std::abs(response_.position(axis, still.value)) < deflected) {
    return false;
  }
  ignored_.set(axis);
  return true;
}

void PadSession::watch(double now_s) {
  const double silence_s = decoder_->silent_after_s();
  if (silence_s > 0.0 && !silent_ && now_s - last_report_s_ > silence_s) {
    silent_ = true;
    raw_ = at_rest(layout());
    note_motion(now_s);
    state_ = response_.apply(raw_, ignored_, {});
  }
  if (stuck_after_s_ <= 0.0) {
    return;
  }
  bool any = false;
  for (std::size_t i = 0; i < std::min(layout().axes.size(), max_raw_axes); ++i) {
    any = check_axis(i, now_s) || any;
  }
  if (any) {
    // The state changes because an axis is now ignored. This must not count as input of a user.
    state_ = response_.apply(raw_, ignored_, state_);
  }
}

void PadSession::release() {
  raw_ = at_rest(layout());
  state_ = {};
}

PadPresses PadSession::take_presses() { return std::exchange(presses_, {}); }

}  // namespace ergodome
