#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/backend_choice.h"
#include "app/cli/commands.h"
#include "app/cli/lens_options.h"
#include "app/cli/option_checks.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/summary_text.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/inspect/show_summary.h"
#include "app/commands/render/run_cost.h"
#include "content/files/console.h"
#include "content/show/animatable_number.h"
#include "content/sky/sky_map.h"
#include "kernels/core/error.h"
#include "kernels/launch/work_counter.h"
#include "render/frame/frame_passes.h"
#include "render/frame/show_renderer.h"
#include "render/passes/objects/object_pass.h"

namespace ergodome {

namespace {

struct PlanOptions : ShowOverrides {
  std::string show;
  std::string backend = "auto";
  std::string view = "sky";
  std::string method;
  LensOptions lens;
  int size_px = 0;
  double time_s = 0.0;
  std::string format = "png";
  std::string out = "frames";
  bool measure = false;
  bool json = false;
};

//! Work counts of the first frame at a camera position, and of a second frame at the same position.
struct Measured {
  std::map<std::string, WorkCount> first;
  std::map<std::string, WorkCount> next;
  double next_ms = 0.0;
};

Measured measure(const PlanOptions& options, const Show& show, Backend backend, std::shared_ptr<StationStream> stream) {
  Measured measured;
  const auto start = work_done();
  ShowRenderer renderer(show, backend, lens_choice(options.lens), std::move(stream));
  const ViewChoice choice = {view_mode(options.view), options.size_px,
                             follow_method(options.method, options.view, show)};
  renderer.render(options.time_s, choice);
  const auto first = work_done();
  const auto begin = std::chrono::steady_clock::now();
  renderer.render(options.time_s, choice);
  measured.next_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  measured.first = work_between(start, first);
  measured.next = work_between(first, work_done());
  return measured;
}

//! Time and disk space of rendering the whole show.
struct RunEstimate {
  int frames = 0;
  int measured_frame = 0;  //!< frame that was measured, counted from 0
  RunFrameCost frame;
  std::uintmax_t free_bytes = 0;  //!< free space on the disk of --out

