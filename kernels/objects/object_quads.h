#pragma once

#include "kernels/objects/draw_objects.h"
#include "kernels/objects/lamp_light.h"
#include "kernels/objects/object_sight.h"
#include "kernels/objects/pixel_slices.h"

// Draws pixels with objects from quads of samples, for any kind of ray that finds the hits.
namespace ergodome::inline ERGO_TARGET {

//! Number of neighboring positions in a pixel that form a quad.
inline constexpr int quad_size = 4;

//! Hits of a pack of pixels, in one direction each.
template <class T>
struct SampleHits {
  MeshHit hits[RealTraits<T>::lane_count];
  T energy;    //!< energy at infinity of light that is seen with energy 1
  T momentum;  //!< axial angular momentum [M]
};

//! Computes the light of pixels in which objects may be seen, from several quads of positions each.
//! rays.find(first, directions, count, met) finds what a pack of pixels meets in directions of up
//! to rays.max_quads quads; rays.slice(number) cuts a pixel along the shadow's edge. Index i covers
//! pixels i * lanes to (i + 1) * lanes - 1.
template <class T, class Rays>
struct ObjectQuads {
  const ObjectPixelBatch& batch;
  const Rays& rays;

  ERGO_HD void draw(int index) const {
    const int first = index * lanes;
    PixelSum sums[lanes] = {};
    LampSight lamp;
    const PixelPositions<lanes> positions(batch, first, [this](int at) { return rays.slice(at); });
    const int quads = batch.samples * batch.samples / quad_size;
    for (int quad = 0; quad < quads; quad += Rays::max_quads) {
      const int left = quads - quad;
      look_at_quads(first, positions, quad, left < Rays::max_quads ? left : Rays::max_quads, lamp, sums);
    }
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      store(first + i, sums[i]);
    }
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

  //! Sums over a pixel's samples.
  struct PixelSum {
    Vector3<float> light;
    float time;
    float hits, misses;  //!< summed weights of the samples that hit a mesh, and of the others
    float darkest, brightest;
    std::int32_t mesh;
    bool several;
    Vector3<float> normal;
    int met;            //!< number of samples that have hit anything
    int outlines;       //!< number of pairs of successive samples that have hit different things
    std::int32_t last;  //!< mesh that the last sample has hit
  };

  //! The lamp's light on a mesh.
  struct LitMesh {
    int mesh = -1;
    LampLight light = {};
  };

  //! The lamp's light as last computed, for each pixel.
  struct LampSight {
    int corrected = -1;                //!< the mesh to which the corrections belong
    LampCorrections corrections = {};  //!< first guesses for the next point
    LitMesh lit[lanes] = {};
  };

  //! Returns whether the lamp's light has to be found again for a quad. Slices are next to each
  //! other, so a few quads share it.
  [[nodiscard]] ERGO_HD bool asks_lamp(int quad) const {
    constexpr int quads_alike = 4;
    return batch.pattern == PixelPattern::grid || quad % quads_alike == 0;
  }

  //! Returns the direction of each pixel's ray at position k of quad number `quad`.
  ERGO_HD Vector3<T> direction(int first, const PixelPositions<lanes>& positions, int quad, int k) const {
    Vector3<T> n = {T(0.0), T(0.0), T(0.0)};
    for (int i = 0; i < lanes; ++i) {
      const std::int32_t* const at = pixel_of_batch(batch, first + i);
      const PixelPosition position = positions.at(i, quad, k);
      const Vector3<double> one = observed_by(batch.objects, at[0] + position.along_px, at[1] + position.down_px);
      set_lane(n.x, i, one.x);
      set_lane(n.y, i, one.y);
      set_lane(n.z, i, one.z);
    }
    return n;
  }

  //! Traces the rays of `count` quads of each pixel, from quad number `quad` on.
  ERGO_HD void look_at_quads(int first, const PixelPositions<lanes>& positions, int quad, int count, LampSight& lamp,
                             PixelSum (&sums)[lanes]) const {
    constexpr int maximum = Rays::max_quads * quad_size;
    Vector3<T> n[maximum];
    SampleHits<T> met[maximum];
    const T zero(0.0);
    for (int k = 0; k < maximum; ++k) {
      n[k] = k < count * quad_size ? direction(first, positions, quad + k / quad_size, k % quad_size)
                                   : Vector3<T>{zero, zero, zero};
    }
    rays.find(first, n, count * quad_size, met);
    for (int k = 0; k < count * quad_size; k += quad_size) {
      for (int i = 0; i < lanes && first + i < batch.count; ++i) {
        const MeshHit own[quad_size] = {met[k].hits[i], met[k + 1].hits[i], met[k + 2].hits[i], met[k + 3].hits[i]};
        if (asks_lamp(quad + k / quad_size)) {
          lamp.lit[i].mesh = -1;
        }
        for (int corner = 0; corner < quad_size; ++corner) {
          const SampleHits<T>& sample = met[k + corner];
          const float weight = positions.at(i, quad + k / quad_size, corner).weight;
          add_sample(own, corner, weight, lane(sample.energy, i), lane(sample.momentum, i), lamp, lamp.lit[i], sums[i]);
        }
      }
    }
  }

  ERGO_HD SurfacePoint position_of(const MeshHit& hit) const {
    const ObjectScene& objects = batch.objects;
    return surface_point(objects.appearances[hit.mesh].surface, objects.scene.meshes[hit.mesh], hit.tree_index,
                         hit.weight_1, hit.weight_2);
  }

