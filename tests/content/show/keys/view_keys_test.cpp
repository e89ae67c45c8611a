#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/reading/show_reader.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

const std::string view_start = "[camera]\n[[camera.key]]\nr = 10\n";

std::string view_problem_of(const std::string& text) {
  return error_of([&] { parse_show(text, "show.toml"); });
}

//! Returns a show whose [view] table contains the given lines.
Show viewed(const std::string& lines) { return parse_show(view_start + "[view]\n" + lines, "show.toml"); }

TEST(View, HasTheUsualFieldOfEachProjection) {
  EXPECT_EQ(viewed("").view.field_of_view_deg, 180.0);
  EXPECT_EQ(viewed("projection = \"equirect\"\n").view.field_of_view_deg, 360.0);
  EXPECT_EQ(viewed("projection = \"cylinder\"\n").view.field_of_view_deg, 360.0);
  EXPECT_EQ(viewed("projection = \"pinhole\"\n").view.field_of_view_deg, 60.0);
}

TEST(View, OfADomeReadsBackAsItIsWritten) {
  const Show show = viewed(
      "fov_deg = 210\nlens = \"polynomial\"\npolynomial = [0.6, 0.01]\ntruncate = { bottom = 0.25, top = 0.1 }\n"
      "viewer = [0.1, -0.2, 0.3]\nfrom_outside = true\nvignette = 0.4\n");
  const ViewSettings back = parse_show(to_toml(show), "show.toml").view;
  EXPECT_EQ(back.lens, LensLaw::polynomial);
  EXPECT_EQ(back.field_of_view_deg, 210.0);
  EXPECT_EQ(back.polynomial, (std::array<double, 4>{0.6, 0.01, 0.0, 0.0}));
  EXPECT_EQ(back.truncation.bottom, 0.25);
  EXPECT_EQ(back.truncation.top, 0.1);
  EXPECT_EQ(back.viewer.x, 0.1);
  EXPECT_EQ(back.viewer.y, -0.2);
  EXPECT_EQ(back.viewer.z, 0.3);
  EXPECT_TRUE(back.from_outside);
  EXPECT_EQ(back.vignette, 0.4);
}

TEST(View, OfACubeReadsBackAsItIsWritten) {
  const Show show = viewed("projection = \"cube\"\ncube_layout = \"faces\"\n");
  EXPECT_EQ(show.view.cube_files, CubeFiles::faces);
  EXPECT_EQ(parse_show(to_toml(show), "show.toml").view.cube_files, CubeFiles::faces);
}

TEST(View, OfACylinderReadsBackAsItIsWritten) {
  const Show show = viewed("projection = \"cylinder\"\nfov_deg = 240\nheight_deg = 70\n");
  const ViewSettings back = parse_show(to_toml(show), "show.toml").view;
  EXPECT_EQ(back.projection, ViewProjection::cylinder);
  EXPECT_EQ(back.field_of_view_deg, 240.0);
  EXPECT_EQ(back.height_deg, 70.0);
}

TEST(View, OfAFrustumReadsBackAsItIsWritten) {
  const Show show =
      viewed("projection = \"pinhole\"\nfrustum = { left_deg = -10, right_deg = 45, up_deg = 20, down_deg = 5 }\n");
  const ViewSettings back = parse_show(to_toml(show), "show.toml").view;
  ASSERT_TRUE(back.frustum.has_value());
  EXPECT_EQ(back.frustum->left_deg, -10.0);
  EXPECT_EQ(back.frustum->right_deg, 45.0);
  EXPECT_EQ(back.frustum->up_deg, 20.0);
  EXPECT_EQ(back.frustum->down_deg, 5.0);
}

//! Returns the error message for a show whose [view] table contains the given lines; the first of
//! them is line 5 of the file.
std::string view_problem(const std::string& lines) { return view_problem_of(view_start + "[view]\n" + lines); }

TEST(View, RefusesAFieldWhereItShowsTheWholeSky) {
  const std::string view = "projection = \"cube\"\n";
  EXPECT_THAT(view_problem(view + "fov_deg = 90\n"),
              AllOf(HasSubstr("show.toml:"), HasSubstr("view.fov_deg"), HasSubstr("the whole sky")));
  EXPECT_EQ(view_problem(view + "fov_deg = 360\n"), "");
}

