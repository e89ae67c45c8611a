#include "render/lens/stations/station_derivatives.h"

#include <algorithm>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/lens/grid/edge_table.h"

namespace ergodome {

namespace {

constexpr double step = 0.01;

//! A node is four vectors with padding: the sky direction, its derivatives along γ and along s, and
//! its mixed derivative.
constexpr std::size_t floats_a_vector = 4;
//! Index in a node of the padding float that states whether the node sees the sky.
constexpr std::size_t sky_known = 3;

glm::dvec3 vector_at(const std::vector<float>& nodes, std::size_t at) {
  return {nodes[at], nodes[at + 1], nodes[at + 2]};
}

void set_vector(std::vector<float>& nodes, std::size_t at, const glm::dvec3& v) {
  nodes[at] = static_cast<float>(v.x);
  nodes[at + 1] = static_cast<float>(v.y);
  nodes[at + 2] = static_cast<float>(v.z);
}

//! Returns the nodes for a camera at another position, without the rotation of frame_rotation().
std::vector<float> nodes_from(const LensStation& station, const NodeTracer& trace, const LensPosition& position) {
  const CameraStation rain =
      make_camera_station(station.spacetime, position.r, position.theta, 0.0, ObserverMotion::rain);
  const EdgeTable edge(Backend::cpu, rain, edge_points);
  std::vector<float> nodes = trace(position, {edge.view(), station.range});
  const glm::dmat3 turn = frame_rotation(station.spacetime, position, {station.r, station.theta});
  for (std::size_t at = 0; at < nodes.size(); at += floats_a_vector) {
    set_vector(nodes, at, turn * vector_at(nodes, at));
  }
  return nodes;
}

//! Returns the derivative of the nodes by camera position (along r or θ), from their values at two
//! positions `distance` apart. It is 0 for nodes that do not see the sky from all three positions:
//! these two and the station's.
std::vector<float> difference(const LensStation& station, const NodeTracer& trace, const LensPosition& from,
                              const LensPosition& to, double distance) {
  const std::vector<float> before = nodes_from(station, trace, from);
  const std::vector<float> after = nodes_from(station, trace, to);
  std::vector<float> change(station.nodes.size(), 0.0F);
  for (std::size_t node = 0; node < change.size(); node += floats_a_node) {
    const std::size_t known = node + sky_known;
    if (station.nodes[known] > 0.0F && before[known] > 0.0F && after[known] > 0.0F) {
      for (std::size_t at = node; at < node + floats_a_node; at += floats_a_vector) {
        set_vector(change, at, (vector_at(after, at) - vector_at(before, at)) / distance);
      }
    }
  }
  return change;
}

}  // namespace

void add_derivatives(LensStation& station, const NodeTracer& trace) {
  const double dr = step * radial_measure(station.spacetime, station.r);
  station.nodes_along_r =
      difference(station, trace, {station.r - dr, station.theta}, {station.r + dr, station.theta}, 2.0 * dr);
  const double north = std::max(station.theta - step, 0.0);
  const double south = std::min(station.theta + step, pi);
  station.nodes_along_theta = difference(station, trace, {station.r, north}, {station.r, south}, south - north);
}

void add_cell_motion(LensStation& station, const LensPosition& reach, const NodeTracer& trace) {
  std::vector<float> corners[2][2];
  for (const int outer : {0, 1}) {
    for (const int south : {0, 1}) {
      corners[outer][south] = nodes_from(
          station, trace,
          {station.r + (outer == 1 ? reach.r : -reach.r), station.theta + (south == 1 ? reach.theta : -reach.theta)});
    }
  }
  for (std::vector<float>* const values :
       {&station.nodes_along_r, &station.nodes_along_theta, &station.nodes_along_r_r, &station.nodes_along_r_theta}) {
    values->assign(station.nodes.size(), 0.0F);
  }
  for (std::size_t node = 0; node < station.nodes.size(); node += floats_a_node) {
    const std::size_t known = node + sky_known;
    const bool seen = station.nodes[known] > 0.0F && corners[0][0][known] > 0.0F && corners[0][1][known] > 0.0F &&
                      corners[1][0][known] > 0.0F && corners[1][1][known] > 0.0F;
    for (std::size_t at = node; seen && at < node + floats_a_node; at += floats_a_vector) {
      const glm::dvec3 inner = vector_at(corners[0][0], at) + vector_at(corners[0][1], at);
      const glm::dvec3 outer = vector_at(corners[1][0], at) + vector_at(corners[1][1], at);
      const glm::dvec3 inner_rise = vector_at(corners[0][1], at) - vector_at(corners[0][0], at);
      const glm::dvec3 outer_rise = vector_at(corners[1][1], at) - vector_at(corners[1][0], at);
      set_vector(station.nodes_along_r, at, 0.25 * (outer - inner) / reach.r);
      set_vector(station.nodes_along_theta, at, 0.25 * (outer_rise + inner_rise) / reach.theta);
      set_vector(station.nodes_along_r_r, at,
                 (0.25 * (outer + inner) - vector_at(station.nodes, at)) / (reach.r * reach.r));
      set_vector(station.nodes_along_r_theta, at, 0.25 * (outer_rise - inner_rise) / (reach.r * reach.theta));
    }
  }
}

std::vector<float> moved_nodes(const LensStation& station, const LensPosition& offset, const glm::dmat3& turn) {
  std::vector<float> nodes = station.nodes;
  const glm::mat3 rotation(turn);
  const auto along_r = static_cast<float>(offset.r);
  const auto along_theta = static_cast<float>(offset.theta);
  const bool curved = !station.nodes_along_r_r.empty();
  const auto vector = [](const std::vector<float>& from, std::size_t at) {
    return glm::vec3(from[at], from[at + 1], from[at + 2]);
  };
  for (std::size_t at = 0; at < nodes.size(); at += floats_a_vector) {
    glm::vec3 moved = vector(station.nodes, at) + along_r * vector(station.nodes_along_r, at) +
                      along_theta * vector(station.nodes_along_theta, at);
    if (curved) {
      moved += along_r * along_r * vector(station.nodes_along_r_r, at) +
               along_r * along_theta * vector(station.nodes_along_r_theta, at);
    }
    const glm::vec3 turned = rotation * moved;
    nodes[at] = turned.x;
    nodes[at + 1] = turned.y;
    nodes[at + 2] = turned.z;
  }
  return nodes;
}

}  // namespace ergodome
