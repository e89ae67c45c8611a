#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/progress.h"
#include "app/commands/rays/ray_groups.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/tables/number_text.h"
#include "content/tables/pair_table.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/schwarzschild/connecting_ray.h"
#include "render/published/connection_table.h"

namespace ergodome {

namespace {

struct ConnectOptions {
  std::string pairs;
  std::string out;
  std::string method = "closed_form";
  int rows = 256;
  int columns = 512;
};

//! Output values of a ray.
struct Answer {
  double xi = 0.0;           //!< angle ξ at the observer, as in ConnectingRay [rad]
  double travel_time = 0.0;  //!< coordinate time of the ray [M]
};

std::vector<Answer> connect_in_closed_form(const std::vector<PairRow>& rows) {
  // Number of pairs to connect, in about a second, between checks for progress and Ctrl-C.
  constexpr std::size_t run = 100'000;
  std::vector<Answer> answers(rows.size());
  Progress progress("connecting", static_cast<long>(std::max<std::size_t>(rows.size(), 1)));
  for (std::size_t begin = 0; begin < rows.size(); begin += run) {
    if (interrupted()) {
      throw Error("connect", "was stopped before it wrote anything", "run it again");
    }
    const std::size_t count = std::min(run, rows.size() - begin);
    parallel_for(static_cast<int>(count), 64, [&](int from, int to) {
      for (std::size_t i = begin + static_cast<std::size_t>(from); i < begin + static_cast<std::size_t>(to); ++i) {
        const ConnectingRay ray = connecting_ray(rows[i].r_observer, rows[i].r, rows[i].angle);
        answers[i] = {ray.xi, ray.travel_time};
      }
    });
    progress.advance_to(static_cast<long>(begin + count));
  }
  return answers;
}

//! Returns the settings of the table for one observer, whose rows have the indices `of_observer`.
//! The table covers the range of radii of Müller, Schulz & Weiskopf, extended to the radii of these
//! rows. Throws Error for a radius above farthest_of_table.
ConnectionTableSettings table_settings(const std::vector<PairRow>& rows, const std::vector<std::size_t>& of_observer,
                                       const ConnectOptions& options) {
  ConnectionTableSettings settings;
  settings.rows = options.rows;
  settings.columns = options.columns;
  settings.r_observer_nearest = rows[of_observer.front()].r_observer;
  settings.r_observer_farthest = settings.r_observer_nearest;
  for (const std::size_t i : of_observer) {
    if (std::max(rows[i].r, rows[i].r_observer) > farthest_of_table) {
      throw Error(rows[i].location, fmt::format("has a radius above {:.9g}, where tables end", farthest_of_table),
                  "choose --method closed_form");
    }
    settings.orders = std::max(settings.orders, rows[i].order);
    settings.r_nearest = std::min(settings.r_nearest, rows[i].r);
    settings.r_farthest = std::max(settings.r_farthest, rows[i].r);
  }
  return settings;
}

std::vector<Answer> connect_through_tables(const std::vector<PairRow>& rows, const ConnectOptions& options) {
  std::map<double, std::vector<std::size_t>> observers;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    observers[rows[i].r_observer].push_back(i);
  }
  std::vector<Answer> answers(rows.size());
  Progress progress("connecting", static_cast<long>(std::max<std::size_t>(observers.size(), 1)));
  long done = 0;
  for (const auto& [r_observer, of_observer] : observers) {
    if (interrupted()) {
      throw Error("connect", "was stopped before it wrote anything", "run it again");
    }
    const ConnectionTableSettings settings = table_settings(rows, of_observer, options);
    const auto start = std::chrono::steady_clock::now();
    const ConnectionTable table(settings);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    for (const std::size_t i : of_observer) {
      const SeenPoint point = look_up_connection(table.view(), r_observer, rows[i].r, rows[i].angle);
      answers[i] = {point.xi, point.travel_time};
    }
    print_out(
        "r_obs {:.9g}: made a table of {} x {} nodes per order, for {} and points from r = {:.9g} to {:.9g}, from {} "
        "rays in {:.1f} ms\n",
        r_observer, settings.rows, settings.columns, counted(settings.orders, "order"), settings.r_nearest,
        settings.r_farthest, table.view().grid.fan_rows * fan_columns(table.view().grid), time.count());
    progress.advance_to(++done);
  }
  return answers;
}

void run_connect(const ConnectOptions& options) {
  require_table_ending("--out", options.out);
  require_output_file("--out", options.out, {options.pairs});
  const std::vector<PairRow> rows = read_pair_table(options.pairs);
  const std::vector<Answer> answers =
      options.method == "table" ? connect_through_tables(rows, options) : connect_in_closed_form(rows);
  LargeText text = "r_obs,r,phi,order,xi,travel_time\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += rows[i].text;
    text += ',';
    append_number(text, answers[i].xi);
    text += ',';
    append_number(text, answers[i].travel_time);
    text += '\n';
  }
  write_table(options.out, text);
}

}  // namespace

void add_connect_command(CLI::App& app) {
  auto options = std::make_shared<ConnectOptions>();
  CLI::App* command =
      app.add_subcommand("connect", "Find light rays from points to observers near a hole without spin, from a table");
  command->add_option("--pairs", options->pairs, "table of pairs (CSV: r_obs,r,phi,order; M = 1, radians)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--out", options->out, "table to write: the rows of --pairs with two more columns, xi,travel_time")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--method", options->method,
                   "closed_form, or table (interpolates in a table made for each observer)")
      ->check(CLI::IsMember({"closed_form", "table"}))
      ->capture_default_str();
  command->add_option("--rows", options->rows, "with --method table: nodes in 1/r")
      ->check(CLI::Range(4, 8192))
      ->capture_default_str();
  command->add_option("--columns", options->columns, "with --method table: nodes in azimuth for each order of images")
      ->check(CLI::Range(4, 8192))
      ->capture_default_str();
  IgnoredOptions ignored(*command);
  ignored.add("without --method table", [options] { return options->method != "table"; }, {"--rows", "--columns"});
  command->callback([options, ignored] {
    ignored.refuse();
    run_connect(*options);
  });
}

}  // namespace ergodome
