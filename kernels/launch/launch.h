#pragma once

#include <string>

#include "kernels/launch/kernel_table.h"
#include "kernels/stars/draw_stars.h"
#include "kernels/stars/search/patch_search.h"
#include "kernels/stars/search/star_twins.h"
#include "kernels/stars/star_sheet.h"

namespace ergodome {

//! Where kernels run.
enum class Backend { cpu, cuda };

//! Why CUDA cannot be used here, or nothing (nullptr) when it can. Asked once; any error of the driver counts as "no GPU".
const char* cuda_unavailable_reason();

//! Traces a batch. With Backend::cuda the arrays are device memory and the call returns after the device has
//! finished, unless the thread works in order (DeviceWorkInOrder).
//!
//! The closed form is not a SIMD method: it runs one ray at a time.
void trace_rays(Backend backend, const RayBatch<float>& batch);
void trace_rays(Backend backend, const RayBatch<double>& batch);

//! Traces rays of an eye that turns with the direction, on the CPU alone; see OmniRayBatch.
void trace_rays(const OmniRayBatch& batch);

//! Traces the pixels of an image; see PixelBatch.
void trace_pixels(Backend backend, const PixelBatch& batch);

//! Traces the pixels of an image whose every pixel has its own camera; see OmniBatch.
void trace_omni_pixels(Backend backend, const OmniBatch& batch);

//! Traces nodes of a lens grid; see NodeBatch. In double on the CPU alone: fine grids are baked, not made in a frame's time.
void trace_nodes(Backend backend, const NodeBatch<float>& batch);
void trace_nodes(const NodeBatch<double>& batch);

//! Compares cells of a lens grid with traced rays; see CheckBatch. In double on the CPU alone.
void check_cells(Backend backend, const CheckBatch<float>& batch);
void check_cells(const CheckBatch<double>& batch);

//! The same for an eye that turns with the direction, on the CPU alone.
void trace_nodes(const OmniNodeBatch& batch);
void check_cells(const OmniCheckBatch& batch);

//! Compares a lens between stations with traced rays; see BlendCheckBatch. On the CPU alone.
void check_blend(const BlendCheckBatch& batch);

//! Reads the pixels of an image from a lens grid; see LookUpBatch.
void look_up_pixels(Backend backend, const LookUpBatch& batch);

//! The same for both eyes at once, on the processor.
void look_up_pixels(const LookUpPairBatch& batch);

//! The same for an eye that turns with the direction, on the CPU alone.
void look_up_pixels(const OmniLookUpBatch& batch);

//! Reads rays from a lens grid; see LookUpRaysBatch.
void look_up_rays(Backend backend, const LookUpRaysBatch<double>& batch);

//! Reads rays from quadtree grids; see QuadtreeRaysBatch.
void read_quadtree_rays(Backend backend, const QuadtreeRaysBatch& batch);

//! Reads the pixels of an image from quadtree grids; see QuadtreePixelBatch. On the CPU alone, as the baseline that it is.
void read_quadtree_pixels(const QuadtreePixelBatch& batch);

//! So many images are followed in the time of one.
struct StarImageLanes {
  int in_float;
  int in_double;
};

StarImageLanes star_image_lanes();

//! Finds images of stars on the processor, in host memory, on the thread that calls; see StarImageBatch. Who calls counts them.
void find_star_images(const StarImageBatch<float>& batch);
void find_star_images(const StarImageBatch<double>& batch);
void find_star_images(const OmniStarBatch<float>& batch);
void find_star_images(const OmniStarBatch<double>& batch);

//! The search for images of stars, on the thread that calls: what patches do to light, stars in a part of the sky, on which side of
//! patches' borders stars are, where patches that are one to one hold them, and, halving them, where others do; and what an observer sees
//! there. See the batches.
void measure_patch(const PatchMeasureBatch& batch);
void search_stars(const StarSearchBatch& batch);
void find_patch_sides(const PatchSideBatch& batch);
void invert_patches(const PatchNewtonBatch& batch);
void see_patches(const SeePatchesBatch& batch);
void halve_parts(const HalvePartsBatch& batch);
void solve_parts(const SolvePartsBatch& batch);
void observe_places(const ObservedPlaceBatch& batch);

//! What shading the sky is counted by; each variant is compiled apart ("shade_sky, point, luminance").
std::string shading_name(SkyFilter filter, SkyShift shift, bool brightening);

//! Turns lens pixels into light or a heat map; see ShadeBatch.
void shade_pixels(Backend backend, const ShadeBatch& batch);

//! What drawing the near field is counted by; each variant is compiled apart. nullptr where there is nothing to draw.
const char* near_field_name(DiskDrawing disk, bool shells);

//! Draws disk and shells over a picture of the sky, by a ray for each pixel that may see them; see NearFieldBatch.
void draw_near_field(Backend backend, const NearFieldBatch& batch);

//! The same for eyes of the stereo model `flat`.
const char* flat_eyes_name(DiskDrawing disk, bool shells);
void draw_flat_eyes(Backend backend, const FlatEyeBatch& batch);

//! By a grid; on the CPU alone.
const char* flat_look_up_name(DiskDrawing disk);
void look_up_flat_eyes(const FlatEyeLookUpBatch& batch);

//! What grids of a camera's sky that hold the disk's images need: tracing their nodes, comparing their cells with traced rays, drawing the
//! disk from them; see the batches. On the CPU alone.
void trace_disk_nodes(const DiskNodeBatch& batch);
void check_disk_cells(const DiskCheckBatch& batch);
void check_disk_grid(const DiskGridCheckBatch& batch);
void look_up_disk(const DiskLookUpBatch& batch);

//! What drawing the disk from a grid is counted by.
const char* disk_look_up_name(DiskDrawing disk);

//! Marks tiles of an image in which objects may be seen, and looks at them in pixels; see the batches.
void mark_object_tiles(Backend backend, const ObjectTileBatch& batch);
void look_at_objects(Backend backend, const ObjectPixelBatch& batch);

//! The same for an eye of the stereo model `flat`.
void mark_object_tiles(Backend backend, const FlatObjectTileBatch& batch);
void look_at_objects(Backend backend, const FlatObjectPixelBatch& batch);

//! Lays them over a picture that has neither disk nor shells.
void lay_objects(Backend backend, const LayObjectsBatch& batch);

//! A step of putting together images that were found; see StarTwinBatch.
void join_star_images(Backend backend, const StarTwinBatch& batch, StarTwinStep step);

//! Makes points of `count` images; see StarPointBatch.
void place_star_images(Backend backend, const StarPointBatch& batch, int count);

//! A step of finding which points shine on which tiles; see StarTileBatch.
void place_stars(Backend backend, const StarTileBatch& batch, StarTileStep step);

//! Sums of all counts before each, and that of all in the end: `count` + 1 numbers. Both lie in the backend's memory.
void sum_counts(Backend backend, const std::int32_t* counts, int count, std::int32_t* sums);

//! Adds the light of stars to a picture in the backend's memory; see StarLightBatch. `points`: how many there are.
void draw_stars(Backend backend, const StarLightBatch& batch, long points);

//! A step of the search for images of stars, `count` patches, pairs or parts; see PatchSearchBatch. `depth`: halvings of the parts that are halved.
void search_patches(Backend backend, const PatchSearchBatch& batch, PatchSearchStep step, int count, int depth = 0);

//! Draws an overlay over a picture; see OverlayBatch.
void draw_overlay(Backend backend, const OverlayBatch& batch);

//! Makes a master's light for projectors, its averages, and what a projector is sent of it; see the batches. A device does one after the other, and
//! calls do not wait for it: wait_for_device() does.
void tone_tiles(Backend backend, const ToneBatch& batch);
void average_tiles(Backend backend, const AverageBatch& batch);
void warp_pixels(Backend backend, const WarpBatch& batch);

//! Waits for all that the calling thread has launched. Throws Error where a launch failed.
void wait_for_device(Backend backend);

}  // namespace ergodome
