#include "content/stars/star_catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "content/files/printable.h"
#include "content/show/show_errors.h"
#include "content/sky/sky_map.h"
#include "content/stars/star_file.h"
#include "content/stars/star_table.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {

//! Limit of the naked eye under a dark sky [mag].
constexpr float faintest_bright_star = 6.5F;

}  // namespace

void sort_by_brightness(std::vector<CatalogueStar>& stars) {
  std::stable_sort(stars.begin(), stars.end(),
                   [](const CatalogueStar& a, const CatalogueStar& b) { return a.v_mag < b.v_mag; });
}

Vector3<double> equatorial_direction(double ra_deg, double dec_deg) {
  const double across = std::cos(dec_deg * one_degree);
  return {across * std::cos(ra_deg * one_degree), across * std::sin(ra_deg * one_degree),
          std::sin(dec_deg * one_degree)};
}

bool is_built_in_catalogue(const std::string& name) { return name == "bright_stars" || name == "all_stars"; }

StarCatalogue load_stars(const Show& show) {
  const std::string& name = show.sky.stars;
  if (name.empty()) {
    return {};
  }
  static WorkCounter counter("load_stars");
  const WorkScope work(counter, 1);
  const bool bright = name == "bright_stars";
  if (is_built_in_catalogue(name)) {
    StarCatalogue built_in = read_star_file(built_in_content_folder() / "stars" / "hipparcos.stars");
    if (bright) {
      std::erase_if(built_in.stars, [](const CatalogueStar& star) { return star.v_mag > faintest_bright_star; });
    }
    built_in.name = name;
    return built_in;
  }
  return read_named(show, "sky.stars", name, [](const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) {
      throw Error(path.string(), "does not exist or is not a regular file",
                  "give a built-in star table (bright_stars, all_stars) or the path of one");
    }
    StarCatalogue read = read_stars(path);
    if (read.stars.empty() && !read.left_out.empty()) {
      throw Error(path.string(), fmt::format("contains no usable star: {}", text_of(read.left_out)),
                  "give each star a right ascension, a declination and a magnitude");
    }
    return read;
  });
}

std::size_t count_of(const std::vector<RowsLeftOut>& left_out) {
  return std::accumulate(left_out.begin(), left_out.end(), std::size_t{0},
                         [](std::size_t sum, const RowsLeftOut& rows) { return sum + rows.count; });
}

std::string text_of(const std::vector<RowsLeftOut>& left_out) {
  std::string text = counted(count_of(left_out), "row") + " skipped";
  for (const RowsLeftOut& rows : left_out) {
    text += fmt::format("{} {} {} ({}line {})", &rows == &left_out.front() ? ":" : ",", counted(rows.count, "row"),
                        rows.why, rows.count > 1 ? "first in " : "", rows.first_line);
  }
  return text;
}

bool lacks_stars(const std::vector<RowsLeftOut>& left_out) {
  return std::ranges::any_of(left_out, [](const RowsLeftOut& rows) { return !rows.meant; });
}

std::string note_of_left_out(const Show& show, const std::vector<RowsLeftOut>& left_out) {
  std::vector<RowsLeftOut> lost = left_out;
  std::erase_if(lost, [](const RowsLeftOut& rows) { return rows.meant; });
  return named_by(show, "sky.stars",
                  Error((std::filesystem::path(show.folder) / show.sky.stars).string(), text_of(lost),
                        "complete or remove these rows"))
      .what();
}

std::string note_of_no_stars(const Show& show) {
  return named_by(show, "sky.stars",
                  Error((std::filesystem::path(show.folder) / show.sky.stars).string(), "contains no stars",
                        "choose another star table, or remove sky.stars"))
      .what();
}

StarCatalogue read_stars(const std::filesystem::path& path) {
  StarCatalogue catalogue = is_star_file(path) ? read_star_file(path) : read_star_table(path);
  catalogue.name = (path.extension() == ".gz" ? path.stem() : path).stem().string();
  return catalogue;
}

}  // namespace ergodome
