#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/show/animated_show.h"
#include "content/show/show_schema.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Rounds a positive number up to six digits, so that the printed value is not below it.
double six_digits_above(double value) {
  const double last = std::pow(10.0, std::floor(std::log10(value)) - 5.0);
  return std::ceil(value / last) * last;
}

//! Computes the radius of the innermost stable circular orbit, or of the horizon if `plunging`, at
//! the minimum and at the maximum spin of the show. Returns the smaller and the larger of the two.
NumberLimits innermost_radii(const Show& show, bool plunging) {
  NumberLimits limits{1e9, 0.0};
  for (const Spacetime spacetime : {spacetime_of(show_at_least(show)), spacetime_of(show_at_most(show))}) {
    const double r = plunging ? horizon_radius(spacetime) : innermost_stable_radius(spacetime, 1.0);
    limits = {std::min(limits.minimum, r), std::max(limits.maximum, r)};
  }
  return limits;
}

constexpr auto unused_without_clouds = [](const Show& /*show*/, const DiskSettings& disk) {
  return disk.pattern == DiskPattern::none ? "is used only with pattern = \"procedural\"" : nullptr;
};

constexpr std::array profile_names = {"page_thorne", "uniform"};
constexpr std::array pattern_names = {"none", "procedural"};

constexpr auto read_inner = [](TomlTable& table, DiskSettings& disk) {
  const toml::node* const inner = table.node("inner");
  if (inner != nullptr && inner->is_string()) {
    table.choice("inner", 0, {"isco"});
  } else if (inner != nullptr) {
    disk.inner = table.number("inner", 6.0, 1.0, 1e6);
  }
};

constexpr auto write_inner = [](toml::table& table, const DiskSettings& disk) {
  if (disk.inner) {
    table.insert("inner", *disk.inner);
  } else {
    table.insert("inner", "isco");
  }
};

constexpr auto check_plunging = [](const TomlTable& table, const DiskSettings& disk) {
  if (disk.plunging && disk.profile == DiskProfile::page_thorne) {
    throw table.error_at("plunging",
                         "has no effect: profile = \"page_thorne\" has no light inside the innermost stable orbit",
                         "write profile = \"uniform\"");
  }
  if (disk.plunging && !disk.inner) {
    throw table.error_at("plunging", "has no effect: the disk ends at the innermost stable orbit",
                         "set inner to a radius inside that orbit");
  }
};

constexpr auto keys_of_disk = keys_of<DiskSettings>(
    other<DiskSettings>("inner", "Inner edge. `\"isco\"` is the innermost stable circular orbit along +φ.")
        .by(read_inner, write_inner)
        .fixed("to let it follow the spin, write inner = \"isco\"")
        .page({.type = "`\"isco\"` or number", .unit = "M", .otherwise = "`\"isco\"`", .bounds = "1 to 1e6"}),
    key<&DiskSettings::outer>("outer", "Outer edge.")
        .range(1.0, 1e6, "M")
        .animated()
        .page({.bounds = "1 to 1e6, above `inner`"}),
    key<&DiskSettings::profile>("profile", "[Temperature at each radius](#temperature-profiles).").words(profile_names),
    key<&DiskSettings::temperature_k>("temperature_K", "Highest temperature of the disk.")
        .range(300.0, 1e7, "K")
        .animated(),
    key<&DiskSettings::exposure>("exposure", "Emitted light at the hottest radius, before any frequency shift.")
        .range(0.0, 1e12, "display white")
        .animated(),
    key<&DiskSettings::opacity>("opacity",
                                "Opacity of each crossing of the disk. The background shows through the rest.")
        .range(0.0, 1.0)
        .animated(),
    key<&DiskSettings::limb_darkening>("limb_darkening",
                                       "`true`: the disk emits [less light at grazing angles](#limb-darkening)."),
    key<&DiskSettings::plunging>(
        "plunging", "`true`: [matter falls in](#plunging-matter) from the innermost stable orbit to `inner`.")
        .after(check_plunging),
    key<&DiskSettings::pattern>("pattern", "`\"procedural\"`: [clouds](#clouds) that orbit with the matter.")
        .words(pattern_names),
    key<&DiskSettings::contrast>("contrast", "Contrast of the clouds, as the logarithm of their brightness.")
        .range(0.0, 4.0)
        .animated()
        .unused_if(unused_without_clouds),
    key<&DiskSettings::speed>("speed", "Speed of the clouds: M of the hole's time in one second of the show.")
        .range(-1e6, 1e6, "M/s")
        .fixed("changing it would make the clouds jump")
        .unused_if(unused_without_clouds));

}  // namespace

constinit const KeyTable<DiskSettings> disk_keys = keys_of_disk;

void check_disk(const toml::table& table, const std::string& file, const Show& show) {
  const TomlTable reader(table, file, "disk");
  const DiskSettings& disk = *show.disk;
  const NumberLimits first = innermost_radii(show, disk.plunging);
  if (disk.inner && *disk.inner < first.minimum) {
    throw reader.error_at("inner",
                          fmt::format("is {} M, {}", *disk.inner,
                                      disk.plunging ? "inside the horizon" : "inside the innermost stable orbit"),
                          fmt::format("choose {:.6g} or more{}", six_digits_above(first.minimum),
                                      disk.plunging ? "" : ", or plunging = true with profile = \"uniform\""));
  }
  const double inner = disk.inner.value_or(first.minimum);
  if (!(disk.outer > inner)) {
    throw reader.has("outer")
        ? reader.error_at("outer",
                          fmt::format("is {:.6g} M, but the disk's inner edge is at {:.6g} M", disk.outer, inner),
                          "choose an outer edge beyond the inner one")
        : reader.error_at("inner",
                          fmt::format("is {:.6g} M, but the disk's outer edge is at {:.6g} M", inner, disk.outer),
                          "choose an outer edge beyond the inner one");
  }
}

}  // namespace ergodome
