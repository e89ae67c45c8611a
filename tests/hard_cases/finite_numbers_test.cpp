#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "kernels/core/error.h"
#include "kernels/launch/check_numbers.h"
#include "render/frame/show_renderer.h"
#include "tests/hard_cases/random_cameras.h"
#include "tests/support/sanitized.h"
#include "tests/support/tiny_sky.h"

// Checks that no kernel returns NaN or infinity. First, the check must find a NaN that a test
// plants; then it must find none in the built-in shows.
namespace ergodome::test {
namespace {

//! A fixture that checks the outputs of all kernels for NaN and infinity while its tests run.
class NumbersChecked : public testing::Test {
 protected:
  NumbersChecked() : before_(numbers_are_checked()) { set_numbers_checked(true); }
  ~NumbersChecked() override { set_numbers_checked(before_); }
  NumbersChecked(const NumbersChecked&) = delete;
  NumbersChecked& operator=(const NumbersChecked&) = delete;

 private:
  bool before_;
};

//! A hundred rays. A test sets one component of the direction of ray 17, for instance to NaN.
struct PlantedRays {
  std::vector<double> n[3], g;

  explicit PlantedRays(double planted) : g(100) {
    for (int axis = 0; axis < 3; ++axis) {
      n[axis].assign(100, axis == 2 ? 1.0 : 0.0);
    }
    n[1][17] = planted;
  }

  RayBatch<double> batch() {
    RayBatch<double> all{};
    all.camera = station_at({0.9, 8.0, 1.0});
    all.settings = {1e-9, 1000};
    all.count = 100;
    for (int axis = 0; axis < 3; ++axis) {
      all.direction[axis] = n[axis].data();
    }
    all.frequency_ratio = g.data();
    return all;
  }
};

TEST_F(NumbersChecked, APlantedNanIsFoundWithItsKernelChannelAndIndex) {
  PlantedRays rays(std::nan(""));
  try {
    launch(Backend::cpu, rays.batch());
    FAIL() << "nothing was found";
  } catch (const Error& error) {
    EXPECT_EQ(error.location(), "kernel trace_rays, double");
    EXPECT_NE(error.problem().find("frequency_ratio[17] of 100 is "), std::string::npos) << error.problem();
  }
}

TEST_F(NumbersChecked, RaysWithoutOnePass) {
  PlantedRays rays(0.0);
  EXPECT_NO_THROW(launch(Backend::cpu, rays.batch()));
}

TEST_F(NumbersChecked, NothingIsLookedAtWhenItIsSwitchedOff) {
  set_numbers_checked(false);
  PlantedRays rays(std::nan(""));
  EXPECT_NO_THROW(launch(Backend::cpu, rays.batch()));
}

//! Returns a built-in show, with a sky map of a few pixels.
Show small_show(const std::string& name) {
  Show show = read_show(built_in_content_folder() / "shows" / (name + ".toml"));
  show.sky.map = tiny_sky();
  return show;
}

class BuiltInShows : public testing::TestWithParam<const char*> {};

TEST_P(BuiltInShows, LetNothingLeaveAKernelThatIsNoNumber) {
  set_numbers_checked(true);
  const Show show = small_show(GetParam());
  ShowRenderer renderer(show, Backend::cpu);
  const double end_s = std::max(show.duration_s, 1.0);
  const std::vector<double> parts = sanitized ? std::vector{0.31} : std::vector{0.0, 0.31, 0.77, 1.0};
  for (const double part : parts) {
    EXPECT_NO_THROW(renderer.render(part * end_s, {ViewMode::sky, sanitized ? 32 : 96})) << part;
  }
  for (const ViewMode mode : {ViewMode::steps, ViewMode::error_estimate, ViewMode::image_order,
                              ViewMode::frequency_ratio, ViewMode::magnification}) {
    EXPECT_NO_THROW(renderer.render(0.5 * end_s, {mode, 32})) << static_cast<int>(mode);
  }
  set_numbers_checked(false);
}

TEST_P(BuiltInShows, LetNothingLeaveAKernelThatIsNoNumberThroughAGrid) {
  set_numbers_checked(true);
  const Show show = small_show(GetParam());
  ShowRenderer renderer(show, Backend::cpu, LensChoice::live);
  EXPECT_NO_THROW(renderer.render(0.6 * std::max(show.duration_s, 1.0), {ViewMode::sky, sanitized ? 32 : 96}));
  set_numbers_checked(false);
}

INSTANTIATE_TEST_SUITE_P(Of, BuiltInShows,
                         testing::Values("once-around", "fall", "zoom-whirl", "through", "plunge", "eyes",
                                         "first-light", "dome-still", "grid-sky", "prograde-edge", "free-flight",
                                         "exhibit", "attract", "star-field", "star-trails", "disk", "shells", "planet",
                                         "published-effects"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

//! Renders the whole sky for cameras at positions that are numerically difficult.
TEST_F(NumbersChecked, HardPlacesLetNothingLeaveAKernelThatIsNoNumber) {
  for (const char* camera :
       {"spin = 1\n[camera]\n[[camera.key]]\nr = 1.001\n",
        "spin = 1\n[camera]\nobserver = \"rain\"\n[[camera.key]]\nr = 1.000001\n",
        "spin = 0.9\n[camera]\nobserver = \"rain\"\n[[camera.key]]\nr = 1.4358909\n",
        "spin = -1\n[camera]\n[[camera.key]]\nr = 3\ntheta_deg = 0\n",
        "spin = 0\n[camera]\n[[camera.key]]\nr = 3\ntheta_deg = 180\n",
        "spin = 0.5\n[camera]\n[[camera.key]]\nr = 1e6\n",
        "spin = 0.999\n[camera]\nobserver = { beta = 0.9999, toward = [0, 0, 1] }\n[[camera.key]]\nr = 2\n"}) {
    Show show =
        parse_show("[hole]\n" + std::string(camera) +
                       "[sky]\nmap = \"grid\"\nstars = \"bright_stars\"\nfaintest_mag = 3\n[effects]\nredshift = true\n"
                       "magnification = true\n[view]\nprojection = \"equirect\"\n",
                   "show.toml");
    show.sky.map = tiny_sky();
    for (const LensChoice lens : {LensChoice::direct, LensChoice::live}) {
      ShowRenderer renderer(show, Backend::cpu, lens);
      EXPECT_NO_THROW(renderer.render(0.0, {ViewMode::sky, sanitized ? 32 : 64})) << camera;
      EXPECT_NO_THROW(renderer.render(0.0, {ViewMode::magnification, 32})) << camera;
    }
  }
}

}  // namespace
}  // namespace ergodome::test
