#include <gtest/gtest.h>

#include <string_view>

#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "tests/render/plan/frame_plan_scenes.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): scenes of tests

TEST_F(FramePlans, HoldForEveryEffectAlone) {
  expect_as_planned(plain_show(), request());
  for (const Effect& effect : effects()) {
    SCOPED_TRACE(effect.name);
    Show show = plain_show();
    effect.add(show);
    expect_as_planned(show, request());
  }
}

TEST_F(FramePlans, HoldForEveryPairOfEffects) {
  // Under sanitizers, a few of the pairs are enough to cover the same code.
  constexpr std::size_t stride = test::sanitized ? 20 : 1;
  for (std::size_t i = 0; i < effects().size(); ++i) {
    for (std::size_t k = i + 1; k < effects().size(); k += stride) {
      SCOPED_TRACE(std::string(effects()[i].name) + " and " + effects()[k].name);
      Show show = plain_show();
      effects()[i].add(show);
      effects()[k].add(show);
      expect_as_planned(show, request());
    }
  }
}

TEST_F(FramePlans, HoldForAllEffectsTogether) {
  for (const StereoLayout layout : {StereoLayout::mono, StereoLayout::side_by_side, StereoLayout::separate}) {
    for (const bool gather : {false, true}) {
      // Under sanitizers, one layout is enough to cover the same code.
      if (test::sanitized && gather && layout != StereoLayout::mono) {
        continue;
      }
      Show show = plain_show();
      for (const Effect& effect : effects()) {
        effect.add(show);
      }
      show.stereo.layout = layout;
      show.stereo.baseline = 0.1;
      show.sky.star_method = gather ? StarMethod::gather : StarMethod::inverse;
      expect_as_planned(show, request());
    }
  }
}

TEST_F(FramePlans, HoldForEveryStereoModelAndLayout) {
  for (const StereoModel model : {StereoModel::physical, StereoModel::flat, StereoModel::omni}) {
    for (const StereoLayout layout : {StereoLayout::multiview, StereoLayout::dubois, StereoLayout::half_top_bottom}) {
      for (const double convergence : {0.0, 10.0}) {
        // Under sanitizers, one layout is enough to cover the same code.
        if (test::sanitized && layout != StereoLayout::multiview) {
          continue;
        }
        SCOPED_TRACE(stereo_model_names[static_cast<std::size_t>(model)]);
        Show show = plain_show();
        show.effects.bloom = BloomSettings{};
        show.tone.automatic = AutoExposureSettings{};
        show.stereo.layout = layout;
        show.stereo.model = model;
        show.stereo.baseline = 0.1;
        show.stereo.convergence = convergence;
        expect_as_planned(show, request());
      }
    }
  }
}

TEST_F(FramePlans, HoldForStarsInEyesThatTurn) {
  for (const LensChoice lens : {LensChoice::automatic, LensChoice::live, LensChoice::direct}) {
    for (const double baseline : {0.0, 0.1}) {
      SCOPED_TRACE(baseline);
      Show show = plain_show();
      show.sky.stars = "bright_stars";
      show.effects.trails = TrailSettings{0.3};
      show.view.size_px = 400;
      show.stereo.layout = StereoLayout::separate;
      show.stereo.model = StereoModel::omni;
      show.stereo.baseline = baseline;
      FrameRequest asked = request();
      asked.lens = lens;
      expect_as_planned(show, asked);
    }
  }
}

TEST_F(FramePlans, HoldForEveryLens) {
  for (const LensChoice lens : {LensChoice::automatic, LensChoice::live, LensChoice::direct}) {
    for (const GridScheme scheme : {GridScheme::conforming, GridScheme::quadtree}) {
      SCOPED_TRACE(static_cast<int>(lens));
      Show show = plain_show();
      show.grid_scheme = scheme;
      show.view.size_px = 400;
      show.quality.budget_px = 1.0;
      FrameRequest asked = request();
      asked.lens = lens;
      expect_as_planned(show, asked);
    }
  }
}

TEST_F(FramePlans, HoldForEffectsThatComeAndGo) {
  int effect = 0;
  for (const auto& [path, value] : std::map<const char*, double>{{"effects.bloom.strength", 0.2},
                                                                 {"effects.diffraction.strength", 0.3},
                                                                 {"disk.opacity", 1.0},
                                                                 {"disk.contrast", 1.0},
                                                                 {"shells[1].fill_opacity", 1.0},
                                                                 {"effects.trails.shutter_s", 0.1},
                                                                 {"view.vignette", 0.7},
                                                                 {"effects.diffraction.scale", 1.5},
                                                                 {"sky.spin_axis.ra_deg", 30.0}}) {
    if (test::sanitized && effect++ % 3 != 0) {
      continue;  // tests of each effect alone cover the same code
    }
    SCOPED_TRACE(path);
    Show show = animated(plain_show(), path, value);
    expect_as_planned(show, request());
    // The plan is for the whole show, so it must also cover pictures before the animation starts,
    // when the effect has zero strength.
    for (NumberKey& key : show.timeline.animations[0].keys) {
      key.time_s += 10.0;
    }
    if (find_animatable(path)->limits.minimum == 0.0) {
      expect_as_planned(show, request());
    }
  }
}

TEST_F(FramePlans, HoldForEveryProjection) {
  for (const bool gather : {false, true}) {
    if (test::sanitized && gather) {
      continue;  // the test of all effects together covers the same code
    }
    Show show = plain_show();
    for (const Effect& effect : effects()) {
      effect.add(show);
    }
    show.sky.star_method = gather ? StarMethod::gather : StarMethod::inverse;
    for (const ViewProjection projection :
         {ViewProjection::equirect, ViewProjection::cylinder, ViewProjection::pinhole}) {
      SCOPED_TRACE(static_cast<int>(projection));
      show.view.projection = projection;
      show.view.field_of_view_deg = usual_field_of_view_deg(projection);
      expect_as_planned(show, request());
    }
    show.view.projection = ViewProjection::cube;
    for (const CubeFiles files : {CubeFiles::cross, CubeFiles::strip, CubeFiles::faces}) {
      SCOPED_TRACE(static_cast<int>(files));
      show.view.cube_files = files;
      show.view.size_px = files == CubeFiles::faces ? 24 : 96;
      expect_as_planned(show, request());
    }
  }
}

TEST_F(FramePlans, HoldForEveryView) {
  for (const ViewMode mode : {ViewMode::steps, ViewMode::error_estimate, ViewMode::image_order,
                              ViewMode::frequency_ratio, ViewMode::magnification}) {
    SCOPED_TRACE(static_cast<int>(mode));
    Show show = plain_show();
    // A heat map shows no effects, but the stars of the show are loaded nevertheless.
    for (const Effect& effect : effects()) {
      effect.add(show);
    }
    FrameRequest asked = request();
    asked.mode = mode;
    expect_as_planned(show, asked);
  }
}

}  // namespace
}  // namespace ergodome