TEST(View, OfHalfASkyReadsBackAsItIsWritten) {
  const Show show = viewed("projection = \"equirect\"\nfov_deg = 180\n");
  EXPECT_FALSE(shows_whole_sky(show.view));
  EXPECT_EQ(parse_show(to_toml(show), "show.toml").view.field_of_view_deg, 180.0);
  EXPECT_TRUE(shows_whole_sky(viewed("projection = \"equirect\"\n").view));
  EXPECT_THAT(view_problem("projection = \"equirect\"\nfov_deg = 361\n"), HasSubstr("view.fov_deg"));
}

TEST(View, RefusesFieldsThatALensCannotSee) {
  EXPECT_THAT(view_problem("lens = \"orthographic\"\nfov_deg = 190\n"),
              AllOf(HasSubstr("show.toml:6"), HasSubstr("view.fov_deg"), HasSubstr("at most 180")));
  EXPECT_THAT(view_problem("lens = \"stereographic\"\nfov_deg = 360\n"), HasSubstr("view.fov_deg"));
  EXPECT_EQ(view_problem("lens = \"equisolid\"\nfov_deg = 360\n"), "");
}

TEST(View, RefusesPolynomialsThatDoNotRise) {
  EXPECT_THAT(view_problem("lens = \"polynomial\"\npolynomial = [1.0, -0.4]\n"),
              AllOf(HasSubstr("show.toml:6"), HasSubstr("view.polynomial"), HasSubstr("does not increase")));
  EXPECT_THAT(view_problem("lens = \"polynomial\"\npolynomial = [-1.0]\n"), HasSubstr("above 0"));
}

TEST(View, RefusesALensWithoutItsPolynomialAndAPolynomialWithoutItsLens) {
  EXPECT_THAT(view_problem("lens = \"polynomial\"\n"), AllOf(HasSubstr("show.toml:5"), HasSubstr("view.lens")));
  EXPECT_THAT(view_problem("polynomial = [0.6]\n"), AllOf(HasSubstr("show.toml:5"), HasSubstr("view.polynomial")));
}

TEST(View, RefusesNumbersThatAreNone) {
  EXPECT_THAT(view_problem("lens = \"polynomial\"\npolynomial = [0.6, nan]\n"), HasSubstr("view.polynomial"));
  EXPECT_THAT(view_problem("lens = \"polynomial\"\npolynomial = []\n"), HasSubstr("view.polynomial"));
  EXPECT_THAT(view_problem("lens = \"polynomial\"\npolynomial = [1, 2, 3, 4, 5]\n"), HasSubstr("view.polynomial"));
  EXPECT_THAT(view_problem("viewer = [0.1, 0.2]\n"), HasSubstr("view.viewer"));
  EXPECT_THAT(view_problem("viewer = \"left\"\n"), HasSubstr("view.viewer"));
}

TEST(View, RefusesAViewerOutsideTheDome) {
  EXPECT_THAT(view_problem("\nviewer = [0.0, 0.8, 0.8]\n"),
              AllOf(HasSubstr("show.toml:6"), HasSubstr("inside the dome")));
}

TEST(View, RefusesATruncationThatLeavesNothing) {
  EXPECT_THAT(view_problem("truncate = { bottom = 0.6, top = 0.4 }\n"), HasSubstr("removes the whole picture"));
  EXPECT_THAT(view_problem("truncate = { botom = 0.6 }\n"), HasSubstr("\"bottom\""));
}

TEST(View, RefusesAFrustumThatIsTurnedOver) {
  EXPECT_THAT(view_problem("projection = \"pinhole\"\nfrustum = { left_deg = 30, right_deg = 10 }\n"),
              HasSubstr("view.frustum.right_deg"));
  EXPECT_THAT(view_problem("projection = \"pinhole\"\nfrustum = { up_deg = -40 }\n"), HasSubstr("view.frustum.up_deg"));
}

}  // namespace
}  // namespace ergodome
