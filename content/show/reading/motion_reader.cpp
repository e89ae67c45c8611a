#include "content/show/reading/motion_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "content/show/reading/show_reader.h"

namespace ergodome {

namespace {

//! Words in show files for the first values of ObserverMotion, in its order; the others have none.
constexpr std::array motion_names = {"zamo", "static", "geodesic", "retrograde", "rain"};

}  // namespace

const char* motion_name(ObserverMotion motion) {
  const auto i = static_cast<std::size_t>(motion);
  return i < motion_names.size() ? motion_names[i] : "velocity";
}

Vector3<double> read_vector(TomlTable& table, std::string_view key, const toml::node& node) {
  const toml::array* list = node.as_array();
  Vector3<double> v{};
  double* const parts[3] = {&v.x, &v.y, &v.z};
  if (list == nullptr || list->size() != 3) {
    throw table.error_at(key, "is not a direction", "write three numbers: [e_r, e_theta, e_phi]");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto part = list->get(i)->value<double>();
    if (!part || !std::isfinite(*part) || std::abs(*part) > 1e100) {
      throw table.error_at(key, "contains an entry that is not a finite number", "write three numbers");
    }
    *parts[i] = *part;
  }
  if (!(dot(v, v) > 0.0)) {
    throw table.error_at(key, "is zero", "write a direction with at least one number other than 0");
  }
  return v;
}

WrittenMotion read_motion(TomlTable& table, std::string_view key, const std::string& file,
                          const WrittenMotion& otherwise) {
  const toml::node* at = table.node(key);
  if (at == nullptr) {
    return otherwise;
  }
  if (!at->is_table()) {
    constexpr ObserverMotion motions[] = {ObserverMotion::zamo, ObserverMotion::fixed, ObserverMotion::geodesic,
                                          ObserverMotion::retrograde, ObserverMotion::rain};
    return {motions[table.choice(key, 0, motion_names)], {}};
  }
  TomlTable velocity(*at->as_table(), file, table.path_of(key));
  const double beta = velocity.number("beta", 0.0, 0.0, 1.0);
  if (!(beta <= fastest_observer)) {
    throw velocity.error_at("beta", "is too close to the speed of light", "choose at most 0.999999");
  }
  const toml::node* toward = velocity.node("toward");
  if (toward == nullptr) {
    throw velocity.error_at("toward", "is missing", "write toward = [e_r, e_theta, e_phi]");
  }
  const Vector3<double> v = read_vector(velocity, "toward", *toward);
  velocity.refuse_unknown_keys();
  return {ObserverMotion::velocity, (beta / std::sqrt(dot(v, v))) * v};
}

void write_motion(toml::table& table, std::string_view key, const WrittenMotion& written) {
  if (written.motion != ObserverMotion::velocity) {
    table.insert(key, motion_name(written.motion));
    return;
  }
  const Vector3<double>& v = written.velocity;
  const double beta = std::min(std::sqrt(dot(v, v)), fastest_observer);
  const Vector3<double> toward = beta > 1e-100 ? (1.0 / beta) * v : Vector3<double>{1.0, 0.0, 0.0};
  table.insert(key, toml::table{{"beta", beta}, {"toward", toml::array{toward.x, toward.y, toward.z}}});
}

}  // namespace ergodome
