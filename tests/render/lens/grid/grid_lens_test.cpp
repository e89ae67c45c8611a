#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/frame/require_path.h"
#include "render/frame/show_renderer.h"
#include "tests/support/baked_show.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

//! Returns a show with the given camera, in front of the grid sky.
Show show_of(const std::string& camera, const std::string& view) {
  return parse_show("[hole]\nspin = 0.999\n[camera]\n" + camera + "[sky]\nmap = \"grid\"\n[view]\n" + view,
                    "test.toml");
}

const SkyCube& grid_sky() {
  static const SkyCube sky(Backend::cpu, make_grid_sky(256), glm::dmat3(1.0));
  return sky;
}

Picture picture_of(const Show& show, LensChoice lens, ViewMode mode = ViewMode::sky) {
  PictureSettings settings;
  settings.mode = mode;
  settings.lens = lens;
  settings.scheme = show.grid_scheme;
  return EyeRenderer(Backend::cpu)
      .render(eye_camera(show, camera_pose(show, 0.0), 0.0), make_projection(show.view, show.view.size_px, 0.0),
              grid_sky(), settings);
}

//! Returns the absolute differences of all color channels of two pictures, in ascending order.
std::vector<double> differences(const Picture& a, const Picture& b) {
  std::vector<double> all(a.rgba.size());
  std::transform(a.rgba.begin(), a.rgba.end(), b.rgba.begin(), all.begin(),
                 [](float x, float y) { return std::abs(static_cast<double>(x) - static_cast<double>(y)); });
  std::sort(all.begin(), all.end());
  return all;
}

void expect_alike(const Show& show) {
  const Picture grid = picture_of(show, LensChoice::live);
  const Picture direct = picture_of(show, LensChoice::direct);
  ASSERT_STREQ(grid.lens, "live");
  ASSERT_STREQ(direct.lens, "direct");
  const std::vector<double> all = differences(grid, direct);
  // The limits correspond to an error of a quarter of a pixel on lines that are blurred over one
  // pixel.
  EXPECT_LT(all[all.size() * 99 / 100], 0.03);
  EXPECT_LT(all[all.size() * 999 / 1000], 0.15);
}

TEST(GridLens, DomePictureIsThatOfDirectRays) {
  expect_alike(show_of("[[camera.key]]\nr = 5\npitch_deg = -30\n", "projection = \"dome\"\nsize_px = 400\n"));
}

TEST(GridLens, PinholePictureOfAMovingObserverIsThatOfDirectRays) {
  expect_alike(show_of("observer = \"geodesic\"\n[[camera.key]]\nr = 6\ntheta_deg = 90\nphi_deg = 77\n",
                       "projection = \"pinhole\"\nfov_deg = 70\nsize_px = 400\n"));
}

TEST(GridLens, WholeSkyOffTheEquatorIsThatOfDirectRays) {
  expect_alike(show_of("observer = \"rain\"\n[[camera.key]]\nr = 8\ntheta_deg = 30\n",
                       "projection = \"equirect\"\nsize_px = 400\n"));
}

//! Returns the picture of an observer at the equator, at the height `above` over the horizon.
Picture picture_beside_horizon(double spin, double above, LensChoice lens) {
  Show show = show_of("[[camera.key]]\nr = 9\ntheta_deg = 90\n", "projection = \"equirect\"\nsize_px = 128\n");
  show.spin = spin;
  show.camera.keys[0].r = horizon_radius(Spacetime{spin}) + above;
  return picture_of(show, lens);
}

TEST(LensChooser, TakesRaysBesideAnExtremalHorizonWhereAGridHasTheShadowWrong) {
  for (const LensChoice asked : {LensChoice::automatic, LensChoice::live, LensChoice::streamed}) {
    EXPECT_STREQ(picture_beside_horizon(1.0, 1e-3, asked).lens, "direct");
  }
}

TEST(LensChooser, TakesTheGridThatIsAskedForBesideAnyOtherHorizon) {
  for (const double spin : {0.0, 0.9, 0.999}) {
    EXPECT_STREQ(picture_beside_horizon(spin, 1e-3, LensChoice::live).lens, "live") << spin;
  }
}

