#include "render/passes/disk/streamed_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "content/sky/sky_map.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/view_projection.h"
#include "render/frame/eye_renderer.h"
#include "render/passes/near_field/near_field_pass.h"
#include "tests/support/baked_show.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

//! Renders the sky and the disk of a show; reads the lens and the disk layers from a trajectory
//! file if there is a stream.
class DiskRenderer {
 public:
  explicit DiskRenderer(std::shared_ptr<StationStream> stream = nullptr)
      : stream_(std::move(stream)), eyes_(Backend::cpu, stream_) {}

  Picture render(const Show& show, const EyeCamera& eye, const Projection& projection, PictureSettings settings) {
    static const SkyCube sky(Backend::cpu, make_grid_sky(16), glm::dmat3(1.0));
    NearFieldPass disk({show, Backend::cpu, stream_});
    settings.show = &show;
    settings.passes = {&disk};
    return eyes_.render(eye, projection, sky, settings);
  }

 private:
  std::shared_ptr<StationStream> stream_;
  EyeRenderer eyes_;
};

//! A show with a disk, its trajectory file, and pictures of it.
class StreamedDiskPictures : public test::FolderTest {
 protected:
  void bake(const Show& show, bool derivatives = true) {
    show_ = show;
    projection_ = make_projection(show.view, show.view.size_px, 0.0);
    pictured_ = show;
    test::bake_to(show, file(), pixel_angle(projection_), derivatives);
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "t.trajectory"; }

  [[nodiscard]] std::shared_ptr<StationStream> stream() {
    return std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(file()), StationStream::default_memory_bytes,
                                           [this](const std::string& message) { said_ += message + "\n"; });
  }

  //! Returns the picture of an eye at a time of the show, and sets `work_` to the counts of the
  //! work done for it.
  std::vector<float> picture(DiskRenderer& renderer, double time_s, const Vector3<double>& eye_offset,
                             LensChoice lens) {
    PictureSettings settings;
    settings.lens = lens;
    settings.moment = {time_s};
    settings.time_s = time_s;
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, time_s), eye_offset);
    const auto before = work_done();
    const Picture made = renderer.render(pictured_, eye, projection_, settings);
    work_ = work_between(before, work_done());
    return {made.rgba.begin(), made.rgba.end()};
  }

  [[nodiscard]] bool did(const std::string& work) const { return work_.contains(work) && work_.at(work).runs > 0; }

  //! Expects that the picture from the trajectory file is similar to one by rays.
  void expect_like_rays(DiskRenderer& streamed, double time_s, const Vector3<double>& eye_offset) {
    SCOPED_TRACE(testing::Message() << time_s << " s, eye " << eye_offset.x);
    DiskRenderer direct;
    const std::vector<float> by_rays = picture(direct, time_s, eye_offset, LensChoice::direct);
    const std::vector<float> read = picture(streamed, time_s, eye_offset, LensChoice::automatic);
    EXPECT_TRUE(did("look_up_disk") || did("look_up_disk, pattern"));
    EXPECT_FALSE(did("trace_disk_nodes"));
    expect_alike(read, by_rays);
  }

  static void expect_alike(const std::vector<float>& a, const std::vector<float>& b) {
    std::vector<float> differences(a.size());
    std::ranges::transform(a, b, differences.begin(),
                           [](float x, float y) { return std::abs(std::min(x, 1.0F) - std::min(y, 1.0F)); });
    std::ranges::sort(differences);
    EXPECT_LT(differences[differences.size() * 99 / 100], 0.03F);
    EXPECT_LT(differences[differences.size() * 999 / 1000], 0.15F);
  }

  Show show_;
  Projection projection_{};
  //! The show whose disk is drawn, which may differ from the baked show.
  Show pictured_;
  std::map<std::string, WorkCount> work_;
  std::string said_;
};

TEST_F(StreamedDiskPictures, AreThoseOfRaysAtAnyTimeAndForBothEyes) {
  for (const bool clouds : {false, true}) {
    bake(test::show_with_disk(clouds));
    DiskRenderer streamed(stream());
    for (const double time_s : test::sanitized ? std::vector{2.3} : std::vector{0.0, 0.3, 1.1, 2.3, 3.7, 9.1}) {
      expect_like_rays(streamed, time_s, {});
      EXPECT_FALSE(did("check_disk_grid"));
    }
    expect_like_rays(streamed, 3.7, {0.05, 0.02, 0.0});
    EXPECT_TRUE(did("check_disk_grid"));
  }
}

TEST_F(StreamedDiskPictures, WithoutDerivativesAreThoseOfRays) {
  bake(test::show_with_disk(), false);
  DiskRenderer streamed(stream());
  expect_like_rays(streamed, 3.7, {});
}

