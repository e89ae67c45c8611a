#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

#include "content/show/reading/show_reader.h"
#include "content/show/stereo_eyes.h"
#include "content/show/unused_keys.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

Show show_with_headset(const std::string& headset) {
  return parse_show("[[camera.key]]\nr = 12\n[headset]\n" + headset, "h.toml");
}

TEST(HeadsetReader, TakesEveryKeyAndWritesItBack) {
  HeadsetSettings headset;
  headset.stereo = HeadsetStereo::omni;
  headset.scale = 0.75;
  headset.rest_frame = false;
  headset.vignette = 0.5;
  headset.fade_s = 1.25;
  headset.snap_turn_deg = 45.0;
  headset.exposure_rate = 3.0;
  headset.panel = false;
  const Show show = show_with_headset(
      "stereo = \"omni\"\nscale = 0.75\nrest_frame = false\nvignette = 0.5\nfade_s = 1.25\nsnap_turn_deg = 45\n"
      "exposure_rate = 3\npanel = false\n");
  EXPECT_EQ(show.headset, headset);
  EXPECT_EQ(parse_show(to_toml(show), "again.toml").headset, headset);
  EXPECT_THAT(unused_keys(show), IsEmpty());
}

TEST(HeadsetReader, HasComfortableDefaults) {
  const HeadsetSettings headset = parse_show("[[camera.key]]\nr = 12\n", "h.toml").headset;
  EXPECT_EQ(headset, HeadsetSettings());
  EXPECT_EQ(headset, show_with_headset("").headset);
  EXPECT_EQ(headset.stereo, HeadsetStereo::flat);
  EXPECT_TRUE(headset.rest_frame && headset.panel);
  EXPECT_EQ(headset.vignette, 1.0);
  EXPECT_EQ(headset.fade_s, 0.3);
  EXPECT_EQ(headset.snap_turn_deg, 30.0);
  EXPECT_EQ(headset.exposure_rate, 1.0);
}

TEST(HeadsetReader, AllowsEverythingToBeTurnedOff) {
  const HeadsetSettings headset = show_with_headset(
                                      "stereo = \"mono\"\nrest_frame = false\nvignette = 0\nfade_s = 0\n"
                                      "snap_turn_deg = 0\nexposure_rate = 0\npanel = false\n")
                                      .headset;
  EXPECT_EQ(headset.stereo, HeadsetStereo::mono);
  EXPECT_EQ(headset.vignette + headset.fade_s + headset.snap_turn_deg + headset.exposure_rate, 0.0);
}

TEST(HeadsetReader, NamesWhatIsWrong) {
  const auto error = [](const std::string& headset) { return test::error_of([&] { show_with_headset(headset); }); };
  EXPECT_THAT(error("vignete = 1\n"), AllOf(HasSubstr("h.toml:4"), HasSubstr("did you mean \"vignette\"")));
  EXPECT_THAT(error("stereo = \"flt\"\n"), AllOf(HasSubstr("headset.stereo"), HasSubstr("physical, omni")));
  EXPECT_THAT(error("rest_frame = 1\n"), HasSubstr("headset.rest_frame"));
  for (const char* const wrong :
       {"scale = -0.1", "scale = 2e6", "scale = nan", "vignette = -0.1", "vignette = 1.1", "fade_s = -1",
        "fade_s = 5.1", "snap_turn_deg = -30", "snap_turn_deg = 91", "exposure_rate = -1", "exposure_rate = inf"}) {
    const std::string_view line = wrong;
    EXPECT_THAT(error(std::string(line) + "\n"), HasSubstr("headset." + std::string(line.substr(0, line.find(' ')))))
        << wrong;
  }
}

TEST(HeadsetReader, RefusesAnimatedNumbers) {
  EXPECT_THAT(test::error_of([] {
                parse_show(
                    "[[camera.key]]\nr = 12\n[[animate]]\nnumber = \"headset.scale\"\n"
                    "key = [{ value = 1 }, { t_s = 1, value = 2 }]\n",
                    "h.toml");
              }),
              HasSubstr("animate[0].number is \"headset.scale\", which is not a number that can be animated"));
}

TEST(HeadsetReader, HasTheStereoModelsAndMono) {
  ASSERT_EQ(headset_stereo_names.size(), stereo_model_names.size() + 1);
  for (std::size_t i = 0; i < headset_stereo_names.size(); ++i) {
    const auto model = stereo_model(static_cast<HeadsetStereo>(i));
    EXPECT_EQ(model ? std::string_view(stereo_model_names[static_cast<std::size_t>(*model)]) : "mono",
              headset_stereo_names[i]);
  }
}

}  // namespace
}  // namespace ergodome
