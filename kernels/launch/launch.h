#pragma once

#include <string>

#include "kernels/launch/kernel_table.h"
#include "kernels/stars/draw_stars.h"
#include "kernels/stars/search/patch_search.h"
#include "kernels/stars/search/star_twins.h"
#include "kernels/stars/star_sheet.h"

// Launches of all kernels, on the CPU or on a GPU.
namespace ergodome {

//! Where kernels run.
enum class Backend { cpu, cuda };

//! Returns why CUDA cannot be used here, or nullptr if it can. Determined once; any driver error
//! counts as no GPU.
const char* cuda_unavailable_reason();

//! Traces a batch. With Backend::cuda the arrays are device memory, and the call returns after the
//! device has finished, unless the thread works in order (DeviceWorkInOrder).
//!
//! The closed form is not a SIMD method: it runs one ray at a time.
void trace_rays(Backend backend, const RayBatch<float>& batch);
void trace_rays(Backend backend, const RayBatch<double>& batch);

//! Traces rays of an omnidirectional eye, on the CPU only; see OmniRayBatch.
void trace_rays(const OmniRayBatch& batch);

//! Traces the pixels of an image; see PixelBatch.
void trace_pixels(Backend backend, const PixelBatch& batch);

//! Traces the pixels of an image in which every pixel has its own camera; see OmniBatch.
void trace_omni_pixels(Backend backend, const OmniBatch& batch);

//! Traces nodes of a lens grid; see NodeBatch. In double on the CPU only: fine grids are baked, not
//! made for one frame.
void trace_nodes(Backend backend, const NodeBatch<float>& batch);
void trace_nodes(const NodeBatch<double>& batch);

//! Compares cells of a lens grid with traced rays; see CheckBatch. In double on the CPU only.
void check_cells(Backend backend, const CheckBatch<float>& batch);
void check_cells(const CheckBatch<double>& batch);

//! Traces nodes and compares cells for an omnidirectional eye, on the CPU only.
void trace_nodes(const OmniNodeBatch& batch);
void check_cells(const OmniCheckBatch& batch);

//! Compares a lens between stations with traced rays; see BlendCheckBatch. On the CPU only.
void check_blend(const BlendCheckBatch& batch);

//! Reads the pixels of an image from a lens grid; see LookUpBatch.
void look_up_pixels(Backend backend, const LookUpBatch& batch);

//! Reads the pixels of both eyes' images at once, on the CPU only.
void look_up_pixels(const LookUpPairBatch& batch);

//! Reads the pixels of an image of an omnidirectional eye, on the CPU only.
void look_up_pixels(const OmniLookUpBatch& batch);

//! Reads rays from a lens grid; see LookUpRaysBatch.
void look_up_rays(Backend backend, const LookUpRaysBatch<double>& batch);

//! Reads rays from quadtree grids; see QuadtreeRaysBatch.
void read_quadtree_rays(Backend backend, const QuadtreeRaysBatch& batch);

//! Reads the pixels of an image from quadtree grids; see QuadtreePixelBatch. On the CPU only, as it
//! is a baseline.
void read_quadtree_pixels(const QuadtreePixelBatch& batch);

//! Number of images of stars that are computed in the time of one.
struct StarImageLanes {
  int in_float;
  int in_double;
};

StarImageLanes star_image_lanes();

//! Finds lensed images of stars on the CPU, in host memory, on the calling thread; see
//! StarImageBatch. The caller counts the work.
void find_star_images(const StarImageBatch<float>& batch);
void find_star_images(const StarImageBatch<double>& batch);
void find_star_images(const OmniStarBatch<float>& batch);
void find_star_images(const OmniStarBatch<double>& batch);

//! Steps of the search for lensed images of stars, on the calling thread; see the batches. They
//! measure what patches do to light, search the stars of a region of the sky, and find the side of
//! patches' borders on which stars are. They invert the patches that are one to one, express the
//! others relative to their stars, halve these and solve their parts. Last, they compute what an
//! observer sees there.
void measure_patch(const PatchMeasureBatch& batch);
void search_stars(const StarSearchBatch& batch);
void find_patch_sides(const PatchSideBatch& batch);
void invert_patches(const PatchNewtonBatch& batch);
void see_patches(const SeePatchesBatch& batch);
void halve_parts(const HalvePartsBatch& batch);
void solve_parts(const SolvePartsBatch& batch);
void observe_places(const ObservedPlaceBatch& batch);

//! Returns the counter's name for a variant of shading the sky; each variant is compiled separately
//! ("shade_sky, point, luminance").
std::string shading_name(SkyFilter filter, SkyShift shift, bool brightening);

//! Converts lens pixels to light or to a heat map; see ShadeBatch.
void shade_pixels(Backend backend, const ShadeBatch& batch);

//! Returns the counter's name for a variant of drawing the near field; each variant is compiled
//! separately. Returns nullptr if there is nothing to draw.
const char* near_field_name(DiskDrawing disk, bool shells);

//! Draws disk and shells over a picture of the sky, by one ray for each pixel that may see them;
//! see NearFieldBatch.
void draw_near_field(Backend backend, const NearFieldBatch& batch);

//! Does the same for eyes of the stereo model `flat`.
const char* flat_eyes_name(DiskDrawing disk, bool shells);
void draw_flat_eyes(Backend backend, const FlatEyeBatch& batch);

//! Draws the disk for such eyes from a grid, on the CPU only.
const char* flat_look_up_name(DiskDrawing disk);
void look_up_flat_eyes(const FlatEyeLookUpBatch& batch);

//! Grids of a camera's sky with the images of the disk: trace their nodes, compare their cells with
//! traced rays, and draw the disk from them; see the batches. On the CPU only.
void trace_disk_nodes(const DiskNodeBatch& batch);
void check_disk_cells(const DiskCheckBatch& batch);
void check_disk_grid(const DiskGridCheckBatch& batch);
void look_up_disk(const DiskLookUpBatch& batch);

//! Returns the counter's name for drawing the disk from a grid.
const char* disk_look_up_name(DiskDrawing disk);

//! Marks tiles of an image in which objects may be visible, and traces objects in pixels; see the
//! batches.
void mark_object_tiles(Backend backend, const ObjectTileBatch& batch);
void look_at_objects(Backend backend, const ObjectPixelBatch& batch);

//! Does the same for an eye of the stereo model `flat`.
void mark_object_tiles(Backend backend, const FlatObjectTileBatch& batch);
void look_at_objects(Backend backend, const FlatObjectPixelBatch& batch);

//! Composes objects over a picture that has neither disk nor shells.
void lay_objects(Backend backend, const LayObjectsBatch& batch);

//! Runs a step of grouping found images by star, without duplicates; see StarTwinBatch.
void join_star_images(Backend backend, const StarTwinBatch& batch, StarTwinStep step);

//! Makes points of `count` images; see StarPointBatch.
void place_star_images(Backend backend, const StarPointBatch& batch, int count);

//! Runs a step of assigning points to the tiles on which they shine; see StarTileBatch.
void place_stars(Backend backend, const StarTileBatch& batch, StarTileStep step);

//! Computes the prefix sums of counts, and their total at the end: `count` + 1 values. Both arrays
//! are in the backend's memory.
void sum_counts(Backend backend, const std::int32_t* counts, int count, std::int32_t* sums);

//! Adds the light of stars to a picture in the backend's memory; see StarLightBatch. `points` is
//! their number.
void draw_stars(Backend backend, const StarLightBatch& batch, long points);

//! Runs a step of the search for lensed images of stars on `count` patches, pairs or parts; see
//! PatchSearchBatch. `depth` is the number of halvings of the parts to halve.
void search_patches(Backend backend, const PatchSearchBatch& batch, PatchSearchStep step, int count, int depth = 0);

//! Draws an overlay over a picture; see OverlayBatch.
void draw_overlay(Backend backend, const OverlayBatch& batch);

//! Computes a master's light for projectors, its averages, and the values that a projector is sent;
//! see the batches. A device runs them in order, and the calls do not wait for it: see
//! wait_for_device().
void tone_tiles(Backend backend, const ToneBatch& batch);
void average_tiles(Backend backend, const AverageBatch& batch);
void warp_pixels(Backend backend, const WarpBatch& batch);

//! Waits for everything that the calling thread has launched. Throws Error if a launch failed.
void wait_for_device(Backend backend);

}  // namespace ergodome
