#pragma once

#include <algorithm>
#include <cstring>

#include "kernels/lens/look_up_kernel.h"
#include "kernels/lens/tile_look_up.h"

// Reads pixels from lens grids on tiles of the screen, on the CPU.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Number of nodes of a tile along each side.
inline constexpr int tile_nodes = 4;

//! Positions of the nodes in [-1, 1]: the zeros of the Chebyshev polynomial of degree 4.
inline constexpr double tile_node[tile_nodes] = {-0.92387953251128674, -0.38268343236508977, 0.38268343236508977,
                                                 0.92387953251128674};

//! Returns the value at t in [-1, 1] of the cubic that is 1 at node i and 0 at the others.
constexpr double tile_basis(int i, double t) {
  double value = 1.0;
  for (int j = 0; j < tile_nodes; ++j) {
    value *= j == i ? 1.0 : (t - tile_node[j]) / (tile_node[i] - tile_node[j]);
  }
  return value;
}

//! Returns the derivative of tile_basis() by t.
constexpr double tile_basis_slope(int i, double t) {
  double slope = 0.0;
  for (int k = 0; k < tile_nodes; ++k) {
    double term = k == i ? 0.0 : 1.0 / (tile_node[i] - tile_node[k]);
    for (int j = 0; j < tile_nodes; ++j) {
      term *= j == i || j == k ? 1.0 : (t - tile_node[j]) / (tile_node[i] - tile_node[j]);
    }
    slope += term;
  }
  return slope;
}

//! The basis of a tile at the middles of its pixels, and its derivatives per pixel.
template <int Side>
struct TileBasis {
  alignas(64) float value[tile_nodes][tile_side] = {};
  alignas(64) float slope[tile_nodes][tile_side] = {};
  //! Derivatives per pixel at the nodes: node_slope[i][j] is that of basis i at node j.
  float node_slope[tile_nodes][tile_nodes] = {};

  constexpr TileBasis() {
    for (int i = 0; i < tile_nodes; ++i) {
      for (int pixel = 0; pixel < Side; ++pixel) {
        const double t = (2.0 * pixel + 1.0) / Side - 1.0;
        value[i][pixel] = static_cast<float>(tile_basis(i, t));
        slope[i][pixel] = static_cast<float>(tile_basis_slope(i, t) * 2.0 / Side);
      }
      for (int j = 0; j < tile_nodes; ++j) {
        node_slope[i][j] = static_cast<float>(tile_basis_slope(i, tile_node[j]) * 2.0 / Side);
      }
    }
  }
};

template <int Side>
inline constexpr TileBasis<Side> tile_basis_of{};

//! Values at the nodes of a tile, and what they show about it.
struct TileNodes {
  //! Sky direction and frequency ratio: value[j][4 c + i] is component c at column i, row j.
  alignas(64) float value[tile_nodes][16];
  bool dark;  //!< no pixel is lit by the sky
  bool good;  //!< interpolation is accurate; without meaning if `dark`
  //! Estimated error of interpolation [px], if the nodes are far from the shadow's edge and their
  //! leaves are accurate; otherwise negative.
  float error_px;
};

}  // namespace detail

//! Reads the pixels of a batch on tiles; each index is a tile.
template <class T, bool Footprints>
struct LookUpTiles {
  using D = Dual<T>;
  using Ray = std::conditional_t<Footprints, D, T>;
  using S = ScalarOf<T>;
  static constexpr int lanes = RealTraits<T>::lane_count;
  static constexpr int quarter_side = tile_side / 2;
  static constexpr int nodes = detail::tile_nodes * detail::tile_nodes;

  TileLookUpBatch batch;

  ERGO_HD void operator()(int index) const {
    const PixelBatch& pixels = batch.look_up.pixels;
    fill(index, {pixels.out, 0, pixels.first_row, pixels.projection.width_px, false});
  }

  //! Where the pixels of a tile are written.
  struct Target {
    LensPixels out;
    int left;  //!< image position of the first pixel of the channels [px]
    int top;
    int stride;      //!< number of pixels from one row to the next
    bool skip_dark;  //!< writes nothing if no pixel is lit
  };

  //! Returns the image position of the top left pixel of a tile [px].
  ERGO_HD int left_of(int index) const { return index % tile_columns(batch) * tile_side; }
  ERGO_HD int top_of(int index) const { return (first_tile_row(batch) + index / tile_columns(batch)) * tile_side; }

