#include "render/passes/objects/object_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "render/passes/objects/object_meshes.h"
#include "render/passes/objects/object_reach.h"
#include "render/passes/stars/drawing/picture_regions.h"

namespace ergodome {

namespace {

//! Composites a tile, stored with its bottom row first, over a picture. `adds_opacity`: also over its
//! fourth channel; see Picture::stars.
void lay_over(const std::vector<float>& drawn, const PictureTile& tile, const PixelCell& cell,
              const Projection& projection, bool adds_opacity, float* rgba) {
  parallel_for(tile.height_px, 16, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      const int y = cell.top_px + tile.top_px + row;
      const float* from = drawn.data() + 4 * static_cast<long>(tile.height_px - 1 - row) * tile.width_px;
      float* to = rgba + 4 * (static_cast<long>(y) * projection.width_px + cell.left_px + tile.left_px);
      for (int i = 0; i < tile.width_px; ++i, from += 4, to += 4) {
        if (!(from[3] > 0.0F)) {
          continue;
        }
        const double x = cell.left_px + tile.left_px + i + 0.5;
        const auto inside = static_cast<float>(image_coverage(projection, x, y + 0.5));
        for (int k = 0; k < 3; ++k) {
          to[k] = (1.0F - from[3]) * to[k] + inside * from[k];
        }
        if (adds_opacity) {
          to[3] = (1.0F - from[3]) * to[3] + inside * from[3];
        }
      }
    }
  });
}

//! The polygons of one picture.
class ObjectPassDrawing : public PassDrawing {
 public:
  ObjectPassDrawing(ObjectPass& pass, const EyePicture& picture) : pass_(pass), picture_(picture) {}

  void finish(Picture& picture) override {
    const PictureSettings& settings = picture_.settings;
    pass_.draw(picture_.eye, picture_.projection, settings.time_s, picture.rgba.data(), settings.omni_view.get(),
               settings.shared ? settings.shared->offset : 0.0, settings.stars_apart != nullptr);
  }

 private:
  ObjectPass& pass_;
  const EyePicture& picture_;
};

}  // namespace

std::unique_ptr<Pass> make_polygon_pass(const PassInput& input) {
  return has_objects(input.show, ObjectMethod::polygon) ? std::make_unique<ObjectPass>(input.show) : nullptr;
}

std::unique_ptr<PassDrawing> ObjectPass::prepare(const EyePicture& picture) {
  return std::make_unique<ObjectPassDrawing>(*this, picture);
}

long ObjectPass::mesh_bytes(const Show& show) {
  long bytes = 0;
  for (const TriangleMesh& mesh : load_meshes(show).meshes) {
    bytes += mesh.bytes();
  }
  return bytes;
}

ObjectPass::ObjectPass(const Show& show) : show_name_(show.name), objects_(show.objects), light_(show.light) {
  static WorkCounter counter("load_meshes");
  const WorkScope scope(counter, static_cast<long>(objects_.size()));
  ObjectMeshes loaded = load_meshes(show);
  meshes_ = std::move(loaded.meshes);
  for (const TriangleMesh& mesh : meshes_) {
    mesh_radii_.push_back(radius_of(mesh));
    count_work("buffer: meshes", mesh.bytes());
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    placed_.push_back({&objects_[i], loaded.mesh_of[i], {}});
    outlines_.push_back(outline_of(meshes_[loaded.mesh_of[i]]));
  }
  gl_.run([this] { drawing_ = std::make_unique<ObjectDrawing>(meshes_); });
}

ObjectPass::~ObjectPass() {
  gl_.run([this] { drawing_.reset(); });
}

long ObjectPass::triangle_count() const {
  long count = 0;
  for (const PlacedObject& object : placed_) {
    count += meshes_[object.mesh].triangle_count();
  }
  return count;
}

RadialRange ObjectPass::place_objects(double time_s) {
  RadialRange all{farthest_of_objects, nearest_of_objects};
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    PlacedObject& object = placed_[i];
    const ObjectPlacement placement = placement_at(*object.settings, time_s);
    if (ranges_.size() <= i || !(placement == object.placement)) {
      const double size = object.settings->size;
      ranges_.resize(std::max(ranges_.size(), i + 1));
      ranges_[i] = radial_range(meshes_[object.mesh], placement, size, size * mesh_radii_[object.mesh]);
      object.placement = placement;
    }
    if (!(ranges_[i].nearest >= nearest_of_objects && ranges_[i].farthest <= farthest_of_objects)) {
      throw Error(fmt::format("{}.toml: objects[{}]", show_name_, i),
                  fmt::format("extends from r = {:.6g} M to r = {:.6g} M at {:.6g} s", ranges_[i].nearest,
                              ranges_[i].farthest, time_s),
                  fmt::format("keep it between {} M and {} M from the center of the hole", nearest_of_objects,
                              farthest_of_objects));
    }
    all.nearest = std::min(all.nearest, ranges_[i].nearest);
    all.farthest = std::max(all.farthest, ranges_[i].farthest);
  }
  return all;
}

void ObjectPass::draw(const EyeCamera& eye, const Projection& projection, double time_s, float* rgba,
                      const OmniView* omni, double beside, bool adds_opacity) {
  static WorkCounter counter("draw_objects");
  const WorkScope scope(counter, static_cast<long>(projection.width_px) * projection.height_px);
  const RadialRange range = place_objects(time_s);
  const ObjectDrawing::Scene scene{object_view(eye), omni, beside, placed_, light_, range};
  std::vector<float> drawn;
  for (const PictureRegion& region : picture_regions(projection)) {
    const Projection& own = region.projection;
    for (int top = 0; top < own.height_px; top += ObjectTarget::longest_side_px) {
      for (int left = 0; left < own.width_px; left += ObjectTarget::longest_side_px) {
        const PictureTile tile{left, top, std::min(ObjectTarget::longest_side_px, own.width_px - left),
                               std::min(ObjectTarget::longest_side_px, own.height_px - top)};
        gl_.run([&] { drawing_->draw(scene, own, tile, drawn); });
        lay_over(drawn, tile, region.cell, projection, adds_opacity, rgba);
      }
    }
  }
}

}  // namespace ergodome
