#include "render/passes/shells/shell_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <glm/matrix.hpp>

#include "content/show/show_errors.h"
#include "content/sky/environment_image.h"
#include "content/sky/sky_map.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Returns the rotation that maps an image onto a shell like a map onto a globe: φ = 0 is in the
//! middle of the image and φ increases to the right as seen from outside; θ = 0 is at the top.
glm::dmat3 shell_from_map() {
  const glm::dvec3 middle = direction_from_map(0.5, 0.5);
  const glm::dvec3 quarter = direction_from_map(0.75, 0.5);
  return glm::transpose(glm::dmat3(middle, quarter, glm::dvec3(0.0, 0.0, 1.0)));
}

std::unique_ptr<SkyCube> load_texture(const Show& show, std::size_t shell, Backend backend, RepairedTexels& repaired) {
  const std::string& texture = show.shells[shell].texture;
  if (texture.empty()) {
    return nullptr;
  }
  const std::string key = fmt::format("shells[{}].texture", shell);
  const EnvironmentImage image = read_named(show, key, texture, [](const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(layered_file(path).path, problem)) {
      throw Error(path.string(), "is not a readable file",
                  "name an equirectangular image; its path is relative to the show's folder");
    }
    return read_environment_image(path);
  });
  repaired = image.repaired;
  return std::make_unique<SkyCube>(backend, image, shell_from_map(), nullptr, "shell texture");
}

Vector3<float> color_of(const std::array<double, 3>& color, double factor) {
  return {static_cast<float>(color[0] * factor), static_cast<float>(color[1] * factor),
          static_cast<float>(color[2] * factor)};
}

ShellAppearance appearance_of(const ShellSettings& shell, const SkyCube* texture) {
  return {static_cast<float>(shell.radius),
          static_cast<float>(shell.spacing_deg * one_degree),
          static_cast<float>(shell.line_width_deg * one_degree),
          static_cast<float>(shell.line_opacity),
          static_cast<float>(shell.fill_opacity),
          texture != nullptr,
          color_of(shell.line_color, shell.exposure),
          color_of(shell.fill_color, shell.exposure),
          texture != nullptr ? texture->view() : CubeMap{}};
}

}  // namespace

ShellPass::ShellPass(const Show& show, Backend backend)
    : u_(backend, show.shells.size(), "shells"), appearances_(backend, show.shells.size(), "shells") {
  for (std::size_t i = 0; i < show.shells.size(); ++i) {
    textures_.push_back(load_texture(show, i, backend, repaired_.emplace_back()));
  }
  set_numbers(show);
}

void ShellPass::set_numbers(const Show& show) {
  shifted_ = show.effects.redshift;
  if (shells_ == show.shells) {
    return;
  }
  shells_ = show.shells;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < shells_.size(); ++i) {
    if (is_visible(shells_[i])) {
      order.push_back(i);
    }
  }
  // Among shells with the same radius, the first one is outermost.
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return shells_[i].radius; });
  std::vector<float> u;
  std::vector<ShellAppearance> appearances;
  for (const std::size_t i : order) {
    u.push_back(static_cast<float>(1.0 / shells_[i].radius));
    appearances.push_back(appearance_of(shells_[i], textures_[i].get()));
  }
  u_.write(u.data(), u.size());
  appearances_.write(appearances.data(), appearances.size());
  count_ = static_cast<int>(order.size());
}

double ShellPass::outermost_r() const {
  double r = 0.0;
  for (const ShellSettings& shell : shells_) {
    r = std::max(r, is_visible(shell) ? shell.radius : 0.0);
  }
  return r;
}

ShellTable ShellPass::table() const { return {u_.data(), appearances_.data(), count_, shifted_}; }

bool same_shell_textures(const Show& a, const Show& b) {
  return a.folder == b.folder &&
         std::ranges::equal(a.shells, b.shells, {}, &ShellSettings::texture, &ShellSettings::texture);
}

}  // namespace ergodome
