#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "content/objects/object_checks.h"
#include "content/objects/object_motion.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"

namespace ergodome {
namespace {

Show show_of(const std::string& rest, const std::string& spin = "0", const std::string& r = "30") {
  return parse_show("[hole]\nspin = " + spin + "\n[camera]\n[[camera.key]]\nr = " + r + "\n" + rest, "show.toml");
}

void expect_position(const Vector3<double>& position, const Vector3<double>& wanted) {
  EXPECT_NEAR(position.x, wanted.x, 1e-9);
  EXPECT_NEAR(position.y, wanted.y, 1e-9);
  EXPECT_NEAR(position.z, wanted.z, 1e-9);
}

TEST(ObjectReader, AShowWithoutObjectsHasNone) {
  EXPECT_TRUE(show_of("").objects.empty());
  EXPECT_FALSE(show_of("").light.has_value());
}

TEST(ObjectReader, ASphereWithItsKeysIsReadAndWrittenBack) {
  const Show show = show_of(R"([[objects]]
shape = "sphere"
segments = 12
rings = 6
size = 0.5
turn_deg = [10, 20, 30]
position = [-5, 3, -0.5]
color = [1, 0.5, 0.25]
exposure = 2
light = "lambert"
checker = { columns = 4, rows = 3, dark = 0.1 }
tessellation = { most = 16, factor = 2, power = 0.5, torn = 20 }
method = "polygon"
[light]
position = [40, 0, 1]
strength = 1600
)");
  for (const Show& each : {show, parse_show(to_toml(show), "again.toml")}) {
    ASSERT_EQ(each.objects.size(), 1U);
    const ObjectSettings& object = each.objects.front();
    EXPECT_EQ(object.form, ObjectForm::sphere);
    EXPECT_EQ(object.sphere.segments, 12);
    EXPECT_EQ(object.sphere.rings, 6);
    EXPECT_EQ(object.size, 0.5);
    EXPECT_NEAR(object.turn.z, pi / 6.0, 1e-15);
    expect_position(object.position, {-5.0, 3.0, -0.5});
    EXPECT_EQ(object.color.z, 0.25);
    EXPECT_EQ(object.exposure, 2.0);
    EXPECT_TRUE(object.lit);
    EXPECT_EQ(object.checker, (CheckerSettings{4, 3, 0.1}));
    EXPECT_EQ(object.tessellation.maximum, 16.0);
    EXPECT_EQ(object.tessellation.power, 0.5);
    EXPECT_EQ(object.torn, 20.0);
    EXPECT_EQ(each.light->strength, 1600.0);
  }
}

TEST(ObjectReader, EveryFormAndMotionReadsBackFromItsOwnText) {
  const Show show = show_of(R"([[objects]]
mesh = "ship.obj"
orbit = { r = 6, phi_deg = 90, inclination_deg = 180, node_deg = 20, speed = 3 }
[[objects]]
shape = "triangle"
corners = [[0, 0, 0], [0, 2, 0], [0, 0, 3]]
key = [{ t_s = 0, position = [-5, 3, 0], ease = "linear" }, { t_s = 10, position = [-5, 1, 2] }]
[[objects]]
shape = "disk"
inner = 6
outer = 9
thickness = 0.5
segments = 16
rings = 2
)");
  const Show again = parse_show(to_toml(show), "again.toml");
  ASSERT_EQ(again.objects.size(), 3U);
  EXPECT_EQ(again.objects[0].mesh, "ship.obj");
  EXPECT_EQ(again.objects[0].orbit->inclination, show.objects[0].orbit->inclination);
  EXPECT_EQ(again.objects[1].triangle.corners[2].z, 3.0);
  EXPECT_EQ(again.objects[2].disk.outer, 9.0);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_position(placement_at(again.objects[i], 4.0).position, placement_at(show.objects[i], 4.0).position);
  }
}

TEST(ObjectReader, RefusesWhatCannotBeAndNamesFileAndKey) {
  for (const char* const object :
       {"",
        "shape = \"cone\"",
        "shape = \"sphere\"\nmesh = \"a.obj\"",
        "shape = \"sphere\"\nrings = 1",
        "shape = \"sphere\"\nsize = 0",
        "shape = \"sphere\"\nsize = nan",
        "shape = \"sphere\"\nposition = [1, 2]",
        "shape = \"sphere\"\nposition = [inf, 0, 0]",
        "shape = \"sphere\"\ncolour = [1, 1, 1]",
        "shape = \"sphere\"\nposition = [9, 0, 0]\norbit = { r = 9 }",
        "shape = \"sphere\"\norbit = { r = 2.5 }",
        "shape = \"sphere\"\nkey = [{ t_s = 0 }]",
        "shape = \"sphere\"\nmethod = \"rays\"",
        "shape = \"sphere\"\nretarded = true",
        "shape = \"sphere\"\nmethod = \"trace\"\nretarded = true\nkey = [{ t_s = 1, position = [9, 0, 0] }]",
        "shape = \"sphere\"\nmethod = \"trace\"\n[[objects]]\nshape = \"sphere\"",
        "shape = \"sphere\"\nkey = [{ t_s = 1, position = [9, 0, 0] }, { t_s = 1, position = [8, 0, 0] }]",
        "shape = \"triangle\"\ncorners = [[0, 0, 0], [1, 0, 0]]",
        "shape = \"disk\"\ninner = 9\nouter = 8",
        "shape = \"sphere\"\nchecker = { columns = 0 }",
        "shape = \"sphere\"\ntessellation = { most = 65 }",
        "shape = \"sphere\"\nlight = \"lambert\""}) {
    SCOPED_TRACE(object);
    try {
      show_of(std::string("[[objects]]\n") + object);
      ADD_FAILURE() << "was taken";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("show.toml:"), testing::HasSubstr("objects"),
                                               testing::HasSubstr("; ")));
    }
  }
  EXPECT_THROW(show_of("[light]\nposition = [1, 1, 1]"), Error);
}

