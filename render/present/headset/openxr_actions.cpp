#include "render/present/headset/openxr_actions.h"

namespace ergodome {

OpenXrActions::OpenXrActions(const OpenXrCalls& calls, XrInstance /*instance*/, const OpenXrLibrary& /*library*/)
    : calls_(calls) {}

void OpenXrActions::attach(XrSession /*session*/) {}

HeadsetHands OpenXrActions::read(XrSession /*session*/) {
  static_cast<void>(calls_);
  return {};
}

void OpenXrActions::pulse(XrSession /*session*/, int /*hand*/, double /*seconds*/, double /*strength*/) {}

}  // namespace ergodome