TEST_F(StreamedDiskPictures, OfAnotherDiskThanTheBakedOneAreNotReadFromIt) {
  bake(test::show_with_disk());
  DiskRenderer streamed(stream());
  const auto read = [&](const Show& show) {
    pictured_ = show;
    picture(streamed, 3.7, {}, LensChoice::automatic);
    return did("look_up_disk") || did("look_up_disk, pattern");
  };
  Show show = show_;
  show.disk->temperature_k = 9000.0;
  show.disk->outer = 14.0;
  EXPECT_TRUE(read(show));
  show.disk->outer = 16.0;
  EXPECT_FALSE(read(show));
  show.disk->outer = 15.0;
  show.disk->inner = 5.0;
  EXPECT_FALSE(read(show));
  show.disk->inner.reset();
  show.disk->pattern = DiskPattern::procedural;
  EXPECT_FALSE(read(show));
}

TEST_F(StreamedDiskPictures, OfAnEyeFarBesideThePathAreNotReadFromIt) {
  bake(test::show_with_disk());
  DiskRenderer streamed(stream());
  picture(streamed, 3.7, {0.0, 12.0, 0.0}, LensChoice::automatic);
  EXPECT_FALSE(did("look_up_disk"));
}

TEST_F(StreamedDiskPictures, AreMadeWithoutLayersThatAreDamaged) {
  bake(test::show_with_disk());
  {
    const TrajectoryReader reader(file());
    std::fstream raw(file(), std::ios::binary | std::ios::in | std::ios::out);
    const StationEntry& first = reader.stations()[0];
    raw.seekp(static_cast<std::streamoff>(first.offset + first.bytes + first.disk_bytes / 2));
    raw.put('x');
    raw.put('y');
  }
  const auto read = stream();
  DiskRenderer streamed(read);
  const std::vector<float> made = picture(streamed, 0.1, {}, LensChoice::automatic);
  EXPECT_FALSE(did("look_up_disk"));
  EXPECT_TRUE(did("shade_tiles"));
  EXPECT_THAT(said_, testing::HasSubstr("station 1, disk: is damaged"));
  EXPECT_EQ(read->statistics().lost_disks, 1);
  DiskRenderer direct;
  const std::vector<float> by_rays = picture(direct, 0.1, {}, LensChoice::direct);
  expect_alike(made, by_rays);
}

TEST_F(StreamedDiskPictures, AreNotReadFromTheNextStationInPlaceOfOneThatIsDamaged) {
  bake(test::show_with_disk());
  {
    const TrajectoryReader reader(file());
    std::fstream raw(file(), std::ios::binary | std::ios::in | std::ios::out);
    const StationEntry& first = reader.stations()[0];
    raw.seekp(static_cast<std::streamoff>(first.offset + first.bytes / 2));
    raw.put('x');
    raw.put('y');
  }
  DiskRenderer streamed(stream());
  picture(streamed, 0.1, {}, LensChoice::automatic);
  EXPECT_FALSE(did("look_up_disk"));
}

TEST_F(StreamedDiskPictures, OfShowsWithoutADiskHaveNoLayersBaked) {
  Show show = test::show_with_disk();
  show.disk.reset();
  test::bake_to(show, file(), 1e-2);
  const TrajectoryReader reader(file());
  EXPECT_FALSE(reader.provenance().disk);
  EXPECT_TRUE(std::ranges::all_of(reader.stations(), [](const StationEntry& s) { return s.disk_bytes == 0; }));
}

TEST_F(StreamedDiskPictures, OfMatterThatFallsHaveNoLayersBaked) {
  Show show = test::show_with_disk();
  show.disk->profile = DiskProfile::uniform;
  show.disk->plunging = true;
  test::bake_to(show, file(), 1e-2);
  EXPECT_FALSE(TrajectoryReader(file()).provenance().disk);
}

//! Bakes a show to a trajectory file, and returns the result of the bake.
BakeResult baked(const Show& show, const std::filesystem::path& file) {
  BakeSettings settings;
  settings.pixel = 1e-2;
  TrajectoryJournal journal(file, provenance_of(show, settings));
  return bake_trajectory(show, settings, journal, [](double) { return true; });
}

TEST_F(StreamedDiskPictures, AreLiveWhereTheCameraGoesThroughTheDisk) {
  Show show = test::show_with_disk();
  EXPECT_EQ(baked(show, folder_ / "above").live_disk_s, 0.0);
  show.camera.keys[1].theta = 110.0 / 180.0 * pi;
  const double live_s = baked(show, folder_ / "through").live_disk_s;
  EXPECT_GT(live_s, 0.0);
  EXPECT_LT(live_s, 0.2 * show.duration_s);
}

TEST_F(StreamedDiskPictures, BakedWithStopsAreTheSameBytes) {
  const auto text_of = [](const std::filesystem::path& path) {
    std::ifstream from(path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(from), {}};
  };
  const Show show = test::show_with_disk();
  baked(show, folder_ / "whole");
  const std::string whole = text_of(folder_ / "whole");
  for (const std::size_t part : {3UL, 5UL, 8UL}) {
    std::ofstream(folder_ / "cut", std::ios::binary) << whole.substr(0, whole.size() * part / 10);
    baked(show, folder_ / "cut");
    EXPECT_EQ(text_of(folder_ / "cut"), whole);
  }
}

}  // namespace
}  // namespace ergodome
