#include "render/frame/show_passes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "render/frame/frame_passes.h"
#include "render/passes/near_field/near_field_pass.h"
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

//! Returns a show with some of the effects.
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
    EXPECT_TRUE(kind.make == nullptr || kind.make({show, Backend::cpu}) == nullptr) << kind.name;
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

}  // namespace
}  // namespace ergodome
