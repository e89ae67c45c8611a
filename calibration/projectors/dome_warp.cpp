#include "calibration/projectors/dome_warp.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int coarsest = 17;
constexpr int finest = 1025;
//! Maximum radius of valid nodes in the domemaster, in half-widths: nodes beyond the rim are needed
//! by cells that cross it.
constexpr double beyond_rim = 1.25;

Projection master_of(const DomeScreen& screen) {
  return make_dome_projection(1, one_degree * screen.field_of_view_deg, one_degree * screen.tilt_deg);
}

//! Returns the distance of a position from the center of the domemaster, in half-widths: 1 at the
//! rim.
double rim_part(double u, double v) { return 2.0 * std::hypot(u - 0.5, v - 0.5); }

WarpNode node_at(const ProjectorOptics& projector, const Projection& master, const RasterPosition& position) {
  WarpNode node;
  node.x = static_cast<float>(position.x);
  node.y = static_cast<float>(position.y);
  double u = 0.0;
  double v = 0.0;
  const auto point = projector.dome_point(position);
  node.valid = point && pixel_from_direction(master, (1.0 / projector.dome_radius_m()) * *point, u, v) &&
               rim_part(u, v) < beyond_rim;
  node.u = static_cast<float>(u);
  node.v = static_cast<float>(v);
  return node;
}

WarpMesh mesh_of(const ProjectorOptics& projector, const Projection& master, int side) {
  WarpMesh mesh;
  mesh.columns = side;
  mesh.rows = side;
  mesh.nodes.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  parallel_for(side, 4, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < side; ++column) {
        mesh.at(column, row) = node_at(
            projector, master, {static_cast<double>(column) / (side - 1), static_cast<double>(row) / (side - 1)});
      }
    }
  });
  return mesh;
}

//! Returns the maximum error of a mesh at the midpoints of its cells' sides and diagonals, where
//! the interpolation in triangles is least accurate. Counts only positions on the dome. The unit is
//! a pixel of the master or of the projector, whichever is larger. `finer` is an exact mesh whose
//! nodes include all these midpoints.
double worst_error_px(const WarpMesh& mesh, const WarpMesh& finer, int master_px, int raster_px) {
  double worst = 0.0;
  const double cell_px = static_cast<double>(raster_px) / (mesh.columns - 1);
  for (int row = 0; row < finer.rows; ++row) {
    for (int column = 0; column < finer.columns; ++column) {
      const WarpNode& exact = finer.at(column, row);
      const WarpNode& before = mesh.at(column / 2, row / 2);
      const WarpNode& after = mesh.at((column + 1) / 2, (row + 1) / 2);
      if (exact.valid && before.valid && after.valid && rim_part(exact.u, exact.v) <= 1.0) {
        const auto apart = [](float u, float v) { return static_cast<double>(std::hypot(u, v)); };
        const double error = apart(0.5F * (before.u + after.u) - exact.u, 0.5F * (before.v + after.v) - exact.v);
        const double pixel = std::max(1.0 / master_px, apart(after.u - before.u, after.v - before.v) / cell_px);
        worst = std::max(worst, error / pixel);
      }
    }
  }
  return worst;
}

}  // namespace

bool master_position(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v) {
  const double inverse = 1.0 / std::sqrt(dot(point, point));
  return pixel_from_direction(master_of(screen), inverse * point, u, v) && rim_part(u, v) <= 1.0;
}

bool master_position_near_rim(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v) {
  const double inverse = 1.0 / std::sqrt(dot(point, point));
  return pixel_from_direction(master_of(screen), inverse * point, u, v) && rim_part(u, v) < beyond_rim;
}

WarpMesh dome_warp(const ProjectorOptics& projector, const DomeScreen& screen, int master_px, double tolerance_px) {
  const Projection master = master_of(screen);
  WarpMesh mesh = mesh_of(projector, master, coarsest);
  while (mesh.columns < finest) {
    WarpMesh finer = mesh_of(projector, master, 2 * mesh.columns - 1);
    const bool good = worst_error_px(mesh, finer, master_px, projector.longer_side_px()) <= tolerance_px;
    if (good) {
      break;
    }
    mesh = std::move(finer);
  }
  const bool lit = std::ranges::any_of(
      mesh.nodes, [](const WarpNode& node) { return node.valid && rim_part(node.u, node.v) <= 1.0; });
  if (!lit) {
    throw Error(projector.location(), "lights no part of the dome",
                "check its position_m and its angles, and radius_m and tilt_deg of the dome");
  }
  return mesh;
}

}  // namespace ergodome
