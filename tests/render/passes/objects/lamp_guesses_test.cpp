#include "render/passes/objects/lamp_guesses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "content/mesh/built_in_meshes.h"
#include "content/show/reading/show_reader.h"
#include "kernels/objects/light_ray.h"

// Tests of initial guesses for the rays from a lamp to objects.
namespace ergodome {
namespace {

const std::string lamp_line = "[light]\nposition = [40, -20, 15]\n[camera]\n[[camera.key]]\nr = 30\n";

//! The objects of a show that are lit by a lamp, and their outlines.
struct LitScene {
  Show show;
  std::vector<PlacedOutline> outlines;

  explicit LitScene(const std::string& objects) : show(parse_show(objects + lamp_line, "lit.toml")) {
    std::vector<MeshOutline> meshes;
    meshes.reserve(show.objects.size());
    for (const ObjectSettings& object : show.objects) {
      meshes.push_back(
          outline_of(object.form == ObjectForm::disk ? make_disk(object.disk) : make_sphere(object.sphere)));
    }
    outlines = place_outlines(show.objects, meshes, 0.0);
  }

  [[nodiscard]] std::vector<LampCorrections> guesses(double spin) const {
    return lamp_guesses(Spacetime{spin}, {show.light->position, 1.0}, show.objects, outlines);
  }
};

const std::string lit_ball =
    "[[objects]]\nmethod = \"trace\"\nlight = \"lambert\"\nshape = \"sphere\"\nposition = [12, 0, 0]\n";
const std::string lit_disk =
    "[[objects]]\nmethod = \"trace\"\nlight = \"lambert\"\nshape = \"disk\"\ninner = 6\nouter = 16\nthickness = 1\n";
const std::string dark_ball = "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nposition = [0, 14, 0]\n";

bool is_known(const RayCorrection& correction) {
  return dot(correction.direction, correction.direction) > 0.0 || correction.gamma != 0.0 || correction.x != 0.0;
}

TEST(LampGuesses, AreThereForLitObjectsThatAreSmallAboutAHoleThatSpins) {
  const LitScene scene(lit_ball + lit_disk + dark_ball);
  const std::vector<LampCorrections> guesses = scene.guesses(0.9);
  ASSERT_EQ(guesses.size(), 3U);
  for (int way = 0; way < 2; ++way) {
    EXPECT_TRUE(is_known(guesses[0].by_way[way])) << way;
    EXPECT_FALSE(is_known(guesses[1].by_way[way])) << way;
    EXPECT_FALSE(is_known(guesses[2].by_way[way])) << way;
    EXPECT_FALSE(is_known(scene.guesses(0.0)[0].by_way[way])) << way;
  }
}

TEST(LampGuesses, LeadToTheRaysThatAreFoundFromNothing) {
  const LitScene scene(lit_ball);
  const LampCorrections guess = scene.guesses(0.9).front();
  int compared = 0;
  for (int i = 0; i < 16; ++i) {
    const double azimuth = 0.4 * i;
    const Vector3<double> point = {12.0 + std::cos(azimuth), std::sin(azimuth), 0.06 * i - 0.5};
    for (int way = 0; way < 2; ++way) {
      const auto find = [&](RayCorrection correction, LightRay& ray) {
        return light_ray(Spacetime{0.9}, local_frame(Spacetime{0.9}, point), point, scene.show.light->position, way + 1,
                         LightRayParts::spread, correction, ray);
      };
      LightRay from_guess{};
      LightRay from_nothing{};
      ASSERT_TRUE(find(guess.by_way[way], from_guess) && find({}, from_nothing));
      EXPECT_NEAR(from_guess.spread, from_nothing.spread, 2e-3 * from_nothing.spread) << i << ' ' << way;
      EXPECT_NEAR(dot(from_guess.direction, from_nothing.direction), 1.0, 1e-9) << i << ' ' << way;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 32);
}

}  // namespace
}  // namespace ergodome
