#include "render/passes/stars/search/corrected_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/lens/grid/grid_tracer.h"
#include "render/passes/stars/drawing/edge_rounding.h"
#include "tests/render/passes/stars/star_cameras.h"

namespace ergodome {
namespace {

bool corrected(const CorrectedGrid& grid, int leaf, const Vector3<double>& star, ChartImage& image) {
  return correct_image(grid.view(host_data), leaf,
                       {static_cast<float>(star.x), static_cast<float>(star.y), static_cast<float>(star.z)}, image);
}

//! Compares values of a star grid with rays traced in double, at one position in each leaf.
class CorrectedImages : public testing::TestWithParam<test::CameraState> {
 protected:
  static constexpr float u = 0.37F;
  static constexpr float v = 0.81F;

  void SetUp() override {
    const EyeCamera eye = test::eye_at_position(GetParam());
    StarSettings settings = test::settings_for(9.0);
    settings.pixel = pi / 1024;
    station_ = build_star_station(eye, settings);
    boxes_ = leaf_boxes(station_);
    std::vector<float> gamma_turns;
    std::vector<float> s;
    for (const LeafBox& box : boxes_) {
      gamma_turns.push_back(static_cast<float>(box.gamma_turns + static_cast<double>(u) * box.width_turns));
      s.push_back(static_cast<float>(box.s + static_cast<double>(v) * box.height));
    }
    GridTracer<double> tracer;
    const CameraStation rain = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, ObserverMotion::rain);
    seen_ = tracer.nodes_of({rain, grid_view(station_).chart, {1e-12, 1000, true}}, gamma_turns, s);
  }

  //! Returns the traced sky direction at a leaf's position (part 0), or its derivative along γ or s
  //! (parts 1 and 2).
  [[nodiscard]] Vector3<double> seen(std::size_t leaf, int part) const {
    const float* const node = seen_.data() + floats_a_node * leaf + 4 * static_cast<std::ptrdiff_t>(part);
    return {static_cast<double>(node[0]), static_cast<double>(node[1]), static_cast<double>(node[2])};
  }

  //! Errors of an image at a leaf's position: its distance from this position relative to the
  //! leaf's size, and the relative error of its area.
  struct Error {
    double parts;
    double area;
  };

  [[nodiscard]] Error error_of(std::size_t leaf, const ChartImage& image) const {
    const LeafBox& box = boxes_[leaf];
    const double area = -dot(seen(leaf, 0), cross(seen(leaf, 1), seen(leaf, 2)));
    const auto away = [](float at, double begin, double size, float position) {
      return std::abs((static_cast<double>(at) - begin) / size - static_cast<double>(position));
    };
    return {away(image.gamma_turns, box.gamma_turns, box.width_turns, u) + away(image.s, box.s, box.height, v),
            std::abs(static_cast<double>(image.sky) / area - 1.0)};
  }

  //! Returns whether a leaf may be folded: near caustics, the ratio of areas on the sky and in the
  //! chart varies strongly between its corners, and images are displaced far.
  [[nodiscard]] bool may_be_folded(std::size_t leaf) const {
    double minimum = 1e30;
    double maximum = -1e30;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const float* const node = station_.traced_nodes.data() +
                                static_cast<std::ptrdiff_t>(floats_a_node) * station_.leaves[4 * leaf + corner];
      const auto part = [&](int first) { return Vector3<float>{node[first], node[first + 1], node[first + 2]}; };
      const auto area = static_cast<double>(dot(part(0), cross(part(4), part(8))));
      minimum = std::min(minimum, area);
      maximum = std::max(maximum, area);
    }
    return minimum * maximum <= 0.0 ||
           std::min(std::abs(minimum), std::abs(maximum)) < 0.3 * std::max(std::abs(minimum), std::abs(maximum));
  }

  [[nodiscard]] ChartImage position_in(std::size_t leaf) const {
    const LeafBox& box = boxes_[leaf];
    return {static_cast<float>(box.gamma_turns + static_cast<double>(u) * box.width_turns),
            static_cast<float>(box.s + static_cast<double>(v) * box.height), 1.0F};
  }

