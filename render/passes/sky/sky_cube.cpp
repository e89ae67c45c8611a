#include "render/passes/sky/sky_cube.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "kernels/core/lanes.h"
#include "kernels/core/pack.h"
#include "kernels/launch/parallel_for.h"
#include "render/backend/cached_memory.h"
#include "render/passes/sky/image_rows.h"

namespace ergodome {

namespace {

constexpr int largest_face = 2048;

int face_size_for(int map_width) {
  int size = 1;
  while (size < map_width / 4 && size < largest_face) {
    size *= 2;
  }
  return size;
}

glm::dvec3 texel_direction(int face, int size, double x, double y) {
  const Vector3<double> d = cube_direction(face, 2.0 * x / size - 1.0, 2.0 * y / size - 1.0);
  return glm::normalize(glm::dvec3(d.x, d.y, d.z));
}

//! Returns the coordinates of sample points along the side of a cube face, `per_texel` for each
//! texel, evenly spaced in the warped coordinates of texels. Inverts the warp numerically, once for
//! all rows.
std::vector<double> side_points(int size, int per_texel) {
  std::vector<double> points(static_cast<std::size_t>(size) * static_cast<std::size_t>(per_texel));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = unwarped(2.0 * ((static_cast<double>(i) + 0.5) / per_texel) / size - 1.0);
  }
  return points;
}

//! Relative solid angles of the texels of a face: the solid angle per area of the cube's surface,
//! times the derivatives of the warp.
class TexelWeights {
 public:
  explicit TexelWeights(int size) : middle_(side_points(size, 1)), width_(middle_.size()) {
    const double h = 1.0 / size;
    for (std::size_t i = 0; i < width_.size(); ++i) {
      const double u = 2.0 * (static_cast<double>(i) + 0.5) * h - 1.0;
      width_[i] = unwarped(u + h) - unwarped(u - h);
    }
  }

  //! Computes the weights of a row of texels, the same on all faces.
  void read_row(int y, std::vector<double>& weights) const {
    const auto j = static_cast<std::size_t>(y);
    weights.resize(width_.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double square = 1.0 + middle_[i] * middle_[i] + middle_[j] * middle_[j];
      weights[i] = width_[i] * width_[j] / (square * std::sqrt(square));
    }
  }

 private:
  std::vector<double> middle_;
  std::vector<double> width_;
};

//! Sample positions, four per texel to avoid aliasing of a source with the same resolution. A row
//! of texels has two rows of samples.
class SampleRows {
 public:
  explicit SampleRows(int face_size)
      : positions_(side_points(face_size, 2)), s_(positions_.begin(), positions_.end()) {}

  [[nodiscard]] DirectionRow row(int face, int y) const {
    const double t = positions_[static_cast<std::size_t>(y)];
    const auto [x0, y0, z0] = cube_point(face, 0.0, t);
    const auto [x1, y1, z1] = cube_point(face, 1.0, t);
    return {{x0, y0, z0}, {x1 - x0, y1 - y0, z1 - z0}, s_};
  }

 private:
  std::vector<double> positions_;
  std::vector<float> s_;
};

//! Returns the number of texels of a cube map with all levels and borders.
std::size_t texel_count(int face_size) {
  std::size_t texels = 0;
  for (auto size = static_cast<std::size_t>(face_size); size >= 1; size /= 2) {
    texels += 6 * (size + 2) * (size + 2);
  }
  return texels;
}

//! Returns CubeMap::scale, given the brightest light.
float scale_for(float brightest) {
  // A smaller scale would be subnormal.
  return brightest > 0.0F ? std::ldexp(1.0F, std::max(std::ilogb(brightest) - 14, -126)) : 1.0F;
}

//! The faces and mip levels in host memory while they are built.
class Pyramid {
 public:
  //! `texels`: uninitialized memory for texel_count(face_size) texels. `brightest`: upper limit of
  //! the light.
  Pyramid(int face_size, float brightest, HalfQuad* texels) : texels_(texels) {
    map_.scale = scale_for(brightest);
    map_.face_size = face_size;
    long offset = 0;
    for (int size = face_size; size >= 1; size /= 2) {
      map_.level_offset[map_.level_count++] = offset;
      offset += 6L * (size + 2) * (size + 2);
    }
    map_.texels = texels_;
  }

