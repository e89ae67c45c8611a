#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/render/present/projectors/projector_frames.h"
#include "tests/render/present/projectors/projector_light.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): projectors and domes of tests

//! The frame of a projector, as the light that it projects.
struct ThrownFrame {
  int width;
  int height;
  std::vector<std::uint8_t> rgb;
  double gamma;

  //! Returns the light at a position of the raster, interpolated between pixel centers, as a lens
  //! would blur it.
  [[nodiscard]] double light(const RasterPosition& position, int channel) const {
    const double x = std::clamp(position.x * width - 0.5, 0.0, width - 1.001);
    const double y = std::clamp(position.y * height - 0.5, 0.0, height - 1.001);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const auto at = [&](int i, int j) {
      const int index = 3 * (j * width + i) + channel;
      return std::pow(rgb[static_cast<std::size_t>(index)] / 255.0, gamma);
    };
    return std::lerp(std::lerp(at(column, row), at(column + 1, row), x - column),
                     std::lerp(at(column, row + 1), at(column + 1, row + 1), x - column), y - row);
  }
};

//! Returns the largest error of a projector's light that the rounding to eight bits causes.
double rounding_of(double light, double gamma) {
  return 0.55 / 255.0 * gamma * std::pow(std::max(light, 1e-4), 1.0 - 1.0 / gamma);
}

constexpr int fringe_px = 48;
constexpr double fringe_height = 0.3;

//! Returns the test color at a position of the master: red varies with u, green varies with v, blue
//! is uniform.
Vector3<float> fringes(double u, double v) {
  const auto wave = [](double at) {
    return static_cast<float>(0.5 + fringe_height * std::sin(2.0 * pi * at * 1024.0 / fringe_px));
  };
  return {wave(u), wave(v), 0.5F};
}

//! The light of all projectors at a point of the dome, in three channels, and its largest error by
//! rounding to eight bits.
struct PointLight {
  double light[3] = {};
  double rounding = 0.0;
};

class ThrownFrames : public ProjectorFrames {
 protected:
  void expect_master(const DomeSetup& setup) {
    std::vector<ProjectorOptics> optics;
    optics.reserve(setup.projectors.size());
    for (const ProjectorSetup& projector : setup.projectors) {
      optics.emplace_back(setup, projector);
    }
    ASSERT_NO_FATAL_FAILURE(open(projector_pictures(setup)));
    if (!projectors_) {
      return;
    }
    projectors_->show(master_of(1024, fringes));
    std::vector<ThrownFrame> frames;
    for (std::size_t i = 0; i < optics.size(); ++i) {
      const ProjectorSetup& projector = setup.projectors[i];
      frames.push_back({projector.width_px, projector.height_px, projectors_->frame(i), projector.gamma});
    }
    constexpr int positions = sanitized ? 2'000 : 20'000;
    std::vector<PointLight> lights;
    double even = 0.0;
    for (int i = 0; i < positions; ++i) {
      lights.push_back(light_at(optics, frames, dome_point(setup, i, positions)));
      even += lights.back().light[2] / positions;
    }
    const double scale = 0.5 / even;
    double max_over = 0.0;
    for (int i = 0; i < positions; ++i) {
      double u = 0.0;
      double v = 0.0;
      ASSERT_TRUE(master_position({setup.tilt_deg, 180.0}, dome_point(setup, i, positions), u, v));
      const Vector3<float> wanted = fringes(u, v);
      const PointLight& found = lights[static_cast<std::size_t>(i)];
      for (int c = 0; c < 3; ++c) {
        const double slope = c < 2 ? fringe_height * 2.0 * pi / fringe_px : 0.0;
        const double allowed = 0.01 * channel_of(wanted, c) + 0.5 * slope + scale * found.rounding;
        max_over = std::max(max_over, std::abs(scale * found.light[c] - channel_of(wanted, c)) / allowed);
      }
    }
    RecordProperty("worst_share_of_tolerance", std::to_string(max_over));
    EXPECT_LT(max_over, 1.0);
  }

 private:
  static PointLight light_at(const std::vector<ProjectorOptics>& optics, const std::vector<ThrownFrame>& frames,
                             const Vector3<double>& point) {
    PointLight sum;
    for (std::size_t k = 0; k < optics.size(); ++k) {
      const auto position = optics[k].raster_position(point);
      if (!position) {
        continue;
      }
      const double spread = optics[k].spread_m2(*position);
      for (int c = 0; c < 3; ++c) {
        sum.light[c] += frames[k].light(*position, c) / spread;
      }
      sum.rounding += rounding_of(frames[k].light(*position, 2), frames[k].gamma) / spread;
    }
    return sum;
  }
};

TEST_P(ThrownFrames, OfThreeProjectorsShowTheMaster) {
  expect_master(calibrated_in(folder_, three(1000), {1024, 0.1}));
}

TEST_P(ThrownFrames, OfSixProjectorsShowTheMaster) {
  if (sanitized) {
    GTEST_SKIP() << "the dome of three is enough";
  }
  expect_master(calibrated_in(folder_, six(700), {1024, 0.1}));
}

TEST_P(ThrownFrames, OfProjectorsWithoutFilesShowTheMaster) {
  if (sanitized) {
    GTEST_SKIP() << "the dome of three is enough";
  }
  DomeSetup setup = three(1000);
  setup.projectors[1].gamma = 1.8;
  expect_master(setup);
}

INSTANTIATE_TEST_SUITE_P(By, ThrownFrames, testing::ValuesIn(drawers), name_of_drawer);

}  // namespace
}  // namespace ergodome
