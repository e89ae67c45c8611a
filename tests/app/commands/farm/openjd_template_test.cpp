#include "app/commands/farm/openjd_template.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/commands/farm/test_plan.h"

namespace ergodome {
namespace {

nlohmann::json template_of(const TaskResources& resources) {
  return nlohmann::json::parse(openjd_template(test::test_plan("/shared"), resources, "/shared/film/farm/runs/0001"));
}

TEST(OpenJobTemplate, NamesItsSpecificationAndExtension) {
  const nlohmann::json job = template_of({});
  EXPECT_EQ(job["specificationVersion"], "jobtemplate-2023-09");
  EXPECT_EQ(job["extensions"], nlohmann::json::array({"TASK_CHUNKING"}));
  EXPECT_EQ(job["name"], "moving");
}

TEST(OpenJobTemplate, RendersFramesInChunks) {
  const nlohmann::json step = template_of({})["steps"][2];
  EXPECT_EQ(step["name"], "render");
  const nlohmann::json parameter = step["parameterSpace"]["taskParameterDefinitions"][0];
  EXPECT_EQ(parameter["type"], "CHUNK[INT]");
  EXPECT_EQ(parameter["range"], "1-12,13-24,49-60");
  EXPECT_EQ(parameter["chunks"]["defaultTaskCount"], 12);
  EXPECT_EQ(parameter["chunks"]["rangeConstraint"], "CONTIGUOUS");
  EXPECT_EQ(step["script"]["actions"]["onRun"]["command"], "bash");
  EXPECT_EQ(step["script"]["actions"]["onRun"]["args"],
            nlohmann::json::array({"/shared/film/farm/runs/0001/render.sh", "{{Task.Param.Frame}}"}));
}

TEST(OpenJobTemplate, BakesPartsAndJoinsThemAfterwards) {
  const nlohmann::json steps = template_of({})["steps"];
  EXPECT_EQ(steps[0]["parameterSpace"]["taskParameterDefinitions"][0]["range"], "1-2");
  EXPECT_EQ(steps[0]["script"]["actions"]["onRun"]["args"][1], "{{Task.Param.Part}}/2");
  EXPECT_FALSE(steps[0].contains("dependencies"));
  EXPECT_FALSE(steps[1].contains("parameterSpace"));
  EXPECT_EQ(steps[1]["dependencies"], nlohmann::json::parse(R"([{"dependsOn": "bake"}])"));
}

TEST(OpenJobTemplate, AsksForResourcesOnlyIfTheyAreGiven) {
  EXPECT_FALSE(template_of({})["steps"][0].contains("hostRequirements"));
  EXPECT_EQ(template_of({8, "16G", "2", "", "", ""})["steps"][0]["hostRequirements"]["amounts"],
            nlohmann::json::parse(R"([{"name": "amount.worker.vcpu", "min": 8},
                                      {"name": "amount.worker.memory", "min": 16384},
                                      {"name": "amount.worker.gpu", "min": 2}])"));
}

}  // namespace
}  // namespace ergodome
