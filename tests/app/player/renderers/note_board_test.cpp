#include "app/player/renderers/note_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "app/player/renderers/play_renderers.h"
#include "render/frame/show_renderer.h"
#include "tests/support/baked_show.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(NoteBoard, TellsANoteOnceHoweverOftenAShowIsReadAgain) {
  NoteBoard board;
  board.post("evening", {"no stars", "no light", "no stars"});
  board.post("evening", {"no stars", "no light"});
  EXPECT_THAT(board.take(), ElementsAre("no stars", "no light"));
  EXPECT_THAT(board.take(), IsEmpty());
}

TEST(NoteBoard, TellsAgainWhatHadGoneAndComesAgain) {
  NoteBoard board;
  board.post("evening", {"no stars"});
  board.post("evening", {});
  board.post("evening", {"no stars"});
  EXPECT_THAT(board.take(), ElementsAre("no stars", "no stars"));
}

TEST(NoteBoard, KeepsTheNotesOfOneShowWhereAnotherIsRead) {
  NoteBoard board;
  board.post("visitors", {"no stars"});
  board.post("attract", {"no light"});
  board.post("visitors", {"no stars"});
  EXPECT_THAT(board.take(), ElementsAre("no stars", "no light"));
}

TEST(NoteBoard, HearsWhatIsReadAfterAShowIsLoaded) {
  NoteBoard board;
  const auto reading = std::make_shared<std::set<std::string>>();
  board.supersede("evening", reading);
  board.add(reading, "a station is damaged");
  board.add(reading, "a station is damaged");
  EXPECT_THAT(board.take(), ElementsAre("a station is damaged"));
  board.post("evening", {"a station is damaged"});
  EXPECT_THAT(board.take(), IsEmpty());
}

//! A renderer whose trajectory file has a damaged station. Stations are read ahead in a separate
//! thread, so the damage is found while the renderer is in use.
class RendererOfADamagedBake : public test::FolderTest {};

TEST_F(RendererOfADamagedBake, TellsOfItsStationsAsTheyAreRead) {
  const Show show = test::approaching_show();
  const std::filesystem::path file = folder_ / "t.trajectory";
  test::bake_to(show, file, 0.05);
  const std::vector<StationEntry> stations = TrajectoryReader(file).stations();
  test::damage_station(file, stations.back());
  const auto board = std::make_shared<NoteBoard>();
  LensOptions lens;
  lens.trajectory = file.string();
  const RendererWish wish = {Backend::cpu, false, lens, 64, false, board, ""};
  const std::shared_ptr<ShowRenderer> renderer = renderer_maker(wish)(show);
  std::vector<std::string> reported;
  for (int wait = 0; wait < 500 && reported.empty(); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    reported = board->take();
  }
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_THAT(reported[0], testing::HasSubstr("damaged"));
}

}  // namespace
}  // namespace ergodome
