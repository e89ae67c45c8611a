#include "app/player/player_services.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/reading/show_reader.h"

namespace ergodome {
namespace {

using testing::ElementsAre;

PlayerStatus first_status(const std::string& clock = "own") {
  const Show show = parse_show(
      "title = \"Evening\"\nduration_s = 20\n[[camera.key]]\nr = 9\n[[chapter]]\nt_s = 0\ntitle = { en = \"One\", de = "
      "\"Eins\" }\n[[chapter]]\nt_s = 9\ntitle = { en = \"Two\", de = \"Zwei\" }\n",
      "evening.toml");
  ServiceOptions options;
  options.sound = false;
  options.clock = clock;
  return PlayerServices(options, show).status();
}

TEST(PlayerServices, TellsOfTheShowBeforeItsFirstPicture) {
  const PlayerStatus status = first_status();
  EXPECT_EQ(status.title, "Evening");
  EXPECT_EQ(status.duration_s, 20.0);
  EXPECT_EQ(status.chapters.size(), 2U);
  EXPECT_THAT(status.languages, ElementsAre("de", "en"));
  EXPECT_EQ(status.problem, "");
}

TEST(PlayerServices, TellsBeforeTheFirstPictureThatAnotherClockMovesTheShow) {
  EXPECT_EQ(first_status("osc").follows, "OSC");
}

}  // namespace
}  // namespace ergodome
