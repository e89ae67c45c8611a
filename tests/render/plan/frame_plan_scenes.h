#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "content/show/animatable_number.h"
#include "kernels/launch/work_counter.h"
#include "render/frame/frame_passes.h"
#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

// Tests that pictures do exactly the work in their plan, by means of work counters: work that the
// plan does not list must not happen.

namespace ergodome::test {

inline constexpr int map_width_px = 64;

using Work = std::map<std::string, WorkCount>;

//! An effect, and a function that adds it to a show.
struct Effect {
  const char* name;
  std::function<void(Show&)> add;
};

inline const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = {
      {"stars", [](Show& show) { show.sky.stars = "bright_stars"; }},
      {"gather", [](Show& show) { show.sky.star_method = StarMethod::gather; }},
      {"point", [](Show& show) { show.sky.filter = SkyFilter::point; }},
      {"polygon", [](Show& show) { show.sky.filter = SkyFilter::polygon; }},
      {"blackbody fit", [](Show& show) { show.sky.shift = SkyShift::blackbody_fit; }},
      {"brightening", [](Show& show) { show.sky.brightening = true; }},
      {"redshift", [](Show& show) { show.effects.redshift = true; }},
      {"magnification", [](Show& show) { show.effects.magnification = true; }},
      {"psf",
       [](Show& show) {
         show.effects.psf = {2.0, 0.0};
       }},
      {"trails", [](Show& show) { show.effects.trails = TrailSettings{0.3}; }},
      {"diffraction", [](Show& show) { show.effects.diffraction = DiffractionSettings{}; }},
      {"bloom", [](Show& show) { show.effects.bloom = BloomSettings{}; }},
      {"vignette", [](Show& show) { show.view.vignette = 0.5; }},
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

//! Returns a show with all effects, in which the number at `path` is animated from 0 at 0 s to a
//! value at 1 s.
inline Show animated(Show show, const char* path, double value) {
  for (const Effect& effect : effects()) {
    if (std::string_view(effect.name) != "gather") {
      effect.add(show);
    }
  }
  show.lines[std::string("animate.") + path] = 99;
  show.timeline.animations.push_back({path, {{0.0, find_animatable(path)->limits.minimum}, {1.0, value}}});
  return show;
}

class FramePlans : public FolderTest {
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
    show.sky.faintest_mag = sanitized ? 2.0 : 4.0;
    show.view.size_px = sanitized ? 40 : 96;
    return show;
  }

  static FrameRequest request() {
    FrameRequest request;
    request.map_width_px = map_width_px;
    request.overlay_bytes = 8L * (64 * 32 + 32 * 16 + 16 * 8 + 8 * 4 + 4 * 2 + 2 + 1);
    return request;
  }

  //! Renders two pictures of the same moment. Returns the work done for each.
  static std::pair<Work, Work> work_of(const Show& show, const FrameRequest& request,
                                       std::shared_ptr<StationStream> stream) {
    const Work start = work_done();
    ShowRenderer renderer(show, request.backend, request.lens, std::move(stream));
    const ViewChoice choice = {request.mode, request.size_px, request.method};
    renderer.render(0.5, choice);
    const Work first = work_done();
    renderer.render(0.5, choice);
    return {work_between(start, first), work_between(first, work_done())};
  }

  //! Expects that the work for two pictures of a show agrees with their plan. All stations of
  //! `stream` must already have been read.
  static void expect_as_planned(const Show& show, const FrameRequest& request,
                                std::shared_ptr<StationStream> stream = nullptr) {
    const FramePlan plan = plan_frame(show, request);
    const auto [first, second] = work_of(show, request, std::move(stream));
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

}  // namespace ergodome::test
