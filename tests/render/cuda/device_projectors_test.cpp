#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "kernels/launch/launch.h"
#include "render/backend/buffer.h"
#include "render/present/projectors/software_projectors.h"
#include "tests/render/curved_projector.h"
#include "tests/render/present/projectors/projector_frames.h"

// Tests that projectors get the same frames from the GPU and from the CPU.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): projectors of tests

//! Projectors whose frames a CUDA device draws.
class DeviceProjectors : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* const reason = cuda_unavailable_reason()) {
      GTEST_SKIP() << reason;
    }
  }

  static std::vector<std::uint8_t> by_processor(const ProjectorPicture& picture, const Picture& master,
                                                float light = 1.0F) {
    SoftwareProjectors projectors({picture});
    projectors.show(master);
    projectors.set_light(light);
    return projectors.frame(0);
  }

  //! Expects that frames are equal, except that few values differ by one, because they were rounded
  //! differently.
  static void expect_alike(const std::vector<std::uint8_t>& found, const std::vector<std::uint8_t>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_NEAR(found[i], expected[i], 1) << i;
      different += found[i] != expected[i] ? 1 : 0;
    }
    EXPECT_LT(different, found.size() / 200);
  }
};

TEST_F(DeviceProjectors, ShowWhatTheProcessorDraws) {
  ProjectorPicture wide = grey_picture();
  wide.width_px = 1280;  // a width at which bytes are written as whole words
  wide.height_px = 801;
  for (const ProjectorPicture& picture : {curved_picture(), grey_picture(), plain_picture(), wide}) {
    for (const int size : {1, 33, 64, 301, 1024}) {
      for (const ToneCurve curve : {ToneCurve::shoulder, ToneCurve::reinhard, ToneCurve::filmic, ToneCurve::gamma}) {
        Picture master = master_of(size, soft_colours);
        master.tone.curve = curve;
        SoftwareProjectors device({picture}, Backend::cuda);
        device.show(master);
        device.set_light(0.8F);
        expect_alike(device.frame(0), by_processor(picture, master, 0.8F));
      }
    }
  }
}

TEST_F(DeviceProjectors, ShowMastersThatLieOnTheDevice) {
  const Picture first = master_of(200, [](double, double) { return Vector3<float>{0.1F, 0.2F, 0.3F}; });
  const Picture second = master_of(200, soft_colours);
  const std::vector<ProjectorPicture> pictures = {curved_picture(), plain_picture()};
  SoftwareProjectors device(pictures, Backend::cuda);
  for (const Picture& master : {first, second}) {
    const Buffer<float> there(Backend::cuda, std::vector<float>(master.rgba.begin(), master.rgba.end()), "test");
    MasterPicture in_place = master_picture(master);
    in_place.rgba = there.data();
    device.show_in_place(in_place);
    device.draw_in_place();
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      expect_alike(device.read_raster(i), by_processor(pictures[i], master));
    }
  }
}

TEST_F(DeviceProjectors, TakeOverOtherPictures) {
  const Picture master = master_of(100, soft_colours);
  ProjectorPicture brighter = curved_picture();
  brighter.gain = {1.3, 1.3, 1.3};
  SoftwareProjectors device({curved_picture()}, Backend::cuda);
  device.show(master);
  device.replace(0, brighter);
  device.show(master);
  expect_alike(device.frame(0), by_processor(brighter, master));
}

}  // namespace
}  // namespace ergodome
