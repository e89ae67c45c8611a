#include "render/plan/frame_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "content/animated_show.h"
#include "content/show_reader.h"
#include "kernels/launch/work_counter.h"
#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"
#include "render/shells/shell_pass.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

// Counters hold pictures to their plan: what it does not name is not done.
namespace ergodome {
namespace {

constexpr int map_width_px = 64;

using Work = std::map<std::string, WorkCount>;

//! One of the things that a scene may ask for.
struct Effect {
  const char* name;
  std::function<void(Show&)> add;
};

const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = {
      {"stars", [](Show& show) { show.sky.stars = "bright_stars"; }},
      {"gather", [](Show& show) { show.sky.star_method = StarMethod::gather; }},
      {"point", [](Show& show) { show.sky.filter = SkyFilter::point; }},
      {"polygon", [](Show& show) { show.sky.filter = SkyFilter::polygon; }},
      {"blackbody fit", [](Show& show) { show.sky.shift = SkyShift::blackbody_fit; }},
      {"brightening", [](Show& show) { show.sky.brightening = true; }},
      {"redshift", [](Show& show) { show.effects.redshift = true; }},
      {"magnification", [](Show& show) { show.effects.magnification = true; }},
      {"psf", [](Show& show) { show.effects.psf = PointSpreadSettings{}; }},
      {"trails", [](Show& show) { show.effects.trails = TrailSettings{0.3}; }},
      {"diffraction", [](Show& show) { show.effects.diffraction = DiffractionSettings{}; }},
      {"bloom", [](Show& show) { show.effects.bloom = BloomSettings{}; }},
      {"caption",
       [](Show& show) {
         Caption caption;
         caption.presence = {0.0, 1.0, 0.1, 0.1};
         caption.text["en"] = "words";
         show.timeline.captions.push_back(caption);
       }},
      {"overlay",
       [](Show& show) {
         Overlay overlay;
         overlay.image = show.sky.map;
         overlay.presence = {0.0, 1.0, 0.1, 0.1};
         show.timeline.overlays.push_back(overlay);
       }},
      {"disk",
       [](Show& show) {
         if (!show.disk) {
           show.disk.emplace();
         }
       }},
      {"clouds",
       [](Show& show) {
         if (!show.disk) {
           show.disk.emplace();
         }
         show.disk->pattern = DiskPattern::procedural;
       }},
      {"shells",
       [](Show& show) {
         show.shells.emplace_back();
         show.shells[0].radius = 12.0;
         show.shells.emplace_back();
         show.shells[1].radius = 3.0;
         show.shells[1].texture = show.sky.map;
       }},
      {"automatic exposure", [](Show& show) { show.tone.automatic = AutoExposureSettings{}; }},
  };
  return all;
}

class FramePlans : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    Picture map;
    map.width = map_width_px;
    map.height = map_width_px / 2;
    map.rgba.assign(4UL * map_width_px * map_width_px / 2, 0.25F);
    write_picture(folder_ / "sky.exr", {ImageFormat::exr}, map, {});
  }

  [[nodiscard]] Show plain_show() const {
    Show show;
    show.name = "scene";
    show.folder = folder_.string();
    show.duration_s = 1.0;
    show.spin = 0.9;
    CameraKey key;
    key.r = 9.0;
    show.camera.keys = {key, key};
    show.camera.keys[1].time_s = 1.0;
    show.camera.keys[1].phi = 0.4;
    show.sky.map = "sky.exr";
    show.sky.faintest_mag = test::sanitized ? 2.0 : 4.0;
    show.view.size_px = test::sanitized ? 40 : 96;
    return show;
  }

  static FrameRequest request() {
    FrameRequest request;
    request.map_width_px = map_width_px;
    request.overlay_bytes = 8L * (64 * 32 + 32 * 16 + 16 * 8 + 8 * 4 + 4 * 2 + 2 + 1);
    return request;
  }

  //! What two pictures of the same moment take.
  static std::pair<Work, Work> work_of(const Show& show, const FrameRequest& request) {
    const Work start = work_done();
    ShowRenderer renderer(show, request.backend, request.lens);
    const ViewChoice choice = {request.mode, request.size_px};
    renderer.render(0.5, choice);
    const Work first = work_done();
    renderer.render(0.5, choice);
    return {work_between(start, first), work_between(first, work_done())};
  }

  //! Holds pictures of a show to their plan.
  static void expect_as_planned(const Show& show, const FrameRequest& request) {
    const FramePlan plan = plan_frame(show, request);
    const auto [first, second] = work_of(show, request);
    expect_passes(plan, first, second);
    expect_buffers(plan, first);
    std::set<std::string> planned;
    std::set<std::string> of_pictures;
    for (const PlannedPass& pass : plan.passes) {
      planned.insert(pass.name);
      if (pass.moment == WorkMoment::picture) {
        of_pictures.insert(pass.name);
      }
    }
    for (const PlannedBuffer& buffer : plan.buffers) {
      planned.insert(buffer.name);
      if (buffer.moment == WorkMoment::picture) {
        of_pictures.insert(buffer.name);
      }
    }
    for (const auto& [name, count] : first) {
      EXPECT_TRUE(planned.contains(name)) << name << " was not planned";
    }
    for (const auto& [name, count] : second) {
      EXPECT_TRUE(of_pictures.contains(name)) << name << " was done again";
    }
  }

 private:
  static void expect_passes(const FramePlan& plan, const Work& first, const Work& second) {
    for (const PlannedPass& pass : plan.passes) {
      const bool once_more = pass.moment == WorkMoment::picture;
      for (const Work* work : {&first, once_more ? &second : &first}) {
        const auto done = work->find(pass.name);
        if (done == work->end()) {
          EXPECT_TRUE(pass.if_needed) << pass.name << " was planned and not done";
          continue;
        }
        if (pass.runs > 0) {
          EXPECT_EQ(done->second.runs, pass.runs) << pass.name;
        }
        if (pass.elements > 0) {
          EXPECT_EQ(done->second.elements, pass.elements) << pass.name;
        }
        EXPECT_FALSE(pass.why.empty()) << pass.name;
      }
    }
  }

  static void expect_buffers(const FramePlan& plan, const Work& first) {
    std::map<std::string, long> bytes;
    std::set<std::string> open;
    for (const PlannedBuffer& buffer : plan.buffers) {
      bytes[buffer.name] += buffer.bytes;
      if (buffer.bytes == 0) {
        open.insert(buffer.name);
      }
    }
    for (const auto& [name, planned] : bytes) {
      const auto done = first.find(name);
      if (open.contains(name)) {
        continue;
      }
      ASSERT_NE(done, first.end()) << name << " was planned and not made";
      EXPECT_EQ(done->second.elements, planned) << name;
    }
  }
};

