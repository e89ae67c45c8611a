#pragma once

#include <string>

struct GLFWwindow;

// Swap groups of NVIDIA's professional cards with sync boards: windows of several computers show
// their next frame in the same refresh of their displays.

namespace ergodome {

//! The functions of GLX_NV_swap_group that are used. The display and the drawable are GLX's.
struct SwapGroupFunctions {
  int (*join)(void* display, unsigned long drawable, unsigned int group) = nullptr;
  int (*bind_barrier)(void* display, unsigned int group, unsigned int barrier) = nullptr;

  [[nodiscard]] bool present() const { return join != nullptr && bind_barrier != nullptr; }
};

//! Lets a window join the swap group and the barrier of all computers, or leave them. Returns why
//! that is not possible; otherwise an empty text.
std::string join_swap_group(const SwapGroupFunctions& functions, void* display, unsigned long drawable, bool joined);

//! Does the same for a window whose context is current, with the functions of its driver.
std::string join_swap_group(GLFWwindow* window, bool joined);

}  // namespace ergodome
