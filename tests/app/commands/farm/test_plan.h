#pragma once

#include "app/commands/farm/farm_plan.h"

namespace ergodome::test {

//! Returns a plan with every kind of step. Its program prints its arguments, one a line.
inline FarmPlan test_plan(const std::filesystem::path& folder) {
  FarmPlan plan;
  plan.name = "moving";
  plan.out = folder / "film";
  plan.work_folder = folder;
  plan.program = "printf '%s\\n'";
  plan.film = {0, 59};
  plan.chunk = 12;
  plan.steps = {{"bake", "baking", {"bake", "moving.toml", "--out=a b.trajectory"}, "--part", {"1/2", "2/2"}},
                {"join", "joining", {"bake", "moving.toml"}, "", {"all"}},
                {"render", "rendering", {"render", "it's.toml"}, "--frames", {"1:12", "13:24", "49:60"}},
                {"film", "verifying", {"render", "moving.toml", "--verify"}, "", {"all"}}};
  return plan;
}

}  // namespace ergodome::test
