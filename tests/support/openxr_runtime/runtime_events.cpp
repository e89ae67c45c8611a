// The queue of events, and the states that a session passes through.
#include <algorithm>
#include <array>
#include <cstring>

#include "tests/support/openxr_runtime/runtime_functions.h"

namespace ergodome::openxr_test {

namespace {

//! States of a running session in the order in which they are entered.
constexpr std::array<XrSessionState, 4> running_states = {XR_SESSION_STATE_READY, XR_SESSION_STATE_SYNCHRONIZED,
                                                          XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_FOCUSED};

const char* state_name(XrSessionState state) {
  constexpr std::array<const char*, 9> names = {"UNKNOWN", "IDLE",     "READY",        "SYNCHRONIZED", "VISIBLE",
                                                "FOCUSED", "STOPPING", "LOSS_PENDING", "EXITING"};
  return names.at(static_cast<std::size_t>(state));
}

std::string event_name(XrStructureType type) {
  switch (type) {
    case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
      return "INSTANCE_LOSS_PENDING";
    case XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED:
      return "INTERACTION_PROFILE_CHANGED";
    case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
      return "REFERENCE_SPACE_CHANGE_PENDING";
    default:
      return std::to_string(type);
  }
}

std::ptrdiff_t running_rank(XrSessionState state) {
  return std::find(running_states.begin(), running_states.end(), state) - running_states.begin();
}

//! Returns the state that the next frame should have.
XrSessionState wanted_state() {
  if (runtime().is_between("taken_off", 30, 60)) {
    return XR_SESSION_STATE_SYNCHRONIZED;
  }
  return runtime().is_between("focus_lost", 30, 60) ? XR_SESSION_STATE_VISIBLE : XR_SESSION_STATE_FOCUSED;
}

//! Queues all states down to STOPPING.
void stop(Session& session) {
  for (std::ptrdiff_t rank = running_rank(session.state) - 1; rank > 0; --rank) {
    queue_state(session, running_states.at(static_cast<std::size_t>(rank)));
  }
  queue_state(session, XR_SESSION_STATE_STOPPING);
}

void recenter() {
  Runtime& state = runtime();
  state.recentered_ns = state.display_time_ns + 2 * state.script.period_ns();
  for (const XrReferenceSpaceType type : {XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_STAGE}) {
    queue_event(XrEventDataReferenceSpaceChangePending{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING, nullptr,
                                                       only_session(), type, *state.recentered_ns, XR_TRUE,
                                                       float_pose(recentered_space())});
  }
  runtime_log().write({{"recentered", "STAGE and LOCAL"},
                       {"change_time_ns", *state.recentered_ns},
                       {"pose_in_previous_space", json_of(float_pose(recentered_space()))}});
}

void log_polled(const XrEventDataBuffer& event) {
  if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
    XrEventDataSessionStateChanged changed{};
    std::memcpy(&changed, &event, sizeof changed);
    if (runtime().sessions.has(changed.session)) {
      runtime().sessions.at(changed.session).polled_state = changed.state;
    }
    runtime_log().write({{"state", state_name(changed.state)}, {"frame", runtime().frame()}});
  } else {
    runtime_log().write({{"event", event_name(event.type)}, {"frame", runtime().frame()}});
  }
}

}  // namespace

void queue_state(Session& session, XrSessionState state) {
  session.state = state;
  queue_event(XrEventDataSessionStateChanged{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr, only_session(), state,
                                             runtime().display_time_ns});
}

void advance_state(Session& session) {
  Runtime& state = runtime();
  if (state.happens_now("session_lost")) {
    queue_state(session, XR_SESSION_STATE_LOSS_PENDING);
    session.lost = true;
    return;
  }
  if (state.happens_now("instance_lost")) {
    queue_event(
        XrEventDataInstanceLossPending{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr, state.display_time_ns});
    state.instance_lost = true;
    return;
  }
  if (state.happens_now("recenter")) {
    recenter();
  }
  if (session.state == XR_SESSION_STATE_STOPPING) {
    return;
  }
  session.exits =
      session.exits || state.happens_now("exit") || (state.script.frames > 0 && state.frames >= state.script.frames);
  if (session.exits || state.happens_now("restart")) {
    stop(session);
    return;
  }
  const std::ptrdiff_t rank = running_rank(session.state);
  const std::ptrdiff_t wanted = running_rank(wanted_state());
  if (rank != wanted) {
    queue_state(session, running_states.at(static_cast<std::size_t>(rank < wanted ? rank + 1 : rank - 1)));
  }
}

XrResult poll_event(XrInstance instance, XrEventDataBuffer* event) {
  Runtime& state = runtime();
  state.instances.at(instance);
  check_structure(event, XR_TYPE_EVENT_DATA_BUFFER);
  for (auto& [handle, session] : state.sessions) {
    const bool is_late = std::chrono::steady_clock::now() - session.created > std::chrono::seconds(1);
    if (state.script.has("not_focused_first") && session.state == XR_SESSION_STATE_IDLE && is_late &&
        state.frames == 0) {
      queue_state(session, XR_SESSION_STATE_READY);
    }
  }
  if (state.events.empty()) {
    return state.instance_lost ? XR_ERROR_INSTANCE_LOST : XR_EVENT_UNAVAILABLE;
  }
  *event = state.events.front();
  state.events.pop_front();
  log_polled(*event);
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
