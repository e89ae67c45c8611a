#include "content/show/key_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::HasSubstr;

enum class Hue { none, red, green };
constexpr std::array hues = {"red", "green"};

struct LampSettings {
  double angle = 0.0;
  Hue hue = Hue::red;
};

struct RoomSettings {
  double width = 2.0;
  std::optional<double> height;
  int doors = 1;
  Vector3<double> corner = {1.0, 2.0, 3.0};
  std::optional<LampSettings> ceiling;
  std::vector<LampSettings> lamps;
};

constexpr auto lamp_keys = keys_of<LampSettings>(
    key<&LampSettings::angle>("angle_deg", "Direction.").degrees(-180.0, 180.0),
    key<&LampSettings::hue>("hue", "Color.").words(hues).first(Hue::red).required("write hue = \"red\""));

constexpr auto room_keys = keys_of<RoomSettings>(
    key<&RoomSettings::width>("width", "Width.").range(1.0, 9.0),
    key<&RoomSettings::height>("height", "Height.").range(1.0, 9.0),
    key<&RoomSettings::doors>("doors", "Doors.").range(0, 4).only_if([](const RoomSettings& room) {
      return room.width > 1.5;
    }),
    key<&RoomSettings::corner>("corner", "Position.").range(-9.0, 9.0),
    table<&RoomSettings::ceiling>("ceiling", lamp_keys), table<&RoomSettings::lamps>("lamp", lamp_keys, "", 2));

RoomSettings room_of(const std::string& text) {
  const toml::table parsed = parse_toml(text, "room.toml", 1, "a room");
  TomlTable table(parsed, "room.toml", "");
  RoomSettings room;
  read_settings<RoomSettings>(room_keys, table, room);
  table.refuse_unknown_keys();
  return room;
}

std::string text_of(const RoomSettings& room) {
  std::ostringstream text;
  text << written_settings<RoomSettings>(room_keys, room);
  return text.str();
}

TEST(KeyTable, KeepsTheMembersOfKeysThatAreAbsent) {
  const RoomSettings room = room_of("");
  EXPECT_EQ(room.width, 2.0);
  EXPECT_FALSE(room.height || room.ceiling);
  EXPECT_EQ(text_of(room), "corner = [ 1.0, 2.0, 3.0 ]\ndoors = 1\nwidth = 2.0");
}

TEST(KeyTable, WritesWhatItReads) {
  const std::string text =
      "corner = [ 4.0, 5.0, 6.0 ]\ndoors = 3\nheight = 7.0\nwidth = 8.0\n\n[ceiling]\nangle_deg = 90.0\nhue = 'green'\n"
      "\n[[lamp]]\nangle_deg = -180.0\nhue = 'red'\n\n[[lamp]]\nangle_deg = 0.0\nhue = 'green'";
  const RoomSettings room = room_of(text);
  EXPECT_EQ(room.ceiling->angle, 0.5 * std::numbers::pi);
  EXPECT_EQ(room.lamps.at(1).hue, Hue::green);
  EXPECT_EQ(text_of(room), text);
}

TEST(KeyTable, RefusesValuesThatTheDeclarationsExclude) {
  const auto problem = [](const std::string& text) { return error_of([&] { room_of(text); }); };
  EXPECT_THAT(problem("width = 10"), HasSubstr("room.toml:1: width is 10, outside 1 to 9"));
  EXPECT_THAT(problem("\nwidht = 2"), HasSubstr("room.toml:2: widht is not a known key; did you mean \"width\"?"));
  EXPECT_THAT(problem("width = 1\ndoors = 2"), HasSubstr("doors is not a known key"));
  EXPECT_THAT(problem("corner = [1, 2]"), HasSubstr("corner is not a list of 3 numbers"));
  EXPECT_THAT(problem("[ceiling]"), HasSubstr("ceiling.hue is missing; write hue = \"red\""));
  EXPECT_THAT(problem("[[lamp]]\nhue = \"none\""), HasSubstr("lamp[0].hue is \"none\""));
  EXPECT_THAT(problem("lamp = [{}, {}, {}]"), HasSubstr("at most 2 times"));
}

}  // namespace
}  // namespace ergodome
