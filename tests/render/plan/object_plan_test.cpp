#include <gmock/gmock.h>

#include <algorithm>

#include "kernels/launch/work_counter.h"
#include "render/frame/frame_passes.h"
#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"
#include "render/passes/objects/object_pass.h"
#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/folder_test.h"

// Tests that plans contain the work for objects, and that none of this work is done in shows
// without objects.
namespace ergodome {
namespace {

using Work = std::map<std::string, WorkCount>;

const std::vector<std::string> work_of_objects = {"load_meshes", "open_gl", "make_connection_table", "draw_objects"};

class TracedObjectPlans : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    Picture map;
    map.width = 64;
    map.height = 32;
    map.rgba.assign(4UL * 64 * 32, 0.25F);
    write_picture(folder_ / "sky.exr", {ImageFormat::exr}, map, {});
  }

  [[nodiscard]] Show show_with(const std::vector<ObjectSettings>& objects) const {
    Show show;
    show.name = "scene";
    show.folder = folder_.string();
    show.camera.keys.emplace_back();
    show.camera.keys.front().r = 40.0;
    show.camera.motion = ObserverMotion::fixed;
    show.sky.map = "sky.exr";
    show.view.projection = ViewProjection::pinhole;
    show.view.field_of_view_deg = 20.0;
    show.view.size_px = 64;
    show.objects = objects;
    show.lines["objects"] = 12;
    return show;
  }

  //! Compares planned work with the work done for a first and a second picture. The plan must name
  //! line 12 of the show as the reason.
  static void expect_planned(const std::vector<std::string>& names, const FramePlan& plan, const Work& first,
                             const Work& second) {
    for (const std::string& name : names) {
      const auto pass = std::ranges::find(plan.passes, name, &PlannedPass::name);
      ASSERT_NE(pass, plan.passes.end()) << name;
      EXPECT_THAT(pass->why, testing::HasSubstr("line 12"));
      ASSERT_TRUE(first.contains(name)) << name;
      EXPECT_TRUE(pass->runs == 0 || first.at(name).runs == pass->runs) << name;
      EXPECT_TRUE(pass->elements == 0 || first.at(name).elements == pass->elements) << name;
      EXPECT_EQ(second.contains(name), pass->moment == WorkMoment::picture) << name;
    }
  }

  //! Expects that a plan contains all work that was done.
  static void expect_all_planned(const FramePlan& plan, const Work& done) {
    for (const auto& [name, work] : done) {
      EXPECT_TRUE(std::ranges::find(plan.passes, name, &PlannedPass::name) != plan.passes.end() ||
                  std::ranges::find(plan.buffers, name, &PlannedBuffer::name) != plan.buffers.end())
          << name;
    }
  }

  //! Renders two pictures of the same moment. Returns the work done for each.
  static std::pair<Work, Work> work_of(const Show& show, ViewMode mode, LensChoice lens = LensChoice::automatic) {
    const Work start = work_done();
    ShowRenderer renderer(show, Backend::cpu, lens);
    renderer.render(0.0, {mode, 0});
    const Work first = work_done();
    renderer.render(0.0, {mode, 0});
    return {work_between(start, first), work_between(first, work_done())};
  }
};

