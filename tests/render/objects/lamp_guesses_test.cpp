#include "render/objects/lamp_guesses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "content/mesh/built_in_meshes.h"
#include "content/show_reader.h"
#include "kernels/mesh/lamp_light.h"

// Where the search for a lamp's rays to objects begins.
namespace ergodome {
namespace {

const std::string lamp_line = "[light]\nposition = [40, -20, 15]\n[camera]\n[[camera.key]]\nr = 30\n";

//! A show's objects with their outlines.
struct LitScene {
  Show show;
  std::vector<PlacedOutline> outlines;

  explicit LitScene(const std::string& objects) : show(parse_show(objects + lamp_line, "lit.toml")) {
    std::vector<MeshOutline> meshes;
    for (const ObjectSettings& object : show.objects) {
      meshes.push_back(
          outline_of(object.form == ObjectForm::disk ? make_disk(object.disk) : make_sphere(object.sphere)));
    }
    outlines = place_outlines(show.objects, meshes, 0.0);
  }

  [[nodiscard]] std::vector<LampGuess> guesses(double spin) const {
    return lamp_guesses(spin, {show.light->position, 1.0}, show.objects, outlines);
  }
};

const std::string lit_ball =
    "[[objects]]\nmethod = \"trace\"\nlight = \"lambert\"\nshape = \"sphere\"\nposition = [12, 0, 0]\n";
const std::string lit_disk =
    "[[objects]]\nmethod = \"trace\"\nlight = \"lambert\"\nshape = \"disk\"\ninner = 6\nouter = 16\nthickness = 1\n";
const std::string dark_ball = "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nposition = [0, 14, 0]\n";

TEST(LampGuesses, AreOfTheMiddleOfWhatIsSmallAndOfAllSidesOfWhatIsNot) {
  EXPECT_EQ(LitScene(lit_ball).guesses(0.9).size(), 1U);
  const std::vector<LampGuess> around = LitScene(lit_disk + dark_ball).guesses(0.9);
  ASSERT_EQ(around.size(), 8U);
  for (const auto& [x, y] : {std::pair{1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}, {-1.0, -1.0}}) {
    EXPECT_TRUE(std::ranges::any_of(
        around, [&](const LampGuess& guess) { return x * guess.place.x > 0.0 && y * guess.place.y > 0.0; }));
  }
}

TEST(LampGuesses, AreNoneWithoutSpinOrLight) {
  EXPECT_TRUE(LitScene(lit_disk).guesses(0.0).empty());
  EXPECT_TRUE(LitScene(dark_ball).guesses(0.9).empty());
}

TEST(LampGuesses, LeadToTheRaysThatAreFoundFromNothing) {
  const LitScene scene(lit_disk);
  const std::vector<LampGuess> guesses = scene.guesses(0.9);
  int compared = 0;
  for (int i = 0; i < 24; ++i) {
    const double azimuth = 0.26 * i;
    const double r = 6.0 + 0.4 * i;
    const Vector3<double> point = {r * std::cos(azimuth), r * std::sin(azimuth), 0.5};
    LampCorrections known = nearest_corrections(guesses.data(), static_cast<int>(guesses.size()), point);
    LampCorrections unknown = {};
    for (int way = 0; way < 2; ++way) {
      EXPECT_GT(dot(known.by_way[way], known.by_way[way]), 0.0);
      const auto find = [&](LampCorrections& corrections, LightRay& ray) {
        return light_ray(0.9, local_frame(0.9, point), point, scene.show.light->position, way + 1,
                         LightRayParts::spread, corrections.by_way[way], ray);
      };
      LightRay from_known{};
      LightRay from_unknown{};
      ASSERT_TRUE(find(known, from_known) && find(unknown, from_unknown));
      EXPECT_NEAR(from_known.spread, from_unknown.spread, 2e-3 * from_unknown.spread) << i << ' ' << way;
      EXPECT_NEAR(dot(from_known.direction, from_unknown.direction), 1.0, 1e-9) << i << ' ' << way;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 48);
}

}  // namespace
}  // namespace ergodome
