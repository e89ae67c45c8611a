// Checks the layers that a program submits, and logs them.
#include <algorithm>
#include <array>

#include "tests/support/openxr_runtime/runtime_functions.h"
#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

constexpr std::uint32_t most_layers = 16;

const char* view_name(std::uint32_t view, std::uint32_t count) {
  constexpr std::array<const char*, 4> names = {"left", "right", "left-inset", "right-inset"};
  return count == 1 ? "mono" : names.at(view);
}

//! Checks the part of an image that a layer shows.
void check_part(const XrSwapchainSubImage& part, bool must_be_new) {
  const Runtime& state = runtime();
  const Swapchain& swapchain = runtime().swapchains.at(part.swapchain);
  const XrRect2Di& rect = part.imageRect;
  const bool fits = rect.offset.x >= 0 && rect.offset.y >= 0 && rect.extent.width > 0 && rect.extent.height > 0 &&
                    static_cast<std::uint32_t>(rect.offset.x + rect.extent.width) <= swapchain.info.width &&
                    static_cast<std::uint32_t>(rect.offset.y + rect.extent.height) <= swapchain.info.height;
  if (!fits) {
    fail(XR_ERROR_SWAPCHAIN_RECT_INVALID, "rect", "the rectangle exceeds the swapchain");
  }
  if (part.imageArrayIndex >= swapchain.info.arraySize) {
    fail(XR_ERROR_VALIDATION_FAILURE, "array_index", "the image has fewer layers");
  }
  if (!swapchain.released) {
    fail(XR_ERROR_LAYER_INVALID, "image_not_released", "no image of the swapchain was ever released");
  }
  if (must_be_new && swapchain.released_frame != state.frame()) {
    runtime_log().violation("image_not_released", "no image was released in this frame");
  }
}

bool are_equal(const XrPosef& a, const XrPosef& b) {
  return a.position.x == b.position.x && a.position.y == b.position.y && a.position.z == b.position.z &&
         a.orientation.x == b.orientation.x && a.orientation.y == b.orientation.y &&
         a.orientation.z == b.orientation.z && a.orientation.w == b.orientation.w;
}

bool are_equal(const XrFovf& a, const XrFovf& b) {
  return a.angleLeft == b.angleLeft && a.angleRight == b.angleRight && a.angleUp == b.angleUp &&
         a.angleDown == b.angleDown;
}

//! Checks that pose and field of view are those of xrLocateViews for this time in the layer's space.
void check_located(Session& session, XrTime time, XrSpace space, std::uint32_t index,
                   const XrCompositionLayerProjectionView& view) {
  bool was_located = false;
  bool has_pose = false;
  bool has_fov = false;
  const auto [first, last] = session.located.equal_range(time);
  for (auto located = first; located != last; ++located) {
    if (located->second.space != space || index >= located->second.views.size()) {
      continue;
    }
    was_located = true;
    has_pose = has_pose || !located->second.valid || are_equal(located->second.views[index].pose, view.pose);
    has_fov = has_fov || are_equal(located->second.views[index].fov, view.fov);
  }
  if (!was_located) {
    runtime_log().violation("not_located", "xrLocateViews was not called for this time and space");
  } else if (!has_pose) {
    runtime_log().violation("view_pose", "the pose is not that of xrLocateViews: " + json_of(view.pose).dump());
  } else if (!has_fov) {
    runtime_log().violation("view_fov", "the field of view is not that of xrLocateViews: " + json_of(view.fov).dump());
  }
}

Json json_of_part(const XrSwapchainSubImage& part) {
  const XrRect2Di& rect = part.imageRect;
  return {{"swapchain", reinterpret_cast<std::uint64_t>(part.swapchain)},
          {"image", *runtime().swapchains.at(part.swapchain).released},
          {"array_index", part.imageArrayIndex},
          {"rect", {rect.offset.x, rect.offset.y, rect.extent.width, rect.extent.height}}};
}

