#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/reading/show_reader.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

Show show_with_flight(const std::string& flight) {
  return parse_show("[[camera.key]]\nr = 12\n[flight]\n" + flight, "f.toml");
}

TEST(FlightReader, TakesEveryKeyAndWritesItBack) {
  FlightSettings flight;
  flight.guard = FlightGuard::photon_orbit;
  flight.mode = FlightMode::geodesic;
  flight.from = FlightStart::first_key;
  flight.max_speed = 0.25;
  flight.least_r = 3.5;
  flight.most_r = 80.0;
  flight.return_s = 6.0;
  flight.comfort = {20.0, 30.0, 0.5};
  const Show show = show_with_flight(
      "guard = \"photon_orbit\"\nmode = \"geodesic\"\nfrom = \"first_key\"\nmax_speed = 0.25\nleast_r = 3.5\n"
      "most_r = 80\nreturn_s = 6\ncomfort = { turn_deg_s = 20, turn_accel_deg_s2 = 30, accel = 0.5 }\n");
  EXPECT_EQ(show.flight, flight);
  EXPECT_EQ(parse_show(to_toml(show), "again.toml").flight, flight);
}

TEST(FlightReader, NamesWhatIsWrong) {
  const auto error = [](const std::string& flight) { return test::error_of([&] { show_with_flight(flight); }); };
  EXPECT_THAT(error("gard = \"horizon\"\n"), HasSubstr("did you mean \"guard\""));
  EXPECT_THAT(error("guard = \"photon\"\n"), HasSubstr("photon_orbit"));
  EXPECT_THAT(error("least_r = 80\nmost_r = 50\n"), HasSubstr("f.toml:4: flight.least_r is 80, too close to most_r"));
  EXPECT_THAT(error("comfort = { turn_deg_s = nan }\n"), HasSubstr("flight.comfort.turn_deg_s"));
}

}  // namespace
}  // namespace ergodome