  LensStation station_;
  std::vector<LeafBox> boxes_;
  std::vector<float> seen_;
};

TEST_P(CorrectedImages, AreWhereRaysHaveThem) {
  const CorrectedGrid grid(station_);
  int compared = 0;
  int beyond = 0;
  for (std::size_t leaf = 0; leaf < boxes_.size(); ++leaf) {
    const LeafErrors errors = grid.errors(static_cast<int>(leaf));
    if (errors.displaced > 0.03F || may_be_folded(leaf)) {
      continue;
    }
    ChartImage image = position_in(leaf);
    image.gamma_turns += static_cast<float>(3e-3 * boxes_[leaf].width_turns);
    ASSERT_TRUE(corrected(grid, static_cast<int>(leaf), seen(leaf, 0), image)) << "leaf " << leaf;
    const Error error = error_of(leaf, image);
    // Where the correction by rays is small, the rounding of positions and sky directions to float
    // dominates. This rounding is larger next to the edge of the shadow.
    const double rounding = edge_rounding / edge_distance(grid_view(station_).chart, boxes_[leaf].s);
    const auto left = static_cast<double>(errors.left);
    const double worst = std::max(error.parts / (4.0 * left + 5e-4 + 0.05 * rounding),
                                  error.area / (10.0 * left + 3e-3 + 0.1 * rounding));
    EXPECT_LE(worst, 3.0) << "leaf " << leaf;
    beyond += worst > 1.0 ? 1 : 0;
    ++compared;
  }
  EXPECT_GT(compared, 500);
  EXPECT_LE(beyond, compared / 200);
}

TEST_P(CorrectedImages, AreWrongByAQuarterOfTheErrorOfTheirPatches) {
  const CorrectedGrid grid(station_);
  std::vector<double> ratios;
  for (std::size_t leaf = 0; leaf < boxes_.size(); ++leaf) {
    const LeafErrors errors = grid.errors(static_cast<int>(leaf));
    // Uses only leaves whose patch has an error larger than rounding.
    if (errors.displaced > 1e-5F && errors.displaced < 0.03F && !may_be_folded(leaf)) {
      ChartImage image = position_in(leaf);
      ASSERT_TRUE(corrected(grid, static_cast<int>(leaf), seen(leaf, 0), image)) << "leaf " << leaf;
      ratios.push_back(error_of(leaf, image).parts / static_cast<double>(errors.displaced));
    }
  }
  ASSERT_GT(ratios.size(), 500U);
  std::ranges::nth_element(ratios, ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2));
  EXPECT_LT(ratios[ratios.size() / 2], 0.25);
}

INSTANTIATE_TEST_SUITE_P(Cameras, CorrectedImages, testing::ValuesIn(test::positions));

TEST(CorrectedGrid, OfAStationThatKeptNoChecksKnowsNoErrors) {
  GridSettings settings;
  settings.budget_px = 1.0;
  const CorrectedGrid grid(build_lens_station(Spacetime{0.9}, 6.0, 1.0, settings));
  EXPECT_GT(grid.errors(0).displaced, 1e6F);
  EXPECT_GT(grid.errors(0).left, 1e6F);
}

TEST(CorrectedGrid, DoesNotMoveAnImageOfAStarThatIsElsewhere) {
  const LensStation station = build_star_station(test::eye_at_position(test::positions[0]), test::settings_for(9.0));
  const CorrectedGrid grid(station);
  const LeafBox box = leaf_boxes(station)[0];
  const Vector3<double> sky = {static_cast<double>(station.nodes[0]), static_cast<double>(station.nodes[1]),
                               static_cast<double>(station.nodes[2])};
  ChartImage image = {static_cast<float>(box.gamma_turns), static_cast<float>(box.s), 1.0F};
  EXPECT_FALSE(corrected(grid, 0, cross(Vector3<double>{0.6, 0.0, 0.8}, sky), image));
  EXPECT_EQ(image.gamma_turns, static_cast<float>(box.gamma_turns));
  EXPECT_EQ(image.sky, 1.0F);
}

}  // namespace
}  // namespace ergodome
