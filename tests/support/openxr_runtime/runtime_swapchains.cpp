// Swapchains: their images and the order of acquiring, waiting and releasing.
#include <algorithm>

#include "tests/support/openxr_runtime/runtime_functions.h"
#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

constexpr std::uint32_t images_per_swapchain = 3;
constexpr std::int64_t slow_wait_ns = 30'000'000;

std::vector<std::int64_t> offered_formats() {
  if (runtime().script.has("one_format")) {
    return {GL_SRGB8_ALPHA8};
  }
  if (runtime().script.has("linear_only")) {
    return {GL_RGBA16F};
  }
  return {GL_SRGB8_ALPHA8, GL_RGBA16F, GL_RGB10_A2, GL_RGBA8, GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8};
}

const char* format_name(std::int64_t format) {
  switch (format) {
    case GL_SRGB8_ALPHA8:
      return "GL_SRGB8_ALPHA8";
    case GL_RGBA16F:
      return "GL_RGBA16F";
    case GL_RGB10_A2:
      return "GL_RGB10_A2";
    case GL_RGBA8:
      return "GL_RGBA8";
    default:
      return "depth";
  }
}

void check_new_swapchain(const XrSwapchainCreateInfo* info) {
  check_structure(info, XR_TYPE_SWAPCHAIN_CREATE_INFO);
  const std::vector<std::int64_t> formats = offered_formats();
  if (std::find(formats.begin(), formats.end(), info->format) == formats.end()) {
    fail(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "format", "format " + std::to_string(info->format) + " is not offered");
  }
  const std::uint32_t limit = runtime().script.has("tiny") ? 1 : 8192;
  if (info->width == 0 || info->height == 0 || info->width > limit || info->height > limit || info->mipCount == 0 ||
      info->arraySize == 0) {
    fail(XR_ERROR_VALIDATION_FAILURE, "swapchain_size",
         std::to_string(info->width) + " x " + std::to_string(info->height) + ", at most " + std::to_string(limit));
  }
  if (info->sampleCount != 1 || info->faceCount != 1) {
    fail(XR_ERROR_FEATURE_UNSUPPORTED, "swapchain_samples", "only one sample and one face are supported");
  }
}

//! Returns a swapchain and the only session, which is alive.
std::pair<Swapchain&, Session&> used_swapchain(XrSwapchain handle) {
  require_live_session();
  Swapchain& swapchain = runtime().swapchains.at(handle);
  return {swapchain, runtime().sessions.at(only_session())};
}

//! Waits 30 ms, or the shorter timeout. Returns whether the image is available.
bool waits_slowly(XrSwapchain handle, XrDuration timeout_ns) {
  Swapchain& swapchain = runtime().swapchains.at(handle);
  const std::int64_t left_ns = swapchain.wait_left_ns.value_or(slow_wait_ns);
  const std::int64_t waited_ns = std::min<std::int64_t>(left_ns, timeout_ns);
  swapchain.wait_left_ns = left_ns - waited_ns;
  sleep_unlocked(std::chrono::nanoseconds(waited_ns));
  return waited_ns == left_ns;
}

}  // namespace

XrResult enumerate_swapchain_formats(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                     std::int64_t* formats) {
  live_session(session);
  return enumerate(offered_formats(), capacity, count, formats);
}

XrResult create_swapchain(XrSession handle, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
  const Session& session = live_session(handle);
  check_new_swapchain(info);
  const ContextScope scope(session);
  Swapchain created;
  created.info = *info;
  created.info.next = nullptr;
  created.textures = create_textures(*info, images_per_swapchain);
  *swapchain = runtime().swapchains.add(created);
  runtime_log().write({{"swapchain", reinterpret_cast<std::uint64_t>(*swapchain)},
                       {"format", format_name(info->format)},
                       {"width", info->width},
                       {"height", info->height},
                       {"array_size", info->arraySize},
                       {"usage", info->usageFlags}});
  return XR_SUCCESS;
}

XrResult destroy_swapchain(XrSwapchain handle) {
  Swapchain& swapchain = runtime().swapchains.at(handle);
  if (!swapchain.acquired.empty()) {
    runtime_log().note("destroyed_while_acquired", "an image of the swapchain is not released");
  }
  const ContextScope scope(runtime().sessions.at(only_session()));
  glDeleteTextures(static_cast<GLsizei>(swapchain.textures.size()), swapchain.textures.data());
  runtime().swapchains.remove(handle);
  return XR_SUCCESS;
}

XrResult enumerate_swapchain_images(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                                    XrSwapchainImageBaseHeader* images) {
  const Swapchain& swapchain = used_swapchain(handle).first;
  auto* const output = reinterpret_cast<XrSwapchainImageOpenGLKHR*>(images);
  std::vector<XrSwapchainImageOpenGLKHR> all;
  all.reserve(swapchain.textures.size());
  for (const GLuint texture : swapchain.textures) {
    all.push_back({XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR, nullptr, texture});
  }
  for (std::uint32_t i = 0; output != nullptr && i < std::min<std::size_t>(capacity, all.size()); ++i) {
    check_structure(&output[i], XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR);
  }
  return enumerate(all, capacity, count, output);
}

XrResult acquire_swapchain_image(XrSwapchain handle, const XrSwapchainImageAcquireInfo* info, std::uint32_t* index) {
  Swapchain& swapchain = used_swapchain(handle).first;
  if (info != nullptr) {
    check_structure(info, XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
  }
  if (swapchain.acquired.size() >= images_per_swapchain) {
    fail(XR_ERROR_CALL_ORDER_INVALID, "swapchain_order", "all images are already acquired");
  }
  *index = swapchain.next_image;
  swapchain.acquired.push_back(*index);
  swapchain.next_image = (*index + 1) % images_per_swapchain;
  return XR_SUCCESS;
}

XrResult wait_swapchain_image(XrSwapchain handle, const XrSwapchainImageWaitInfo* info) {
  {
    const Swapchain& swapchain = used_swapchain(handle).first;
    check_structure(info, XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
    if (swapchain.acquired.empty() || swapchain.waited) {
      fail(XR_ERROR_CALL_ORDER_INVALID, "swapchain_order",
           swapchain.waited ? "the image was already waited for" : "no image is acquired");
    }
  }
  if (runtime().script.has("slow_wait") && !waits_slowly(handle, info->timeout)) {
    return XR_TIMEOUT_EXPIRED;
  }
  const auto [swapchain, session] = used_swapchain(handle);
  swapchain.waited = true;
  swapchain.wait_left_ns.reset();
  const ContextScope scope(session);
  clear_texture(swapchain.info, swapchain.textures[swapchain.acquired.front()]);
  return XR_SUCCESS;
}

XrResult release_swapchain_image(XrSwapchain handle, const XrSwapchainImageReleaseInfo* info) {
  const auto [swapchain, session] = used_swapchain(handle);
  if (info != nullptr) {
    check_structure(info, XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
  }
  if (!swapchain.waited) {
    fail(XR_ERROR_CALL_ORDER_INVALID, "swapchain_order", "no image was waited for");
  }
  // The program has drawn with the context that is current now.
  runtime().foreign_contexts += glXGetCurrentContext() == session.binding.glxContext ? 0 : 1;
  swapchain.waited = false;
  swapchain.released = swapchain.acquired.front();
  swapchain.released_frame = runtime().frame();
  swapchain.acquired.pop_front();
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
