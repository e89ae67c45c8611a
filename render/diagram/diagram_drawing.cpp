#include "render/diagram/diagram_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "kernels/core/error.h"
#include "render/diagram/diagram_shaders.h"
#include "render/opengl/gl_program.h"

namespace ergodome {

namespace {

//! Supersampling factor in each direction, in addition to the target's multisampling.
constexpr int finer_each_way = 2;
//! Picture height for which line widths are specified [px].
constexpr double reference_height_px = 720.0;

struct DrawnCorner {
  float position[3];
  float normal[3];
  float color[4];
  float checker[3];
};

struct DrawnLine {
  float from[3];
  float to[3];
  float color[3];
  float width;
};

void attribute(unsigned vertex_array, unsigned at, int count, std::size_t offset) {
  glEnableVertexArrayAttrib(vertex_array, at);
  glVertexArrayAttribFormat(vertex_array, at, count, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(vertex_array, at, 0);
}

template <class Item>
void fill_buffer(unsigned buffer, const std::vector<Item>& items) {
  while (glGetError() != GL_NO_ERROR) {
  }
  glNamedBufferData(buffer, static_cast<GLsizeiptr>(items.size() * sizeof(Item)), items.data(), GL_STREAM_DRAW);
  if (glGetError() != GL_NO_ERROR) {
    throw Error("OpenGL", "the graphics driver cannot allocate memory for the diagram", "simplify its meshes");
  }
}

void put_vector(const Vector3<double>& v, float (&to)[3]) {
  to[0] = static_cast<float>(v.x);
  to[1] = static_cast<float>(v.y);
  to[2] = static_cast<float>(v.z);
}

DrawnCorner drawn_corner(const DiagramCorner& corner, const OutsideCamera& camera) {
  DrawnCorner out{};
  put_vector(camera.in_view(corner.position), out.position);
  const Vector3<double> n = {static_cast<double>(corner.normal.x), static_cast<double>(corner.normal.y),
                             static_cast<double>(corner.normal.z)};
  put_vector({dot(camera.right, n), dot(camera.up, n), dot(camera.back, n)}, out.normal);
  std::ranges::copy(corner.color, out.color);
  std::ranges::copy(corner.checker, out.checker);
  return out;
}

//! Returns the corners of translucent triangles, sorted so that the farthest triangle is drawn
//! first (painter's algorithm).
std::vector<DrawnCorner> painted_veils(const std::vector<DiagramCorner>& veils, const OutsideCamera& camera) {
  const std::size_t count = veils.size() / 3;
  std::vector<float> depth(count);
  std::vector<DrawnCorner> corners;
  corners.reserve(veils.size());
  for (const DiagramCorner& corner : veils) {
    corners.push_back(drawn_corner(corner, camera));
  }
  for (std::size_t i = 0; i < count; ++i) {
    depth[i] = corners[3 * i].position[2] + corners[3 * i + 1].position[2] + corners[3 * i + 2].position[2];
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return depth[i]; });
  std::vector<DrawnCorner> sorted;
  sorted.reserve(corners.size());
  for (const std::size_t i : order) {
    sorted.insert(sorted.end(), corners.begin() + static_cast<long>(3 * i),
                  corners.begin() + static_cast<long>(3 * i + 3));
  }
  return sorted;
}

void add_pieces(const std::vector<Vector3<double>>& positions, const Ink& ink, double width,
                const OutsideCamera& camera, std::vector<DrawnLine>& pieces) {
  for (std::size_t i = 1; i < positions.size(); ++i) {
    DrawnLine piece{};
    put_vector(camera.in_view(positions[i - 1]), piece.from);
    put_vector(camera.in_view(positions[i]), piece.to);
    std::ranges::copy(ink, piece.color);
    piece.width = static_cast<float>(width);
    pieces.push_back(piece);
  }
}

}  // namespace

//! Numbers of triangle corners and straight line pieces that were uploaded.
struct DiagramDrawing::Uploaded {
  int solid_corners;
  int veil_corners;
  int lines;
};

//! A rectangle of a picture, and the size of the whole picture [px].
struct DiagramDrawing::Tile {
  int left, top, width, height;
  int whole_width, whole_height;
};

DiagramDrawing::DiagramDrawing()
    : surface_program_(linked_program(diagram_surface_vertex_source, diagram_surface_fragment_source)),
      line_program_(linked_program(diagram_line_vertex_source, diagram_line_fragment_source)) {
  glCreateBuffers(1, &surface_buffer_);
  glCreateBuffers(1, &line_buffer_);
  glCreateVertexArrays(1, &surface_array_);
  glVertexArrayVertexBuffer(surface_array_, 0, surface_buffer_, 0, sizeof(DrawnCorner));
  attribute(surface_array_, 0, 3, offsetof(DrawnCorner, position));
  attribute(surface_array_, 1, 3, offsetof(DrawnCorner, normal));
  attribute(surface_array_, 2, 4, offsetof(DrawnCorner, color));
  attribute(surface_array_, 3, 3, offsetof(DrawnCorner, checker));
  glCreateVertexArrays(1, &line_array_);
  glVertexArrayVertexBuffer(line_array_, 0, line_buffer_, 0, sizeof(DrawnLine));
  glVertexArrayBindingDivisor(line_array_, 0, 1);
  attribute(line_array_, 0, 3, offsetof(DrawnLine, from));
  attribute(line_array_, 1, 3, offsetof(DrawnLine, to));
  attribute(line_array_, 2, 3, offsetof(DrawnLine, color));
  attribute(line_array_, 3, 1, offsetof(DrawnLine, width));
}

DiagramDrawing::~DiagramDrawing() {
  glDeleteVertexArrays(1, &surface_array_);
  glDeleteVertexArrays(1, &line_array_);
  glDeleteBuffers(1, &surface_buffer_);
  glDeleteBuffers(1, &line_buffer_);
  glDeleteProgram(surface_program_);
  glDeleteProgram(line_program_);
}

DiagramDrawing::Uploaded DiagramDrawing::upload(const DiagramScene& scene, const OutsideCamera& camera) {
  std::vector<DrawnCorner> corners;
  corners.reserve(scene.solids.size() + scene.veils.size());
  for (const DiagramCorner& corner : scene.solids) {
    corners.push_back(drawn_corner(corner, camera));
  }
  const std::vector<DrawnCorner> veils = painted_veils(scene.veils, camera);
  corners.insert(corners.end(), veils.begin(), veils.end());
  std::vector<DrawnLine> pieces;
  for (const DiagramLine& line : scene.lines) {
    add_pieces(line.positions, line.ink, line.width_px, camera, pieces);
  }
  if (scene.photon_sphere > 0.0) {
    add_pieces(sphere_outline(scene.photon_sphere, camera), diagram_inks::photon_sphere(), 1.2, camera, pieces);
  }
  fill_buffer(surface_buffer_, corners);
  fill_buffer(line_buffer_, pieces);
  return {static_cast<int>(scene.solids.size()), static_cast<int>(veils.size()), static_cast<int>(pieces.size())};
}

void DiagramDrawing::draw_tile(const Uploaded& uploaded, const OutsideCamera& camera, const Tile& tile) const {
  target_->begin();
  glViewport(0, 0, finer_each_way * tile.width, finer_each_way * tile.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  // Scale and shift from the clip space of the whole picture to that of the tile.
  const double scale_x = static_cast<double>(tile.whole_width) / tile.width;
  const double scale_y = static_cast<double>(tile.whole_height) / tile.height;
  const double shift_x = (tile.whole_width - 2.0 * tile.left - tile.width) / tile.width;
  const double shift_y = -(tile.whole_height - 2.0 * tile.top - tile.height) / tile.height;
  const double width_px = unit_height_px(tile.whole_width, tile.whole_height) / reference_height_px;
  for (const unsigned program : {surface_program_, line_program_}) {
    glProgramUniform4f(program, uniform_diagram_screen, static_cast<float>(camera.half_width),
                       static_cast<float>(camera.half_height), static_cast<float>(camera.nearest),
                       static_cast<float>(camera.farthest));
    glProgramUniform4f(program, uniform_diagram_tile, static_cast<float>(scale_x), static_cast<float>(scale_y),
                       static_cast<float>(shift_x), static_cast<float>(shift_y));
  }
  glProgramUniform2f(line_program_, uniform_diagram_pixel, static_cast<float>(2.0 * width_px / tile.width),
                     static_cast<float>(2.0 * width_px / tile.height));
  glUseProgram(surface_program_);
  glBindVertexArray(surface_array_);
  glDrawArrays(GL_TRIANGLES, 0, uploaded.solid_corners);
  glUseProgram(line_program_);
  glBindVertexArray(line_array_);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, uploaded.lines);
  glUseProgram(surface_program_);
  glBindVertexArray(surface_array_);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, uploaded.solid_corners, uploaded.veil_corners);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void DiagramDrawing::lay_on_paper(const std::vector<float>& rgba, const Tile& tile, std::vector<float>& picture) {
  const Ink paper = diagram_inks::paper();
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      std::array<float, 4> sum = {};
      for (int i = 0; i < finer_each_way * finer_each_way; ++i) {
        const long row = static_cast<long>(finer_each_way) * (tile.height - 1 - y) + i / finer_each_way;
        const float* const from =
            rgba.data() + 4 * (row * finer_each_way * tile.width + finer_each_way * x + i % finer_each_way);
        for (std::size_t k = 0; k < 4; ++k) {
          sum[k] += from[k] / static_cast<float>(finer_each_way * finer_each_way);
        }
      }
      float* const to = picture.data() + 3 * (static_cast<long>(tile.top + y) * tile.whole_width + tile.left + x);
      for (std::size_t k = 0; k < 3; ++k) {
        to[k] = sum[k] + (1.0F - sum[3]) * paper[k];
      }
    }
  }
}

std::vector<float> DiagramDrawing::draw(const DiagramScene& scene, const OutsideCamera& camera, int width_px,
                                        int height_px) {
  constexpr int longest = ObjectTarget::longest_side_px / finer_each_way;
  const Uploaded uploaded = upload(scene, camera);
  std::vector<float> picture(3UL * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  std::vector<float> rgba;
  for (int top = 0; top < height_px; top += longest) {
    for (int left = 0; left < width_px; left += longest) {
      const Tile tile{left,     top,      std::min(longest, width_px - left), std::min(longest, height_px - top),
                      width_px, height_px};
      if (!target_ || target_->width() != finer_each_way * tile.width ||
          target_->height() != finer_each_way * tile.height) {
        target_.reset();
        target_ = std::make_unique<ObjectTarget>(finer_each_way * tile.width, finer_each_way * tile.height);
      }
      draw_tile(uploaded, camera, tile);
      target_->read(rgba);
      lay_on_paper(rgba, tile, picture);
    }
  }
  return picture;
}

}  // namespace ergodome