TEST(QuadtreeSource, PictureOfAShowThatAsksForItIsNearThatOfDirectRays) {
  Show show = show_of("observer = \"geodesic\"\n[[camera.key]]\nr = 6\ntheta_deg = 80\nphi_deg = 77\n",
                      "projection = \"dome\"\nsize_px = 300\n[grid]\nscheme = \"quadtree\"\n");
  const Picture quadtree = picture_of(show, LensChoice::automatic);
  const Picture direct = picture_of(show, LensChoice::direct);
  ASSERT_STREQ(quadtree.lens, "quadtree");
  ASSERT_STREQ(direct.lens, "direct");
  const std::vector<double> all = differences(quadtree, direct);
  EXPECT_LT(all[all.size() * 95 / 100], 0.03);
}

TEST(GridLens, ShadowHasTheSameSoftEdge) {
  const Show show = show_of("[[camera.key]]\nr = 5\n", "projection = \"pinhole\"\nfov_deg = 90\nsize_px = 300\n");
  const Picture grid = picture_of(show, LensChoice::live);
  const Picture direct = picture_of(show, LensChoice::direct);
  double worst = 0.0;
  for (std::size_t i = 3; i < grid.rgba.size(); i += 4) {
    worst = std::max(worst, std::abs(static_cast<double>(grid.rgba[i]) - static_cast<double>(direct.rgba[i])));
  }
  EXPECT_LT(worst, 0.02);
}

TEST(GridLens, FarAwayHoleIsTheSameSpeck) {
  expect_alike(show_of("[[camera.key]]\nr = 20000\n", "projection = \"pinhole\"\nfov_deg = 20\nsize_px = 300\n"));
}

TEST(GridLens, EveryHardCameraGivesAFinitePicture) {
  for (const char* camera : {"[[camera.key]]\nr = 1.0458\n", "[[camera.key]]\nr = 1.5\ntheta_deg = 60\n",
                             "[[camera.key]]\nr = 3\ntheta_deg = 0\n", "[[camera.key]]\nr = 1e6\n",
                             "observer = { beta = 0.999, toward = [0, 0, 1] }\n[[camera.key]]\nr = 7\n"}) {
    const Picture picture =
        picture_of(show_of(camera, "projection = \"dome\"\nfov_deg = 360\nsize_px = 128\n"), LensChoice::live);
    EXPECT_TRUE(std::all_of(picture.rgba.begin(), picture.rgba.end(), [](float v) { return std::isfinite(v); }))
        << camera;
  }
}

TEST(LensChooser, TracesSmallPicturesAndReadsLargeOnes) {
  const std::string camera = "[[camera.key]]\nr = 8\n";
  EXPECT_STREQ(picture_of(show_of(camera, "size_px = 64\n"), LensChoice::automatic).lens, "direct");
  EXPECT_STREQ(picture_of(show_of(camera, "size_px = 512\n"), LensChoice::automatic).lens, "live");
}

TEST(LensChooser, TracesWhatShowsRays) {
  const Show show = show_of("[[camera.key]]\nr = 8\n", "size_px = 64\n");
  for (const ViewMode mode : {ViewMode::steps, ViewMode::error_estimate, ViewMode::image_order}) {
    EXPECT_STREQ(picture_of(show, LensChoice::live, mode).lens, "direct");
  }
}

