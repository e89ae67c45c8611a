#include "app/commands/farm/openjd_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "content/files/printable.h"

namespace ergodome {

namespace {

using Json = nlohmann::ordered_json;

//! Maximum length of a job's name.
constexpr std::size_t max_job_name = 128;

//! Returns the ranges of a step's tasks, "13:24", as a range expression: "1-12,13-24".
std::string frame_expression(const FarmStep& step) {
  std::string expression;
  for (const std::string& task : step.tasks) {
    std::string range = task;
    std::ranges::replace(range, ':', '-');
    expression += (expression.empty() ? "" : ",") + range;
  }
  return expression;
}

//! Returns the parameter of a step's tasks, and the argument of its script that depends on it.
std::pair<Json, std::string> task_parameter(const FarmStep& step, int chunk) {
  if (step.task_option == "--part") {
    return {Json{{"name", "Part"}, {"type", "INT"}, {"range", fmt::format("1-{}", step.tasks.size())}},
            fmt::format("{{{{Task.Param.Part}}}}/{}", step.tasks.size())};
  }
  return {Json{{"name", "Frame"},
               {"type", "CHUNK[INT]"},
               {"range", frame_expression(step)},
               {"chunks", {{"defaultTaskCount", chunk}, {"rangeConstraint", "CONTIGUOUS"}}}},
          "{{Task.Param.Frame}}"};
}

//! Returns the amounts that a host must have.
Json host_amounts(const TaskResources& resources) {
  Json amounts = Json::array();
  if (resources.cpus > 0) {
    amounts.push_back({{"name", "amount.worker.vcpu"}, {"min", resources.cpus}});
  }
  if (const long mib = memory_mib(resources.memory); mib > 0) {
    amounts.push_back({{"name", "amount.worker.memory"}, {"min", mib}});
  }
  if (const int gpus = std::atoi(resources.gpus.c_str()); gpus > 0) {
    amounts.push_back({{"name", "amount.worker.gpu"}, {"min", gpus}});
  }
  return amounts;
}

}  // namespace

std::string openjd_template(const FarmPlan& plan, const TaskResources& resources, const std::filesystem::path& run) {
  Json job = {{"specificationVersion", "jobtemplate-2023-09"},
              {"extensions", Json::array({"TASK_CHUNKING"})},
              {"name", std::string(shortened(printable(plan.name), max_job_name))},
              {"steps", Json::array()}};
  std::string before;
  for (const FarmStep& step : plan.steps) {
    Json json = {{"name", step.name}, {"description", step.description}};
    if (!before.empty()) {
      json["dependencies"] = Json::array({Json{{"dependsOn", before}}});
    }
    Json arguments = Json::array({(run / (step.name + ".sh")).string()});
    if (!step.task_option.empty()) {
      const auto [parameter, argument] = task_parameter(step, plan.chunk);
      json["parameterSpace"] = Json{{"taskParameterDefinitions", Json::array({parameter})}};
      arguments.push_back(argument);
    }
    if (const Json amounts = host_amounts(resources); !amounts.empty()) {
      json["hostRequirements"] = Json{{"amounts", amounts}};
    }
    const Json action = {{"command", "bash"}, {"args", arguments}};
    json["script"] = Json{{"actions", Json{{"onRun", action}}}};
    job["steps"].push_back(json);
    before = step.name;
  }
  return job.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ergodome
