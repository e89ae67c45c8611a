#include "app/player/recording/flight_recorder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/cli/show_loading.h"
#include "content/camera/rain_pose.h"
#include "content/files/atomic_file.h"
#include "content/show/reading/show_reader.h"
#include "tests/support/folder_test.h"
#include "tests/support/killed_writer.h"

namespace ergodome {
namespace {

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = glm::inverse(a) * b;
  return 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

//! Returns the pose at time `t` of a simulated flight that falls inwards and rotates.
CameraPose flight_at(double t) {
  const glm::dquat look = glm::angleAxis(0.7 * std::sin(0.4 * t), glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
  return {6.0 + 9.0 * std::exp(-0.1 * t), 1.4 + 0.3 * std::sin(0.3 * t), 0.2 * t, key_orientation(CameraKey()) * look};
}

FlightSample outside(double time_s, const CameraPose& pose, bool as_observer = false) {
  return {time_s, pose, Spacetime{0.9}, as_observer, {}};
}

FlightRecorder recorded(double seconds) {
  FlightRecorder recorder;
  for (int i = 0; i <= 30 * seconds; ++i) {
    recorder.note(outside(100.0 + i / 30.0, flight_at(i / 30.0)));
  }
  return recorder;
}

TEST(KeyAt, LooksWhereThePoseLooks) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const glm::dquat q = glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
    EXPECT_LT(angle_between(key_orientation(key_at(0.0, {10.0, 1.0, 0.0, q})), q), 1e-7);
  }
}

TEST(KeyAt, LooksStraightUpWithoutYawAndRollFightingEachOther) {
  for (const double pitch : {0.5, -0.5}) {
    CameraKey key;
    key.pitch = pitch * 3.14159265358979323846;
    key.yaw = 0.8;
    const glm::dquat up = key_orientation(key);
    EXPECT_LT(angle_between(key_orientation(key_at(0.0, {10.0, 1.0, 0.0, up})), up), 1e-7);
  }
}

TEST(FlightRecorder, MakesAPathThatStaysNearEveryNote) {
  const Show scene = load_show("free-flight");
  Show path = scene;
  path.camera.keys = recorded(30.0).path(scene).keys;
  for (int i = 0; i <= 900; ++i) {
    const CameraPose was = flight_at(i / 30.0);
    const CameraPose is = camera_pose(path, i / 30.0);
    ASSERT_NEAR(is.r / was.r, 1.0, 1.01e-3) << i;
    ASSERT_NEAR(is.theta, was.theta, 1.01e-3) << i;
    ASSERT_NEAR(is.phi, was.phi, 2e-3) << i;
    ASSERT_LT(angle_between(is.orientation, was.orientation), 1.01e-3) << i;
  }
}

//! Returns a velocity at time `t` that changes as in a fall past the hole.
Vector3<double> flight_velocity_at(double t) {
  return {-0.6 * std::cos(0.2 * t), 0.1 * std::sin(0.3 * t), 0.7 * std::sin(0.2 * t)};
}

TEST(FlightRecorder, KeepsHowWhoLooksMoves) {
  FlightRecorder recorder;
  for (int i = 0; i <= 300; ++i) {
    CameraPose pose = flight_at(i / 30.0);
    pose.velocity = flight_velocity_at(i / 30.0);
    recorder.note(outside(i / 30.0, pose));
  }
  Show path = load_show("free-flight");
  path.camera.keys = recorder.path(path).keys;
  EXPECT_LT(path.camera.keys.size(), 100U);
  for (int i = 0; i <= 300; ++i) {
    const Vector3<double> off = *camera_pose(path, i / 30.0).velocity - flight_velocity_at(i / 30.0);
    ASSERT_LT(std::sqrt(dot(off, off)), 1.01e-3) << i;
  }
}

TEST(FlightRecorder, TurnsEachNoteByTheSpinThatTheHoleHadThen) {
  FlightRecorder recorder;
  const double spins[] = {0.9, -0.4};
  for (const int i : {0, 1}) {
    CameraPose pose = flight_at(i);
    pose.velocity = flight_velocity_at(i);
    recorder.note({static_cast<double>(i), in_rain_frame(pose, Spacetime{spins[i]}), Spacetime{spins[i]}, false,
                   FallingNote{0.0, false}});
  }
  Show scene = load_show("free-flight");
  scene.spin = 0.1;
  const std::vector<CameraKey> keys = recorder.path(scene).keys;
  ASSERT_EQ(keys.size(), 2U);
  for (const CameraKey& key : keys) {
    const Vector3<double> off = *key.velocity - flight_velocity_at(key.time_s);
    EXPECT_LT(std::sqrt(dot(off, off)), 1e-12);
    EXPECT_LT(angle_between(key_orientation(key), flight_at(key.time_s).orientation), 1e-7);
  }
}

TEST(FlightRecorder, HasNoVelocitiesWhereTheScenesObserverHasThemAll) {
  for (const bool all : {true, false}) {
    FlightRecorder recorder;
    for (const double time_s : {0.0, 1.0}) {
      CameraPose pose = flight_at(time_s);
      pose.velocity = flight_velocity_at(time_s);
      recorder.note(outside(time_s, pose, all || time_s == 0.0));
    }
    for (const CameraKey& key : recorder.path(load_show("free-flight")).keys) {
      EXPECT_EQ(key.velocity.has_value(), !all);
    }
  }
}

TEST(FlightRecorder, NeedsFarFewerKeysThanNotes) {
  EXPECT_LT(recorded(30.0).path(load_show("free-flight")).keys.size(), 900U / 5U);
}

TEST(FlightRecorder, GoesOnAcrossAWholeTurn) {
  FlightRecorder recorder;
  for (int i = 0; i <= 60; ++i) {
    CameraPose pose = flight_at(0.0);
    pose.phi = std::remainder(6.2 + 0.01 * i, 2.0 * 3.14159265358979323846);
    recorder.note(outside(i / 30.0, pose));
  }
  const auto keys = recorder.path(load_show("free-flight")).keys;
  EXPECT_NEAR(keys.back().phi - keys.front().phi, 0.6, 1e-12);
}

TEST(FlightRecorder, PassesOverWhatIsNoPlace) {
  FlightRecorder recorder;
  recorder.note(outside(0.0, flight_at(0.0)));
  CameraPose nowhere = flight_at(1.0);
  nowhere.r = std::numeric_limits<double>::quiet_NaN();
  recorder.note(outside(1.0, nowhere));
  recorder.note(outside(-1.0, flight_at(1.0)));
  recorder.note(outside(std::numeric_limits<double>::infinity(), flight_at(1.0)));
  EXPECT_TRUE(recorder.empty());
}

TEST(FlightRecorder, IsBounded) {
  FlightRecorder recorder;
  for (int i = 0; i < 200'000; ++i) {
    recorder.note(outside(i / 30.0, flight_at(0.0)));
  }
  EXPECT_TRUE(recorder.full());
  EXPECT_NEAR(recorder.path(load_show("free-flight")).keys.back().time_s, 3600.0, 1.0);
}

using RecordedShow = test::FolderTest;

TEST_F(RecordedShow, IsReadAgainWithTheSamePath) {
  const Show scene = load_show("free-flight");
  const Show show = recorded_show(scene, recorded(5.0).path(scene), "A flight");
  const Show read = parse_show(to_toml(show), (folder_ / "flight.toml").string());
  EXPECT_EQ(read.title, (LocalText{{"", "A flight"}}));
  EXPECT_NEAR(read.duration_s, 5.0, 1e-9);
  for (double t = 0.0; t < 5.0; t += 0.1) {
    EXPECT_NEAR(camera_pose(read, t).r, camera_pose(show, t).r, 1e-9);
    EXPECT_LT(angle_between(camera_pose(read, t).orientation, camera_pose(show, t).orientation), 1e-6);
  }
}

TEST_F(RecordedShow, IsReadAgainWithTheSameVelocities) {
  const Show scene = load_show("free-flight");
  std::vector<CameraKey> keys = recorded(5.0).path(scene).keys;
  for (CameraKey& key : keys) {
    key.velocity = flight_velocity_at(key.time_s);
  }
  const Show show = recorded_show(scene, {keys, {}}, "A flight");
  const Show read = parse_show(to_toml(show), (folder_ / "flight.toml").string());
  for (double t = 0.0; t < 5.0; t += 0.5) {
    const Vector3<double> off = *camera_pose(read, t).velocity - *camera_pose(show, t).velocity;
    EXPECT_LT(std::sqrt(dot(off, off)), 1e-9);
  }
}

TEST_F(RecordedShow, IsOldOrNewWhateverMomentTheProgramIsKilledIn) {
  const Show scene = load_show("free-flight");
  const std::filesystem::path file = folder_ / "flight.toml";
  test::kill_while_writing(
      [&](int i) {
        std::vector<CameraKey> keys(2 + static_cast<std::size_t>(i % 100));
        for (std::size_t k = 0; k < keys.size(); ++k) {
          keys[k].time_s = static_cast<double>(k);
        }
        write_text_atomically(file, to_toml(recorded_show(scene, {keys, {}}, "A flight")));
      },
      [&] {
        if (std::filesystem::exists(file)) {
          EXPECT_EQ(text_in(read_show(file).title, ""), "A flight");
        }
      });
  EXPECT_TRUE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace ergodome