TEST(LensChooser, KeepsTheGridOfACameraThatTurnsAndGoesRoundTheAxis) {
  const Show show = show_of("[[camera.key]]\nr = 8\ntheta_deg = 70\n", "size_px = 256\n");
  LensChooser lenses(Backend::cpu);
  const Projection projection = make_projection(show.view, 256, 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  const auto built = [&] {
    lenses.choose({LensChoice::live, eye_camera(show, pose, 0.0), projection, ViewMode::sky, {}, {}});
    return lenses.built();
  };
  EXPECT_EQ(built(), 1);
  pose.phi += 1.0;
  EXPECT_EQ(built(), 1);
  pose.r += 0.01;
  EXPECT_EQ(built(), 2);
  pose.r -= 0.01;
  EXPECT_EQ(built(), 2);
}

TEST(LensChooser, WhoCannotWaitGetsTheViewFromTheLastGridAndThenTheRightOne) {
  const Show show = show_of("[[camera.key]]\nr = 8\ntheta_deg = 70\n", "size_px = 2048\n");
  LensChooser lenses(Backend::cpu);
  const Projection projection = make_projection(show.view, 2048, 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  const auto behind = [&](double patience_s) {
    const ShowMoment moment = {std::nullopt, patience_s};
    return lenses.choose({LensChoice::live, eye_camera(show, pose, 0.0), projection, ViewMode::sky, {}, moment, {}})
        ->behind();
  };
  // No grid exists yet, so the chooser waits for the first one, however short its patience is.
  EXPECT_FALSE(behind(0.0));
  pose.r += 0.01;
  EXPECT_TRUE(behind(0.0));
  EXPECT_FALSE(behind(60.0));
  // After a large step of the camera, the grid of the old position must not be used.
  pose.r += 5.0;
  EXPECT_FALSE(behind(0.0));
}

//! A show, its trajectory file, and the projection of its pictures.
class StreamedLens : public test::FolderTest {
 protected:
  StreamedLens() : show_(test::approaching_show()), projection_(make_projection(show_.view, show_.view.size_px, 0.0)) {}

  std::shared_ptr<StationStream> stream(bool derivatives = true) {
    test::bake_to(show_, folder_ / "t.trajectory", pixel_angle(projection_), derivatives);
    return std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(folder_ / "t.trajectory"),
                                           StationStream::default_memory_bytes, [](const std::string&) {});
  }

  //! Returns the name of the lens that is chosen for an eye at a time of the show. `budget` is a
  //! factor on the budget of the show.
  std::string lens_at(LensChooser& lenses, double time_s, double eye_offset, LensChoice choice = LensChoice::automatic,
                      double budget = 1.0) {
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, time_s), eye_offset);
    const LensAccuracy accuracy = {budget * show_.quality.budget_px, 0.05};
    return lenses.choose({choice, eye, projection_, ViewMode::sky, accuracy, {time_s}})->name();
  }

  Show show_;
  Projection projection_;
};

TEST_F(StreamedLens, PictureIsThatOfDirectRaysOnThePathAndForBothEyes) {
  EyeRenderer streamed(Backend::cpu, stream());
  EyeRenderer direct(Backend::cpu);
  for (const double offset : {0.0, -0.05, 0.05}) {
    const double time_s = 3.7;
    PictureSettings settings;
    settings.moment = {time_s};
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, time_s), offset);
    const Picture a = streamed.render(eye, projection_, grid_sky(), settings);
    settings.lens = LensChoice::direct;
    const Picture b = direct.render(eye, projection_, grid_sky(), settings);
    ASSERT_STREQ(a.lens, "streamed") << offset;
    const std::vector<double> all = differences(a, b);
    EXPECT_LT(all[all.size() * 99 / 100], 0.03) << offset;
    EXPECT_LT(all[all.size() * 999 / 1000], 0.15) << offset;
  }
}

TEST_F(StreamedLens, LeavingThePathMakesNoJump) {
  // The same pose is rendered twice: as a moment of the show, and as in free flight.
  EyeRenderer renderer(Backend::cpu, stream());
  PictureSettings settings;
  settings.lens = LensChoice::streamed;
  settings.moment = {5.1};
  const EyeCamera eye = eye_camera(show_, camera_pose(show_, 5.1), 0.0);
  const Picture on = renderer.render(eye, projection_, grid_sky(), settings);
  settings.moment = {};
  const Picture off = renderer.render(eye, projection_, grid_sky(), settings);
  ASSERT_STREQ(on.lens, "streamed");
  ASSERT_STREQ(off.lens, "live");
  const std::vector<double> all = differences(on, off);
  EXPECT_LT(all[all.size() * 99 / 100], 0.03);
}

TEST_F(StreamedLens, EyesTooFarBesideThePathGetGridsOfTheirOwn) {
  LensChooser lenses(Backend::cpu, stream());
  EXPECT_EQ(lens_at(lenses, 4.0, 0.02, LensChoice::streamed), "streamed");
  EXPECT_EQ(lens_at(lenses, 4.0, 3.0, LensChoice::streamed), "live");
}

