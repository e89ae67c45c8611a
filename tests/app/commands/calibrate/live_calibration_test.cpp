#include "app/commands/calibrate/live_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

using testing::HasSubstr;
using Action = CalibrationAction;

class LiveKeys : public testing::Test {
 protected:
  LiveKeys() : live_(setup(), 5) {}

  static DomeSetup setup() {
    DomeSetup setup;
    setup.radius_m = 4.0;
    setup.tilt_deg = 10.0;
    for (const char* const name : {"north", "south"}) {
      ProjectorSetup projector;
      projector.name = name;
      projector.width_px = 1000;
      projector.height_px = 500;
      setup.projectors.push_back(projector);
    }
    return setup;
  }

  Renewal press(Action action, int times = 1) {
    Renewal last = Renewal::nothing;
    for (int i = 0; i < times; ++i) {
      last = live_.press(action);
    }
    return last;
  }

  [[nodiscard]] const ProjectorSetup& projector(std::size_t i) const { return live_.setup().projectors[i]; }

  LiveCalibration live_;
};

TEST_F(LiveKeys, TiltGoesUpAndDownByHalfDegrees) {
  press(Action::choose_tilt);
  EXPECT_EQ(press(Action::up, 3), Renewal::master);
  EXPECT_DOUBLE_EQ(live_.setup().tilt_deg, 11.5);
  press(Action::down, 5);
  EXPECT_DOUBLE_EQ(live_.setup().tilt_deg, 9.0);
}

TEST_F(LiveKeys, StepsAreATenthAndTenTimes) {
  press(Action::finer, 4);
  press(Action::up);
  EXPECT_DOUBLE_EQ(live_.setup().tilt_deg, 10.05);
  press(Action::coarser, 7);
  press(Action::up);
  EXPECT_NEAR(live_.setup().tilt_deg, 15.05, 1e-12);
}

TEST_F(LiveKeys, TiltEndsWhereSetupsEnd) {
  press(Action::coarser);
  press(Action::up, 100);
  EXPECT_EQ(live_.setup().tilt_deg, 90.0);
  press(Action::down, 100);
  EXPECT_EQ(live_.setup().tilt_deg, -90.0);
}

TEST_F(LiveKeys, RotationGoesRound) {
  press(Action::choose_rotation);
  press(Action::coarser);
  EXPECT_EQ(press(Action::right, 37), Renewal::master);
  EXPECT_NEAR(live_.setup().rotation_deg, -175.0, 1e-9);
}

TEST_F(LiveKeys, ViewerGoesRightForwardAndUpAndStaysInTheDome) {
  press(Action::choose_viewer);
  press(Action::right, 2);
  press(Action::up);
  EXPECT_EQ(press(Action::upwards, 3), Renewal::master);
  EXPECT_DOUBLE_EQ(live_.setup().viewer_m.x, 0.2);
  EXPECT_DOUBLE_EQ(live_.setup().viewer_m.y, 0.3);
  EXPECT_DOUBLE_EQ(live_.setup().viewer_m.z, -0.1);
  press(Action::coarser);
  EXPECT_EQ(press(Action::right, 20), Renewal::nothing);
  EXPECT_LT(live_.setup().viewer_m.x, 4.0);
}

TEST_F(LiveKeys, CornersOfTheChosenProjectorMoveByPixels) {
  press(Action::next_projector);
  press(Action::choose_bottom_right);
  press(Action::right);
  EXPECT_EQ(press(Action::down, 2), Renewal::warps);
  constexpr std::size_t bottom_right = 3;
  EXPECT_DOUBLE_EQ(live_.offsets()[1].right[bottom_right], 0.005);
  EXPECT_DOUBLE_EQ(live_.offsets()[1].down[bottom_right], 0.02);
  EXPECT_TRUE(live_.offsets()[0].none());
}

TEST_F(LiveKeys, CornersStayWhereWarpsCanFollow) {
  press(Action::choose_top_left);
  press(Action::coarser);
  press(Action::left, 100);
  EXPECT_EQ(live_.offsets()[0].right[0], -GridOffsets::farthest);
}

TEST_F(LiveKeys, PointsOfFinerGridsMoveAlone) {
  press(Action::choose_bottom_right);
  press(Action::right);
  EXPECT_EQ(press(Action::finer_grid, 2), Renewal::warps);
  EXPECT_THAT(live_.text(), HasSubstr("point in column 5, row 5 of 5 x 5: 5.0 px right, 0.0 px down"));
  press(Action::previous_point, 7);
  EXPECT_THAT(live_.text(), HasSubstr("point in column 3, row 4 of 5 x 5"));
  press(Action::up);
  EXPECT_DOUBLE_EQ(live_.offsets()[0].down[3 * 5 + 2], -0.01);
  EXPECT_DOUBLE_EQ(live_.offsets()[0].down[2 * 5 + 2], 0.0);
  // Only the vertical offset of this point was changed: its horizontal offset is still interpolated
  // from that of the corner.
  EXPECT_NEAR(live_.offsets()[0].right[3 * 5 + 2], 0.005 * 0.5 * 0.75, 1e-12);
  press(Action::next_projector);
  EXPECT_EQ(live_.offsets()[1].points, 2);
}

