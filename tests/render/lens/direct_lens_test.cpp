#include "render/lens/direct_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernels/launch/launch.h"
#include "kernels/projection/make_projection.h"
#include "render/lens/grid/edge_table.h"
#include "tests/render/passes/stars/star_cameras.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras of these tests

constexpr int dome_px = 512;

//! Returns the number of pixels of a dome picture whose rays do not end within `step_limit` steps.
//! 0 stands for the limit that pictures use.
long unresolved_pixels(const EyeCamera& eye, int step_limit) {
  const Projection projection = make_dome_projection(dome_px, pi, 0.5);
  const EdgeTable edge(Backend::cpu, station_of(eye), 1024);
  PixelBatch batch = pixel_batch(eye, projection, 0.05);
  set_edge(batch, edge.view(), projection);
  set_sky_steps(batch, eye);
  batch.settings.step_limit = step_limit > 0 ? step_limit : batch.settings.step_limit;
  constexpr std::size_t pixels = std::size_t{dome_px} * dome_px;
  std::vector<float> channels(5 * pixels);
  batch.row_count = dome_px;
  batch.out.coverage = channels.data();
  batch.out.error_estimate = channels.data() + pixels;
  for (std::size_t i = 0; i < 3; ++i) {
    batch.out.sky[i] = channels.data() + (2 + i) * pixels;
  }
  launch(Backend::cpu, batch);
  const float* const estimates = batch.out.error_estimate;
  return std::count_if(estimates, estimates + pixels, [](float estimate) { return estimate < 0.0F; });
}

class DirectLensSteps : public testing::TestWithParam<CameraState> {};

TEST_P(DirectLensSteps, AreAsManyAsLightTakesThatComesToAnEnd) {
  const EyeCamera eye = eye_at_position(GetParam());
  EXPECT_EQ(unresolved_pixels(eye, 0), unresolved_pixels(eye, 1000));
}

INSTANTIATE_TEST_SUITE_P(Of, DirectLensSteps,
                         testing::Values(positions[0], positions[1], positions[2],
                                         CameraState{0.999, 1.06, pi / 2, 0.0, ObserverMotion::zamo},
                                         CameraState{0.999, 2.5, 1.2, 0.0, ObserverMotion::zamo},
                                         CameraState{1.0, 1.3, pi / 2, 0.0, ObserverMotion::zamo}),
                         [](const auto& each) { return "Camera" + std::to_string(each.index); });

TEST(DirectLensStep, LimitsAreFeltWhereTheyAreTooLow) {
  const EyeCamera eye = eye_at_position(positions[0]);
  EXPECT_GT(unresolved_pixels(eye, 8), 10 * unresolved_pixels(eye, 0));
}

}  // namespace
}  // namespace ergodome
