#include "app/pads/pad_calibration.h"

#include <gmock/gmock.h>

#include <cmath>

#include "app/pads/decoders/decoders.h"
#include "app/pads/pad_response.h"
#include "tests/app/pads/fixtures.h"

namespace ergodome::test {
namespace {

//! Simulates a worn pad. Its left stick rests at (133, 121), jitters by one, and covers only 20 to
//! 240; its right stick is not used.
class WornPad {
 public:
  explicit WornPad(PadCalibrator& calibrator) : calibrator_(calibrator), pad_(at_rest(layout())) {}

  static const RawLayout& layout() {
    static const auto decoder = make_dualshock4(HidBus::usb);
    return decoder->layout();
  }

  void rest(double seconds) {
    for (int i = 0; i < seconds * 100; ++i) {
      pad_.values[0] = 133 + (i % 3) - 1;
      pad_.values[1] = 121;
      pad_.values[4] = 3;
      pass();
    }
  }

  void move_round() {
    for (int i = 0; i <= 100; ++i) {
      const double angle = 6.283185307 * i / 100;
      pad_.values[0] = static_cast<int>(std::lround(130 + 110 * std::cos(angle)));
      pad_.values[1] = static_cast<int>(std::lround(130 + 110 * std::sin(angle)));
      pad_.values[4] = i == 50 ? 250 : 3;
      pass();
    }
  }

  [[nodiscard]] double now_s() const { return now_s_; }

 private:
  void pass() {
    now_s_ += 0.01;
    calibrator_.take(pad_, now_s_);
  }

  PadCalibrator& calibrator_;
  RawPad pad_;
  double now_s_ = 0.0;
};

TEST(PadCalibrator, EndsWhenAllIsLetGo) {
  PadCalibrator calibrator(WornPad::layout());
  WornPad pad(calibrator);
  pad.rest(5.0);
  EXPECT_FALSE(calibrator.is_done(pad.now_s()));
  pad.move_round();
  EXPECT_FALSE(calibrator.is_done(pad.now_s()));
  pad.rest(1.0);
  EXPECT_FALSE(calibrator.is_done(pad.now_s()));
  pad.rest(1.5);
  EXPECT_TRUE(calibrator.is_done(pad.now_s()));
}

TEST(PadCalibrator, FindsEndsAndMiddleOfWhatWasMoved) {
  PadCalibrator calibrator(WornPad::layout());
  WornPad pad(calibrator);
  pad.rest(1.0);
  pad.move_round();
  pad.rest(3.0);
  const PadProfile profile = calibrator.applied_to({});
  EXPECT_EQ(profile.calibration.at("left_x"), (AxisCalibration{20, 133, 240}));
  EXPECT_EQ(profile.calibration.at("left_y"), (AxisCalibration{20, 121, 240}));
  EXPECT_EQ(profile.calibration.at("left_trigger"), (AxisCalibration{3, 3, 250}));
  EXPECT_EQ(calibrator.unmoved(), (std::vector<std::string>{"right_x", "right_y", "right_trigger"}));
  EXPECT_EQ(profile.right_stick, PadProfile{}.right_stick);
}

TEST(PadCalibrator, MakesDeadZonesThatHoldWhatRestWanders) {
  PadCalibrator calibrator(WornPad::layout());
  WornPad pad(calibrator);
  pad.rest(1.0);
  pad.move_round();
  pad.rest(3.0);
  const PadProfile profile = calibrator.applied_to({});
  EXPECT_GE(profile.left_stick.dead_zone, 0.05);
  EXPECT_LE(profile.left_stick.dead_zone, 0.1);
  RawPad raw = at_rest(WornPad::layout());
  raw.values = {134, 121, 128, 128, 3, 0};
  const PadState state = PadResponse(WornPad::layout(), profile).apply(raw, {}, {});
  EXPECT_EQ(state, PadState{});
  raw.values[0] = 240;
  EXPECT_FLOAT_EQ(PadResponse(WornPad::layout(), profile).apply(raw, {}, {}).axis(PadAxis::left_x), 1.0F);
}

TEST(PadCalibrator, LeavesAllAsItWasWhereNothingWasMoved) {
  PadCalibrator calibrator(WornPad::layout());
  WornPad pad(calibrator);
  pad.rest(10.0);
  EXPECT_FALSE(calibrator.is_done(pad.now_s()));
  EXPECT_EQ(calibrator.applied_to({}), PadProfile{});
}

}  // namespace
}  // namespace ergodome::test
