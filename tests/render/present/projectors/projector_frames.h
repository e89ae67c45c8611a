#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kernels/core/error.h"
#include "kernels/launch/launch.h"
#include "render/present/projectors/headless_projectors.h"
#include "tests/support/folder_test.h"
#include "tests/support/gl_driver.h"
#include "tests/support/simulated_dome.h"

namespace ergodome::test {

//! Draws the frames of projectors by OpenGL, the CPU or CUDA (the parameter). Tests are skipped if
//! OpenGL or CUDA is not available.
class ProjectorFrames : public FolderTest, public testing::WithParamInterface<ProjectorDrawer> {
 protected:
  void open(const std::vector<ProjectorPicture>& pictures) {
    if (GetParam() == ProjectorDrawer::cuda && cuda_unavailable_reason() != nullptr) {
      GTEST_SKIP() << cuda_unavailable_reason();
    }
    try {
      driver_was_loaded = driver_was_loaded || GetParam() == ProjectorDrawer::opengl;
      projectors_ = std::make_unique<HeadlessProjectors>(pictures, GetParam());
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
  }

  std::unique_ptr<HeadlessProjectors> projectors_;
};

//! Returns a domemaster with the given light, which should vary smoothly from pixel to pixel.
inline Picture master_of(int size, const std::function<Vector3<float>(double u, double v)>& light) {
  Picture picture;
  picture.width = size;
  picture.height = size;
  picture.rgba.resize(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  auto to = picture.rgba.begin();
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vector3<float> c = light((x + 0.5) / size, (y + 0.5) / size);
      to = std::ranges::copy(std::array{c.x, c.y, c.z, 1.0F}, to).out;
    }
  }
  return picture;
}

//! Returns channel 0, 1 or 2 of a color.
inline float channel_of(const Vector3<float>& colour, int channel) {
  return channel == 0 ? colour.x : channel == 1 ? colour.y : colour.z;
}

inline constexpr const char* drawer_names[] = {"automatic", "opengl", "processor", "cuda"};
inline std::string name_of_drawer(const testing::TestParamInfo<ProjectorDrawer>& drawer) {
  return drawer_names[static_cast<int>(drawer.param)];
}
inline constexpr auto drawers = {ProjectorDrawer::opengl, ProjectorDrawer::processor, ProjectorDrawer::cuda};

}  // namespace ergodome::test
