#include "render/passes/sky/image_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace ergodome {

namespace {

//! Returns the coefficients of u, u^3, u^5, ... of the arc tangent in [-1, 1], from its Chebyshev
//! series arctan u = 2 Σ (-1)^k q^(2k+1) / (2k+1) T_(2k+1)(u), q = √2 - 1, up to T_17. The omitted
//! terms are below 7e-9.
constexpr std::array<float, 9> arc_tangent_factors() {
  constexpr std::size_t terms = 9;
  constexpr double q = std::numbers::sqrt2 - 1.0;
  // Coefficients of T_n in powers of u, by T_(n+1) = 2 u T_n - T_(n-1).
  std::array<double, 2 * terms> before{1.0};
  std::array<double, 2 * terms> now{0.0, 1.0};
  std::array<double, 2 * terms> sum{};
  double weight = 2.0 * q;
  for (std::size_t n = 1; n < 2 * terms; ++n) {
    for (std::size_t power = 0; n % 2 == 1 && power < sum.size(); ++power) {
      sum[power] += weight / static_cast<double>(n) * now[power];
    }
    weight *= n % 2 == 1 ? -q * q : 1.0;
    std::array<double, 2 * terms> next{};
    for (std::size_t power = 0; power < next.size(); ++power) {
      next[power] = (power > 0 ? 2.0 * now[power - 1] : 0.0) - before[power];
    }
    before = now;
    now = next;
  }
  std::array<float, terms> factors{};
  for (std::size_t k = 0; k < terms; ++k) {
    factors[k] = static_cast<float>(sum[2 * k + 1]);
  }
  return factors;
}

//! Returns the same as `std::atan2`, without branches, within 3e-7. Ignores the sign of zeros; 0
//! for two zeros.
inline float angle_of(float y, float x) {
  constexpr auto factors = arc_tangent_factors();
  const float across = std::abs(x);
  const float up = std::abs(y);
  const float greater = across > up ? across : up;
  const float less = across > up ? up : across;
  const float u = less / (greater > 1e-30F ? greater : 1e-30F);
  const float square = u * u;
  float sum = factors.back();
  for (std::size_t k = factors.size() - 1; k-- > 0;) {
    sum = sum * square + factors[k];
  }
  sum *= u;
  // Selects summands, because a compiler would generate branches for a selection between sums.
  constexpr auto pi = std::numbers::pi_v<float>;
  sum = (across > up ? 0.0F : 0.5F * pi) + (across > up ? sum : -sum);
  sum = (x < 0.0F ? pi : 0.0F) + (x < 0.0F ? -sum : sum);
  return std::copysign(sum, y);
}

}  // namespace

void positions_in_map(const DirectionRow& row, std::span<float> x, std::span<float> y) {
  const glm::vec3 base(row.base);
  const glm::vec3 along(row.along);
  constexpr float per_radian = 0.5F * std::numbers::inv_pi_v<float>;
  for (std::size_t i = 0; i < row.s.size(); ++i) {
    const float s = row.s[i];
    const float ahead = base.x + s * along.x;
    const float aside = base.y + s * along.y;
    const float above = base.z + s * along.z;
    x[i] = 0.25F - per_radian * angle_of(aside, ahead);
    y[i] = 0.5F - 2.0F * per_radian * angle_of(above, std::sqrt(ahead * ahead + aside * aside));
  }
}

namespace {

//! The three colors of a texel, and a fourth float without meaning.
using TexelVector __attribute__((vector_size(16))) = float;

//! Returns a + part (b - a) as glm::mix() does.
TexelVector mixed(const TexelVector& a, const TexelVector& b, float part) { return a * (1.0F - part) + b * part; }

//! Interpolates between a texel and its right neighbor.
TexelVector between_neighbors(const float* texel, float right) {
  TexelVector first;
  TexelVector second;
  std::memcpy(&first, texel, sizeof first);
  // Starts with the last color of the first texel, so that it ends with the neighbor.
  std::memcpy(&second, texel + 2, sizeof second);
  return mixed(first, __builtin_shufflevector(second, second, 1, 2, 3, 0), right);
}

//! Interpolates between texels that are not neighbors in memory.
TexelVector between_texels_apart(const float* a, const float* b, float right) {
  return mixed(TexelVector{a[0], a[1], a[2]}, TexelVector{b[0], b[1], b[2]}, right);
}

}  // namespace

glm::vec3 ImageRows::between_texels(float x, float y) const {
  // `std::floor` is a function call if the compiler targets old CPUs.
  const auto below = [](float value) { return static_cast<int>(value) - (value < 0.0F ? 1 : 0); };
  const int left = below(x);
  const int upper = below(y);
  const float right = x - static_cast<float>(left);
  const float lower = y - static_cast<float>(upper);
  const auto line = [&](int j) {
    return image_.rgb.data() +
           3 * static_cast<std::size_t>(std::clamp(j, 0, image_.height - 1)) * static_cast<std::size_t>(image_.width);
  };
  const auto across = [&](const float* texels) {
    const std::size_t column = 3 * static_cast<std::size_t>(left < 0 ? left + image_.width : left);
    return left == -1 ? between_texels_apart(texels + column, texels, right)
                      : between_neighbors(texels + column, right);
  };
  const TexelVector light = mixed(across(line(upper)), across(line(upper + 1)), lower);
  return {light[0], light[1], light[2]};
}

void ImageRows::read(const DirectionRow& row, std::span<glm::vec3> light) const {
  constexpr std::size_t at_once = 256;
  std::array<float, at_once> x;
  std::array<float, at_once> y;
  for (std::size_t begin = 0; begin < row.s.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, row.s.size() - begin);
    positions_in_map({map_from_sky_ * row.base, map_from_sky_ * row.along, row.s.subspan(begin, count)},
                     std::span(x).first(count), std::span(y).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      light[begin + i] = between_texels(x[i] * static_cast<float>(image_.width) - 0.5F,
                                        y[i] * static_cast<float>(image_.height) - 0.5F);
    }
  }
}

}  // namespace ergodome
