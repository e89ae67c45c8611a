#include "render/frame/show_passes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/projection/make_projection.h"
#include "render/frame/frame_passes.h"
#include "render/passes/flat_shadow/flat_shadow_pass.h"
#include "render/passes/near_field/near_field_pass.h"
#include "render/passes/overlay/overlay_pass.h"
#include "render/passes/stars/star_pass.h"
#include "tests/render/plan/frame_plan_scenes.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): scenes of tests
using testing::ElementsAre;

std::vector<std::string> names_of(const std::vector<Pass*>& passes) {
  std::vector<std::string> names;
  names.reserve(passes.size());
  for (const Pass* pass : passes) {
    names.emplace_back(pass->kind().name);
  }
  return names;
}

//! Returns the show with the named effects added.
Show with(Show show, const std::vector<std::string>& wanted) {
  for (const Effect& effect : effects()) {
    if (std::ranges::find(wanted, effect.name) != wanted.end()) {
      effect.add(show);
    }
  }
  return show;
}

class PassesOfShows : public FramePlans {};

TEST_F(PassesOfShows, AreNoneForAPlainSky) {
  const Show show = plain_show();
  const ShowPasses passes({show, Backend::cpu});
  EXPECT_THAT(names_of(passes.of_pictures(show, ViewMode::sky)), ElementsAre());
  for (const PassKind& kind : frame_passes()) {
    // Eyes and captions can also be set from outside the show.
    const bool for_all = kind.name == std::string(flat_shadow_kind.name) || kind.name == std::string(overlay_kind.name);
    EXPECT_TRUE(for_all || kind.make == nullptr || kind.make({show, Backend::cpu}) == nullptr) << kind.name;
  }
}

TEST_F(PassesOfShows, DrawInTheOrderOfTheList) {
  const Show show = with(plain_show(), {"bloom", "stars", "disk", "diffraction"});
  const ShowPasses passes({show, Backend::cpu});
  EXPECT_THAT(names_of(passes.of_pictures(show, ViewMode::sky)),
              ElementsAre("stars", "near_field", "bloom", "image_edge"));
  EXPECT_THAT(names_of(passes.of_pictures(show, ViewMode::steps)), ElementsAre());
}

TEST_F(PassesOfShows, DrawOnlyWhileTheirNumbersHaveAnEffect) {
  Show show = with(plain_show(), {"bloom", "disk"});
  const ShowPasses passes({show, Backend::cpu});
  show.effects.bloom->strength = 0.0;
  show.disk->opacity = 0.0;
  EXPECT_THAT(names_of(passes.of_pictures(show, ViewMode::sky)), ElementsAre());
}

TEST_F(PassesOfShows, AreKeptForAnotherShowThatTheyServe) {
  const Show now = with(plain_show(), {"stars", "disk"});
  ShowPasses passes({now, Backend::cpu});
  const auto* const stars = passes.find<StarPass>();
  Show next = now;
  next.sky.exposure = 2.0;
  next.disk.reset();
  passes.replace(passes.changed_for(now, {next, Backend::cpu}));
  EXPECT_EQ(passes.find<StarPass>(), stars);
  EXPECT_THAT(names_of(passes.of_pictures(next, ViewMode::sky)), ElementsAre("stars"));
  EXPECT_EQ(passes.find<NearFieldPass>(), nullptr);
}

TEST_F(PassesOfShows, KeepTheStateOfOverlaysInAnotherShow) {
  const Show now = plain_show();
  ShowPasses passes({now, Backend::cpu});
  auto* const overlays = passes.find<OverlayPass>();
  Caption welcome;
  welcome.text[""] = "Welcome";
  overlays->set_extra({welcome});
  Show next = now;
  next.timeline.captions.push_back(welcome);
  passes.replace(passes.changed_for(now, {next, Backend::cpu}));
  EXPECT_EQ(passes.find<OverlayPass>(), overlays);
  EXPECT_TRUE(overlays->draws_at(1.0));
}

TEST_F(PassesOfShows, ExposeTheFramesOfTheSkyAlone) {
  Show show = plain_show();
  show.tone.automatic.emplace().target = 0.5;
  const ShowPasses passes({show, Backend::cpu});
  Picture picture;
  picture.width = 1;
  picture.height = 1;
  picture.rgba.assign(4, 1.0F);
  const CameraPose pose{};
  const Projection projection = make_dome_projection(1, 3.0, 0.0);
  for (const ViewMode mode : {ViewMode::steps, ViewMode::sky}) {
    FinishedFrame frame = {
        Backend::cpu, show, mode, pose, projection, {}, 0.0, {}, {{picture.rgba.data(), 0.0, &picture}}};
    const float before = frame.tone.gain;
    passes.finish(frame);
    EXPECT_FLOAT_EQ(frame.tone.gain, mode == ViewMode::sky ? 0.5F * before : before);
  }
}

}  // namespace
}  // namespace ergodome
