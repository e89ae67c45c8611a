#include "render/lens/stations/station_derivatives.h"

#include <algorithm>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/lens/grid/edge_table.h"

namespace ergodome {

namespace {

constexpr double step = 0.01;

//! Index in a node of the first component of each vector: the sky direction, its derivatives along
//! γ and along s, and its mixed derivative.
constexpr std::size_t vectors[] = {0, 4, 8, 12};
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

//! Returns the derivative of the nodes by camera position (along r or θ), from their values at two
//! positions `distance` apart. It is 0 for nodes that do not see the sky from all three positions:
//! these two and the station's.
std::vector<float> difference(const LensStation& station, const NodeTracer& trace, const LensPosition& from,
                              const LensPosition& to, double distance) {
  const LensPosition here = {station.r, station.theta};
  const auto nodes_at = [&](const LensPosition& position) {
    const CameraStation rain =
        make_camera_station(station.spacetime, position.r, position.theta, 0.0, ObserverMotion::rain);
    const EdgeTable edge(Backend::cpu, rain, edge_points);
    return trace(position, {edge.view(), station.range});
  };
  const std::vector<float> before = nodes_at(from);
  const std::vector<float> after = nodes_at(to);
  const glm::dmat3 turn_before = frame_rotation(station.spacetime, from, here);
  const glm::dmat3 turn_after = frame_rotation(station.spacetime, to, here);
  std::vector<float> change(station.nodes.size(), 0.0F);
  for (std::size_t node = 0; node < change.size(); node += floats_a_node) {
    const std::size_t known = node + sky_known;
    if (station.nodes[known] > 0.0F && before[known] > 0.0F && after[known] > 0.0F) {
      for (const std::size_t vector : vectors) {
        const std::size_t at = node + vector;
        set_vector(change, at, (turn_after * vector_at(after, at) - turn_before * vector_at(before, at)) / distance);
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

std::vector<float> moved_nodes(const LensStation& station, const LensPosition& offset, const glm::dmat3& turn) {
  std::vector<float> nodes = station.nodes;
  const glm::mat3 rotation(turn);
  const auto along_r = static_cast<float>(offset.r);
  const auto along_theta = static_cast<float>(offset.theta);
  const auto vector = [](const std::vector<float>& from, std::size_t at) {
    return glm::vec3(from[at], from[at + 1], from[at + 2]);
  };
  for (std::size_t at = 0; at < nodes.size(); at += 4) {
    const glm::vec3 moved = vector(station.nodes, at) + along_r * vector(station.nodes_along_r, at) +
                            along_theta * vector(station.nodes_along_theta, at);
    const glm::vec3 turned = rotation * moved;
    nodes[at] = turned.x;
    nodes[at + 1] = turned.y;
    nodes[at + 2] = turned.z;
  }
  return nodes;
}

}  // namespace ergodome
