#include "render/passes/objects/polygons/connection_textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "content/show/object_settings.h"
#include "kernels/launch/work_counter.h"
#include "render/published/connection_table.h"

namespace ergodome {

namespace {

//! Maximum number of cached tables: for two eyes and a light.
constexpr std::size_t max_tables = 3;

}  // namespace

RadialRange table_range(const RadialRange& range) {
  RadialRange wider = {nearest_of_objects, std::exp2(std::ceil(std::log2(range.farthest * (1.0 + 1e-6))))};
  for (const double r : {2.5, 3.0, 4.0, 6.0}) {
    wider.nearest = range.nearest >= r * (1.0 + 1e-6) ? r : wider.nearest;
  }
  return wider;
}

ConnectionTexture::ConnectionTexture(const RadialRange& observers, const RadialRange& range, int orders)
    : observers_(observers), range_(range) {
  ConnectionTableSettings settings;
  settings.r_nearest = range.nearest;
  settings.r_farthest = range.farthest;
  settings.r_observer_nearest = observers.nearest;
  settings.r_observer_farthest = observers.farthest;
  settings.layers = observers.farthest > observers.nearest ? 4 : 1;
  settings.orders = orders;
  const ConnectionTable table(settings);
  const ConnectionView view = table.view();
  grid_ = view.grid;
  const int width = grid_.columns + 1;
  count_work("buffer: connecting rays", static_cast<long>(sizeof(ConnectionNode)) * width * grid_.rows * grid_.layers);
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &texture_);
  glTextureStorage3D(texture_, 1, GL_RGBA32F, width, grid_.rows, grid_.layers);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage3D(texture_, 0, 0, 0, 0, width, grid_.rows, grid_.layers, GL_RGBA, GL_FLOAT, view.nodes);
  glTextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

ConnectionTexture::~ConnectionTexture() { glDeleteTextures(1, &texture_); }

bool ConnectionTexture::serves(const RadialRange& observers, const RadialRange& range, int orders) const {
  return observers == observers_ && range == range_ && orders == grid_.orders;
}

const ConnectionTexture& ConnectionTextures::table(const RadialRange& observers, const RadialRange& points,
                                                   int orders) {
  const RadialRange range = table_range(points);
  const auto found =
      std::ranges::find_if(tables_, [&](const auto& each) { return each->serves(observers, range, orders); });
  if (found != tables_.end()) {
    std::rotate(found, found + 1, tables_.end());
    return *tables_.back();
  }
  if (tables_.size() == max_tables) {
    tables_.erase(tables_.begin());
  }
  tables_.push_back(std::make_unique<ConnectionTexture>(observers, range, orders));
  return *tables_.back();
}

}  // namespace ergodome