TEST_F(StreamedLens, WithoutDerivativesEyesBesideThePathGetGridsOfTheirOwn) {
  LensChooser lenses(Backend::cpu, stream(false));
  EXPECT_EQ(lens_at(lenses, 1.0, 0.0), "streamed");
  EXPECT_EQ(lens_at(lenses, 1.0, 0.02, LensChoice::streamed), "live");
}

TEST_F(StreamedLens, ABakeThatIsTooCoarseIsUsedOnlyWhenAskedFor) {
  LensChooser lenses(Backend::cpu, stream());
  EXPECT_EQ(lens_at(lenses, 4.0, 0.0, LensChoice::automatic, 0.5), "live");
  EXPECT_EQ(lens_at(lenses, 4.0, 0.0, LensChoice::streamed, 0.5), "streamed");
  EXPECT_EQ(lens_at(lenses, 4.0, 0.0, LensChoice::live), "live");
}

TEST_F(StreamedLens, DamagedStationsAreBlendedAcrossAsFarAsThatHoldsTheBudget) {
  const std::filesystem::path file = folder_ / "t.trajectory";
  test::bake_to(show_, file, pixel_angle(projection_), false, 0.02);
  const std::vector<StationEntry> stations = TrajectoryReader(file).stations();
  ASSERT_GT(stations.size(), 5U);
  const auto lens_in_the_middle = [&] {
    LensChooser lenses(Backend::cpu,
                       std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(file),
                                                       StationStream::default_memory_bytes, [](const std::string&) {}));
    return lens_at(lenses, stations[stations.size() / 2].time_s, 0.0, LensChoice::streamed, 0.5);
  };
  test::damage_station(file, stations[stations.size() / 2]);
  EXPECT_EQ(lens_in_the_middle(), "streamed");
  for (std::size_t i = 1; i + 1 < stations.size(); ++i) {
    if (i != stations.size() / 2) {
      test::damage_station(file, stations[i]);
    }
  }
  EXPECT_EQ(lens_in_the_middle(), "live");
}

TEST_F(StreamedLens, AGapThatMissesItsBudgetGetsLiveGrids) {
  const std::filesystem::path file = folder_ / "t.trajectory";
  test::bake_to(show_, folder_ / "good.trajectory", pixel_angle(projection_), false, 0.1);
  const TrajectoryReader good(folder_ / "good.trajectory");
  TrajectoryJournal journal(folder_ / "part", good.provenance());
  std::vector<double> times_s;
  for (std::size_t i = 0; i < good.stations().size(); ++i) {
    const StationEntry& station = good.stations()[i];
    journal.add(station.time_s, good.read(i));
    if (i > 0) {
      // The first gap between stations misses the error budget.
      journal.add(Gap{times_s.back(), station.time_s, i == 1 ? 0.3F : 0.1F, 0.0F});
    }
    times_s.push_back(station.time_s);
  }
  ASSERT_GT(times_s.size(), 2U);
  journal.seal(file, times_s);
  LensChooser lenses(Backend::cpu,
                     std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(file),
                                                     StationStream::default_memory_bytes, [](const std::string&) {}));
  EXPECT_EQ(lens_at(lenses, 0.5 * times_s[1], 0.0, LensChoice::streamed), "live");
  EXPECT_EQ(lens_at(lenses, 0.5 * (times_s[1] + times_s[2]), 0.0, LensChoice::streamed), "streamed");
}

TEST_F(StreamedLens, TrajectoryOfAnotherPathIsRefused) {
  const auto baked = stream();
  EXPECT_NO_THROW(require_path_of(show_, baked->trajectory()));
  Show other = show_;
  other.camera.keys[1].r = 7.1;
  EXPECT_THROW(require_path_of(other, baked->trajectory()), Error);
  other = show_;
  other.spin = 0.91;
  EXPECT_THROW(require_path_of(other, baked->trajectory()), Error);
  other = show_;
  other.duration_s = 9.0;
  EXPECT_THROW(require_path_of(other, baked->trajectory()), Error);
}

}  // namespace
}  // namespace ergodome
