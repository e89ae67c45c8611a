#include "render/present/headset/headset_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/error.h"
#include "render/present/headset/openxr_actions.h"

namespace ergodome {

namespace {

constexpr XrViewConfigurationType two_eyes = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

glm::dquat quaternion_of(const XrQuaternionf& q) { return glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)); }

HeadsetEye eye_of(const XrView& view) {
  const XrFovf& field = view.fov;
  return {quaternion_of(view.pose.orientation),
          {view.pose.position.x, view.pose.position.y, view.pose.position.z},
          {std::tan(field.angleLeft), std::tan(field.angleRight), std::tan(field.angleUp), std::tan(field.angleDown)}};
}

//! The images of one eye.
struct EyeImages {
  XrSwapchain swapchain = XR_NULL_HANDLE;
  std::vector<XrSwapchainImageOpenGLKHR> images;
};

}  // namespace

struct HeadsetSession::State {
  OpenXrLibrary library;
  OpenXrCalls call;
  XrInstance instance = XR_NULL_HANDLE;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  XrSession session = XR_NULL_HANDLE;
  XrSpace space = XR_NULL_HANDLE;
  std::optional<OpenXrActions> actions;
  std::array<EyeImages, 2> eyes;
  ImageSize size = {0, 0};
  std::int64_t format = 0;
  HeadsetOrigin origin = HeadsetOrigin::head;
  std::string name;

  bool running = false;
  HeadsetState state = HeadsetState::waiting;
  bool recentered = false;
  XrTime display_time = 0;
  std::array<XrView, 2> views{};  //!< result of the last locate()
  glm::dvec3 last_position_m[2] = {glm::dvec3(0.0), glm::dvec3(0.0)};

  State();
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void destroy();
  void find_headset();
  void create_session();
  void create_space();
  void create_images();
  void take(const XrEventDataBuffer& event);
  void follow(XrSessionState now);
  [[nodiscard]] double seconds_until(XrTime time, XrDuration otherwise) const;
};

HeadsetSession::State::State() {
  instance = library.create_instance();
  call.set(instance, library.functions(instance));
  try {
    find_headset();
    actions.emplace(call, instance, library);
    create_session();
    create_space();
    create_images();
    actions->attach(session);
  } catch (...) {
    destroy();
    throw;
  }
}

HeadsetSession::State::~State() { destroy(); }

void HeadsetSession::State::destroy() {
  const auto destroy_if = [&](auto function, auto handle) {
    if (handle != XR_NULL_HANDLE) {
      call.ignoring_errors(function, handle);
    }
  };
  for (const EyeImages& eye : eyes) {
    destroy_if(call.xr().DestroySwapchain, eye.swapchain);
  }
  destroy_if(call.xr().DestroySpace, space);
  destroy_if(call.xr().DestroySession, session);
  actions.reset();
  destroy_if(call.xr().DestroyInstance, instance);
}

void HeadsetSession::State::find_headset() {
  const OpenXrFunctions& xr = call.xr();
  const XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
  call("xrGetSystem", xr.GetSystem, instance, &wanted, &system);
  auto runtime = openxr_struct<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
  call("xrGetInstanceProperties", xr.GetInstanceProperties, instance, &runtime);
  auto headset = openxr_struct<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  call("xrGetSystemProperties", xr.GetSystemProperties, instance, system, &headset);
  name = fmt::format("{}, {}", runtime.runtimeName, headset.systemName);
  // Some runtimes report 0 layers although they show one, so `headset.graphicsProperties` does not
  // refuse a headset.
  std::uint32_t count = 0;
  call("xrEnumerateViewConfigurations", xr.EnumerateViewConfigurations, instance, system, 0U, &count, nullptr);
  std::vector<XrViewConfigurationType> kinds(count);
  call("xrEnumerateViewConfigurations", xr.EnumerateViewConfigurations, instance, system, count, &count, kinds.data());
  if (std::ranges::find(kinds, two_eyes) == kinds.end()) {
    throw Error("headset", fmt::format("{} does not show two eyes", name), "connect a stereoscopic headset");
  }
}

