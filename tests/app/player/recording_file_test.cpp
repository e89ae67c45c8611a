#include "app/player/recording_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/reading/show_reader.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

//! Records a simulated flight to a file, one second at a time.
class RecordedToAFile : public test::FolderTest {
 protected:
  void fly(RecordingFile& file) {
    file.begin();
    session_.record();
    for (int i = 0; i < 10; ++i) {
      now_ += std::chrono::milliseconds(100);
      session_.advance({});
    }
    file.save(session_);
  }
  [[nodiscard]] bool is_there(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  MonotonicTime now_ = std::chrono::seconds(1000);
  PlayerSession session_{parse_show("[hole]\nspin = 0.5\n[[camera.key]]\nr = 12\n", "scene.toml"),
                         {.free_flight = true, .language = "en", .source = [this] { return now_; }}};
};

TEST_F(RecordedToAFile, KeepsWhatWasThereFromBefore) {
  std::ofstream(folder_ / "flight.toml") << "another run's";
  RecordingFile file(folder_ / "flight.toml", RecordingFile::Names::one);
  fly(file);
  EXPECT_TRUE(file.save(session_));
  EXPECT_EQ(text("flight.toml.bak"), "another run's");
  EXPECT_THAT(text("flight.toml"), HasSubstr("Recorded flight"));
}

TEST_F(RecordedToAFile, EachFlightHasAFileOfItsOwn) {
  RecordingFile file(folder_ / "flight.toml", RecordingFile::Names::numbered);
  fly(file);
  const std::string first = text("flight-000001.toml");
  fly(file);
  file.save(session_);
  EXPECT_THAT(first, HasSubstr("Recorded flight"));
  EXPECT_EQ(text("flight-000001.toml"), first);
  EXPECT_TRUE(is_there("flight-000002.toml"));
  EXPECT_FALSE(is_there("flight-000003.toml"));
  EXPECT_FALSE(is_there("flight.toml"));
}

TEST_F(RecordedToAFile, ASessionThatDoesNotRecordWritesNothing) {
  RecordingFile file(folder_ / "flight.toml", RecordingFile::Names::numbered);
  session_.advance({});
  EXPECT_FALSE(file.save(session_));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace ergodome
