// Shows frames through OpenXR's loader, without a mistake or with the one that a scenario names:
//   openxr_test_client FOLDER SCENARIO[:MODE,...]...
// The test runtime writes FOLDER/SCENARIO.jsonl and pictures.
#include <GLFW/glfw3.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/openxr_runtime/openxr_glx.h"

namespace ergodome::openxr_test {

namespace {

//! Returns a structure of which only the type is set.
template <typename Structure>
Structure of_type(XrStructureType type) {
  Structure structure{};  // NOLINT(bugprone-invalid-enum-default-initialization): the caller sets the others
  structure.type = type;
  return structure;
}

class Client {
 public:
  explicit Client(const std::string& scenario) : scenario_(scenario) {
    create_instance();
    create_session();
    create_swapchains();
    create_action();
  }

  //! Shows frames until the runtime ends the session.
  void run() {
    while (state_ != XR_SESSION_STATE_EXITING) {
      poll();
      if (state_ == XR_SESSION_STATE_READY && !running_) {
        begin_session();
      } else if (state_ == XR_SESSION_STATE_STOPPING && running_) {
        check(xrEndSession(session_));
        running_ = false;
      } else if (running_) {
        show_frame();
      }
    }
  }

  void close() {
    if (scenario_ != "destroy_order") {
      for (const XrSwapchain swapchain : swapchains_) {
        check(xrDestroySwapchain(swapchain));
      }
    }
    check(xrDestroySpace(space_));
    check(xrDestroySession(session_));
    check(xrDestroyAction(action_));
    check(xrDestroyActionSet(set_));
    check(xrDestroyInstance(instance_));
  }

 private:
  //! Returns whether the scenario's mistake happens now: once, in frame 10.
  bool makes(const char* mistake) const { return scenario_ == mistake && frame_ == 10; }

  //! Makes the window's context current again, which a call may have changed, and clears GL errors.
  void check(XrResult result) {
    glXMakeCurrent(binding_.xDisplay, binding_.glxDrawable, binding_.glxContext);
    while (glGetError() != GL_NO_ERROR) {
    }
    if (XR_FAILED(result) && !tolerant_) {
      throw std::runtime_error("OpenXR error " + std::to_string(result) + " in frame " + std::to_string(frame_));
    }
  }

  void create_instance() {
    binding_ = {XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR,
                nullptr,
                glXGetCurrentDisplay(),
                0,
                nullptr,
                glXGetCurrentDrawable(),
                glXGetCurrentContext()};
    const std::array<const char*, 1> extensions = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME};
    auto info = of_type<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    std::strcpy(info.applicationInfo.applicationName, "openxr_test_client");
    info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
    info.enabledExtensionCount = 1;
    info.enabledExtensionNames = extensions.data();
    check(xrCreateInstance(&info, &instance_));
  }

  void create_session() {
    const XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    XrSystemId system = 0;
    check(xrGetSystem(instance_, &wanted, &system));
    PFN_xrGetOpenGLGraphicsRequirementsKHR get_requirements = nullptr;
    check(xrGetInstanceProcAddr(instance_, "xrGetOpenGLGraphicsRequirementsKHR",
                                reinterpret_cast<PFN_xrVoidFunction*>(&get_requirements)));
    XrGraphicsRequirementsOpenGLKHR requirements{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR, nullptr, 0, 0};
    check(get_requirements(instance_, system, &requirements));
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding_, 0, system};
    check(xrCreateSession(instance_, &info, &session_));
    const XrReferenceSpaceCreateInfo space{
        XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_STAGE, {{0, 0, 0, 1}, {0, 0, 0}}};
    check(xrCreateReferenceSpace(session_, &space, &space_));
  }