  //! Returns the change of texture coordinates from a sample to its neighbors in the quad, if they
  //! are on the same mesh.
  ERGO_HD OverlayFootprint footprint_of(const MeshHit (&quad)[quad_size], int k, const SurfacePoint& at) const {
    OverlayFootprint footprint = {};
    const auto difference = [&](int other, float& along_u, float& along_v) {
      if (quad[other].mesh != quad[k].mesh) {
        return;
      }
      const SurfacePoint beside = position_of(quad[other]);
      // A larger change means that the samples are on both sides of an image's seam.
      const float u = beside.u - at.u;
      const float v = beside.v - at.v;
      along_u = ::fabsf(u) < 0.5F ? u : 0.0F;
      along_v = ::fabsf(v) < 0.5F ? v : 0.0F;
    };
    difference(k ^ 1, footprint.s_along_x, footprint.t_along_x);
    difference(k ^ 2, footprint.s_along_y, footprint.t_along_y);
    return footprint;
  }

  ERGO_HD void add_sample(const MeshHit (&quad)[quad_size], int k, float weight, double energy, double momentum,
                          LampSight& lamp, LitMesh& lit, PixelSum& sum) const {
    const MeshHit& hit = quad[k];
    sum.outlines += sum.hits + sum.misses > 0.0F && hit.mesh != sum.last ? 1 : 0;
    sum.last = hit.mesh;
    if (hit.mesh < 0) {
      sum.misses += weight;
      return;
    }
    const ObjectScene& objects = batch.objects;
    const SurfaceAppearance& appearance = objects.appearances[hit.mesh];
    const PlacedMesh& mesh = objects.scene.meshes[hit.mesh];
    const SurfacePoint at = position_of(hit);
    const bool textured = appearance.surface.parts[at.part].textured;
    Vector3<float> light = surface_color(appearance, at, textured ? footprint_of(quad, k, at) : OverlayFootprint{});
    if (appearance.lit && objects.lamp.strength > 0.0) {
      // The samples of a quad share the lamp's light, but may be on different meshes.
      if (lit.mesh != hit.mesh) {
        MeshLimits limits = objects.limits;
        limits.delay = hit.delay;
        const double off_surface = 1e-5 * mesh.size * mesh.tree.radius;
        const LitSurfacePoint position = {hit.point, at.normal, mesh_velocity(mesh, hit.delay),
                                          hit.point + at.lift + off_surface * at.normal};
        lit.mesh = hit.mesh;
        if (lamp.corrected != hit.mesh) {
          lamp.corrected = hit.mesh;
          lamp.corrections = objects.guesses[hit.mesh];
        }
        lit.light =
            lamp_light(spacetime_of(objects.camera), objects.lamp, position, objects.scene, limits, lamp.corrections);
      }
      light = static_cast<float>(illuminance(lit.light, at.normal)) * light;
    }
    if (objects.shifted) {
      const double frequency =
          emitted_frequency(spacetime_of(objects.camera), hit, energy, momentum, mesh_velocity(mesh, hit.delay));
      const double g2 = ::fmin(1.0 / ::fmax(frequency * frequency, 1e-12), 1e6);
      light = static_cast<float>(g2 * g2) * light;
    }
    add_light(hit, at, light, weight, sum);
  }

  ERGO_HD static void add_light(const MeshHit& hit, const SurfacePoint& at, const Vector3<float>& light, float weight,
                                PixelSum& sum) {
    // If the cosine of the angle between two normals is less than this, or the mesh differs, an
    // outline may pass through the pixel.
    constexpr float one_face = 0.9F;
    const Vector3<float> normal = {static_cast<float>(at.normal.x), static_cast<float>(at.normal.y),
                                   static_cast<float>(at.normal.z)};
    const float brightness = light.x + light.y + light.z;
    if (!(sum.hits > 0.0F)) {
      sum.mesh = hit.mesh;
      sum.normal = normal;
      sum.darkest = brightness;
      sum.brightest = brightness;
    }
    sum.several = sum.several || sum.mesh != hit.mesh || dot(normal, sum.normal) < one_face;
    sum.darkest = ::fminf(sum.darkest, brightness);
    sum.brightest = ::fmaxf(sum.brightest, brightness);
    sum.light = sum.light + weight * light;
    sum.time += weight * static_cast<float>(hit.time);
    sum.hits += weight;
    ++sum.met;
  }

  //! Returns whether slices have met an object that may be thinner than they resolve. A single
  //! outline of an object is resolved.
  ERGO_HD static bool is_thin(const PixelSum& sum) {
    constexpr int few = 4;
    return sum.outlines > 1 || (sum.outlines > 0 && sum.met < few);
  }

  ERGO_HD void store(int at, const PixelSum& sum) const {
    // Contrast within a pixel that a display shows as a step.
    constexpr float contrast = 0.05F;
    const float all = sum.hits + sum.misses;
    float* const rgba = batch.rgba + 4 * static_cast<long>(at);
    rgba[0] = sum.light.x / all;
    rgba[1] = sum.light.y / all;
    rgba[2] = sum.light.z / all;
    rgba[3] = sum.hits / all;
    batch.time[at] = sum.hits > 0.0F ? sum.time / sum.hits : 0.0F;
    const bool uneven = sum.brightest - sum.darkest > contrast * sum.brightest;
    const bool several = batch.pattern == PixelPattern::slices
                             ? is_thin(sum)
                             : sum.several || (sum.hits > 0.0F && (sum.misses > 0.0F || uneven));
    batch.content[at] = several ? pixel_of_several : sum.hits > 0.0F ? sum.mesh : pixel_of_nothing;
  }
};

}  // namespace ergodome::inline ERGO_TARGET
