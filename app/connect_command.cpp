#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "content/files/atomic_file.h"
#include "content/pair_table.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/schwarzschild/connecting_ray.h"

namespace ergodome {

namespace {

struct ConnectOptions {
  std::string pairs;
  std::string out;
};

//! What is written of a ray.
struct Answer {
  double xi = 0.0;           //!< [rad]
  double travel_time = 0.0;  //!< [M]
};

std::vector<Answer> connect_in_closed_form(const std::vector<PairRow>& rows) {
  constexpr std::size_t run = 100'000;  // a second's work: progress and Ctrl-C
  std::vector<Answer> answers(rows.size());
  Progress progress("connecting", static_cast<long>(std::max<std::size_t>(rows.size(), 1)));
  for (std::size_t begin = 0; begin < rows.size(); begin += run) {
    if (interrupted()) {
      throw Error("connect", "stopped; nothing was written", "run it again");
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

void run_connect(const ConnectOptions& options) {
  const std::vector<PairRow> rows = read_pair_table(options.pairs);
  const std::vector<Answer> answers = connect_in_closed_form(rows);
  std::string text = "r_obs,r,phi,order,xi,travel_time\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += fmt::format("{},{:.17g},{:.17g}\n", rows[i].text, answers[i].xi, answers[i].travel_time);
  }
  write_text_atomically(options.out, text);
}

}  // namespace

void add_connect_command(CLI::App& app) {
  auto options = std::make_shared<ConnectOptions>();
  CLI::App* command = app.add_subcommand(
      "connect", "Light rays between observers and points near a hole without spin, from a table to a table");
  command->add_option("--pairs", options->pairs, "table of pairs (CSV: r_obs,r,phi,order; M = 1, radians)")->required();
  command->add_option("--out", options->out, "table to write: the same with xi,travel_time")->required();
  command->callback([options] { run_connect(*options); });
}

}  // namespace ergodome
