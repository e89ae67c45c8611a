#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/cli/commands.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/sky/sky_map.h"
#include "content/stars/star_catalogue.h"
#include "content/stars/star_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

struct CatalogueOptions {
  std::string stars;
  std::string out;
  float faintest = 60.0F;
  bool replace = false;
};

//! Throws Error if the output exists and is not an Ergodome catalogue, such as a user's table or a
//! show, unless --replace is given.
void require_star_file(const CatalogueOptions& options) {
  std::error_code problem;
  if (!options.replace && std::filesystem::exists(options.out, problem) && !is_star_file(options.out)) {
    throw Error("--out " + options.out, "already exists and is not an Ergodome catalogue",
                "choose another name, or add --replace to overwrite it");
  }
}

void print_summary(const StarCatalogue& catalogue) {
  const auto& stars = catalogue.stars;
  const auto colourless = std::ranges::count_if(stars, [](const CatalogueStar& star) { return std::isnan(star.b_v); });
  print_out("{}: {}, {} without a color, {}\n", catalogue.name, counted(stars.size(), "star"), colourless,
            text_of(catalogue.left_out));
  if (!catalogue.read_as.empty()) {
    print_out("read as {}\n", catalogue.read_as);
  }
  if (!stars.empty()) {
    print_out("V {:.2f} to {:.2f}; the brightest:\n  number   RA [deg]  Dec [deg]       V     B-V\n",
              stars.front().v_mag, stars.back().v_mag);
  }
  for (const CatalogueStar& star : std::span(stars).first(std::min<std::size_t>(stars.size(), 5))) {
    print_out("{:8} {:10.4f} {:10.4f} {:7.2f} {:>7}\n", star.number, star.ra_deg, star.dec_deg, star.v_mag,
              std::isnan(star.b_v) ? "-" : fmt::format("{:.3f}", star.b_v));
  }
}

void run(const CatalogueOptions& options) {
  require_output_file("--out", options.out, {options.stars});
  if (is_built_in_catalogue(options.stars)) {
    require_other_file("--out", options.out, {built_in_content_folder() / "stars" / "hipparcos.stars"});
  }
  require_star_file(options);
  Show show;
  show.sky.stars = options.stars;
  StarCatalogue catalogue = load_stars(show);
  const auto fainter =
      std::erase_if(catalogue.stars, [&](const CatalogueStar& star) { return star.v_mag > options.faintest; });
  print_summary(catalogue);
  if (fainter > 0) {
    print_out("left out: {} fainter than V {}\n", fainter, options.faintest);
  }
  if (!options.out.empty()) {
    write_star_file(catalogue, options.out);
    print_out("written to {}: {} bytes\n", options.out, std::filesystem::file_size(options.out));
  }
}

}  // namespace

void add_catalogue_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("catalogue", "Summarize a star catalogue, and convert it to Ergodome's own format");
  auto options = std::make_shared<CatalogueOptions>();
  command
      ->add_option("stars", options->stars,
                   "bright_stars, all_stars, or a file: a table (.csv, .tsv, .csv.gz) or an Ergodome catalogue")
      ->required();
  CLI::Option* const out =
      command->add_option("--out", options->out, "catalogue to write, in Ergodome's own format")->type_name("FILE");
  command->add_option("--faintest", options->faintest, "leave out stars fainter than this V magnitude")
      ->check(number_between(-30.0, 60.0));
  command->add_flag("--replace", options->replace, "overwrite --out even if it is not an Ergodome catalogue")
      ->needs(out);
  command->callback([options] { run(*options); });
}

}  // namespace ergodome