void HeadsetSession::State::create_session() {
  const OpenXrFunctions& xr = call.xr();
  // A runtime must be asked for its requirements before a session is created.
  auto required = openxr_struct<XrGraphicsRequirementsOpenGLKHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
  call("xrGetOpenGLGraphicsRequirementsKHR", xr.GetOpenGLGraphicsRequirementsKHR, instance, system, &required);
  auto graphics = openxr_struct<XrGraphicsBindingOpenGLXlibKHR>(XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR);
  graphics.xDisplay = call.display();
  graphics.glxDrawable = call.drawable();
  graphics.glxContext = call.context();
  const XrSessionCreateInfo wanted{XR_TYPE_SESSION_CREATE_INFO, &graphics, 0, system};
  call("xrCreateSession", xr.CreateSession, instance, &wanted, &session);
}

void HeadsetSession::State::create_space() {
  const OpenXrFunctions& xr = call.xr();
  std::uint32_t count = 0;
  call("xrEnumerateReferenceSpaces", xr.EnumerateReferenceSpaces, session, 0U, &count, nullptr);
  std::vector<XrReferenceSpaceType> kinds(count);
  call("xrEnumerateReferenceSpaces", xr.EnumerateReferenceSpaces, session, count, &count, kinds.data());
  const bool floor = std::ranges::find(kinds, XR_REFERENCE_SPACE_TYPE_STAGE) != kinds.end();
  origin = floor ? HeadsetOrigin::floor : HeadsetOrigin::head;
  auto wanted = openxr_struct<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
  wanted.referenceSpaceType = floor ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL;
  wanted.poseInReferenceSpace.orientation.w = 1.0F;
  call("xrCreateReferenceSpace", xr.CreateReferenceSpace, session, &wanted, &space);
}

namespace {

//! Returns the best of the formats that a runtime offers: eight bits of sRGB values, otherwise
//! linear light.
std::int64_t best_format(const std::vector<std::int64_t>& offered) {
  for (const std::int64_t format : {GL_SRGB8_ALPHA8, GL_SRGB8, GL_RGBA16F, GL_RGBA32F, GL_RGBA8}) {
    if (std::ranges::find(offered, format) != offered.end()) {
      return format;
    }
  }
  throw Error("headset", "the OpenXR runtime offers no supported image format", "update the runtime");
}

}  // namespace

