#include "render/frame/frame_images.h"

#include <utility>

#include "render/eyes/view_projection.h"
#include "render/output/stereo_layout.h"
#include "render/picture/cube_pictures.h"

namespace ergodome {

namespace {

//! Cuts the eyes' pictures of a frame into cube faces with a file each: `faces[i][eye]`.
std::vector<std::vector<Picture>> cut_into_faces(const std::vector<Picture>& eyes, const Projection& projection) {
  std::vector<std::vector<Picture>> faces(cube_faces);
  for (const Picture& eye : eyes) {
    auto cut = cube_face_pictures(eye, projection);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      faces[i].push_back(std::move(cut[i]));
    }
  }
  return faces;
}

//! Appends the image or images of one or two eyes.
void add_images(std::vector<Picture> eyes, StereoLayout layout, std::optional<CubeFace> face,
                std::vector<FrameImage>& images) {
  if (eyes.size() < 2) {
    images.push_back({FramePart::whole, std::move(eyes.front()), face});
  } else if (keeps_eyes_apart(layout)) {
    images.push_back({FramePart::left, std::move(eyes[0]), face});
    images.push_back({FramePart::right, std::move(eyes[1]), face});
  } else {
    images.push_back({FramePart::whole, joined_eyes(eyes[0], eyes[1], layout), face});
  }
}

}  // namespace

std::vector<FrameImage> frame_images(std::vector<Picture> eyes, const Projection& projection, const Show& show) {
  std::vector<FrameImage> images;
  if (!has_face_files(show.view)) {
    add_images(std::move(eyes), show.stereo.layout, std::nullopt, images);
    return images;
  }
  std::vector<std::vector<Picture>> faces = cut_into_faces(eyes, projection);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    add_images(std::move(faces[i]), show.stereo.layout, static_cast<CubeFace>(i), images);
  }
  return images;
}

}  // namespace ergodome