TEST(ObjectReader, RefusesAHoleThatSpinsAndACameraInsideThePhotonSphere) {
  const std::string sphere = "[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\n";
  EXPECT_NO_THROW(show_of(sphere));
  EXPECT_THROW(show_of(sphere, "0.5"), Error);
  EXPECT_THROW(show_of(sphere, "0", "2.9"), Error);
  const std::string spun = "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = 0 }]\n";
  EXPECT_THROW(show_of(sphere + spun), Error);
}

TEST(ObjectReader, TakesThemWhereTheyAreTraced) {
  const std::string sphere = "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nposition = [9, 0, 0]\n";
  EXPECT_NO_THROW(show_of(sphere, "0.5"));
  EXPECT_NO_THROW(show_of(sphere, "0", "2.9"));
  EXPECT_TRUE(missing_features(show_of(sphere + "[disk]\n")).empty());
}

TEST(ObjectReader, KeepsMethodAndRetardationWhenAShowIsWritten) {
  const Show show =
      show_of("[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nretarded = true\norbit = { r = 9 }\n", "0.5");
  EXPECT_EQ(show.objects.front().method, ObjectMethod::trace);
  EXPECT_TRUE(show.objects.front().retarded);
  const Show again = parse_show(to_toml(show), "again.toml");
  EXPECT_EQ(again.objects.front().method, ObjectMethod::trace);
  EXPECT_TRUE(again.objects.front().retarded);
}

TEST(ObjectReader, KeepsTheNumberOfImagesOfPolygonsWhenAShowIsWritten) {
  const Show show = show_of("[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\nimages = 4\n");
  EXPECT_EQ(show.objects.front().images, 4);
  EXPECT_EQ(parse_show(to_toml(show), "again.toml").objects.front().images, 4);
  EXPECT_THROW(show_of("[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\nimages = 6\n"), Error);
  EXPECT_THROW(show_of("[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nposition = [9, 0, 0]\nimages = 2\n"),
               Error);
}