  void create_swapchains() {
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO,
                                       nullptr,
                                       0,
                                       XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT,
                                       GL_SRGB8_ALPHA8,
                                       1,
                                       32,
                                       24,
                                       1,
                                       1,
                                       1};
      check(xrCreateSwapchain(session_, &info, &swapchains_[eye]));
      std::uint32_t count = 0;
      check(xrEnumerateSwapchainImages(swapchains_[eye], 0, &count, nullptr));
      images_[eye].resize(count, {XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR, nullptr, 0});
      check(xrEnumerateSwapchainImages(swapchains_[eye], count, &count,
                                       reinterpret_cast<XrSwapchainImageBaseHeader*>(images_[eye].data())));
    }
    glGenFramebuffers(1, &framebuffer_);
  }

  void create_action() {
    auto set = of_type<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
    std::strcpy(set.actionSetName, "flight");
    std::strcpy(set.localizedActionSetName, "Flight");
    check(xrCreateActionSet(instance_, &set, &set_));
    auto action = of_type<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    std::strcpy(action.actionName, "thrust");
    std::strcpy(action.localizedActionName, "Thrust");
    action.actionType = XR_ACTION_TYPE_FLOAT_INPUT;
    check(xrCreateAction(set_, &action, &action_));
    XrActionSuggestedBinding binding{action_, XR_NULL_PATH};
    check(xrStringToPath(instance_, "/user/hand/right/input/trigger/value", &binding.binding));
    XrInteractionProfileSuggestedBinding bindings{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, XR_NULL_PATH,
                                                  1, &binding};
    check(xrStringToPath(instance_, "/interaction_profiles/oculus/touch_controller", &bindings.interactionProfile));
    check(xrSuggestInteractionProfileBindings(instance_, &bindings));
    const XrSessionActionSetsAttachInfo attached{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set_};
    check(xrAttachSessionActionSets(session_, &attached));
  }

  void poll() {
    auto event = of_type<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    while (xrPollEvent(instance_, &event) == XR_SUCCESS) {
      if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
        XrEventDataSessionStateChanged changed{};
        std::memcpy(&changed, &event, sizeof changed);
        state_ = changed.state;
      }
      event = of_type<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    }
  }

  void begin_session() {
    if (scenario_ == "not_running") {
      const XrFrameEndInfo end{XR_TYPE_FRAME_END_INFO, nullptr, 1, XR_ENVIRONMENT_BLEND_MODE_OPAQUE, 0, nullptr};
      xrEndFrame(session_, &end);
    }
    const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
    check(xrBeginSession(session_, &info));
    running_ = true;
  }

  void sync() {
    if (state_ == XR_SESSION_STATE_FOCUSED || scenario_ == "sync_without_focus") {
      const XrActiveActionSet active{set_, XR_NULL_PATH};
      const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
      check(xrSyncActions(session_, &info));
      const XrActionStateGetInfo wanted{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action_, XR_NULL_PATH};
      auto thrust = of_type<XrActionStateFloat>(XR_TYPE_ACTION_STATE_FLOAT);
      check(xrGetActionStateFloat(session_, &wanted, &thrust));
      thrust_ = thrust.currentState;
    }
  }

  void show_frame() {
    if (++frame_ > 200) {
      throw std::runtime_error("the runtime does not end the session");
    }
    sync();
    tolerant_ = makes(scenario_.c_str());
    auto frame = of_type<XrFrameState>(XR_TYPE_FRAME_STATE);
    if (makes("begin_without_wait")) {
      check(xrBeginFrame(session_, nullptr));
    }
    check(xrWaitFrame(session_, nullptr, &frame));
    if (makes("end_without_begin")) {
      submit(frame, {});
    }
    if (makes("wait_twice")) {
      check(xrWaitFrame(session_, nullptr, &frame));
      check(xrBeginFrame(session_, nullptr));
    }
    check(xrBeginFrame(session_, nullptr));
    std::array<XrCompositionLayerProjectionView, 2> views{};
    if (frame.shouldRender == XR_TRUE) {
      draw(frame.predictedDisplayTime, views);
    }
    submit(frame, views);
    tolerant_ = false;
  }

  void draw(XrTime time, std::array<XrCompositionLayerProjectionView, 2>& views) {
    const XrViewLocateInfo where{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, time,
                                 space_};
    auto state = of_type<XrViewState>(XR_TYPE_VIEW_STATE);
    std::array<XrView, 2> located{};
    located.fill(of_type<XrView>(XR_TYPE_VIEW));
    std::uint32_t count = 0;
    if (makes("structure_type")) {
      auto wrong = of_type<XrViewState>(XR_TYPE_VIEW);
      check(xrLocateViews(session_, &where, &wrong, 2, &count, located.data()));
    }
    check(xrLocateViews(session_, &where, &state, 2, &count, located.data()));
    for (std::size_t eye = 0; eye < 2; ++eye) {
      draw_eye(eye);
      views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                    nullptr,
                    located[eye].pose,
                    located[eye].fov,
                    {swapchains_[eye], {{0, 0}, {eye == 0 && makes("rect") ? 33 : 32, 24}}, 0}};
    }
    views[1].pose.position.x += makes("view_pose") ? 0.001F : 0;
    views[1].fov.angleUp += makes("view_fov") ? 0.001F : 0;
  }

  //! Draws the lower half blue and the upper half in a color of the eye, brighter by the trigger.
  void draw_eye(std::size_t eye) {
    if (eye == 0 && makes("image_not_released")) {
      return;
    }
    std::uint32_t index = 0;
    const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, 1'000'000'000};
    if (eye == 0 && makes("wait_without_acquire")) {
      check(xrWaitSwapchainImage(swapchains_[eye], &wait));
    }
    check(xrAcquireSwapchainImage(swapchains_[eye], nullptr, &index));
    if (eye == 0 && makes("release_without_wait")) {
      check(xrReleaseSwapchainImage(swapchains_[eye], nullptr));
    }
    check(xrWaitSwapchainImage(swapchains_[eye], &wait));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, images_[eye].at(index).image, 0);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(eye == 0 ? 1 : 0, eye == 0 ? 0 : 1, thrust_, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 32, 12);
    glClearColor(0, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    check(xrReleaseSwapchainImage(swapchains_[eye], nullptr));
  }

  void submit(const XrFrameState& frame, const std::array<XrCompositionLayerProjectionView, 2>& views) {
    const XrBaseInStructure stray{XR_TYPE_VIEW, nullptr};
    const XrCompositionLayerProjection layer{
        XR_TYPE_COMPOSITION_LAYER_PROJECTION, makes("next_pointer") ? &stray : nullptr, 0, space_, 2, views.data()};
    const std::array<const XrCompositionLayerBaseHeader*, 1> layers = {
        reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer)};
    const XrFrameEndInfo end{
        XR_TYPE_FRAME_END_INFO,
        nullptr,
        frame.predictedDisplayTime + (makes("display_time") ? 1 : 0),
        makes("blend_mode") ? XR_ENVIRONMENT_BLEND_MODE_ADDITIVE : XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
        frame.shouldRender,
        layers.data()};
    check(xrEndFrame(session_, &end));
  }

  std::string scenario_;
  XrGraphicsBindingOpenGLXlibKHR binding_{};
  XrInstance instance_ = XR_NULL_HANDLE;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace space_ = XR_NULL_HANDLE;
  std::array<XrSwapchain, 2> swapchains_{};
  std::array<std::vector<XrSwapchainImageOpenGLKHR>, 2> images_;
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction action_ = XR_NULL_HANDLE;
  GLuint framebuffer_ = 0;
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  bool running_ = false;
  bool tolerant_ = false;
  int frame_ = 0;
  float thrust_ = 0;
};

