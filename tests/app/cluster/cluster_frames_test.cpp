#include "app/player/cluster_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "app/cli/show_loading.h"
#include "app/cluster/cluster_codec.h"
#include "app/player/outputs/dome_output.h"
#include "tests/app/cluster/cluster_frames.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

PictureRequest some_request() {
  PictureRequest request;
  request.frame.time_s = 12.3456789012345;
  request.frame.path_time_s = request.frame.time_s;
  request.frame.pose = test::full_frame().pose;
  request.before = LensPosition{12.0, 1.5};
  request.frame.observer.motion = ObserverMotion::velocity;
  request.frame.observer.velocity = {0.1, 0.2, 0.3};
  request.frame.stereo.baseline = 0.5;
  request.frame.exposure_stops = 1.5;
  request.frame.language = "de";
  request.frame.captions = false;
  request.frame.field_of_view_deg = 180.0;
  request.size_px = 512;
  request.output.projectors_px = 2048;
  request.quality = FrameQuality{0.5, LensChoice::live, SkyFilter::point};
  request.whole_px = 1024;
  return request;
}

TEST(ClusterFrames, LetTwoComputersRenderTheSameRequest) {
  const PictureRequest sent = some_request();
  const ClusterFrame frame = cluster_frame(sent, 1.0);
  const auto received = decode_cluster(encode_cluster(frame));
  ASSERT_TRUE(received);
  PictureRequest there;
  apply(std::get<ClusterFrame>(*received), there);
  PictureRequest here = sent;
  apply(frame, here);
  EXPECT_EQ(there.frame.time_s, here.frame.time_s);
  EXPECT_NEAR(here.frame.time_s, sent.frame.time_s, 1e-9);
  EXPECT_EQ(there.frame.path_time_s, here.frame.time_s);
  EXPECT_EQ(there.frame.pose.r, sent.frame.pose.r);
  EXPECT_EQ(there.frame.pose.orientation, sent.frame.pose.orientation);
  EXPECT_EQ(there.frame.observer.motion, sent.frame.observer.motion);
  EXPECT_EQ(there.frame.observer.velocity.z, 0.3);
  EXPECT_EQ(there.frame.stereo, sent.frame.stereo);
  EXPECT_EQ(there.frame.exposure_stops, 1.5);
  EXPECT_EQ(there.frame.language, "de");
  EXPECT_FALSE(there.frame.captions);
  EXPECT_EQ(there.frame.field_of_view_deg, 180.0);
  EXPECT_EQ(there.size_px, 512);
  EXPECT_EQ(there.output.projectors_px, 2048);
  EXPECT_EQ(there.quality, sent.quality);
  EXPECT_EQ(there.whole_px, 1024);
  EXPECT_EQ(there.patience_s, here.patience_s);
  EXPECT_EQ(there.before->r, 12.0);
  EXPECT_EQ(there.before->theta, 1.5);
  EXPECT_TRUE(there.alike);
  EXPECT_TRUE(here.alike);
}

//! Renders a picture of a flight as a computer of a cluster does.
PixelValues picture_of_flight(const std::shared_ptr<ShowRenderer>& renderer, const LensPosition& before,
                              const LensPosition& here, double budget_px, int size_px = 256) {
  PictureRequest sent;
  sent.frame.pose = camera_pose(renderer->show(), 0.0);
  sent.frame.pose.r = here.r;
  sent.frame.pose.theta = here.theta;
  sent.frame.field_of_view_deg = 180.0;
  sent.before = before;
  sent.size_px = size_px;
  sent.quality = FrameQuality{budget_px, LensChoice::live, SkyFilter::ewa};
  sent.whole_px = 256;
  PictureRequest request;
  request.renderer = renderer;
  apply(cluster_frame(sent, 1.0), request);
  return render_for_output(request).picture.rgba;
}

