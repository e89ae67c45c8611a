#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kernels/projection/make_projection.h"
#include "render/lens/follow_lens.h"
#include "tests/render/eye_at.h"
#include "tests/render/plan/frame_plan_scenes.h"

namespace ergodome {
namespace {

using test::effects;
using test::eye_at;

constexpr int heat_size_px = 97;

//! Coverage, error estimates and numbers of steps of all rays of a picture.
struct StepPicture {
  std::vector<float> coverage, error, steps;

  [[nodiscard]] float at(int x, int y) const {
    return steps[static_cast<std::size_t>(y) * heat_size_px + static_cast<std::size_t>(x)];
  }
};

StepPicture steps_of(TraceMethod method, const std::vector<WatchedShell>& shells) {
  constexpr std::size_t pixels = std::size_t{heat_size_px} * heat_size_px;
  StepPicture picture{std::vector<float>(pixels), std::vector<float>(pixels), std::vector<float>(pixels)};
  LensPixels out{};
  out.coverage = picture.coverage.data();
  out.error_estimate = picture.error.data();
  out.steps = picture.steps.data();
  const Projection projection = make_pinhole_projection(heat_size_px, heat_size_px, 40.0 * one_degree);
  const FollowLens lens(Backend::cpu, eye_at(0.0, 15.0, 0.4 * pi), projection, 0.05, {method, shells, false});
  lens.fill(0, heat_size_px, out);
  return picture;
}

float middle_of(std::vector<float> values) {
  std::erase(values, 0.0F);
  const auto at = static_cast<long>(values.size() / 2);
  std::ranges::nth_element(values, values.begin() + at);
  return values[values.size() / 2];
}

TEST(RayHeat, OfAShellIsHotAtThePolesInPolarAnglesAlone) {
  // A camera looks down on the north pole of a shell. The pole is in the middle column of the
  // picture, where θ is smallest.
  const std::vector<WatchedShell> shell = {{1.0F / 4.0F, true}};
  const StepPicture polar = steps_of(TraceMethod::baseline_rk34, shell);
  const StepPicture ours = steps_of(TraceMethod::taylor, shell);
  const auto max_in = [](const StepPicture& picture, int left, int right) {
    float maximum = 0.0F;
    for (int y = 0; y < heat_size_px; ++y) {
      for (int x = left; x < right; ++x) {
        maximum = std::max(maximum, picture.at(x, y));
      }
    }
    return maximum;
  };
  constexpr int middle = heat_size_px / 2;
  EXPECT_GT(max_in(polar, middle - 1, middle + 2), 4.0F * middle_of(polar.steps));
  EXPECT_LE(max_in(ours, 0, heat_size_px), 3.0F * middle_of(ours.steps));
  EXPECT_LT(10.0F * middle_of(ours.steps), middle_of(polar.steps));
}

TEST(RayHeat, EndsSoonerAtAShellThatCovers) {
  const StepPicture through = steps_of(TraceMethod::cash_karp, {{1.0F / 4.0F, false}});
  const StepPicture covered = steps_of(TraceMethod::cash_karp, {{1.0F / 4.0F, true}});
  const StepPicture sky = steps_of(TraceMethod::cash_karp, {});
  int sooner = 0;
  int dark = 0;
  for (std::size_t i = 0; i < through.steps.size(); ++i) {
    EXPECT_LE(covered.steps[i], through.steps[i]);
    sooner += covered.steps[i] < through.steps[i] ? 1 : 0;
    // The shell is in front of the shadow and covers a part of it.
    EXPECT_GE(covered.coverage[i], sky.coverage[i]);
    dark += sky.coverage[i] < covered.coverage[i] ? 1 : 0;
  }
  EXPECT_GT(sooner, 20);
  EXPECT_GT(dark, 200);
}

class RayHeatPlans : public test::FramePlans {};

TEST_F(RayHeatPlans, HoldForEveryMethodWithShellsAndWithout) {
  for (const ViewMode mode : {ViewMode::steps, ViewMode::error_estimate, ViewMode::image_order}) {
    for (const bool with_shells : {false, true}) {
      for (const std::optional<TraceMethod> method : {std::optional<TraceMethod>(), std::optional(TraceMethod::rk34),
                                                      std::optional(TraceMethod::baseline_rk34)}) {
        if (method && mode == ViewMode::image_order) {
          continue;
        }
        SCOPED_TRACE(static_cast<int>(mode));
        Show show = plain_show();
        for (const test::Effect& effect : effects()) {
          if (with_shells && std::string_view(effect.name) == "shells") {
            effect.add(show);
          }
        }
        FrameRequest asked = request();
        asked.mode = mode;
        asked.method = method;
        expect_as_planned(show, asked);
      }
    }
  }
}

TEST_F(RayHeatPlans, NameTheShellsThatRaysAreFollowedTo) {
  Show show = plain_show();
  show.shells.resize(1);
  show.lines["shells"] = 7;
  FrameRequest asked = request();
  asked.mode = ViewMode::steps;
  const FramePlan plan = plan_frame(show, asked);
  const auto pass = std::ranges::find(plan.passes, "follow_rays", &PlannedPass::name);
  ASSERT_NE(pass, plan.passes.end());
  EXPECT_NE(pass->why.find("line 7"), std::string::npos);
  EXPECT_EQ(std::ranges::find(plan.passes, "trace_pixels", &PlannedPass::name), plan.passes.end());
}

}  // namespace
}  // namespace ergodome