//! Writes the picture of a view, if the script wants this frame. Returns its file name or nothing.
std::string written_picture(const Session& session, const XrSwapchainSubImage& part, const std::string& name) {
  Runtime& state = runtime();
  if (state.script.pictures_folder.empty() || state.frame() % state.script.picture_every != 0) {
    return {};
  }
  std::string number = std::to_string(state.frame());
  number.insert(0, 5 - std::min<std::size_t>(5, number.size()), '0');
  const std::string file_name = "frame-" + number + "-" + name + ".ppm";
  const ContextScope scope(session);
  if (!write_picture(state.script.pictures_folder + "/" + file_name, state.swapchains.at(part.swapchain), part)) {
    runtime_log().violation("script", "cannot write " + file_name);
  }
  ++state.pictures;
  return file_name;
}

Json check_projection(Session& session, XrTime time, const XrCompositionLayerProjection& layer) {
  const std::uint32_t count = view_count(session.views);
  if (layer.viewCount != count || layer.views == nullptr) {
    fail(XR_ERROR_VALIDATION_FAILURE, "view_count", "a projection layer needs " + std::to_string(count) + " views");
  }
  Json views = Json::array();
  for (std::uint32_t i = 0; i < count; ++i) {
    const XrCompositionLayerProjectionView& view = layer.views[i];
    check_structure(&view, XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
    check_pose(view.pose, "view");
    check_part(view.subImage, true);
    check_located(session, time, layer.space, i, view);
    Json line = {{"eye", view_name(i, count)}, {"pose", json_of(view.pose)}, {"fov", json_of(view.fov)}};
    line.update(json_of_part(view.subImage));
    const std::string picture = written_picture(session, view.subImage, view_name(i, count));
    if (!picture.empty()) {
      line["picture"] = picture;
    }
    views.push_back(line);
  }
  return {{"type", "projection"},
          {"space", space_name(runtime().spaces.at(layer.space))},
          {"flags", layer.layerFlags},
          {"views", views}};
}

Json check_quad(const Session& session, std::size_t index, const XrCompositionLayerQuad& layer) {
  check_pose(layer.pose, "quad");
  check_part(layer.subImage, false);
  Json line = {{"type", "quad"},
               {"space", space_name(runtime().spaces.at(layer.space))},
               {"flags", layer.layerFlags},
               {"eyes", static_cast<int>(layer.eyeVisibility)},
               {"pose", json_of(layer.pose)},
               {"size", {layer.size.width, layer.size.height}}};
  line.update(json_of_part(layer.subImage));
  const std::string picture = written_picture(session, layer.subImage, "quad" + std::to_string(index));
  if (!picture.empty()) {
    line["picture"] = picture;
  }
  return line;
}

}  // namespace

Json check_layers(Session& session, const XrFrameEndInfo& info) {
  Json layers = Json::array();
  if (info.layerCount > most_layers) {
    fail(XR_ERROR_LAYER_LIMIT_EXCEEDED, "layer_count", std::to_string(info.layerCount) + " layers");
  }
  for (std::uint32_t i = 0; i < info.layerCount; ++i) {
    const XrCompositionLayerBaseHeader* const layer = info.layers == nullptr ? nullptr : info.layers[i];
    if (layer == nullptr) {
      fail(XR_ERROR_LAYER_INVALID, "null_pointer", "a layer");
    }
    switch (layer->type) {
      case XR_TYPE_COMPOSITION_LAYER_PROJECTION:
        check_structure(layer, XR_TYPE_COMPOSITION_LAYER_PROJECTION);
        layers.push_back(
            check_projection(session, info.displayTime, *reinterpret_cast<const XrCompositionLayerProjection*>(layer)));
        break;
      case XR_TYPE_COMPOSITION_LAYER_QUAD:
        check_structure(layer, XR_TYPE_COMPOSITION_LAYER_QUAD);
        layers.push_back(check_quad(session, i, *reinterpret_cast<const XrCompositionLayerQuad*>(layer)));
        break;
      default:
        fail(XR_ERROR_LAYER_INVALID, "structure_type", "a layer of type " + std::to_string(layer->type));
    }
  }
  return layers;
}

}  // namespace ergodome::openxr_test