void HeadsetSession::State::create_images() {
  const OpenXrFunctions& xr = call.xr();
  std::uint32_t count = 0;
  call("xrEnumerateViewConfigurationViews", xr.EnumerateViewConfigurationViews, instance, system, two_eyes, 0U, &count,
       nullptr);
  std::vector<XrViewConfigurationView> described(
      count, openxr_struct<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
  call("xrEnumerateViewConfigurationViews", xr.EnumerateViewConfigurationViews, instance, system, two_eyes, count,
       &count, described.data());
  if (count != 2) {
    throw Error("headset", fmt::format("{} reports {} views instead of 2", name, count), "update the OpenXR runtime");
  }
  // Both eyes get the same size, so that they share buffers.
  const auto common = [&](auto recommended, auto largest) {
    const std::uint32_t wanted = std::max(described[0].*recommended, described[1].*recommended);
    const std::uint32_t possible = std::min(described[0].*largest, described[1].*largest);
    return static_cast<int>(std::max(1U, possible > 0 ? std::min(wanted, possible) : wanted));
  };
  size = {common(&XrViewConfigurationView::recommendedImageRectWidth, &XrViewConfigurationView::maxImageRectWidth),
          common(&XrViewConfigurationView::recommendedImageRectHeight, &XrViewConfigurationView::maxImageRectHeight)};
  call("xrEnumerateSwapchainFormats", xr.EnumerateSwapchainFormats, session, 0U, &count, nullptr);
  std::vector<std::int64_t> formats(count);
  call("xrEnumerateSwapchainFormats", xr.EnumerateSwapchainFormats, session, count, &count, formats.data());
  format = best_format(formats);
  auto wanted = openxr_struct<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  wanted.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
  wanted.format = format;
  wanted.sampleCount = 1;
  wanted.width = static_cast<std::uint32_t>(size.width);
  wanted.height = static_cast<std::uint32_t>(size.height);
  wanted.faceCount = 1;
  wanted.arraySize = 1;
  wanted.mipCount = 1;
  for (EyeImages& eye : eyes) {
    call("xrCreateSwapchain", xr.CreateSwapchain, session, &wanted, &eye.swapchain);
    call("xrEnumerateSwapchainImages", xr.EnumerateSwapchainImages, eye.swapchain, 0U, &count, nullptr);
    eye.images.assign(count, openxr_struct<XrSwapchainImageOpenGLKHR>(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR));
    call("xrEnumerateSwapchainImages", xr.EnumerateSwapchainImages, eye.swapchain, count, &count,
         reinterpret_cast<XrSwapchainImageBaseHeader*>(eye.images.data()));
  }
}

void HeadsetSession::State::take(const XrEventDataBuffer& event) {
  switch (event.type) {
    case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
      throw HeadsetLost("the OpenXR runtime is shutting down; start it again");
    case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
      recentered = true;
      break;
    case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED:
      follow(reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state);
      break;
    default:
      break;
  }
}

void HeadsetSession::State::follow(XrSessionState now) {
  switch (now) {
    case XR_SESSION_STATE_READY: {
      const XrSessionBeginInfo begin{XR_TYPE_SESSION_BEGIN_INFO, nullptr, two_eyes};
      call("xrBeginSession", call.xr().BeginSession, session, &begin);
      running = true;
      state = HeadsetState::hidden;
      break;
    }
    case XR_SESSION_STATE_SYNCHRONIZED:
      state = HeadsetState::hidden;
      break;
    case XR_SESSION_STATE_VISIBLE:
      state = HeadsetState::visible;
      break;
    case XR_SESSION_STATE_FOCUSED:
      state = HeadsetState::focused;
      break;
    case XR_SESSION_STATE_STOPPING:
      running = false;
      state = HeadsetState::waiting;
      call("xrEndSession", call.xr().EndSession, session);
      break;
    case XR_SESSION_STATE_EXITING:
      running = false;
      state = HeadsetState::ended;
      break;
    case XR_SESSION_STATE_LOSS_PENDING:
      throw HeadsetLost("the headset was disconnected; connect it again");
    default:
      break;
  }
}

double HeadsetSession::State::seconds_until(XrTime time, XrDuration otherwise) const {
  const auto convert = call.xr().ConvertTimespecTimeToTimeKHR;
  timespec clock{};
  clock_gettime(CLOCK_MONOTONIC, &clock);
  XrTime now = 0;
  if (convert == nullptr || call.ignoring_errors(convert, instance, &clock, &now) != XR_SUCCESS) {
    now = time - otherwise;
  }
  // A runtime whose clock jumps must not move the show by more than a quarter of a second.
  return std::clamp(1e-9 * static_cast<double>(time - now), 0.0, 0.25);
}

HeadsetSession::HeadsetSession() : state_(std::make_unique<State>()) {}

HeadsetSession::~HeadsetSession() = default;

void HeadsetSession::poll() {
  State& state = *state_;
  while (true) {
    auto event = openxr_struct<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    if (state.call("xrPollEvent", state.call.xr().PollEvent, state.instance, &event) != XR_SUCCESS) {
      return;
    }
    state.take(event);
  }
}

HeadsetState HeadsetSession::state() const { return state_->state; }

std::optional<HeadsetFrame> HeadsetSession::begin_frame() {
  State& state = *state_;
  if (!state.running) {
    return std::nullopt;
  }
  const OpenXrFunctions& xr = state.call.xr();
  const auto wait = openxr_struct<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
  auto frame = openxr_struct<XrFrameState>(XR_TYPE_FRAME_STATE);
  state.call("xrWaitFrame", xr.WaitFrame, state.session, &wait, &frame);
  const auto begin = openxr_struct<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
  state.call("xrBeginFrame", xr.BeginFrame, state.session, &begin);
  state.display_time = frame.predictedDisplayTime;
  return HeadsetFrame{frame.predictedDisplayTime,
                      state.seconds_until(frame.predictedDisplayTime, frame.predictedDisplayPeriod),
                      1e-9 * static_cast<double>(frame.predictedDisplayPeriod), frame.shouldRender == XR_TRUE};
}

std::optional<HeadsetEyes> HeadsetSession::locate() {
  State& state = *state_;
  const XrViewLocateInfo wanted{XR_TYPE_VIEW_LOCATE_INFO, nullptr, two_eyes, state.display_time, state.space};
  auto known = openxr_struct<XrViewState>(XR_TYPE_VIEW_STATE);
  state.views.fill(openxr_struct<XrView>(XR_TYPE_VIEW));
  std::uint32_t count = 0;
  state.call("xrLocateViews", state.call.xr().LocateViews, state.session, &wanted, &known, 2U, &count,
             state.views.data());
  if (count != 2 || (known.viewStateFlags & XR_VIEW_STATE_ORIENTATION_VALID_BIT) == 0) {
    return std::nullopt;
  }
  HeadsetEyes eyes;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    eyes[i] = eye_of(state.views[i]);
    if ((known.viewStateFlags & XR_VIEW_STATE_POSITION_VALID_BIT) == 0) {
      // A headset that has lost its position still knows where it is turned.
      eyes[i].position_m = state.last_position_m[i];
    }
    state.last_position_m[i] = eyes[i].position_m;
  }
  return eyes;
}

