#include "app/exhibit/black_view.h"

#include <gtest/gtest.h>

#include "app/cli/show_loading.h"
#include "app/player/renderers/picture_light.h"
#include "kernels/core/angles.h"

namespace ergodome {
namespace {

TEST(BlackView, HintsAndThenReturnsOnce) {
  BlackView view;
  view.note(100.0, 0.0);
  EXPECT_FALSE(view.back_in_s(102.9).has_value());
  EXPECT_DOUBLE_EQ(view.back_in_s(104.0).value_or(-1.0), 16.0);
  EXPECT_FALSE(view.take_return(119.9));
  EXPECT_TRUE(view.take_return(120.0));
  EXPECT_FALSE(view.take_return(121.0));
  EXPECT_FALSE(view.back_in_s(121.0).has_value());
}

TEST(BlackView, CountsFromTheFirstOfSeveralBlackPictures) {
  BlackView view;
  view.note(100.0, 0.0);
  view.note(110.0, 0.0005);
  EXPECT_DOUBLE_EQ(view.back_in_s(110.0).value_or(-1.0), 10.0);
}

TEST(BlackView, ForgetsWhenAnythingIsInViewAgain) {
  BlackView view;
  view.note(100.0, 0.0);
  view.note(110.0, 0.01);
  EXPECT_FALSE(view.back_in_s(111.0).has_value());
  EXPECT_FALSE(view.take_return(130.0));
}

//! Returns the fraction of lit pixels in a visitor's first view, with the camera at `r` and turned
//! by `yaw_deg`.
double visitors_lit_part(double r, double yaw_deg, double exposure_stops = 0.0) {
  Show show = load_show("exhibit");
  show.camera.keys.at(0).r = r;
  show.camera.keys.at(0).yaw = yaw_deg * one_degree;
  PictureRequest request;
  request.renderer = std::make_shared<ShowRenderer>(show, Backend::cpu);
  request.renderer->set_exposure(exposure_stops);
  request.frame.pose = camera_pose(show, 0.0);
  request.frame.field_of_view_deg = show.view.field_of_view_deg;
  request.frame.exposure_stops = exposure_stops;
  return lit_part_of_view(*request.renderer, request, {});
}

TEST(LitPart, IsNothingWhereAVisitorHoversCloseToTheHorizonAndLooksDown) {
  // The horizon for spin 0.9 is at 1.4359 M. From 0.01 M above the horizon, the sky appears as a
  // narrow cone overhead.
  EXPECT_LT(visitors_lit_part(1.446, 0.0), BlackView::min_lit_part);
}

TEST(LitPart, IsMuchWhereAVisitorLooksUpFromThere) {
  EXPECT_GT(visitors_lit_part(1.446, 180.0), 10.0 * BlackView::min_lit_part);
}

TEST(LitPart, IsMuchWhereAVisitorsFlightBegins) { EXPECT_GT(visitors_lit_part(28.0, 0.0), 0.3); }

TEST(LitPart, IsTheSameInADisplayThatAnOperatorDarkened) {
  EXPECT_DOUBLE_EQ(visitors_lit_part(28.0, 0.0, -12.0), visitors_lit_part(28.0, 0.0));
}

}  // namespace
}  // namespace ergodome
