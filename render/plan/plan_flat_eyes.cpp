#include "kernels/launch/launch.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/lens/grid/edge_table.h"
#include "render/passes/disk/disk_grids.h"
#include "render/plan/planner.h"

// Eyes of the stereo model `flat`: the sky is drawn once for the head; disk, shells and objects are
// drawn for each eye.
namespace ergodome {

bool Planner::eyes_are_flat() const {
  return shown_ > 1 && show_.stereo.model == StereoModel::flat && show_.stereo.baseline > 0.0;
}

bool Planner::eyes_are_together_at_times() const { return !(least_.stereo.baseline > 0.0); }

void Planner::flat_pass(const std::string& name, const std::string& reason, bool if_needed) {
  pass(name, WorkMoment::picture, shown_ * blocks_, shown_ * pixels_, reason + ", " + why("stereo.model"),
       if_needed || eyes_are_together_at_times());
}

void Planner::plan_flat_near_field() {
  constexpr long places = FlatShadow::spokes * FlatShadow::depths;
  const bool certain = (always_.disk || always_.shells || always_.traced_objects) && !eyes_are_together_at_times();
  buffer("flat shadow", WorkMoment::picture, certain ? (edge_points + places) * long{sizeof(float)} : 0,
         why("stereo.model"));
  if (request_.backend != Backend::cpu) {
    buffer("flat eye's picture", WorkMoment::start, 0, why("stereo.model"));
  }
  pass("see_horizon", WorkMoment::picture, certain ? shown_ : 0, certain ? shown_ * places : 0, why("stereo.model"),
       !certain);
  const bool disk_goes = needs_.disk && (!always_.disk || disk_edges_move());
  const bool changes = disk_goes || needs_.shells != always_.shells;
  const std::string with_shells = needs_.disk ? why("disk") + ", " + why("shells") : why("shells");
  if (needs_.shells) {
    flat_pass(flat_eyes_name(needs_.disk ? DiskDrawing::plain : DiskDrawing::none, true), with_shells, changes);
    if (disk_goes) {
      flat_pass(flat_eyes_name(DiskDrawing::none, true), why("shells"), true);
    }
  }
  if (needs_.disk && !always_.shells) {
    plan_flat_disk(changes);
  }
}

void Planner::plan_flat_disk(bool if_needed) {
  const bool asked = request_.lens == LensChoice::live;
  const auto pixels = static_cast<double>(pixels_);
  const bool may_make = may_read_disk_grid(request_.backend, request_.lens, show_.grid_scheme) &&
                        (asked || is_worth_a_disk_grid(request_.backend, pixels));
  // As for other disks: some have no grid, and for others the grid leaves most pixels to rays at
  // some positions.
  const bool certain = asked && !show_.disk->plunging;
  const bool pattern_changes = needs_.disk_pattern != always_.disk_pattern;
  const std::string reason = why(needs_.disk_pattern ? "disk.pattern" : "disk");
  if (may_make) {
    const std::string with_budget = reason + ", " + why("quality.budget_px");
    plan_disk_grid(with_budget, if_needed || !certain || eyes_are_together_at_times());
    for (const bool pattern : {true, false}) {
      if (pattern ? needs_.disk_pattern : !always_.disk_pattern) {
        flat_pass(flat_look_up_name(pattern ? DiskDrawing::pattern : DiskDrawing::plain), with_budget,
                  if_needed || !certain || pattern_changes);
      }
    }
  }
  if (!may_make || !certain || needs_.traced_objects) {
    // Pixels that show objects need rays beside a grid.
    flat_pass(flat_eyes_name(DiskDrawing::plain, false),
              needs_.traced_objects ? reason + ", " + why("objects") : reason,
              if_needed || (may_make && !always_.traced_objects));
  }
}

}  // namespace ergodome
