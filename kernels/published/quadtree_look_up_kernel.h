#pragma once

#include "kernels/published/quadtree_look_up.h"
#include "kernels/spacetime/trace/pixel_geometry.h"
#include "kernels/spacetime/trace/trace_rays_kernel.h"

// Reads rays and pixels from quadtree grids.
namespace ergodome::inline ERGO_TARGET {

//! Reads rays from quadtree grids, one per index, because each takes a different path through the
//! tree.
struct ReadQuadtreeRays {
  QuadtreeRaysBatch batch;

  ERGO_HD void operator()(int index) const {
    const RayBatch<double>& rays = batch.rays;
    const Vector3<double> n = {rays.direction[0][index], rays.direction[1][index], rays.direction[2][index]};
    float row = 0.0F;
    float column = 0.0F;
    // Vectors that are not unit vectors have no position in the tree.
    const double square = dot(n, n);
    const bool proper = square > 0.5 && square < 2.0;
    quadtree_position(batch.look_up.grids[0].level, proper ? n : Vector3<double>{1.0, 0.0, 0.0}, row, column);
    const SkyAngles angles = read_quadtree(batch.look_up, row, column);
    const bool bright = proper && !in_shadow(angles);
    const double theta = static_cast<double>(angles.theta);
    const double phi = static_cast<double>(angles.phi);
    const Vector3<double> sky = turned_to_camera(
        rays.camera, Vector3<double>{::sin(theta) * ::cos(phi), ::sin(theta) * ::sin(phi), ::cos(theta)});
    store_lanes(rays.sky[0], index, rays.count, bright ? sky.x : 0.0);
    store_lanes(rays.sky[1], index, rays.count, bright ? sky.y : 0.0);
    store_lanes(rays.sky[2], index, rays.count, bright ? sky.z : 0.0);
    store_lanes(rays.frequency_ratio, index, rays.count, 1.0 / detail::evaluate(rays.camera.energy, n));
    store_lanes(rays.status, index, rays.count,
                static_cast<double>(static_cast<int>(bright ? LightEnd::sky : LightEnd::horizon)));
    store_lanes(rays.steps, index, rays.count, 0.0);
    store_lanes(rays.error_estimate, index, rays.count, 0.0);
    store_lanes(rays.mino_time, index, rays.count, 0.0);
  }
};

//! Reads the pixels of a batch from quadtree grids, one per index. The footprint of a pixel is
//! spanned by the midpoints of its sides. A pixel is dark if its center is, because the grids know
//! the shadow only by vertices.
struct ReadQuadtreePixels {
  using D = Dual<float>;

  QuadtreePixelBatch batch;

  ERGO_HD void operator()(int index) const {
    const PixelBatch& pixels = batch.pixels;
    float x_px = 0.0F;
    float y_px = 0.0F;
    pixel_middles(pixels, index, x_px, y_px);
    const float inside = image_coverage(pixels.projection, x_px, y_px);
    const Vector3<D> n = observed_direction(pixels, x_px, y_px);
    const Vector3<float> along_x = {n.x.along_x, n.y.along_x, n.z.along_x};
    const Vector3<float> along_y = {n.x.along_y, n.y.along_y, n.z.along_y};
    const Vector3<float> middle = {n.x.value, n.y.value, n.z.value};
    Vector3<float> sky{};
    const bool bright = inside > 0.0F && seen_at(middle, sky);
    const Vector3<float> sky_x = bright ? change(middle, sky, 0.5F * along_x) : Vector3<float>{};
    const Vector3<float> sky_y = bright ? change(middle, sky, 0.5F * along_y) : Vector3<float>{};
    store_sky(pixels, index,
              Vector3<D>{{sky.x, sky_x.x, sky_y.x}, {sky.y, sky_x.y, sky_y.y}, {sky.z, sky_x.z, sky_y.z}}, bright);
    const int count = pixel_count(pixels);
    store_lanes(pixels.out.coverage, index, count, bright ? inside : 0.0F);
    store_lanes(pixels.out.steps, index, count, 0.0F);
    store_lanes(pixels.out.error_estimate, index, count, 0.0F);
    if (pixels.out.frequency_ratio != nullptr) {
      store_lanes(pixels.out.frequency_ratio, index, count, 1.0F / detail::evaluate(pixels.camera.energy, middle));
    }
  }

 private:
  //! Reads the sky in a direction of any length. Returns false in the shadow.
  ERGO_HD bool seen_at(const Vector3<float>& n, Vector3<float>& sky) const {
    float row = 0.0F;
    float column = 0.0F;
    quadtree_position(batch.look_up.grids[0].level,
                      {static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)}, row, column);
    const SkyAngles angles = read_quadtree(batch.look_up, row, column);
    const float sine = ::sinf(angles.theta);
    sky = {sine * ::cosf(angles.phi), sine * ::sinf(angles.phi), ::cosf(angles.theta)};
    return !in_shadow(angles);
  }

  //! Returns the change of the sky over a pixel with half side `half`; from one side only if the
  //! other is dark.
  ERGO_HD Vector3<float> change(const Vector3<float>& n, const Vector3<float>& sky, const Vector3<float>& half) const {
    Vector3<float> after{};
    Vector3<float> before{};
    const bool lit_after = seen_at(n + half, after);
    const bool lit_before = seen_at(n - half, before);
    if (lit_after && lit_before) {
      return after - before;
    }
    return lit_after ? 2.0F * (after - sky) : (lit_before ? 2.0F * (sky - before) : Vector3<float>{});
  }
};

template <class T, class Action>
void dispatch(const QuadtreeRaysBatch& batch, const Action& action) {
  action(ReadQuadtreeRays{batch});
}

template <class T, class Action>
void dispatch(const QuadtreePixelBatch& batch, const Action& action) {
  action(ReadQuadtreePixels{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