unsigned HeadsetSession::begin_eye(int eye) {
  State& state = *state_;
  const OpenXrFunctions& xr = state.call.xr();
  const EyeImages& images = state.eyes[static_cast<std::size_t>(eye)];
  const auto acquire = openxr_struct<XrSwapchainImageAcquireInfo>(XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
  std::uint32_t index = 0;
  state.call("xrAcquireSwapchainImage", xr.AcquireSwapchainImage, images.swapchain, &acquire, &index);
  const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
  state.call("xrWaitSwapchainImage", xr.WaitSwapchainImage, images.swapchain, &wait);
  return images.images.at(index).image;
}

void HeadsetSession::end_eye(int eye) {
  const auto release = openxr_struct<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
  state_->call("xrReleaseSwapchainImage", state_->call.xr().ReleaseSwapchainImage,
               state_->eyes[static_cast<std::size_t>(eye)].swapchain, &release);
}

void HeadsetSession::end_frame(const std::optional<HeadsetEyes>& eyes) {
  State& state = *state_;
  std::array<XrCompositionLayerProjectionView, 2> views{};
  auto layer = openxr_struct<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
  layer.space = state.space;
  layer.viewCount = 2;
  layer.views = views.data();
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i] = openxr_struct<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
    views[i].pose = state.views[i].pose;
    views[i].fov = state.views[i].fov;
    views[i].subImage.swapchain = state.eyes[i].swapchain;
    views[i].subImage.imageRect.extent = {state.size.width, state.size.height};
  }
  const auto* const layers = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
  auto end = openxr_struct<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
  end.displayTime = state.display_time;
  end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  end.layerCount = eyes ? 1 : 0;
  end.layers = eyes ? &layers : nullptr;
  state.call("xrEndFrame", state.call.xr().EndFrame, state.session, &end);
  // SteamVR has left an error here, which the next check of ours would report as its own.
  while (glGetError() != GL_NO_ERROR) {
  }
}

HeadsetHands HeadsetSession::hands() {
  return state_->state == HeadsetState::focused ? state_->actions->read(state_->session) : HeadsetHands{};
}

void HeadsetSession::pulse(int hand, double seconds, double strength) {
  if (state_->state == HeadsetState::focused) {
    state_->actions->pulse(state_->session, hand, seconds, strength);
  }
}

ImageSize HeadsetSession::eye_size() const { return state_->size; }
bool HeadsetSession::encoded() const { return state_->format == GL_SRGB8_ALPHA8 || state_->format == GL_SRGB8; }
HeadsetOrigin HeadsetSession::origin() const { return state_->origin; }
bool HeadsetSession::take_recentered() { return std::exchange(state_->recentered, false); }
std::string HeadsetSession::name() const { return state_->name; }

}  // namespace ergodome