//! Tests of plans of shows whose objects are drawn as polygons; skipped if OpenGL is not available.
class ObjectPlans : public TracedObjectPlans {
 protected:
  void SetUp() override {
    TracedObjectPlans::SetUp();
    test::driver_was_loaded = true;
    try {
      const GlThread thread;
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
};

const std::vector<std::string> work_of_tracing = {"load_meshes", "mark_object_tiles", "look_at_objects",
                                                  "look_at_objects, slices", "lay_objects"};

ObjectSettings traced(ObjectSettings object) {
  object.method = ObjectMethod::trace;
  return object;
}

TEST_F(TracedObjectPlans, NameWhatTracingTakesAndNothingThatPolygonsDo) {
  const Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  const FramePlan plan = plan_frame(show, {});
  const auto [first, second] = work_of(show, ViewMode::sky);
  expect_planned(work_of_tracing, plan, first, second);
  for (const char* const name : {"open_gl", "make_connection_table", "draw_objects"}) {
    EXPECT_EQ(std::ranges::find(plan.passes, name, &PlannedPass::name), plan.passes.end()) << name;
    EXPECT_FALSE(first.contains(name)) << name;
  }
  for (const auto& [name, work] : first) {
    if (name.starts_with("buffer: objects'") || name == "buffer: meshes") {
      EXPECT_NE(std::ranges::find(plan.buffers, name, &PlannedBuffer::name), plan.buffers.end()) << name;
    }
  }
}

TEST_F(TracedObjectPlans, NameTheCamerasOfEyesThatTurn) {
  Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::omni;
  show.stereo.baseline = 0.1;
  const FramePlan plan = plan_frame(show, {});
  const Work first = work_of(show, ViewMode::sky).first;
  EXPECT_TRUE(first.contains("buffer: objects' cameras"));
  for (const auto& [name, work] : first) {
    if (name.starts_with("buffer: objects'")) {
      EXPECT_NE(std::ranges::find(plan.buffers, name, &PlannedBuffer::name), plan.buffers.end()) << name;
    }
  }
}

TEST_F(TracedObjectPlans, NameWhatEyesThatSeeThroughOneLensTake) {
  Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  for (const double baseline : {0.0, 0.5}) {
    SCOPED_TRACE(baseline);
    show.stereo.baseline = baseline;
    const FramePlan plan = plan_frame(show, {});
    const auto [first, second] = work_of(show, ViewMode::sky);
    const bool apart = baseline > 0.0;
    expect_planned({"load_meshes", apart ? "mark_flat_object_tiles" : "mark_object_tiles",
                    apart ? "look_at_flat_objects" : "look_at_objects", "lay_objects"},
                   plan, first, second);
    expect_all_planned(plan, second);
  }
}

TEST_F(TracedObjectPlans, NameWhatEyesThatSeeThroughOneLensTakeBesideADiskAndShells) {
  Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  show.stereo.baseline = 0.5;
  show.view.size_px = 32;
  for (const bool disk : {true, false}) {
    for (const bool shells : {true, false}) {
      SCOPED_TRACE(testing::Message() << disk << shells);
      show.disk = disk ? std::optional<DiskSettings>(DiskSettings{}) : std::nullopt;
      show.shells.assign(shells ? 1 : 0, {});
      // In shows with shells, the disk is always drawn by rays.
      const LensChoice lens = shells ? LensChoice::direct : LensChoice::live;
      FrameRequest request;
      request.lens = lens;
      const FramePlan plan = plan_frame(show, request);
      const auto [first, second] = work_of(show, ViewMode::sky, lens);
      EXPECT_TRUE(second.contains("look_at_flat_objects"));
      EXPECT_EQ(second.contains("lay_objects"), !disk && !shells);
      EXPECT_EQ(second.contains("look_up_flat_eyes"), disk && !shells);
      EXPECT_EQ(second.contains("draw_flat_eyes, disk"), disk && !shells);
      expect_all_planned(plan, second);
      for (const PlannedPass& pass : plan.passes) {
        EXPECT_TRUE(pass.if_needed || first.contains(pass.name)) << pass.name;
      }
    }
  }
}

TEST_F(TracedObjectPlans, NameWhatLaysObjectsWhereADiskHasNoWidthYet) {
  Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  show.view.size_px = 32;
  show.disk.emplace();
  // At the start of the animation, the outer radius of the disk is smaller than its inner radius.
  show.disk->outer = 3.0;
  show.timeline.animations.push_back({"disk.outer", {{0.0, 3.0}, {10.0, 20.0}}});
  for (const double baseline : {0.0, 0.5}) {
    show.stereo.baseline = baseline;
    const Work work = work_of(show, ViewMode::sky).first;
    EXPECT_TRUE(work.contains("lay_objects"));
    expect_all_planned(plan_frame(show, {}), work);
  }
}

TEST_F(TracedObjectPlans, NameTheRowsThatEyesOfOneLensTakeThroughAGpu) {
  Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  show.stereo.baseline = 0.5;
  const auto names_rows = [&show](Backend backend) {
    FrameRequest request;
    request.backend = backend;
    const FramePlan plan = plan_frame(show, request);
    return std::ranges::find(plan.buffers, "buffer: flat eye's picture", &PlannedBuffer::name) != plan.buffers.end();
  };
  EXPECT_TRUE(names_rows(Backend::cuda));
  EXPECT_FALSE(names_rows(Backend::cpu));
}

TEST_F(TracedObjectPlans, LookAtNoPixelWhereNoObjectIsNear) {
  Show show = show_with({traced(test::small_sphere({60.0, 0.0, 0.0}, 1.0))});
  show.view.field_of_view_deg = 10.0;
  // The view points past the hole. Next to the edge of the shadow, every object would be visible.
  show.camera.keys.front().yaw = 0.5;
  const Work work = work_of(show, ViewMode::sky).first;
  EXPECT_TRUE(work.contains("mark_object_tiles"));
  EXPECT_FALSE(work.contains("look_at_objects"));
}

TEST_F(TracedObjectPlans, AHeatMapShowsNoObjects) {
  const Show show = show_with({traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0))});
  FrameRequest request;
  request.mode = ViewMode::steps;
  const FramePlan plan = plan_frame(show, request);
  EXPECT_EQ(std::ranges::find(plan.passes, "mark_object_tiles", &PlannedPass::name), plan.passes.end());
  EXPECT_FALSE(work_of(show, ViewMode::steps).first.contains("mark_object_tiles"));
}