  //! Fills a tile. Returns false if nothing was written, because no pixel is lit.
  ERGO_HD bool fill(int index, const Target& to) const {
    const PixelBatch& pixels = batch.look_up.pixels;
    const int x = left_of(index);
    const int y = top_of(index);
    float error_px = -1.0F;
    const Found found = read_tile<tile_side>(x, y, to, error_px);
    if (found != Found::uneven) {
      return found == Found::smooth || !to.skip_dark;
    }
    // Half the side has a sixteenth of the error, in smooth tiles.
    const bool hopeless = error_px > 64.0F * batch.tolerance_px;
    Runs runs;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const int left = x + quarter % 2 * quarter_side;
      const int top = y + quarter / 2 * quarter_side;
      if (left >= pixels.projection.width_px || top + quarter_side <= pixels.first_row ||
          top >= pixels.first_row + pixels.row_count) {
        continue;
      }
      if (hopeless || read_quarter(left, top, to) == Found::uneven) {
        for (int row = std::max(top, pixels.first_row);
             row < std::min(top + quarter_side, pixels.first_row + pixels.row_count); ++row) {
          runs.x[runs.count] = left;
          runs.y[runs.count] = row;
          ++runs.count;
        }
      }
    }
    if (runs.count > 0) {
      read_runs(runs, to);
    }
    return true;
  }

 private:
  //! What was found about a tile.
  enum class Found { smooth, dark, uneven };

  ERGO_HD Found read_quarter(int x, int y, const Target& to) const {
    Target all = to;
    all.skip_dark = false;
    float error_px = -1.0F;
    return read_tile<quarter_side>(x, y, all, error_px);
  }

  //! Runs of quarter_side pixels in a row.
  struct Runs {
    int x[tile_side * 2];
    int y[tile_side * 2];
    int count = 0;
  };

  //! Fractions of the pixels of a tile that the image covers.
  struct Cover {
    bool whole;  //!< the image covers all pixels; the fractions are not computed
    bool none;
    alignas(64) float inside[tile_side * tile_side];
  };

  //! Returns the image positions of the nodes of a register: nodes first, first + 1, ..., row by
  //! row.
  static ERGO_HD void node_positions(int x, int y, int side, int first, T& x_px, T& y_px) {
    const float half = 0.5F * static_cast<float>(side);
    for (int i = 0; i < lanes; ++i) {
      const int node = first + i;
      set_lane(x_px, i, static_cast<float>(x) + half * (1.0F + static_cast<float>(detail::tile_node[node % 4])));
      set_lane(y_px, i, static_cast<float>(y) + half * (1.0F + static_cast<float>(detail::tile_node[node / 4 % 4])));
    }
  }

  template <int Side>
  ERGO_HD void find_cover(int x, int y, Cover& cover) const {
    const ProjectionOf<float>& projection = batch.look_up.pixels.projection;
    cover.whole = projection.kind != ProjectionKind::dome_fisheye && projection.kind != ProjectionKind::cube;
    cover.none = false;
    if (cover.whole) {
      return;
    }
    const T one(1.0F);
    if (projection.kind == ProjectionKind::dome_fisheye) {
      // The picture of a dome is convex, so its corners decide.
      constexpr float last = static_cast<float>(Side) - 0.5F;
      bool whole = true;
      for (int corner = 0; corner < 4; ++corner) {
        const float at_x = static_cast<float>(x) + (corner % 2 == 0 ? 0.5F : last);
        const float at_y = static_cast<float>(y) + (corner / 2 == 0 ? 0.5F : last);
        whole = whole && image_coverage<float>(projection, at_x, at_y) >= 1.0F;
      }
      cover.whole = whole;
      if (whole) {
        return;
      }
    }
    bool some = false;
    bool part = false;
    for (int first = 0; first < Side * Side; first += lanes) {
      T x_px;
      T y_px;
      for (int i = 0; i < lanes; ++i) {
        const int column = (first + i) % Side;
        const int row = (first + i) / Side;
        set_lane(x_px, i, static_cast<float>(x + column) + 0.5F);
        set_lane(y_px, i, static_cast<float>(y + row) + 0.5F);
      }
      const T inside = image_coverage(projection, x_px, y_px);
      store_lanes(cover.inside, first, Side * Side, inside);
      some = some || any(inside > T(0.0F));
      part = part || any(inside < one);
    }
    cover.whole = !part;
    cover.none = !some;
  }

  //! Computes the values at the nodes of a tile.
  template <int Side>
  ERGO_HD void find_nodes(int x, int y, bool outside, detail::TileNodes& of) const {
    const LookUpBatch& look_up = batch.look_up;
    const PixelBatch& pixels = look_up.pixels;
    const T zero(0.0F);
    const T one(1.0F);
    of.dark = outside;
    of.good = false;
    of.error_px = -1.0F;
    if (outside && pixels.out.frequency_ratio == nullptr) {
      return;
    }
    alignas(64) float sky[9][nodes];
    bool all_dark = true;
    bool all_lit = true;
    bool flagged = false;
    for (int first = 0; first < nodes; first += lanes) {
      T x_px;
      T y_px;
      node_positions(x, y, Side, first, x_px, y_px);
      const Vector3<D> n = observed_direction(pixels, x_px, y_px);
      if (pixels.out.frequency_ratio != nullptr) {
        const T ratio = one / energy_of(camera_of(look_up), Vector3<T>{n.x.value, n.y.value, n.z.value});
        for (int i = 0; i < lanes; ++i) {
          of.value[(first + i) / 4][12 + (first + i) % 4] = lane(ratio, i);
        }
      }
      if (outside) {
        continue;
      }
      const Vector3<D> in_rain = rain_direction(look_up.aberration, n);
      const ChartPosition<D> position = chart_position(look_up.lens.chart, in_rain);
      // No pixel is farther than five pixels from a node, and single pixels are drawn within three
      // pixels of the edge.
      constexpr float margin_px = 8.0F;
      const T square = maximum(in_rain.x.along_x * in_rain.x.along_x + in_rain.y.along_x * in_rain.y.along_x +
                                   in_rain.z.along_x * in_rain.z.along_x,
                               in_rain.x.along_y * in_rain.x.along_y + in_rain.y.along_y * in_rain.y.along_y +
                                   in_rain.z.along_y * in_rain.z.along_y);
      const T distance = position.edge_distance.value;
      const auto far = distance * distance > square * (margin_px * margin_px);
      all_dark = all_dark && !any(!(far & (distance < zero)));
      all_lit = all_lit && !any(!(far & (distance > zero)));
      if (!all_lit) {
        continue;
      }
      const GridSky<T> read = read_blended(look_up.lens, position, distance > zero);
      flagged = flagged || any(read.flagged);
      const auto store = [&](int component, const Vector3<T>& v) {
        const Vector3<T> turned = turned_to_camera(pixels.camera, v);
        store_lanes(sky[component], first, nodes, turned.x);
        store_lanes(sky[component + 1], first, nodes, turned.y);
        store_lanes(sky[component + 2], first, nodes, turned.z);
      };
      store(0, {read.sky.x.value, read.sky.y.value, read.sky.z.value});
      store(3, {read.sky.x.along_x, read.sky.y.along_x, read.sky.z.along_x});
      store(6, {read.sky.x.along_y, read.sky.y.along_y, read.sky.z.along_y});
    }
    if (outside || all_dark) {
      of.dark = true;
      return;
    }
    if (!all_lit || flagged) {
      return;
    }
    for (int component = 0; component < 3; ++component) {
      for (int node = 0; node < nodes; ++node) {
        of.value[node / 4][4 * component + node % 4] = sky[component][node];
      }
    }
    of.error_px = error_of<Side>(sky);
    of.good = of.error_px <= batch.tolerance_px;
  }

  //! Estimates the largest error of interpolation in a tile [px], from the differences between the
  //! polynomial's derivatives and those of the nodes, of which `sky` has x, y and z of the values,
  //! then those along x and y. Returns NaN if a node has no derivatives.
  //!
  //! The error of a cubic through the nodes is c T(t) / 8, with the Chebyshev polynomial T of degree
  //! 4 and a nearly constant c. Its derivative at a node gives c.
  template <int Side>
  static ERGO_HD float error_of(const float (&sky)[9][nodes]) {
    constexpr const detail::TileBasis<Side>& basis = detail::tile_basis_of<Side>;
    alignas(64) float slope_x[3][nodes];
    alignas(64) float slope_y[3][nodes];
    for (int component = 0; component < 3; ++component) {
      const float* value = sky[component];
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
          float x = 0.0F;
          float y = 0.0F;
          for (int k = 0; k < 4; ++k) {
            x += basis.node_slope[k][column] * value[4 * row + k];
            y += basis.node_slope[k][row] * value[4 * k + column];
          }
          slope_x[component][4 * row + column] = x;
          slope_y[component][4 * row + column] = y;
        }
      }
    }
    // |T'| / 8 is 1.3066 at the outer nodes, and 0.5412 at the inner ones.
    constexpr float outer = 0.125F / 1.3065630F * 0.5F * Side;
    constexpr float inner = 0.125F / 0.5411961F * 0.5F * Side;
    constexpr float reach[4] = {outer, inner, inner, outer};
    float worst = 0.0F;
    for (int first = 0; first < nodes; first += lanes) {
      const auto vector = [&](const float(*from)[nodes]) {
        return Vector3<T>{load_lanes<T>(from[0], first, nodes), load_lanes<T>(from[1], first, nodes),
                          load_lanes<T>(from[2], first, nodes)};
      };
      const Vector3<T> a = vector(sky + 3);
      const Vector3<T> b = vector(sky + 6);
      const Vector3<T> normal = cross(a, b);
      const T aa = dot(a, a);
      const T ab = dot(a, b);
      const T bb = dot(b, b);
      const T inverse = S(1) / (dot(normal, normal) + T(1e-30F));
      // Length of the displacement on the screen that explains a difference [px].
      const auto displacement = [&](const Vector3<T>& miss) {
        const T p = dot(a, miss);
        const T q = dot(b, miss);
        const T x = (bb * p - ab * q) * inverse;
        const T y = (aa * q - ab * p) * inverse;
        return sqrt(x * x + y * y);
      };
      T reach_x;
      T reach_y;
      for (int i = 0; i < lanes; ++i) {
        set_lane(reach_x, i, reach[(first + i) % 4]);
        set_lane(reach_y, i, reach[(first + i) / 4]);
      }
      const T error = displacement(vector(slope_x) - a) * reach_x + displacement(vector(slope_y) - b) * reach_y;
      for (int i = 0; i < lanes; ++i) {
        // Keeps NaN, which is not less than anything.
        worst = lane(error, i) <= worst ? worst : lane(error, i);
      }
    }
    return worst;
  }

  //! Fills a tile, unless its pixels must be read one by one. `error_px` receives the estimated
  //! error; negative if there is none.
  template <int Side>
  ERGO_HD Found read_tile(int x, int y, const Target& to, float& error_px) const {
    Cover cover;
    find_cover<Side>(x, y, cover);
    detail::TileNodes of;
    find_nodes<Side>(x, y, cover.none, of);
    error_px = of.error_px;
    if (!of.dark && !of.good) {
      return Found::uneven;
    }
    const Found found = of.dark ? Found::dark : Found::smooth;
    if (of.dark && to.skip_dark) {
      return found;
    }
    const PixelBatch& pixels = batch.look_up.pixels;
    const int begin = std::max(y, pixels.first_row);
    const int end = std::min(y + Side, pixels.first_row + pixels.row_count);
    const int width = std::min(Side, pixels.projection.width_px - x);
    for (int row = begin; row < end; ++row) {
      store_row<Side>(of, cover, to.out, {row - y, (row - to.top) * to.stride + x - to.left, width});
    }
    return found;
  }

  //! A row of a tile.
  struct Row {
    int in_tile;
    int first;  //!< number of its first pixel in the channels
    int width;  //!< number of pixels
  };

  //! Writes the first pixels of a register, which may reach past the tile's right side.
  static ERGO_HD void store_part(float* to, int first, int count, const T& value) {
    if (to == nullptr) {
      return;
    }
    if (count >= lanes) {
      std::memcpy(to + first, &value, sizeof value);
    } else if (count == quarter_side) {
      std::memcpy(to + first, &value, quarter_side * sizeof(float));
    } else {
      for (int i = 0; i < count; ++i) {
        to[first + i] = lane(value, i);
      }
    }
  }

  template <int Side>
  ERGO_HD void store_row(const detail::TileNodes& of, const Cover& cover, const LensPixels& out, const Row& row) const {
    constexpr const detail::TileBasis<Side>& basis = detail::tile_basis_of<Side>;
    const T zero(0.0F);
    // Sums along y first: value[4 c + i] is component c at column i of the nodes.
    alignas(64) float value[16];
    alignas(64) float slope[16];
    for (int part = 0; part < 16; part += lanes) {
      T sum = zero;
      T rate = zero;
      for (int j = 0; j < 4; ++j) {
        const T at = load_lanes<T>(of.value[j], part, 16);
        sum = sum + at * basis.value[j][row.in_tile];
        rate = rate + at * basis.slope[j][row.in_tile];
      }
      store_lanes(value, part, 16, sum);
      store_lanes(slope, part, 16, rate);
    }
    for (int column = 0; column < row.width; column += lanes) {
      const int first = row.first + column;
      const int count = row.width - column;
      T along[4];
      T rate_along[4];
      for (int i = 0; i < 4; ++i) {
        along[i] = load_lanes<T>(basis.value[i], column, tile_side);
        rate_along[i] = load_lanes<T>(basis.slope[i], column, tile_side);
      }
      const auto sum = [&](const float* nodes_of, const T(&weights)[4]) {
        return weights[0] * nodes_of[0] + weights[1] * nodes_of[1] + weights[2] * nodes_of[2] +
               weights[3] * nodes_of[3];
      };
      T inside(of.dark ? 0.0F : 1.0F);
      if (!cover.whole && !of.dark) {
        inside = load_lanes<T>(cover.inside, row.in_tile * Side + column, tile_side * tile_side);
      }
      store_part(out.coverage, first, count, inside);
      store_part(out.error_estimate, first, count, zero);
      store_part(out.steps, first, count, zero);
      if (out.frequency_ratio != nullptr) {
        store_part(out.frequency_ratio, first, count, sum(value + 12, along));
      }
      // As store_sky() writes where no light arrives.
      const T elsewhere(Footprints ? 0.57735027F : 0.0F);
      const T wide(1e3F);
      if (of.dark) {
        for (int c = 0; c < 3; ++c) {
          store_part(out.sky[c], first, count, elsewhere);
          if constexpr (Footprints) {
            store_part(out.sky_along_x[c], first, count, wide);
            store_part(out.sky_along_y[c], first, count, wide);
          }
        }
        continue;
      }
      const auto seen = inside > zero;
      Vector3<T> sky = {sum(value, along), sum(value + 4, along), sum(value + 8, along)};
      // One step of Newton's method makes it a unit vector.
      const T scale = S(1.5) - S(0.5) * dot(sky, sky);
      const T parts[3] = {sky.x * scale, sky.y * scale, sky.z * scale};
      for (int c = 0; c < 3; ++c) {
        store_part(out.sky[c], first, count, select(seen, parts[c], elsewhere));
        if constexpr (Footprints) {
          store_part(out.sky_along_x[c], first, count, select(seen, sum(value + 4 * c, rate_along), wide));
          store_part(out.sky_along_y[c], first, count, select(seen, sum(slope + 4 * c, along), wide));
        }
      }
    }
  }

  //! Pixels of flagged leaves, which are traced together: few registers of a run have more than one
  //! or two of them.
  struct FlaggedPixels {
    static constexpr int parts = Footprints ? 9 : 3;
    alignas(64) float direction[parts][tile_side * tile_side + lanes];  //!< with derivatives per pixel
    int element[tile_side * tile_side];                                 //!< number of the pixel in the channels
    int count = 0;

    //! Appends the lanes in `bits` of a register whose first pixel is element `first`.
    ERGO_HD void append(const Vector3<Ray>& n, unsigned bits, int first) {
      const ChosenLanes<T> chosen(bits);
      const auto store = [&](int part, const Ray& component) {
        if constexpr (Footprints) {
          chosen.store(direction[part] + count, component.value);
          chosen.store(direction[part + 3] + count, component.along_x);
          chosen.store(direction[part + 6] + count, component.along_y);
        } else {
          chosen.store(direction[part] + count, component);
        }
      };
      store(0, n.x);
      store(1, n.y);
      store(2, n.z);
      for (int i = 0; i < lanes; ++i) {
        if ((bits >> static_cast<unsigned>(i) & 1U) != 0) {
          element[count++] = first + i;
        }
      }
    }

    //! Returns the directions of pixels first, first + 1, ...
    [[nodiscard]] ERGO_HD Vector3<Ray> directions(int first) const {
      const auto load = [&](int part) {
        const auto of = [&](int i) { return load_lanes<T>(direction[i], first, count); };
        if constexpr (Footprints) {
          return D(of(part), of(part + 3), of(part + 6));
        } else {
          return of(part);
        }
      };
      return {load(0), load(1), load(2)};
    }

    //! Writes the lanes in `bits` to a channel, if it is requested.
    ERGO_HD void scatter(float* channel, const T& value, unsigned bits, int first) const {
      for (int i = 0; channel != nullptr && i < lanes; ++i) {
        if ((bits >> static_cast<unsigned>(i) & 1U) != 0) {
          channel[element[first + i]] = lane(value, i);
        }
      }
    }
  };

  //! Traces pixels and writes those that arrive to the channels.
  ERGO_HD void trace_flagged(const LookUpPixels<T, Footprints>& one_by_one, const FlaggedPixels& flagged) const {
    const LensPixels& out = one_by_one.batch.pixels.out;
    const T zero(0.0F);
    for (int first = 0; first < flagged.count; first += lanes) {
      const unsigned traced = bits_within<T>(first, flagged.count);
      Vector3<Ray> sky = {Ray(zero), Ray(zero), Ray(zero)};
      T steps = zero;
      T estimate = zero;
      const unsigned reached =
          mask_bits(one_by_one.trace(flagged.directions(first), mask_from_bits<T>(traced), sky, steps, estimate));
      const auto scatter = [&](float* const(&to)[3], const Vector3<T>& v) {
        const Vector3<T> turned = turned_to_camera(batch.look_up.pixels.camera, v);
        flagged.scatter(to[0], turned.x, reached, first);
        flagged.scatter(to[1], turned.y, reached, first);
        flagged.scatter(to[2], turned.z, reached, first);
      };
      scatter(out.sky, {value_of(sky.x), value_of(sky.y), value_of(sky.z)});
      if constexpr (Footprints) {
        scatter(out.sky_along_x, {sky.x.along_x, sky.y.along_x, sky.z.along_x});
        scatter(out.sky_along_y, {sky.x.along_y, sky.y.along_y, sky.z.along_y});
      }
      flagged.scatter(out.steps, steps, traced, first);
      flagged.scatter(out.error_estimate, estimate, traced, first);
    }
  }

  //! Reads runs of pixels one by one, and traces those of flagged leaves.
  [[gnu::noinline]] ERGO_HD void read_runs(const Runs& runs, const Target& into) const {
    constexpr int most = tile_side * tile_side;
    constexpr int channels = 13;
    alignas(64) float memory[channels][most];
    const PixelBatch& pixels = batch.look_up.pixels;
    LookUpPixels<T, Footprints> one_by_one{batch.look_up};
    LensPixels& to = one_by_one.batch.pixels.out;
    to = into.out;
    // All pixels are valid elements of the scratch memory, whatever the width of the image.
    one_by_one.batch.pixels.row_count = most;
    int used = 0;
    const float* source[channels];
    float* target[channels];
    const auto redirect = [&](float*& channel) {
      if (channel != nullptr) {
        target[used] = channel;
        source[used] = memory[used];
        channel = memory[used];
        ++used;
      }
    };
    for (int axis = 0; axis < 3; ++axis) {
      redirect(to.sky[axis]);
      redirect(to.sky_along_x[axis]);
      redirect(to.sky_along_y[axis]);
    }
    redirect(to.coverage);
    redirect(to.frequency_ratio);
    redirect(to.steps);
    redirect(to.error_estimate);
    const int pixel_count = runs.count * quarter_side;
    FlaggedPixels flagged;
    for (int first = 0; first < pixel_count; first += lanes) {
      T x_px;
      T y_px;
      for (int i = 0; i < lanes; ++i) {
        const int run = std::min((first + i) / quarter_side, runs.count - 1);
        set_lane(x_px, i, static_cast<float>(runs.x[run] + (first + i) % quarter_side) + 0.5F);
        set_lane(y_px, i, static_cast<float>(runs.y[run]) + 0.5F);
      }
      one_by_one.look_up_deferring(ViewedPixels<T>(pixels, first, x_px, y_px),
                                   [&](const Vector3<Ray>& n, const MaskOf<T>& traced) {
                                     flagged.append(n, mask_bits(traced) & bits_within<T>(first, pixel_count), first);
                                   });
    }
    trace_flagged(one_by_one, flagged);
    for (int run = 0; run < runs.count; ++run) {
      const int first = (runs.y[run] - into.top) * into.stride + runs.x[run] - into.left;
      const int count = std::min(quarter_side, pixels.projection.width_px - runs.x[run]);
      for (int channel = 0; channel < used; ++channel) {
        std::memcpy(target[channel] + first, source[channel] + run * quarter_side,
                    static_cast<std::size_t>(count) * sizeof(float));
      }
    }
  }
};

template <class T, class Action>
void dispatch(const TileLookUpBatch& batch, const Action& action) {
  if (has_footprints(batch.look_up.pixels.out)) {
    action(LookUpTiles<T, true>{batch});
  } else {
    action(LookUpTiles<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
