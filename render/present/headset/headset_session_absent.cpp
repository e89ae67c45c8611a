#include "kernels/core/error.h"
#include "render/present/headset/headset_session.h"

// For builds without OpenXR's headers: there is never a session, so only its constructor is called.

namespace ergodome {

struct HeadsetSession::State {};

HeadsetSession::HeadsetSession() {
  throw Error("headset", "this program was built without OpenXR", "install libopenxr-dev and build again");
}

HeadsetSession::~HeadsetSession() = default;
void HeadsetSession::poll() {}
HeadsetState HeadsetSession::state() const { return HeadsetState::waiting; }
std::optional<HeadsetFrame> HeadsetSession::begin_frame() { return std::nullopt; }
std::optional<HeadsetEyes> HeadsetSession::locate() { return std::nullopt; }
unsigned HeadsetSession::begin_eye(int /*eye*/) { return 0; }
void HeadsetSession::end_eye(int /*eye*/) {}
void HeadsetSession::end_frame(const std::optional<HeadsetEyes>& /*eyes*/) {}
HeadsetHands HeadsetSession::hands() { return {}; }
void HeadsetSession::pulse(int /*hand*/, double /*seconds*/, double /*strength*/) {}
ImageSize HeadsetSession::eye_size() const { return {0, 0}; }
bool HeadsetSession::encoded() const { return true; }
HeadsetOrigin HeadsetSession::origin() const { return HeadsetOrigin::head; }
bool HeadsetSession::take_recentered() { return false; }
std::string HeadsetSession::name() const { return {}; }

}  // namespace ergodome
