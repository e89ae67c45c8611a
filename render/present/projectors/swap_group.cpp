#include "render/present/projectors/swap_group.h"

#include <GLFW/glfw3.h>

// As in GLFW/glfw3native.h, whose X11 headers define macros with common names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void* glfwGetX11Display();
unsigned long glfwGetGLXWindow(GLFWwindow* window);
}
// NOLINTEND(readability-identifier-naming)

namespace ergodome {

namespace {

constexpr const char* barrier_remains = "; the network barrier is used, so displays may differ by a refresh";

SwapGroupFunctions functions_of_driver() {
  SwapGroupFunctions functions;
  if (glfwExtensionSupported("GLX_NV_swap_group") == GLFW_TRUE) {
    functions.join = reinterpret_cast<decltype(functions.join)>(glfwGetProcAddress("glXJoinSwapGroupNV"));
    functions.bind_barrier =
        reinterpret_cast<decltype(functions.bind_barrier)>(glfwGetProcAddress("glXBindSwapBarrierNV"));
  }
  return functions;
}

}  // namespace

std::string join_swap_group(const SwapGroupFunctions& functions, void* display, unsigned long drawable, bool joined) {
  constexpr unsigned int group = 1;
  constexpr unsigned int barrier = 1;
  if (!functions.present() || display == nullptr || drawable == 0) {
    return joined ? std::string("this graphics driver has no GLX_NV_swap_group") + barrier_remains : std::string();
  }
  if (!joined) {
    functions.bind_barrier(display, group, 0);
    functions.join(display, drawable, 0);
    return {};
  }
  if (functions.join(display, drawable, group) == 0) {
    return std::string("the graphics driver refused to join the swap group") + barrier_remains;
  }
  if (functions.bind_barrier(display, group, barrier) == 0) {
    functions.join(display, drawable, 0);
    return std::string("the graphics driver has no swap barrier, which needs a sync board") + barrier_remains;
  }
  return {};
}

std::string join_swap_group(GLFWwindow* window, bool joined) {
  const SwapGroupFunctions functions = functions_of_driver();
  // The native handles exist only with X11.
  return functions.present() ? join_swap_group(functions, glfwGetX11Display(), glfwGetGLXWindow(window), joined)
                             : join_swap_group(functions, nullptr, 0, joined);
}

}  // namespace ergodome