TEST(ObjectReader, SaysWhichPartsOfAShowDoNotGoWithObjects) {
  const std::string sphere = "[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\n";
  EXPECT_TRUE(missing_features(show_of(sphere)).empty());
  EXPECT_EQ(missing_features(show_of(sphere + "[disk]\n")).size(), 1U);
  EXPECT_TRUE(missing_features(show_of(sphere + "[stereo]\nlayout = \"rows\"\nmodel = \"flat\"\n")).empty());
  EXPECT_TRUE(missing_features(show_of(sphere + "[stereo]\nlayout = \"rows\"\nbaseline = 0.1\n")).empty());
}

TEST(ObjectReader, LetsEyesOfEveryModelSeeObjects) {
  const std::string stereo = "[stereo]\nlayout = \"rows\"\nbaseline = 0.1\nmodel = ";
  for (const std::string method : {"trace", "polygon"}) {
    const std::string sphere = "[[objects]]\nshape = \"sphere\"\nmethod = \"" + method + "\"\nposition = [9, 0, 0]\n";
    for (const char* const model : {"\"physical\"\n", "\"omni\"\n", "\"flat\"\n"}) {
      EXPECT_TRUE(missing_features(show_of(sphere + stereo + model)).empty()) << method << " " << model;
    }
  }
}

TEST(ObjectMotion, AnOrbitIsRunThroughOnceInKeplersPeriod) {
  ObjectSettings object;
  object.orbit = ObjectOrbit{9.0, 0.25 * pi, 0.0, 0.0, 2.0};
  const double period_s = 2.0 * pi * 27.0 / 2.0;
  expect_position(placement_at(object, 0.0).position, {9.0 * std::sqrt(0.5), 9.0 * std::sqrt(0.5), 0.0});
  expect_position(placement_at(object, 0.5 * period_s).position, {-9.0 * std::sqrt(0.5), -9.0 * std::sqrt(0.5), 0.0});
  expect_position(placement_at(object, 1000.0 * period_s).position, placement_at(object, 0.0).position);
}

TEST(ObjectMotion, AnOrbitAboutASpinningHoleIsRunThroughAsMatterInFreeFallDoes) {
  // Angular velocity of circular orbits (Bardeen, Press & Teukolsky 1972, eq. 2.16): 1 / (r^1.5 +
  // a) with the hole's rotation, 1 / (r^1.5 - a) against it.
  const auto rate_of = [](const char* orbit) {
    return orbit_rate(
        *show_of(std::string("[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\norbit = ") + orbit + "\n", "0.9")
             .objects.front()
             .orbit);
  };
  EXPECT_NEAR(rate_of("{ r = 9 }"), 1.0 / 27.9, 1e-15);
  EXPECT_NEAR(rate_of("{ r = 9, speed = -5 }"), -1.0 / 26.1, 1e-15);
  EXPECT_NEAR(rate_of("{ r = 9, inclination_deg = 180 }"), 1.0 / 26.1, 1e-15);
  EXPECT_NEAR(rate_of("{ r = 9, inclination_deg = 90 }"), 1.0 / 27.0, 1e-15);
}

TEST(ObjectMotion, AnInclinedOrbitRisesAtItsNode) {
  ObjectSettings object;
  object.orbit = ObjectOrbit{10.0, 0.5 * pi, pi / 3.0, 0.5 * pi, 1.0};
  expect_position(placement_at(object, 0.0).position, {-5.0, 0.0, 10.0 * std::sin(pi / 3.0)});
}

TEST(ObjectMotion, TurnsGoAboutXThenYThenZ) {
  ObjectSettings object;
  object.turn = {0.5 * pi, 0.0, 0.5 * pi};
  const ObjectPlacement placement = placement_at(object, 0.0);
  const auto& rows = placement.rows;
  // The rotation about x moves the object's y axis to z, and the later rotation about z leaves it
  // there. The rotation about z moves the object's x axis to y.
  expect_position({rows[0][1], rows[1][1], rows[2][1]}, {0.0, 0.0, 1.0});
  expect_position({rows[0][0], rows[1][0], rows[2][0]}, {0.0, 1.0, 0.0});
}

}  // namespace
}  // namespace ergodome
