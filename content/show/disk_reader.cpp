#include "content/show/disk_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/files/toml_table.h"
#include "content/show/animated_show.h"
#include "content/show/own_number.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Rounds a positive number up to six digits, so that the printed value is not below it.
double six_digits_above(double value) {
  const double last = std::pow(10.0, std::floor(std::log10(value)) - 5.0);
  return std::ceil(value / last) * last;
}

constexpr double least_r = 1.0;
constexpr double greatest_r = 1e6;

//! Returns the minimum and maximum over the show of the smallest radius at which disk matter can
//! exist.
NumberLimits innermost_radii(const Show& show, bool plunging) {
  NumberLimits limits{1e9, 0.0};
  for (const double spin : {show_at_least(show).spin, show_at_most(show).spin}) {
    const double r = plunging ? horizon_radius(spin) : innermost_stable_radius(spin, 1.0);
    limits = {std::min(limits.least, r), std::max(limits.greatest, r)};
  }
  return limits;
}

}  // namespace

DiskSettings read_disk(const toml::table& table, const std::string& file) {
  TomlTable reader(table, file, "disk");
  DiskSettings disk;
  const toml::node* const inner = reader.node("inner");
  if (inner != nullptr && inner->is_string()) {
    reader.choice("inner", 0, {"isco"});
  } else if (inner != nullptr) {
    disk.inner = reader.number("inner", 6.0, least_r, greatest_r);
  }
  disk.outer = own_number(reader, "outer", disk.outer);
  disk.plunging = reader.boolean("plunging", disk.plunging);
  disk.profile = static_cast<DiskProfile>(reader.choice("profile", 0, {"page_thorne", "uniform"}));
  disk.temperature_k = own_number(reader, "temperature_K", disk.temperature_k);
  disk.limb_darkening = reader.boolean("limb_darkening", disk.limb_darkening);
  disk.opacity = own_number(reader, "opacity", disk.opacity);
  disk.exposure = own_number(reader, "exposure", disk.exposure);
  disk.pattern = static_cast<DiskPattern>(reader.choice("pattern", 0, {"none", "procedural"}));
  disk.contrast = own_number(reader, "contrast", disk.contrast);
  disk.speed = reader.number("speed", disk.speed, -1e6, 1e6);
  if (disk.plunging && disk.profile == DiskProfile::page_thorne) {
    throw reader.error_at("plunging",
                          "has no effect: profile = \"page_thorne\" has no light inside the innermost stable orbit",
                          "write profile = \"uniform\"");
  }
  if (disk.plunging && !disk.inner) {
    throw reader.error_at("plunging", "has no effect: the disk ends at the innermost stable orbit",
                          "set inner to a radius inside that orbit");
  }
  reader.refuse_unknown_keys();
  return disk;
}

void check_disk(const toml::table& table, const std::string& file, const Show& show) {
  const TomlTable reader(table, file, "disk");
  const DiskSettings& disk = *show.disk;
  const NumberLimits first = innermost_radii(show, disk.plunging);
  if (disk.inner && *disk.inner < first.least) {
    throw reader.error_at("inner",
                          fmt::format("is {} M, {}", *disk.inner,
                                      disk.plunging ? "inside the horizon" : "inside the innermost stable orbit"),
                          fmt::format("choose {:.6g} or more{}", six_digits_above(first.least),
                                      disk.plunging ? "" : ", or plunging = true with profile = \"uniform\""));
  }
  const double inner = disk.inner.value_or(first.least);
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

toml::table disk_table(const DiskSettings& disk) {
  constexpr const char* profiles[] = {"page_thorne", "uniform"};
  constexpr const char* patterns[] = {"none", "procedural"};
  toml::table table{{"outer", disk.outer},
                    {"plunging", disk.plunging},
                    {"profile", profiles[static_cast<int>(disk.profile)]},
                    {"temperature_K", disk.temperature_k},
                    {"limb_darkening", disk.limb_darkening},
                    {"opacity", disk.opacity},
                    {"exposure", disk.exposure},
                    {"pattern", patterns[static_cast<int>(disk.pattern)]},
                    {"contrast", disk.contrast},
                    {"speed", disk.speed}};
  if (disk.inner) {
    table.insert("inner", *disk.inner);
  } else {
    table.insert("inner", "isco");
  }
  return table;
}

}  // namespace ergodome