  [[nodiscard]] int size(int level) const { return map_.face_size >> level; }
  [[nodiscard]] const CubeMap& map() const { return map_; }

  [[nodiscard]] glm::vec4 texel(int level, int face, int x, int y) const {
    const Quad light = load_quad(texels_ + texel_index(map_, level, face, x, y));
    return map_.scale * glm::vec4(quad_part(light, 0), quad_part(light, 1), quad_part(light, 2), quad_part(light, 3));
  }

  void set(int level, int face, int x, int y, const glm::vec4& light) {
    HalfQuad& to = texels_[texel_index(map_, level, face, x, y)];
    for (int i = 0; i < 4; ++i) {
      to.part[i] = half(light[i] / map_.scale).bits();
    }
  }

  //! Computes a level; each texel is the mean of the four finer ones, weighted by solid angle.
  void reduce(int level) {
    const TexelWeights weights(size(level - 1));
    parallel_for(size(level), 8, [&](int begin, int end) {
      std::vector<double> rows[2];
      for (int y = begin; y < end; ++y) {
        weights.read_row(2 * y, rows[0]);
        weights.read_row(2 * y + 1, rows[1]);
        for (int face = 0; face < 6; ++face) {
          for (int x = 0; x < size(level); ++x) {
            reduce_texel(level, face, x, y, rows);
          }
        }
      }
    });
  }

  //! Fills the border of a level with texels of the adjacent faces.
  void fill_border(int level) {
    const int n = size(level);
    for (int face = 0; face < 6; ++face) {
      for (int i = -1; i <= n; ++i) {
        for (const auto& [x, y] : {std::pair{i, -1}, {i, n}, {-1, i}, {n, i}}) {
          set(level, face, x, y, seen_from(level, texel_direction(face, n, x + 0.5, y + 0.5)));
        }
      }
    }
  }

 private:
  //! `weights`: those of the two rows of finer texels.
  void reduce_texel(int level, int face, int x, int y, const std::vector<double> (&weights)[2]) {
    glm::dvec4 sum(0.0);
    double all = 0.0;
    for (int i = 0; i < 4; ++i) {
      const int fine_x = 2 * x + i % 2;
      const double weight = weights[i / 2][static_cast<std::size_t>(fine_x)];
      sum += weight * glm::dvec4(texel(level - 1, face, fine_x, 2 * y + i / 2));
      all += weight;
    }
    set(level, face, x, y, glm::vec4(sum / all));
  }

  //! Samples a level bilinearly within one face; does not need borders.
  glm::vec4 seen_from(int level, const glm::dvec3& d) {
    const int n = size(level);
    const CubePosition<float> position =
        cube_position<float>({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
    const int its_face = static_cast<int>(position.face);
    const float last = static_cast<float>(n - 1);
    const float x = std::clamp((position.x + 1.0F) * 0.5F * static_cast<float>(n) - 0.5F, 0.0F, last);
    const float y = std::clamp((position.y + 1.0F) * 0.5F * static_cast<float>(n) - 0.5F, 0.0F, last);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const auto at = [&](int dx, int dy) {
      return texel(level, its_face, std::min(x0 + dx, n - 1), std::min(y0 + dy, n - 1));
    };
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
  }

  CubeMap map_{};
  HalfQuad* texels_;
};

//! Returns the maximum of brightest_of_row(0), brightest_of_row(1), ..., computed by all threads.
float brightest_of(int rows, const std::function<float(int)>& brightest_of_row) {
  std::vector<float> maxima(static_cast<std::size_t>(rows));
  parallel_for(rows, 8, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      maxima[static_cast<std::size_t>(row)] = brightest_of_row(row);
    }
  });
  return std::ranges::max(maxima);
}

float brightest_of(const EnvironmentImage& image) {
  return brightest_of(image.height, [&](int row) {
    using Register = Pack<float, 4>;
    const int count = 3 * image.width;
    const float* const light = image.rgb.data() + static_cast<std::ptrdiff_t>(row) * count;
    Register brightest(0.0F);
    for (int i = 0; i < count; i += 4) {
      brightest = maximum(brightest, load_lanes<Register>(light, i, count));
    }
    return std::max({lane(brightest, 0), lane(brightest, 1), lane(brightest, 2), lane(brightest, 3)});
  });
}

}  // namespace

