// Sessions: creation, beginning and end.
#include "tests/support/openxr_runtime/runtime_functions.h"
#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

const XrGraphicsBindingOpenGLXlibKHR& checked_binding(const XrSessionCreateInfo& info) {
  const auto* const binding = static_cast<const XrGraphicsBindingOpenGLXlibKHR*>(info.next);
  if (binding == nullptr) {
    fail(XR_ERROR_GRAPHICS_DEVICE_INVALID, "graphics_binding", "XrGraphicsBindingOpenGLXlibKHR is missing");
  }
  if (binding->xDisplay == nullptr || binding->glxDrawable == 0 || binding->glxContext == nullptr) {
    fail(XR_ERROR_GRAPHICS_DEVICE_INVALID, "graphics_binding", "display, drawable or context is null");
  }
  return *binding;
}

}  // namespace

XrResult create_session(XrInstance instance, const XrSessionCreateInfo* info, XrSession* session) {
  Runtime& state = runtime();
  state.instances.at(instance);
  check_structure(info, XR_TYPE_SESSION_CREATE_INFO, {XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR});
  if (!state.has_graphics_requirements) {
    fail(XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING, "graphics_requirements",
         "xrGetOpenGLGraphicsRequirementsKHR was not called");
  }
  if (info->systemId != 1) {
    fail(XR_ERROR_SYSTEM_INVALID, "system", "system " + std::to_string(info->systemId) + " does not exist");
  }
  if (!state.sessions.empty()) {
    fail(XR_ERROR_LIMIT_REACHED, "second_session", "the first session is not destroyed");
  }
  Session created;
  created.binding = checked_binding(*info);
  created.created = std::chrono::steady_clock::now();
  if (state.script.has("changes_context")) {
    create_other_context(created);
  }
  *session = state.sessions.add(created);
  Session& stored = state.sessions.at(*session);
  queue_state(stored, XR_SESSION_STATE_IDLE);
  if (!state.script.has("not_focused_first")) {
    queue_state(stored, XR_SESSION_STATE_READY);
  }
  runtime_log().write({{"session", "created"}, {"frame", state.frame()}});
  return XR_SUCCESS;
}

XrResult destroy_session(XrSession handle) {
  Runtime& state = runtime();
  Session& session = state.sessions.at(handle);
  if (!state.swapchains.empty() || !state.spaces.empty()) {
    runtime_log().violation("destroy_order", "the session is destroyed before its swapchains or spaces");
    state.swapchains.clear();
    state.spaces.clear();
  }
  if (session.running && !session.lost && !state.instance_lost) {
    runtime_log().note("destroyed_while_running", "xrEndSession was not called");
  }
  destroy_other_context(session);
  state.sessions.remove(handle);
  for (auto& [set_handle, set] : state.action_sets) {
    set.attached = false;
  }
  state.events.clear();
  runtime_log().write({{"session", "destroyed"}, {"frame", state.frame()}});
  return XR_SUCCESS;
}

XrResult begin_session(XrSession handle, const XrSessionBeginInfo* info) {
  Session& session = live_session(handle);
  check_structure(info, XR_TYPE_SESSION_BEGIN_INFO);
  if (session.running) {
    fail(XR_ERROR_SESSION_RUNNING, "session_order", "the session is already running");
  }
  if (session.state != XR_SESSION_STATE_READY) {
    fail(XR_ERROR_SESSION_NOT_READY, "session_order", "the session is not READY");
  }
  view_count(info->primaryViewConfigurationType);
  session.views = info->primaryViewConfigurationType;
  session.running = true;
  session.waited.clear();
  session.begun.reset();
  runtime_log().write({{"session", "begun"}, {"frame", runtime().frame()}});
  return XR_SUCCESS;
}

XrResult end_session(XrSession handle) {
  Session& session = running_session(handle);
  if (session.state != XR_SESSION_STATE_STOPPING) {
    fail(XR_ERROR_SESSION_NOT_STOPPING, "session_order", "the session is not STOPPING");
  }
  session.running = false;
  runtime_log().write({{"session", "ended"}, {"frame", runtime().frame()}});
  queue_state(session, XR_SESSION_STATE_IDLE);
  queue_state(session, session.exits ? XR_SESSION_STATE_EXITING : XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XrResult request_exit_session(XrSession handle) {
  Session& session = running_session(handle);
  session.exits = true;
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
