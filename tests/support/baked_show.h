#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "content/show/reading/show_reader.h"
#include "content/trajectory/trajectory_journal.h"
#include "render/bake/trajectory_baker.h"

// Shows and their trajectory files, for tests.
namespace ergodome::test {

//! Returns a show whose camera goes from r = 9 to 7 in ten seconds in front of the grid sky, for
//! small pictures.
inline Show approaching_show() {
  return parse_show(
      "duration_s = 10\n[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nt_s = 0\nr = 9\ntheta_deg = 70\nyaw_deg = 30\n"
      "[[camera.key]]\nt_s = 10\nr = 7\ntheta_deg = 80\nphi_deg = 40\nyaw_deg = 30\n"
      "[sky]\nmap = \"grid\"\n[view]\nprojection = \"dome\"\nsize_px = 200\n",
      "show.toml");
}

//! Returns a show with a disk that starts at the innermost stable orbit, for small pictures. The
//! camera goes from r = 30 to 22 in ten seconds, outside the disk.
inline Show show_with_disk(bool clouds = false) {
  Show show = parse_show(
      "duration_s = 10\n[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nt_s = 0\nr = 30\ntheta_deg = 70\n"
      "[[camera.key]]\nt_s = 10\nr = 22\ntheta_deg = 80\nphi_deg = 40\n"
      "[sky]\nmap = \"black\"\n[disk]\nouter = 15\n[view]\nfov_deg = 90\nsize_px = 200\n",
      "show.toml");
  show.disk->pattern = clouds ? DiskPattern::procedural : DiskPattern::none;
  return show;
}

//! Bakes a show into a finished trajectory file, for pixels of angle `pixel` [rad] and errors up to
//! `budget_px`.
inline void bake_to(const Show& show, const std::filesystem::path& file, double pixel, bool derivatives = true,
                    double budget_px = 0.25) {
  BakeSettings settings;
  settings.pixel = pixel;
  settings.budget_px = budget_px;
  settings.derivatives = derivatives;
  const std::filesystem::path part = file.string() + ".part";
  TrajectoryJournal journal(part, provenance_of(show, settings));
  journal.seal(file, bake_trajectory(show, settings, journal, [](double) { return true; }).times_s);
  std::filesystem::remove(part);
}

//! Flips a bit in the middle of a station in a trajectory file.
inline void damage_station(const std::filesystem::path& file, const StationEntry& station) {
  std::fstream raw(file, std::ios::binary | std::ios::in | std::ios::out);
  const auto at = static_cast<std::streamoff>(station.offset + station.bytes / 2);
  raw.seekg(at);
  const char old = static_cast<char>(raw.get());
  raw.seekp(at);
  raw.put(static_cast<char>(old ^ 1));
}

}  // namespace ergodome::test