  [[nodiscard]] std::uintmax_t bytes() const { return frame.bytes * static_cast<std::uintmax_t>(frames); }
};

//! Returns whether the buffers of a frame, as far as their size is known, fit in half of this
//! machine's memory.
bool fits_in_memory(const FramePlan& plan) {
  double bytes = 0.0;
  for (const PlannedBuffer& buffer : plan.buffers) {
    bytes += static_cast<double>(buffer.bytes);
  }
  return bytes <= 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

//! Measures a frame in the middle of the show and assumes that all frames cost the same. Returns
//! nothing, after a note, if that fails.
std::optional<RunEstimate> estimate(const PlanOptions& options, const Show& show, Backend backend,
                                    std::shared_ptr<StationStream> stream, const FramePlan& plan) {
  if (!fits_in_memory(plan)) {
    print_note("cannot estimate time and disk space: a frame needs more than half of this machine's memory");
    return std::nullopt;
  }
  try {
    ShowRenderer renderer(show, backend, lens_choice(options.lens), std::move(stream));
    const ViewChoice choice = {view_mode(options.view), options.size_px,
                               follow_method(options.method, options.view, show)};
    RunEstimate estimate;
    estimate.frames = frame_count(show);
    const MeasuredFrame measured =
        measured_frame(renderer, choice, frame_format(options.format, "", false), estimate.frames / 2);
    estimate.measured_frame = measured.frame;
    estimate.frame = measured.cost;
    estimate.free_bytes = free_bytes(options.out);
    return estimate;
  } catch (const std::exception& problem) {
    print_note("cannot estimate time and disk space: {}", problem.what());
    return std::nullopt;
  }
}

nlohmann::json json_of(const RunEstimate& estimate) {
  return {{"frames", estimate.frames},
          {"measured_frame", estimate.measured_frame + 1},
          {"frame_s", estimate.frame.seconds},
          {"frame_bytes", estimate.frame.bytes},
          {"run_s", estimate.frames * estimate.frame.seconds},
          {"run_bytes", estimate.bytes()},
          {"free_bytes", estimate.free_bytes}};
}

nlohmann::json json_of(const WorkCount& count) {
  return {{"runs", count.runs}, {"elements", count.elements}, {"ms", static_cast<double>(count.time_ns) * 1e-6}};
}

//! Returns null for 0, which stands for a count that the plan leaves open.
nlohmann::json known(long number) { return number > 0 ? nlohmann::json(number) : nlohmann::json(nullptr); }

nlohmann::json json_of(const Show& show, const FramePlan& plan) {
  constexpr const char* moments[] = {"start", "place", "picture"};
  nlohmann::json all = {{"show", text_in(show.title, "")},
                        {"width_px", plan.width_px},
                        {"height_px", plan.height_px},
                        {"eyes", plan.eyes},
                        {"lens", plan.lens},
                        {"channels", nlohmann::json::array()},
                        {"passes", nlohmann::json::array()},
                        {"buffers", nlohmann::json::array()}};
  for (const PlannedChannel& channel : plan.channels) {
    all["channels"].push_back({{"name", channel.name}, {"floats", channel.floats}, {"why", channel.why}});
  }
  for (const PlannedPass& pass : plan.passes) {
    all["passes"].push_back({{"name", pass.name},
                             {"when", moments[static_cast<int>(pass.moment)]},
                             {"runs", known(pass.runs)},
                             {"elements", known(pass.elements)},
                             {"if_needed", pass.if_needed},
                             {"why", pass.why}});
  }
  for (const PlannedBuffer& buffer : plan.buffers) {
    all["buffers"].push_back({{"name", buffer.name},
                              {"when", moments[static_cast<int>(buffer.moment)]},
                              {"bytes", known(buffer.bytes)},
                              {"why", buffer.why}});
  }
  all["idle"] = summary_of_unused_keys(show);
  return all;
}

std::string text_of(const nlohmann::json& number) {
  return number.is_null() ? "-" : fmt::format("{}", number.get<long>());
}

void print(const nlohmann::json& plan) {
  print_out("{}: {} x {} pixels, {} {}, lens: {}\n", plan["show"].get<std::string>(), plan["width_px"].get<int>(),
            plan["height_px"].get<int>(), plan["eyes"].get<int>(), plan["eyes"] == 1 ? "eye" : "eyes",
            plan["lens"].get<std::string>());
  print_out("\nper pixel         floats  reason\n");
  for (const auto& channel : plan["channels"]) {
    print_out("  {:<16}{:>6}  {}\n", channel["name"].get<std::string>(), channel["floats"].get<int>(),
              channel["why"].get<std::string>());
  }
  print_out("\npass                           run once per      runs    elements  reason\n");
  for (const auto& pass : plan["passes"]) {
    print_out("  {:<33}{:<8}{:>10}{:>12}  {}{}\n", pass["name"].get<std::string>(), pass["when"].get<std::string>(),
              text_of(pass["runs"]), text_of(pass["elements"]), pass["why"].get<std::string>(),
              pass["if_needed"].get<bool>() ? ", if needed" : "");
  }
  print_out("\nmemory                                filled once per       bytes  reason\n");
  for (const auto& buffer : plan["buffers"]) {
    print_out("  {:<43}{:<8}{:>12}  {}\n", buffer["name"].get<std::string>().substr(8),
              buffer["when"].get<std::string>(), text_of(buffer["bytes"]), buffer["why"].get<std::string>());
  }
  print_out("\n-: not known in advance\n");
  print_unused_keys(plan["idle"]);
}

void print(const Measured& measured) {
  print_out("\nmeasured                                     first frame there          next frame: {:.1f} ms\n",
            measured.next_ms);
  print_out("                                            runs      elements        runs      elements        ms\n");
  for (const auto& [name, count] : measured.first) {
    const auto next = measured.next.find(name);
    const WorkCount again = next != measured.next.end() ? next->second : WorkCount{};
    print_out("  {:<40}{:>6}{:>14}{:>12}{:>14}{:>10.2f}\n", name, count.runs, count.elements, again.runs,
              again.elements, static_cast<double>(again.time_ns) * 1e-6);
  }
  print_out("\nTimes of passes include the kernels that they call. Elements of buffers are bytes.\n");
}

void print(const RunEstimate& estimate, const PlanOptions& options) {
  print_out("\nrender: {}\n", run_cost_text(estimate.frames, estimate.frame));
  print_out("  measured on frame {}, in the middle of the show, written as {}\n  free disk space for {}: {}\n",
            estimate.measured_frame + 1, options.format, options.out, size_text(estimate.free_bytes));
}

void run(const PlanOptions& options) {
  Show show = load_show(options.show, options.set);
  if (options.measure) {
    require_time("plan --time", show, options.time_s);
  }
  apply_overrides(show, options, false);
  require_two_eyes(show, "--baseline", options.baseline.has_value());
  require_used_memory(show, options.lens);
  require_features(show);
  const Backend backend = choose_backend(options.backend);
  std::shared_ptr<StationStream> stream = open_stream(show, options.lens, backend);
  for (const std::string& note : stream_notes(stream.get(), show, options.lens, backend, options.size_px)) {
    print_note_once(note);
  }
  const std::optional<BaselineReductions> reduced = baseline_reductions(show);
  if (reduced) {
    print_note_once(note_of(show, *reduced));
  }
  const FrameRequest request = {
      backend,
      view_mode(options.view),
      lens_choice(options.lens),
      follow_method(options.method, options.view, show),
      options.size_px,
      load_sky_map(show).width,
      stream && (lens_choice(options.lens) == LensChoice::streamed || is_fine_enough(*stream, show, options.size_px)),
      OverlayPass::image_bytes(show),
      has_objects(show, ObjectMethod::polygon) ? ObjectPass::mesh_bytes(show) : 0};
  const FramePlan planned = plan_frame(show, request);
  nlohmann::json plan = json_of(show, planned);
  plan["narrowed_eyes"] = reduced ? summary_of(*reduced) : nlohmann::json(nullptr);
  std::optional<Measured> measured;
  if (options.measure) {
    measured = measure(options, show, backend, stream);
  }
  const std::optional<RunEstimate> whole = estimate(options, show, backend, std::move(stream), planned);
  const std::string room = whole ? room_note(options.out, "the show", whole->bytes(), whole->free_bytes) : "";
  if (!room.empty()) {
    print_note("{}", room);
  }
  plan["estimate"] = whole ? json_of(*whole) : nlohmann::json(nullptr);
  if (!options.json) {
    print(plan);
    if (measured) {
      print(*measured);
    }
    if (whole) {
      print(*whole, options);
    }
    return;
  }
  if (measured) {
    plan["measured"]["picture_ms"] = measured->next_ms;
    for (const auto& [name, count] : measured->first) {
      plan["measured"]["first"][name] = json_of(count);
    }
    for (const auto& [name, count] : measured->next) {
      plan["measured"]["next"][name] = json_of(count);
    }
  }
  print_out("{}\n", json_text(plan));
}

}  // namespace

void add_plan_command(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand(
      "plan", "Print what a frame computes and why, and estimate the time and disk space of all frames");
  command->add_option("show", options->show, "show file (.toml) or name of a built-in show")->required();
  add_set_option(*command, options->set);
  command->add_option("--size", options->size_px, "width of one eye's image in pixels (default: the show's)")
      ->check(CLI::Range(1, 16384));
  CLI::Option* const measure =
      command->add_flag("--measure", options->measure, "render a frame twice, and report its work and times");
  command->add_option("--time", options->time_s, "with --measure: time in the show [s]")
      ->check(show_time())
      ->needs(measure)
      ->capture_default_str();
  command->add_option("--format", options->format, "format of the frames: png, png16, tiff or exr")
      ->check(CLI::IsMember(image_format_names()))
      ->capture_default_str();
  command->add_option("--out", options->out, "folder planned for the frames, to compare with its free disk space")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  add_projection_options(*command, *options, "the show's");
  add_objects_option(*command, *options);
  add_view_option(*command, options->view);
  add_method_option(*command, options->method);
  add_stereo_options(*command, *options);
  add_backend_option(*command, options->backend);
  IgnoredOptions ignored(*command);
  add_lens_options(*command, options->lens, ignored);
  command->callback([options, ignored] {
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