TEST_F(TracedObjectPlans, AFrameOfAShowHasItsObjectInFrontOfTheSky) {
  ObjectSettings sphere = traced(test::small_sphere({10.0, 0.0, 0.0}, 1.0));
  sphere.color = {0.0, 0.5, 0.0};
  ShowRenderer renderer(show_with({sphere}), Backend::cpu);
  const std::vector<FrameImage> images = renderer.render(0.0, {});
  const PixelValues& rgba = images.front().picture.rgba;
  const std::size_t middle = 4 * (32 * 64 + 32);
  EXPECT_FLOAT_EQ(rgba[middle], 0.0F);
  EXPECT_NEAR(rgba[middle + 1], 0.5F, 1e-3F);
  EXPECT_NEAR(rgba[0], 0.25F, 0.01F);
}

TEST_F(ObjectPlans, NameWhatObjectsTakeAndTheLineThatCallsForIt) {
  Show show = show_with({test::small_sphere({10.0, 0.0, 0.0}, 1.0)});
  FrameRequest request;
  request.map_width_px = 64;
  request.mesh_bytes = ObjectPass::mesh_bytes(show);
  const FramePlan plan = plan_frame(show, request);
  const auto [first, second] = work_of(show, ViewMode::sky);
  expect_planned(work_of_objects, plan, first, second);
  const auto meshes = std::ranges::find(plan.buffers, "buffer: meshes", &PlannedBuffer::name);
  ASSERT_NE(meshes, plan.buffers.end());
  EXPECT_EQ(meshes->bytes, first.at("buffer: meshes").elements);
  for (const char* const name : {"buffer: connecting rays", "buffer: objects' picture"}) {
    EXPECT_NE(std::ranges::find(plan.buffers, name, &PlannedBuffer::name), plan.buffers.end()) << name;
    EXPECT_TRUE(first.contains(name)) << name;
    EXPECT_FALSE(second.contains(name)) << name;
  }
}

TEST_F(TracedObjectPlans, WithoutObjectsNoMeshIsReadNoTableIsMadeAndNoOpenGlIsOpened) {
  const Show show = show_with({});
  const FramePlan plan = plan_frame(show, {});
  const auto [first, second] = work_of(show, ViewMode::sky);
  std::vector<std::string> names = work_of_objects;
  names.insert(names.end(), work_of_tracing.begin(), work_of_tracing.end());
  for (const std::string& name : names) {
    EXPECT_EQ(std::ranges::find(plan.passes, name, &PlannedPass::name), plan.passes.end()) << name;
    EXPECT_FALSE(first.contains(name)) << name;
    EXPECT_FALSE(second.contains(name)) << name;
  }
}

TEST_F(ObjectPlans, OfEyesThatSeeThroughOneLensDrawThemForEach) {
  Show show = show_with({test::small_sphere({10.0, 0.0, 0.0}, 1.0)});
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  for (const double baseline : {0.0, 0.2}) {
    show.stereo.baseline = baseline;
    const FramePlan plan = plan_frame(show, {});
    const auto pass = std::ranges::find(plan.passes, "draw_objects", &PlannedPass::name);
    ASSERT_NE(pass, plan.passes.end());
    EXPECT_EQ(pass->runs, baseline > 0.0 ? 2 : 1);
    EXPECT_EQ(work_of(show, ViewMode::sky).second.at("draw_objects").runs, pass->runs) << baseline;
  }
}

TEST_F(ObjectPlans, AHeatMapShowsNoObjects) {
  const Show show = show_with({test::small_sphere({10.0, 0.0, 0.0}, 1.0)});
  FrameRequest request;
  request.mode = ViewMode::steps;
  const FramePlan plan = plan_frame(show, request);
  EXPECT_EQ(std::ranges::find(plan.passes, "draw_objects", &PlannedPass::name), plan.passes.end());
  EXPECT_FALSE(work_of(show, ViewMode::steps).first.contains("draw_objects"));
}

TEST_F(ObjectPlans, AFrameOfAShowHasItsObjectInFrontOfTheSky) {
  ObjectSettings sphere = test::small_sphere({10.0, 0.0, 0.0}, 1.0);
  sphere.color = {0.0, 0.5, 0.0};
  ShowRenderer renderer(show_with({sphere}), Backend::cpu);
  const std::vector<FrameImage> images = renderer.render(0.0, {});
  const PixelValues& rgba = images.front().picture.rgba;
  const std::size_t middle = 4 * (32 * 64 + 32);
  EXPECT_FLOAT_EQ(rgba[middle], 0.0F);
  EXPECT_NEAR(rgba[middle + 1], 0.5F, 1e-3F);
  EXPECT_NEAR(rgba[0], 0.25F, 0.01F);
}

}  // namespace
}  // namespace ergodome
