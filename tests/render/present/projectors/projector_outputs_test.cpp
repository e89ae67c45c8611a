#include "render/present/projectors/projector_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<DesktopMonitor> side_by_side = {{"left", {0, 0, 1000, 800}, {0, 0, 1000, 800}},
                                                  {"right", {1000, 0, 1000, 800}, {1000, 0, 1000, 800}}};

ProjectorSetup projector_in_window(int x_px, int y_px) {
  ProjectorSetup projector;
  projector.name = "north";
  projector.read_from = "dome.toml:7";
  projector.width_px = 200;
  projector.height_px = 100;
  projector.output.window_x_px = x_px;
  projector.output.window_y_px = y_px;
  return projector;
}

ProjectorSetup projector_on_monitor(int monitor) {
  ProjectorSetup projector = projector_in_window(0, 0);
  projector.output.monitor = monitor;
  return projector;
}

DomeSetup setup_of(const std::vector<ProjectorSetup>& projectors) {
  DomeSetup setup;
  setup.projectors = projectors;
  return setup;
}

TEST(ProjectorOutputs, AreOnMonitorsWhereAPixelIs) {
  const DomeSetup setup =
      setup_of({projector_in_window(-199, -99), projector_in_window(1999, 799), projector_on_monitor(1)});
  EXPECT_NO_THROW(require_outputs(setup, side_by_side));
}

TEST(ProjectorOutputs, BesideAllMonitorsAreToldWithThese) {
  for (const auto& [x, y] : {std::pair(2000, 0), {-200, 0}, {0, 800}, {0, -100}, {100000, 100000}}) {
    const std::string problem =
        test::error_of([&, x = x, y = y] { require_outputs(setup_of({projector_in_window(x, y)}), side_by_side); });
    EXPECT_THAT(problem, AllOf(HasSubstr("dome.toml:7, projector north: no monitor shows its window"),
                               HasSubstr("0 (left, 1000 x 800 at 0, 0), 1 (right, 1000 x 800 at 1000, 0)")));
  }
}

TEST(ProjectorOutputs, OnAMissingMonitorAreToldWithThoseThatThereAre) {
  EXPECT_THAT(test::error_of([] { require_outputs(setup_of({projector_on_monitor(2)}), side_by_side); }),
              AllOf(HasSubstr("projector north: there is no monitor 2; choose from 0 (left"), HasSubstr("1 (right")));
}

TEST(ProjectorOutputs, WithoutMonitorsWindowsAreTakenAsTheyAre) {
  EXPECT_NO_THROW(require_outputs(setup_of({projector_in_window(5000, 0)}), {}));
  EXPECT_THAT(test::error_of([] { require_outputs(setup_of({projector_on_monitor(0)}), {}); }),
              HasSubstr("connect it"));
}

TEST(ProjectorOutputs, AreWholeMonitorsOrWindows) {
  const DomeSetup setup = setup_of({projector_on_monitor(1), projector_in_window(10, 20)});
  EXPECT_THAT(output_rectangles(setup, side_by_side),
              testing::ElementsAre(DesktopRectangle{1000, 0, 1000, 800}, DesktopRectangle{10, 20, 200, 100}));
}

TEST(ProjectorOutputs, UncoverAWindowWhereThereIsRoom) {
  const DomeSetup setup = setup_of({projector_in_window(0, 0), projector_on_monitor(1)});
  EXPECT_EQ(rectangle_beside_projectors({0, 40, 700, 700}, setup, side_by_side), (DesktopRectangle{200, 0, 700, 700}));
  EXPECT_EQ(rectangle_beside_projectors({0, 40, 900, 700}, setup, side_by_side), (DesktopRectangle{0, 100, 900, 700}));
}

TEST(ProjectorOutputs, LeaveAWindowWhereItIsSeenOrNothingIsFree) {
  const DomeSetup setup = setup_of({projector_in_window(0, 0), projector_on_monitor(1)});
  EXPECT_EQ(rectangle_beside_projectors({300, 40, 700, 700}, setup, side_by_side), std::nullopt);
  EXPECT_EQ(rectangle_beside_projectors({0, 40, 900, 750}, setup, side_by_side), std::nullopt);
}

}  // namespace
}  // namespace ergodome