TEST(ClusterFrames, OfAFlightAmongStarsDoNotDependOnEarlierPictures) {
  Show show;
  show.camera.keys.emplace_back();
  show.view.projection = ViewProjection::dome;
  show.sky.stars = "bright_stars";
  show.sky.faintest_mag = 6.0;
  const auto computer = [&] { return std::make_shared<ShowRenderer>(show, Backend::cpu); };
  const auto master = computer();
  const auto expect_joins = [&](const LensPosition& before, const LensPosition& here, double budget_px,
                                int size_px = 256) {
    const PixelValues shown = picture_of_flight(master, before, here, budget_px, size_px);
    const PixelValues joined = picture_of_flight(computer(), before, here, budget_px, size_px);
    ASSERT_EQ(shown.size(), joined.size());
    EXPECT_TRUE(std::ranges::equal(shown, joined)) << "r = " << here.r << ", " << budget_px << " px";
  };
  LensPosition here = {8.0, 1.3};
  expect_joins(here, here, 0.25);
  for (int frame = 0; frame < 12; ++frame) {
    const LensPosition before = std::exchange(here, LensPosition{here.r - 0.008, here.theta + 2e-4});
    if (frame % 4 == 3) {
      expect_joins(before, here, 0.25);
    } else {
      picture_of_flight(master, before, here, 0.25);
    }
  }
  expect_joins(here, here, 0.25);
  expect_joins(here, here, 0.4);
  expect_joins(here, here, 0.4, 254);
}

TEST(ClusterFrames, ShowAPictureWithTheStopsOfTheMaster) {
  PictureAnswer answer;
  answer.picture.tone.gain = 8.0F;
  answer.right_eye.emplace().tone.gain = 8.0F;
  show_with_stops(2.0, answer);
  EXPECT_EQ(answer.picture.tone.gain, 8.0F) << "the show has no automatic exposure";
  answer.followed_stops = 3.0;
  show_with_stops(2.0, answer);
  EXPECT_FLOAT_EQ(answer.picture.tone.gain, 4.0F);
  EXPECT_FLOAT_EQ(answer.right_eye->tone.gain, 4.0F);
  EXPECT_EQ(answer.followed_stops, 2.0);
}

TEST(ClusterFrames, SendCaptionsInOneLanguage) {
  Caption caption;
  caption.text = {{"en", "Welcome"}, {"de", "Willkommen"}};
  EXPECT_EQ(in_language({caption}, "de").at(0).text, (LocalText{{"", "Willkommen"}}));
}

class ClusterFingerprints : public test::FolderTest {
 protected:
  [[nodiscard]] Show show_with(const std::string& sky, const ShowSettings& settings = {}) const {
    std::ofstream(folder_ / "sky.ppm", std::ios::binary) << sky;
    std::ofstream(folder_ / "show.toml") << "title = \"T\"\n[[camera.key]]\nr = 20\n[sky]\nmap = \"sky.ppm\"\n";
    return load_show((folder_ / "show.toml").string(), settings);
  }
};

TEST_F(ClusterFingerprints, DifferIfTheShowOrItsFilesDo) {
  const std::string one = "P6 2 1 255\nabcdef";
  const std::string other = "P6 2 1 255\nabcdeg";
  const Show show = show_with(one);
  EXPECT_EQ(fingerprint_of_shows({show}), fingerprint_of_shows({show_with(one)}));
  EXPECT_NE(fingerprint_of_shows({show}), fingerprint_of_shows({show_with(one, {"hole.spin=0.5"})}));
  const std::string content = fingerprint_of_contents({show});
  EXPECT_EQ(content, fingerprint_of_contents({show_with(one)}));
  EXPECT_NE(content, fingerprint_of_contents({show_with(other)}));
  EXPECT_EQ(fingerprint_of_shows({show}), fingerprint_of_shows({show_with(other)}));
}

TEST(ClusterProjectors, AreThoseOfTheNode) {
  ProjectorOptions projectors;
  for (const char* const node : {"", "left", "right", "left"}) {
    ProjectorSetup& projector = projectors.setup.projectors.emplace_back();
    projector.name = "p" + std::to_string(projectors.setup.projectors.size());
    projector.node = node;
    projectors.pictures.emplace_back().name = projector.name;
  }
  keep_projectors_of(projectors, "left");
  ASSERT_EQ(projectors.pictures.size(), 2U);
  EXPECT_EQ(projectors.pictures[0].name, "p2");
  EXPECT_EQ(projectors.pictures[1].name, "p4");
  EXPECT_EQ(projectors.setup.projectors[1].name, "p4");
}

}  // namespace
}  // namespace ergodome