//! Runs a scenario. Only `clean` and `validated` run with OpenXR's validation layer, which rejects mistakes.
void run_scenario(const std::string& folder, const std::string& argument) {
  const std::size_t at = argument.find(':');
  const std::string scenario = argument.substr(0, at);
  const std::string modes = at == std::string::npos ? "" : argument.substr(at + 1);
  const std::string script = "log=" + folder + "/" + scenario + ".jsonl;frames=60;every=50;pictures=" + folder + "/" +
                             scenario + ";input=" + folder + "/input.txt;modes=" + modes;
  ::setenv("ERGODOME_OPENXR_TEST", script.c_str(), 1);
  if (scenario == "clean" || scenario == "validated") {
    ::setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
    ::setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
    ::setenv("XR_CORE_VALIDATION_FILE_NAME", (folder + "/" + scenario + ".txt").c_str(), 1);
  } else {
    ::unsetenv("XR_ENABLE_API_LAYERS");
  }
  Client client(scenario == "validated" ? "structure_type" : scenario);
  client.run();
  client.close();
}

int run_all(int argument_count, char** arguments) {
  if (glfwInit() == GLFW_FALSE) {
    std::puts("no display");
    return 1;
  }
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* const window = glfwCreateWindow(64, 64, "OpenXR", nullptr, nullptr);
  if (window == nullptr) {
    std::puts("no window");
    return 1;
  }
  int failures = 0;
  for (int i = 2; i < argument_count; ++i) {
    glfwMakeContextCurrent(window);
    try {
      run_scenario(arguments[1], arguments[i]);
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", arguments[i], error.what());
      ++failures;
    }
  }
  glfwTerminate();
  return failures;
}

}  // namespace

}  // namespace ergodome::openxr_test

int main(int argument_count, char** arguments) {
  return argument_count < 3 ? 2 : ergodome::openxr_test::run_all(argument_count, arguments);
}
