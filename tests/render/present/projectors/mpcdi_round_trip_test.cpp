// Tests that projectors get the same frames after their setup was written as MPCDI and read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "calibration/projectors/setup_conversion.h"
#include "render/present/projectors/software_projectors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

//! Returns a domemaster whose color varies smoothly and is different at every position.
Picture colourful_master(int size) {
  Picture master;
  master.width = size;
  master.height = size;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(size);
      const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(size);
      master.rgba.insert(master.rgba.end(), {u, v, 0.5F + 0.5F * std::sin(9.0F * (u + v)), 1.0F});
    }
  }
  return master;
}

class MpcdiRoundTrip : public test::FolderTest {
 protected:
  [[nodiscard]] DomeSetup read(const std::string& dome, const std::string& projector) const {
    const std::string lens = "frustum = { left_deg = -30, right_deg = 28, up_deg = 24, down_deg = -22 }\n";
    return parse_dome_setup("[dome]\nradius_m = 5\n" + dome +
                                "[[projector]]\nname = \"A\"\nresolution_px = [64, 48]\nposition_m = [0.4, 0.3, -1]\n"
                                "yaw_deg = 25\npitch_deg = 50\nroll_deg = 4\n" +
                                lens + projector +
                                "[[projector]]\nname = \"B\"\nresolution_px = [64, 48]\nwindow_px = [64, 0]\n"
                                "yaw_deg = -20\npitch_deg = 55\n" +
                                lens,
                            (folder_ / "dome.toml").string(), NamedFiles::must_exist);
  }

  //! Expects that the frames of the first projector, before and after the round trip, differ by at
  //! most 2 of 255.
  void expect_same_picture(const DomeSetup& setup) const {
    write_mpcdi(folder_ / "dome.mpcdi", mpcdi_from_setup(setup, "2026-01-01 00:00:00"));
    DomeSetup again = setup_from_mpcdi(read_mpcdi(folder_ / "dome.mpcdi"), "dome.mpcdi", setup.radius_m);
    again.folder = folder_;
    const Picture master = colourful_master(256);
    SoftwareProjectors before(projector_pictures(setup));
    SoftwareProjectors after(
        projector_pictures(parse_dome_setup(to_toml(again), (folder_ / "b.toml").string(), NamedFiles::must_exist)));
    before.show(master);
    after.show(master);
    const std::vector<std::uint8_t> is = after.frame(0);
    const std::vector<std::uint8_t> was = before.frame(0);
    ASSERT_EQ(is.size(), was.size());
    ASSERT_GT(*std::ranges::max_element(was), 100);
    int farthest = 0;
    for (std::size_t i = 0; i < was.size(); ++i) {
      farthest = std::max(farthest, std::abs(is[i] - was[i]));
    }
    EXPECT_LE(farthest, 2);
  }
};

TEST_F(MpcdiRoundTrip, KeepsTheTiltAndTheRotationOfTheDome) {
  expect_same_picture(read("tilt_deg = 20\nrotation_deg = 35\n", ""));
}

TEST_F(MpcdiRoundTrip, KeepsABlackLevelOfColours) {
  expect_same_picture(read("", "black_level_lift = [0.05, 0.1, 0.02]\n"));
}

TEST_F(MpcdiRoundTrip, KeepsAGain) {
  expect_same_picture(read("", "gain = [0.9, 0.6, 0.75]\nblack_level_lift = [0.05, 0.1, 0.02]\n"));
}

TEST_F(MpcdiRoundTrip, KeepsAGammaOfOne) { expect_same_picture(read("", "gamma = 1\n")); }

TEST_F(MpcdiRoundTrip, KeepsAllOfThemOfAFisheye) {
  DomeSetup setup =
      read("tilt_deg = 20\nrotation_deg = 35\n", "gain = [0.9, 0.6, 0.75]\nblack_level_lift = 0.06\ngamma = 1.8\n");
  ProjectorFisheye narrow;
  narrow.field_of_view_deg = 60.0;
  setup.projectors[1].lens = narrow;
  setup.projectors[1].orientation = {200.0, 20.0, 0.0};
  expect_same_picture(setup);
}

}  // namespace
}  // namespace ergodome
