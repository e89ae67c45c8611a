#include "render/passes/objects/polygons/object_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "render/opengl/gl_program.h"
#include "render/passes/objects/polygons/object_shaders.h"

namespace ergodome {

namespace {

//! Minimum number of image orders in a table: light of lamps arrives on the two shortest paths.
constexpr int min_orders = 2;
constexpr GLsizeiptr eyes_bytes =
    static_cast<GLsizeiptr>(sizeof(float)) * 4 * omni_groups * omni_terms(omni_max_degree);

int orders_of(std::span<const PlacedObject> objects) {
  int orders = min_orders;
  for (const PlacedObject& object : objects) {
    orders = std::max(orders, object.settings->images);
  }
  return orders;
}

void set_vec3(int at, const Vector3<double>& v) {
  glUniform3f(at, static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

void set_matrix(int at, const Vector3<double> (&columns)[3], double factor) {
  float values[9];
  for (int i = 0; i < 3; ++i) {
    values[3 * i] = static_cast<float>(factor * columns[i].x);
    values[3 * i + 1] = static_cast<float>(factor * columns[i].y);
    values[3 * i + 2] = static_cast<float>(factor * columns[i].z);
  }
  glUniformMatrix3fv(at, 1, GL_FALSE, values);
}

void set_table(int unit, int at, const ConnectionTexture& table, double r) {
  glBindTextureUnit(static_cast<GLuint>(unit), table.name());
  glUniform4f(at, static_cast<float>(table.grid().u_low), static_cast<float>(table.grid().u_high),
              static_cast<float>(r), static_cast<float>(std::sqrt((r - 2.0) / r)));
}

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

void set_appearance(const ObjectSettings& object) {
  const TessellationSettings& tessellation = object.tessellation;
  glUniform4f(uniform_tessellation, static_cast<float>(tessellation.maximum), static_cast<float>(tessellation.factor),
              static_cast<float>(tessellation.power), static_cast<float>(object.torn));
  const CheckerSettings checker = object.checker.value_or(CheckerSettings{0, 0, 1.0});
  glUniform3f(uniform_checker, static_cast<float>(checker.columns), static_cast<float>(checker.rows),
              static_cast<float>(checker.dark));
}

ObjectSight sight_of(const ObjectDrawing::Scene& scene) {
  if (scene.omni != nullptr) {
    return ObjectSight::omni;
  }
  return scene.beside < 0.0 || scene.beside > 0.0 ? ObjectSight::beside : ObjectSight::camera;
}

unsigned object_program(ObjectSight sight) {
  return linked_program({{GL_VERTEX_SHADER, object_vertex_source()},
                         {GL_TESS_CONTROL_SHADER, object_control_source(sight)},
                         {GL_TESS_EVALUATION_SHADER, object_evaluation_source(sight)},
                         {GL_GEOMETRY_SHADER, object_geometry_source()},
                         {GL_FRAGMENT_SHADER, object_fragment_source()}});
}

}  // namespace

ObjectDrawing::ObjectDrawing(const std::vector<TriangleMesh>& meshes) : programs_{object_program(ObjectSight::camera)} {
  for (const TriangleMesh& mesh : meshes) {
    meshes_.push_back(std::make_unique<GlMesh>(mesh));
  }
}

ObjectDrawing::~ObjectDrawing() {
  glDeleteBuffers(1, &eyes_);
  for (const unsigned program : programs_) {
    glDeleteProgram(program);
  }
}

void ObjectDrawing::use_program(const Scene& scene) {
  const ObjectSight sight = sight_of(scene);
  unsigned& program = programs_[static_cast<std::size_t>(sight)];
  if (program == 0) {
    program = object_program(sight);
  }
  glUseProgram(program);
  if (sight == ObjectSight::omni) {
    set_omni_view(*scene.omni);
  } else if (sight == ObjectSight::beside) {
    glUniform1f(uniform_beside, static_cast<float>(scene.beside));
  }
}

void ObjectDrawing::set_omni_view(const OmniView& omni) {
  if (eyes_ == 0) {
    glCreateBuffers(1, &eyes_);
    glNamedBufferStorage(eyes_, eyes_bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  }
  glBindBufferBase(GL_UNIFORM_BUFFER, block_eyes, eyes_);
  glUniform1i(uniform_degree, omni.degree);
  const OmniCameraOf<float>& eye = omni.eye;
  glUniform4f(uniform_omni, eye.offset, eye.inverse_convergence, eye.fade_begin, eye.fade_scale);
  glUniform1f(uniform_inverse_reach, eye.inverse_reach);
  const std::vector<float>& numbers = omni.coefficients;
  glNamedBufferSubData(eyes_, 0, static_cast<GLsizeiptr>(numbers.size() * sizeof(float)), numbers.data());
}

void ObjectDrawing::set_tables(const Scene& scene) {
  const int orders = orders_of(scene.objects);
  const RadialRange observers = scene.omni != nullptr ? scene.omni->radii : RadialRange{scene.view.r, scene.view.r};
  const ConnectionTexture& table = tables_.table(observers, scene.range, orders);
  set_table(unit_table, uniform_table_range, table, scene.view.r);
  if (scene.omni != nullptr) {
    glUniform2f(uniform_table_observers, static_cast<float>(table.grid().u_observer_low),
                static_cast<float>(table.grid().u_observer_high));
  }
  glUniform1i(uniform_table_orders, orders);
  const bool lit =
      scene.light && std::ranges::any_of(scene.objects, [](const PlacedObject& o) { return o.settings->lit; });
  if (lit) {
    const double r = length(scene.light->position);
    set_table(unit_light_table, uniform_light_table_range, tables_.table({r, r}, scene.range, min_orders), r);
  }
}

void ObjectDrawing::draw_object(const Scene& scene, const PlacedObject& object) const {
  const ObjectSettings& settings = *object.settings;
  const ObjectPlacement& placement = object.placement;
  Vector3<double> turned[3];
  for (int i = 0; i < 3; ++i) {
    turned[i] = scene.view.in_frame({placement.rows[0][i], placement.rows[1][i], placement.rows[2][i]});
  }
  set_matrix(uniform_model, turned, settings.size);
  set_matrix(uniform_turn, turned, 1.0);
  set_vec3(uniform_position, scene.view.in_frame(placement.position));
  set_appearance(settings);
  const bool lit = settings.lit && scene.light;
  const Vector3<double> light = lit ? scene.view.in_frame(scene.light->position) : Vector3<double>{};
  glUniform4f(uniform_light, static_cast<float>(light.x), static_cast<float>(light.y), static_cast<float>(light.z),
              lit ? static_cast<float>(scene.light->strength) : 0.0F);
  const GlMesh& mesh = *meshes_[object.mesh];
  mesh.bind();
  for (const GlMesh::Part& part : mesh.parts()) {
    const std::array<float, 3>& own = part.color;
    set_vec3(uniform_color, {settings.exposure * settings.color.x * static_cast<double>(own[0]),
                             settings.exposure * settings.color.y * static_cast<double>(own[1]),
                             settings.exposure * settings.color.z * static_cast<double>(own[2])});
    glUniform1i(uniform_textured, part.image != 0 ? 1 : 0);
    glBindTextureUnit(unit_image, part.image);
    for (int order = 1; order <= settings.images; ++order) {
      glUniform1i(uniform_order, order);
      mesh.draw(part, settings.tessellation.maximum);
    }
  }
}

void ObjectDrawing::draw(const Scene& scene, const Projection& projection, const PictureTile& tile,
                         std::vector<float>& rgba) {
  if (!target_ || target_->width() != tile.width_px || target_->height() != tile.height_px) {
    target_.reset();
    target_ = std::make_unique<ObjectTarget>(tile.width_px, tile.height_px);
  }
  target_->begin();
  // OpenGL counts rows from the bottom.
  glViewport(-tile.left_px, -(projection.height_px - tile.top_px - tile.height_px), projection.width_px,
             projection.height_px);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  use_program(scene);
  Projection flat = projection;
  ObjectView view = scene.view;
  turn_to_face(flat, view);
  set_projection(flat);
  set_view(view);
  set_tables(scene);
  for (const PlacedObject& object : scene.objects) {
    draw_object(scene, object);
  }
  target_->read(rgba);
}

}  // namespace ergodome
