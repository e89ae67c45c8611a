// The frame loop: waiting, beginning and ending frames, and the clock of the display.
#include <ctime>

#include "tests/support/openxr_runtime/runtime_functions.h"
#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

//! The first display time at the pace `fast`. It is fixed, so that every run sees the same poses.
constexpr XrTime fast_start_ns = 1'000'000'000'000;

XrTime monotonic_ns() {
  std::timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return XrTime{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

//! Waits for the next frame and returns when it will be displayed.
XrTime next_display_time() {
  Runtime& state = runtime();
  const XrTime period_ns = state.script.period_ns();
  if (state.script.has("time_jumps") && state.frame() % 20 == 0) {
    state.jumped_ns += 500'000'000;
  }
  if (!state.script.waits_in_real_time) {
    return state.display_time_ns == 0 ? fast_start_ns
                                      : state.display_time_ns + period_ns + std::exchange(state.jumped_ns, 0);
  }
  // The display refreshes at multiples of the period; a frame starts at one and is displayed at the next.
  const XrTime now_ns = monotonic_ns();
  const XrTime last_ns = state.display_time_ns - state.jumped_ns;
  const XrTime start_ns = std::max((now_ns / period_ns + 1) * period_ns, last_ns);
  sleep_unlocked(std::chrono::nanoseconds(start_ns - now_ns));
  return std::max(start_ns + period_ns + state.jumped_ns, state.display_time_ns + 1);
}

//! Forgets what old frames have recorded.
void forget_old_frames(Session& session) {
  const XrTime oldest = runtime().display_time_ns - 100 * runtime().script.period_ns();
  session.located.erase(session.located.begin(), session.located.lower_bound(oldest));
  session.should_render.erase(session.should_render.begin(), session.should_render.lower_bound(oldest));
}

}  // namespace

XrResult wait_frame(XrSession handle, const XrFrameWaitInfo* info, XrFrameState* frame) {
  {
    Session& session = running_session(handle);
    if (info != nullptr) {
      check_structure(info, XR_TYPE_FRAME_WAIT_INFO);
    }
    check_structure(frame, XR_TYPE_FRAME_STATE);
    if (!session.waited.empty()) {
      runtime_log().violation("frame_order", "xrWaitFrame before xrBeginFrame of the previous frame");
    }
  }
  const XrTime display_time_ns = next_display_time();
  // Waiting may have let another thread destroy the session.
  Session& session = running_session(handle);
  runtime().display_time_ns = display_time_ns;
  forget_old_frames(session);
  const bool renders = session.state == XR_SESSION_STATE_VISIBLE || session.state == XR_SESSION_STATE_FOCUSED;
  session.waited.push_back(display_time_ns);
  session.should_render[display_time_ns] = renders;
  frame->predictedDisplayTime = display_time_ns;
  frame->predictedDisplayPeriod = runtime().script.period_ns();
  frame->shouldRender = renders ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult begin_frame(XrSession handle, const XrFrameBeginInfo* info) {
  Session& session = running_session(handle);
  if (info != nullptr) {
    check_structure(info, XR_TYPE_FRAME_BEGIN_INFO);
  }
  if (session.waited.empty()) {
    fail(XR_ERROR_CALL_ORDER_INVALID, "frame_order", "xrBeginFrame without xrWaitFrame");
  }
  const bool discards = session.begun.has_value();
  session.begun = session.waited.front();
  session.waited.pop_front();
  if (discards) {
    runtime_log().note("frame_discarded", "xrBeginFrame without xrEndFrame of the previous frame");
  }
  return discards ? XR_FRAME_DISCARDED : XR_SUCCESS;
}

XrResult end_frame(XrSession handle, const XrFrameEndInfo* info) {
  Runtime& state = runtime();
  Session& session = running_session(handle);
  check_structure(info, XR_TYPE_FRAME_END_INFO);
  if (!session.begun) {
    fail(XR_ERROR_CALL_ORDER_INVALID, "frame_order", "xrEndFrame without xrBeginFrame");
  }
  if (info->displayTime != *session.begun) {
    fail(XR_ERROR_TIME_INVALID, "display_time",
         "displayTime is " + std::to_string(info->displayTime) + ", predicted " + std::to_string(*session.begun));
  }
  if (info->environmentBlendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE) {
    fail(XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED, "blend_mode",
         "mode " + std::to_string(info->environmentBlendMode) + " is not offered");
  }
  const bool renders = session.should_render[info->displayTime];
  if (info->layerCount > 0 && !renders) {
    runtime_log().note("layers_not_wanted", "the frame has layers although shouldRender is false");
  }
  const Json layers = check_layers(session, *info);
  runtime_log().write({{"frame", state.frame()},
                       {"display_time_ns", info->displayTime},
                       {"should_render", renders},
                       {"layers", layers}});
  session.begun.reset();
  state.frames_with_layers += info->layerCount > 0 ? 1 : 0;
  ++state.frames;
  advance_state(session);
  if (state.script.has("gl_error")) {
    leave_gl_error();
  }
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
