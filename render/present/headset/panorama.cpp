#include "render/present/headset/panorama.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "kernels/core/error.h"
#include "kernels/projection/cube_faces.h"
#include "render/present/cuda_interop.h"

namespace ergodome {

struct Panorama::State {
  GLuint cubes[2] = {0, 0};
  PanoramaStars stars[2];
  GLuint strip = 0;  //!< receives pictures from CUDA
  std::unique_ptr<CudaTextureLink> link;
  int face_px = 0;
  int eyes = 0;
  Tone tone;
  bool heat_map = false;
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};

  void resize(int width_px, int height_px, int eye_count);
  void copy_strip(GLuint cube) const;
  void set_stars(int eye, const StarLights* lights);
};

namespace {

GLuint new_cube(int face_px) {
  GLuint cube = 0;
  glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
  glTextureStorage2D(cube, 1, GL_RGBA32F, face_px, face_px);
  glTextureParameteri(cube, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(cube, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return cube;
}

void upload_faces(GLuint cube, int face_px, const float* strip_rgba) {
  glPixelStorei(GL_UNPACK_ROW_LENGTH, cube_faces * face_px);
  for (int face = 0; face < cube_faces; ++face) {
    const std::ptrdiff_t left = 4L * face * face_px;
    glTextureSubImage3D(cube, 0, 0, 0, face, face_px, face_px, 1, GL_RGBA, GL_FLOAT, strip_rgba + left);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

}  // namespace

void Panorama::State::resize(int width_px, int height_px, int eye_count) {
  if (height_px < 1 || width_px != cube_faces * height_px) {
    throw Error("headset", fmt::format("a picture of {} x {} px is not a strip of six faces", width_px, height_px),
                "report this error");
  }
  if (face_px == height_px && eyes == eye_count) {
    return;
  }
  link.reset();
  glDeleteTextures(1, &strip);
  glDeleteTextures(2, cubes);
  strip = cubes[0] = cubes[1] = 0;
  for (int eye = 0; eye < eye_count; ++eye) {
    cubes[eye] = new_cube(height_px);
  }
  face_px = height_px;
  eyes = eye_count;
}

void Panorama::State::copy_strip(GLuint cube) const {
  for (int face = 0; face < cube_faces; ++face) {
    glCopyImageSubData(strip, GL_TEXTURE_2D, 0, face * face_px, 0, 0, cube, GL_TEXTURE_CUBE_MAP, 0, 0, 0, face, face_px,
                       face_px, 1);
  }
}

void Panorama::State::set_stars(int eye, const StarLights* lights) {
  PanoramaStars& mine = stars[eye];
  mine.count = lights != nullptr ? static_cast<int>(lights->stars.size()) : 0;
  if (mine.count == 0) {
    return;
  }
  if (mine.buffer == 0) {
    glCreateBuffers(1, &mine.buffer);
  }
  glNamedBufferData(mine.buffer, static_cast<GLsizeiptr>(lights->stars.size() * sizeof(StarLight)),
                    lights->stars.data(), GL_STATIC_DRAW);
  mine.sigma_px = lights->sigma_px;
  mine.cutoff_px = lights->cutoff_px;
}

Panorama::Panorama() : state_(std::make_unique<State>()) { glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS); }

Panorama::~Panorama() {
  state_->link.reset();
  glDeleteTextures(1, &state_->strip);
  glDeleteTextures(2, state_->cubes);
  for (const PanoramaStars& stars : state_->stars) {
    glDeleteBuffers(1, &stars.buffer);
  }
}

void Panorama::set(const OutputFrame& frame) {
  State& state = *state_;
  state.turn = frame.turn;
  if (frame.on_device) {
    const DevicePicture& device = *frame.on_device;
    state.resize(device.width_px, device.height_px, device.right != nullptr ? 2 : 1);
    if (state.strip == 0) {
      glCreateTextures(GL_TEXTURE_2D, 1, &state.strip);
      glTextureStorage2D(state.strip, 1, GL_RGBA32F, device.width_px, device.height_px);
      state.link = std::make_unique<CudaTextureLink>(state.strip);
    }
    const float* const eyes[2] = {device.rgba, device.right};
    for (int eye = 0; eye < state.eyes; ++eye) {
      const CudaTextureLink::Part whole = {eyes[eye], device.width_px, device.height_px, 0, 0};
      state.link->copy_from_device({&whole, 1});
      state.copy_strip(state.cubes[eye]);
    }
    state.set_stars(0, device.stars.get());
    state.set_stars(1, device.right_stars.get());
    state.tone = device.tone;
    state.heat_map = device.heat_map;
    return;
  }
  const Picture& left = frame.picture;
  state.resize(left.width, left.height, frame.right_eye ? 2 : 1);
  upload_faces(state.cubes[0], state.face_px, left.rgba.data());
  if (frame.right_eye) {
    upload_faces(state.cubes[1], state.face_px, frame.right_eye->rgba.data());
  }
  state.set_stars(0, left.stars.get());
  state.set_stars(1, frame.right_eye ? frame.right_eye->stars.get() : nullptr);
  state.tone = left.tone;
  state.heat_map = left.heat_range.has_value();
}

bool Panorama::empty() const { return state_->eyes == 0; }

void Panorama::use(int eye, unsigned unit) const {
  glBindTextureUnit(unit, state_->cubes[eye < state_->eyes ? eye : 0]);
}

const PanoramaStars* Panorama::stars(int eye) const {
  const PanoramaStars& stars = state_->stars[eye < state_->eyes ? eye : 0];
  return stars.count > 0 ? &stars : nullptr;
}

const Tone& Panorama::tone() const { return state_->tone; }
bool Panorama::heat_map() const { return state_->heat_map; }
const glm::dquat& Panorama::turn() const { return state_->turn; }
int Panorama::face_px() const { return state_->face_px; }

}  // namespace ergodome
