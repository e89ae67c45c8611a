#include "app/player/note_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace ergodome
