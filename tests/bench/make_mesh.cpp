#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "kernels/core/angles.h"

// Writes a mesh of any size, to measure the cost of large meshes:
//
// ergodome_make_mesh TRIANGLES FILE.obj|FILE.glb
//
// The mesh is a closed ball of radius 1 with bumps. It has no normals, so the reader has to compute
// them.

namespace {

using ergodome::pi;

struct Ball {
  std::uint32_t segments, rings;

  [[nodiscard]] std::uint32_t vertex_count() const { return segments * (rings - 1) + 2; }

  //! Writes the position of corner `at` to `p`. Corner 0 is the north pole; then follow the rings
  //! from north to south, and the south pole.
  void place(std::uint32_t at, float (&p)[3]) const {
    const bool pole = at == 0 || at + 1 == vertex_count();
    const std::uint32_t ring = at == 0 ? 0 : at + 1 == vertex_count() ? rings : (at - 1) / segments + 1;
    const std::uint32_t segment = pole ? 0 : (at - 1) % segments;
    const double theta = pi * ring / rings;
    const double phi = 2.0 * pi * segment / segments;
    const double r = 1.0 + 0.03 * std::sin(9.0 * theta) * std::sin(theta) * std::sin(7.0 * phi);
    p[0] = static_cast<float>(r * std::sin(theta) * std::cos(phi));
    p[1] = static_cast<float>(r * std::sin(theta) * std::sin(phi));
    p[2] = static_cast<float>(r * std::cos(theta));
  }

  //! Calls each(a, b, c) for all triangles, counterclockwise as seen from outside.
  template <class Each>
  void triangles(const Each& each) const {
    const auto corner = [&](std::uint32_t ring, std::uint32_t segment) {
      return ring == 0 ? 0 : ring == rings ? vertex_count() - 1 : 1 + (ring - 1) * segments + segment % segments;
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
      for (std::uint32_t segment = 0; segment < segments; ++segment) {
        if (ring + 1 < rings) {
          each(corner(ring, segment), corner(ring + 1, segment), corner(ring + 1, segment + 1));
        }
        if (ring > 0) {
          each(corner(ring, segment), corner(ring + 1, segment + 1), corner(ring, segment + 1));
        }
      }
    }
  }

  [[nodiscard]] std::uint32_t triangle_count() const { return 2 * segments * (rings - 1); }
};

void write_obj(const Ball& ball, std::FILE* file) {
  for (std::uint32_t i = 0; i < ball.vertex_count(); ++i) {
    float p[3];
    ball.place(i, p);
    std::fprintf(file, "v %.7g %.7g %.7g\n", static_cast<double>(p[0]), static_cast<double>(p[1]),
                 static_cast<double>(p[2]));
  }
  ball.triangles([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::fprintf(file, "f %u %u %u\n", a + 1, b + 1, c + 1);
  });
}

void write_word(std::FILE* file, std::uint32_t word) { std::fwrite(&word, sizeof word, 1, file); }

void write_glb(const Ball& ball, std::FILE* file) {
  const std::uint32_t vertex_bytes = 12 * ball.vertex_count();
  const std::uint32_t index_bytes = 12 * ball.triangle_count();
  std::string json =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":)" +
      std::to_string(vertex_bytes + index_bytes) + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" +
      std::to_string(vertex_bytes) + R"(},{"buffer":0,"byteOffset":)" + std::to_string(vertex_bytes) +
      R"(,"byteLength":)" + std::to_string(index_bytes) +
      R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","min":[-2,-2,-2],"max":[2,2,2],"count":)" +
      std::to_string(ball.vertex_count()) + R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" +
      std::to_string(3 * ball.triangle_count()) + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto json_bytes = static_cast<std::uint32_t>(json.size());
  std::fwrite("glTF", 4, 1, file);
  write_word(file, 2);
  write_word(file, 12 + 8 + json_bytes + 8 + vertex_bytes + index_bytes);
  write_word(file, json_bytes);
  std::fwrite("JSON", 4, 1, file);
  std::fwrite(json.data(), json.size(), 1, file);
  write_word(file, vertex_bytes + index_bytes);
  std::fwrite("BIN\0", 4, 1, file);
  for (std::uint32_t i = 0; i < ball.vertex_count(); ++i) {
    float p[3];
    ball.place(i, p);
    std::fwrite(p, sizeof p, 1, file);
  }
  ball.triangles([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t corners[3] = {a, b, c};
    std::fwrite(corners, sizeof corners, 1, file);
  });
}

}  // namespace

int main(int argc, char** argv) {
  const double wanted = argc == 3 ? std::atof(argv[1]) : 0.0;
  const std::string name = argc == 3 ? argv[2] : "";
  const bool obj = name.ends_with(".obj");
  if (!(wanted >= 100.0 && wanted <= 1e8) || !(obj || name.ends_with(".glb"))) {
    std::fprintf(stderr, "usage: ergodome_make_mesh TRIANGLES FILE.obj|FILE.glb   (100 to 100000000)\n");
    return 2;
  }
  const auto rings = static_cast<std::uint32_t>(std::ceil(0.5 + std::sqrt(0.25 * wanted + 0.25)));
  const Ball ball = {2 * rings, rings};
  std::FILE* const file = std::fopen(name.c_str(), "wb");
  if (file == nullptr) {
    std::fprintf(stderr, "ergodome_make_mesh: %s cannot be written\n", name.c_str());
    return 1;
  }
  (obj ? write_obj : write_glb)(ball, file);
  const bool failed = std::ferror(file) != 0;
  if (std::fclose(file) != 0 || failed) {
    std::fprintf(stderr, "ergodome_make_mesh: %s: the disk is full\n", name.c_str());
    return 1;
  }
  std::printf("%s: %u triangles\n", name.c_str(), ball.triangle_count());
  return 0;
}