TEST_F(LiveKeys, TheFinestGridGoesBackToCornersUnlessPointsBetweenWereMoved) {
  press(Action::finer_grid, 4);
  EXPECT_EQ(live_.offsets()[0].points, 2);
  press(Action::finer_grid, 3);
  press(Action::next_point);
  press(Action::right);
  EXPECT_EQ(press(Action::finer_grid), Renewal::nothing);
  EXPECT_EQ(live_.offsets()[0].points, 9);
}

TEST_F(LiveKeys, GainIsOfAllColorsOrOfOne) {
  press(Action::choose_gain);
  EXPECT_EQ(press(Action::down, 2), Renewal::colours);
  press(Action::choose_gain, 2);
  EXPECT_THAT(live_.text(), HasSubstr("gain of green"));
  press(Action::down);
  EXPECT_NEAR(projector(0).gain.x, 0.96, 1e-12);
  EXPECT_NEAR(projector(0).gain.y, 0.94, 1e-12);
  EXPECT_NEAR(projector(0).gain.z, 0.96, 1e-12);
  EXPECT_EQ(projector(1).gain.y, 1.0);
  press(Action::undo);
  EXPECT_EQ(projector(0).gain.x, 1.0);
  press(Action::choose_gain, 2);
  EXPECT_THAT(live_.text(), HasSubstr("gain: 1.000 red"));
}

TEST_F(LiveKeys, GammaAndBlackLevelAreTheChosenProjectors) {
  press(Action::choose_gamma);
  EXPECT_EQ(press(Action::up, 2), Renewal::colours);
  press(Action::choose_black_level);
  EXPECT_EQ(press(Action::up, 3), Renewal::colours);
  EXPECT_NEAR(projector(0).gamma, 2.3, 1e-12);
  EXPECT_NEAR(projector(0).black_level_lift.y, 0.006, 1e-12);
  EXPECT_EQ(projector(1).gamma, 2.2);
  press(Action::down, 9);
  EXPECT_EQ(projector(0).black_level_lift.x, 0.0);
}

TEST_F(LiveKeys, GammaEndsWhereSetupsEnd) {
  press(Action::choose_gamma);
  press(Action::coarser);
  press(Action::down, 10);
  EXPECT_EQ(projector(0).gamma, 0.1);
  press(Action::up, 100);
  EXPECT_EQ(projector(0).gamma, 10.0);
}

TEST_F(LiveKeys, PatternsAndProjectorsGoRound) {
  EXPECT_EQ(press(Action::previous_pattern), Renewal::master);
  EXPECT_EQ(live_.pattern(), 4);
  press(Action::next_pattern, 2);
  EXPECT_EQ(live_.pattern(), 1);
  EXPECT_EQ(press(Action::previous_projector), Renewal::text);
  EXPECT_EQ(live_.projector(), 1U);
  press(Action::next_projector);
  EXPECT_EQ(live_.projector(), 0U);
}

TEST_F(LiveKeys, UndoTakesBackWhatIsChosenAlone) {
  press(Action::up);
  press(Action::choose_gamma);
  press(Action::up);
  press(Action::undo);
  EXPECT_EQ(projector(0).gamma, 2.2);
  EXPECT_DOUBLE_EQ(live_.setup().tilt_deg, 10.5);
}

TEST_F(LiveKeys, WhatIsUnsavedIsKnown) {
  EXPECT_FALSE(live_.unsaved());
  for (int quantity = 0; quantity < 10; ++quantity) {
    press(static_cast<Action>(static_cast<int>(Action::choose_tilt) + quantity));
    press(Action::up);
    EXPECT_TRUE(live_.unsaved()) << quantity;
    press(Action::undo);
    EXPECT_FALSE(live_.unsaved()) << quantity;
  }
}

TEST_F(LiveKeys, SavingKeepsWhatWasChosen) {
  press(Action::next_projector);
  press(Action::choose_top_left);
  press(Action::up);
  live_.note_saved(live_.setup());
  EXPECT_FALSE(live_.unsaved());
  EXPECT_TRUE(live_.offsets()[1].none());
  EXPECT_EQ(live_.projector(), 1U);
  EXPECT_EQ(live_.adjustable(), Adjustable::point);
}

TEST_F(LiveKeys, TextNamesWhatIsChangedAndItsValue) {
  press(Action::next_projector);
  press(Action::choose_bottom_left);
  press(Action::left);
  EXPECT_THAT(live_.text(), HasSubstr("projector 2 of 2: south"));
  EXPECT_THAT(live_.text(), HasSubstr("bottom left corner: -5.0 px right, 0.0 px down"));
  EXPECT_THAT(live_.text(), HasSubstr("step 5 px"));
  EXPECT_THAT(live_.text(), HasSubstr("not saved"));
}

TEST_F(LiveKeys, QuittingAndSavingChangeNothingHere) {
  EXPECT_EQ(press(Action::quit), Renewal::nothing);
  EXPECT_EQ(press(Action::save), Renewal::nothing);
  EXPECT_EQ(press(Action::none), Renewal::nothing);
  EXPECT_FALSE(live_.unsaved());
}

}  // namespace
}  // namespace ergodome