TEST_F(FramePlans, OfAPlainSkyNameRaysAndLightAlone) {
  const FramePlan plan = plan_frame(plain_show(), request());
  std::vector<std::string> names;
  names.reserve(plan.passes.size());
  for (const PlannedPass& pass : plan.passes) {
    names.push_back(pass.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("trace_pixels, footprints", "shade_sky"));
  EXPECT_EQ(plan.lens, "direct");
}

TEST_F(FramePlans, NameTheDiskAndWhatCallsForIt) {
  Show show = plain_show();
  show.disk.emplace();
  show.lines["disk"] = 7;
  const FramePlan plan = plan_frame(show, request());
  const auto disk = std::ranges::find(plan.passes, "draw_disk", &PlannedPass::name);
  ASSERT_NE(disk, plan.passes.end());
  EXPECT_THAT(disk->why, testing::HasSubstr("line 7"));
  EXPECT_EQ(disk->elements, static_cast<long>(plan.width_px) * plan.height_px);
}

TEST_F(FramePlans, NameTheShellsAndWhatCallsForThem) {
  Show show = plain_show();
  show.shells.resize(3);
  show.lines["shells"] = 7;
  const FramePlan plan = plan_frame(show, request());
  const auto pass = std::ranges::find(plan.passes, "draw_shells", &PlannedPass::name);
  ASSERT_NE(pass, plan.passes.end());
  EXPECT_THAT(pass->why, testing::HasSubstr("line 7"));
  EXPECT_EQ(pass->elements, static_cast<long>(plan.width_px) * plan.height_px);
  const auto buffer = std::ranges::find(plan.buffers, "buffer: shells", &PlannedBuffer::name);
  ASSERT_NE(buffer, plan.buffers.end());
  EXPECT_EQ(buffer->bytes, 3 * ShellPass::shell_bytes);
  show.disk.emplace();
  const FramePlan with_disk = plan_frame(show, request());
  EXPECT_NE(std::ranges::find(with_disk.passes, "draw_shells, disk", &PlannedPass::name), with_disk.passes.end());
  EXPECT_EQ(std::ranges::find(with_disk.passes, "draw_disk", &PlannedPass::name), with_disk.passes.end());
}

TEST_F(FramePlans, OfShellsThatNobodySeesTraceNoneOfThem) {
  Show show = plain_show();
  show.shells.resize(1);
  show.shells[0].line_opacity = 0.0;
  const FramePlan plan = plan_frame(show, request());
  EXPECT_EQ(std::ranges::find(plan.passes, "draw_shells", &PlannedPass::name), plan.passes.end());
  expect_as_planned(show, request());
}

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
  // Sanitizers see the same code in a few of the pairs.
  constexpr std::size_t stride = test::sanitized ? 12 : 1;
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
      // Sanitizers see the same code in one layout.
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

//! Animates a number of the whole scene from nothing at 0 s to a value at 1 s.
Show animated(Show show, const char* path, double value) {
  for (const Effect& effect : effects()) {
    if (std::string_view(effect.name) != "gather") {
      effect.add(show);
    }
  }
  show.lines[std::string("animate.") + path] = 99;
  show.timeline.animations.push_back({path, {{0.0, find_animatable(path)->limits.least}, {1.0, value}}});
  return show;
}

TEST_F(FramePlans, HoldForEffectsThatComeAndGo) {
  for (const auto& [path, value] : std::map<const char*, double>{{"effects.bloom.strength", 0.2},
                                                                 {"effects.diffraction.strength", 0.3},
                                                                 {"disk.opacity", 1.0},
                                                                 {"disk.contrast", 1.0},
                                                                 {"shells[1].fill_opacity", 1.0},
                                                                 {"effects.trails.shutter_s", 0.1},
                                                                 {"effects.diffraction.scale", 1.5},
                                                                 {"sky.spin_axis.ra_deg", 30.0}}) {
    SCOPED_TRACE(path);
    Show show = animated(plain_show(), path, value);
    expect_as_planned(show, request());
    // The pictures before it begins are held to the same plan.
    for (NumberKey& key : show.timeline.animations[0].keys) {
      key.time_s += 10.0;
    }
    if (find_animatable(path)->limits.least == 0.0) {
      expect_as_planned(show, request());
    }
  }
}

TEST_F(FramePlans, NameTheLineThatAnimatesAnEffect) {
  const FramePlan plan = plan_frame(animated(plain_show(), "effects.bloom.strength", 0.2), request());
  const auto bloom = std::ranges::find(plan.passes, "add_bloom", &PlannedPass::name);
  ASSERT_NE(bloom, plan.passes.end());
  EXPECT_TRUE(bloom->if_needed);
  EXPECT_THAT(bloom->why, testing::HasSubstr("animated from line 99"));
  const auto trails = std::ranges::find(plan.passes, "follow_trails", &PlannedPass::name);
  ASSERT_NE(trails, plan.passes.end());
  EXPECT_FALSE(trails->if_needed);
}

TEST_F(FramePlans, HoldForEveryProjection) {
  for (const bool gather : {false, true}) {
    if (test::sanitized && gather) {
      continue;  // the same code has been through there with all effects together
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
    // Effects have nothing to do in a heat map, but stars are read when the show is opened.
    for (const Effect& effect : effects()) {
      effect.add(show);
    }
    FrameRequest asked = request();
    asked.mode = mode;
    expect_as_planned(show, asked);
  }
}

TEST_F(FramePlans, OfPicturesInBlocksCountEach) {
  Show show = plain_show();
  show.view.size_px = 1500;
  FrameRequest asked = request();
  asked.lens = LensChoice::direct;
  expect_as_planned(show, asked);
}

TEST_F(FramePlans, NameTheLinesThatCallForAPass) {
  const Show show = parse_show("[camera]\n[[camera.key]]\nr = 9\n[sky]\nmap = \"grid\"\n\n[effects]\nredshift = true\n",
                               "folder/scene.toml");
  const FramePlan plan = plan_frame(show, request());
  EXPECT_EQ(plan.passes.back().name, "shade_sky, luminance");
  EXPECT_EQ(plan.passes.back().why, "sky.filter (by default), effects.redshift (scene.toml line 8)");
  EXPECT_EQ(plan.channels[2].why, "sky.map (scene.toml line 5)");
}

TEST_F(FramePlans, LeaveOutEffectsWithoutStrength) {
  Show show = plain_show();
  show.sky.stars = "bright_stars";
  show.effects.bloom = BloomSettings{0.0, 40.0};
  show.effects.diffraction = DiffractionSettings{};
  show.effects.diffraction->strength = 0.0;
  show.effects.trails = TrailSettings{0.0};
  for (const PlannedPass& pass : plan_frame(show, request()).passes) {
    EXPECT_THAT(pass.name, testing::Not(testing::AnyOf("add_bloom", "draw_spikes", "follow_trails", "clear_outside")));
  }
  expect_as_planned(show, request());
}

}  // namespace
}  // namespace ergodome