SkyCube::SkyCube(Backend backend, const EnvironmentImage& image, const glm::dmat3& sky_from_map,
                 const TemperatureFit* fit, const char* name) {
  const ImageRows rows(image, glm::transpose(sky_from_map));
  build(
      backend, face_size_for(image.width),
      [&](const DirectionRow& row, std::span<glm::vec3> light) { rows.read(row, light); }, brightest_of(image), fit,
      name);
}

SkyCube::SkyCube(Backend backend, int face_size, const std::function<glm::vec3(const glm::dvec3&)>& light,
                 const TemperatureFit* fit) {
  const auto light_of_row = [&](const DirectionRow& row, std::span<glm::vec3> lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
      lights[i] = light(glm::normalize(row.base + static_cast<double>(row.s[i]) * row.along));
    }
  };
  const SampleRows samples(face_size);
  const float brightest = brightest_of(12 * face_size, [&](int row) {
    std::vector<glm::vec3> lights(2 * static_cast<std::size_t>(face_size));
    light_of_row(samples.row(row / (2 * face_size), row % (2 * face_size)), lights);
    float of_row = 0.0F;
    for (const glm::vec3& each : lights) {
      of_row = std::max({of_row, each.x, each.y, each.z});
    }
    return of_row;
  });
  build(backend, face_size, light_of_row, brightest, fit, "sky map");
}

void SkyCube::build(Backend backend, int face_size, const LightOfRow& light, float brightest, const TemperatureFit* fit,
                    const char* name) {
  const std::size_t texels = texel_count(face_size);
  texels_ = Buffer<HalfQuad>(backend, texels, name);
  // The CPU builds the map in its own memory, in that of the buffer if possible.
  std::vector<HalfQuad, UnfilledAllocator<HalfQuad>> host(backend == Backend::cpu ? 0 : texels);
  Pyramid pyramid(face_size, brightest, host.empty() ? texels_.data() : host.data());
  const SampleRows samples(face_size);
  parallel_for(6 * face_size, 8, [&](int begin, int end) {
    std::vector<glm::vec3> upper(2 * static_cast<std::size_t>(face_size));
    std::vector<glm::vec3> lower(upper.size());
    for (int row = begin; row < end; ++row) {
      const int face = row / face_size;
      const int y = row % face_size;
      light(samples.row(face, 2 * y), upper);
      light(samples.row(face, 2 * y + 1), lower);
      for (int x = 0; x < face_size; ++x) {
        const std::size_t i = 2 * static_cast<std::size_t>(x);
        const glm::vec3 mean = 0.25F * (upper[i] + upper[i + 1] + lower[i] + lower[i + 1]);
        pyramid.set(0, face, x, y, glm::vec4(mean, fit != nullptr ? fit->weighted_log_temperature(mean) : 0.0F));
      }
    }
  });
  for (int level = 1; level < pyramid.map().level_count; ++level) {
    pyramid.reduce(level);
  }
  for (int level = 0; level < pyramid.map().level_count; ++level) {
    pyramid.fill_border(level);
  }
  map_ = pyramid.map();
  texels_.write(host.data(), host.size());
}

std::size_t SkyCube::bytes_for(int map_width) { return sizeof(HalfQuad) * texel_count(face_size_for(map_width)); }

CubeMap SkyCube::view() const {
  CubeMap map = map_;
  map.texels = texels_.data();
  return map;
}

}  // namespace ergodome
