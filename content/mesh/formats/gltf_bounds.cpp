#include "content/mesh/formats/gltf_bounds.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

using Json = nlohmann::json;

constexpr int deepest_nesting = 64;
//! Maximum number of JSON objects: each node, accessor and primitive is one, and takes up to a
//! kilobyte in memory.
constexpr long max_objects = 200'000;
constexpr long max_values = 2'000'000;

//! Counts the parser's events and stops it at a limit. The SAX parser does not recurse.
class Counter : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return value(); }
  bool boolean(bool /*value*/) override { return value(); }
  bool number_integer(number_integer_t /*value*/) override { return value(); }
  bool number_unsigned(number_unsigned_t /*value*/) override { return value(); }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return value(); }
  bool string(string_t& /*value*/) override { return value(); }
  bool binary(binary_t& /*value*/) override { return value(); }
  bool key(string_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*elements*/) override {
    return within(++objects_ <= max_objects, "has more than {} objects in its JSON", max_objects) && open();
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*elements*/) override { return open(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string& /*token*/, const Json::exception& /*problem*/) override {
    problem_ = fmt::format("is not valid JSON at byte {}", position);
    return false;
  }

  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  bool value() { return within(++values_ <= max_values, "has more than {} values in its JSON", max_values); }
  bool open() {
    return value() && within(++depth_ <= deepest_nesting, "nests its JSON deeper than {} levels", deepest_nesting);
  }
  bool close() {
    --depth_;
    return true;
  }
  bool within(bool holds, std::string_view problem, long limit) {
    if (!holds) {
      problem_ = fmt::format(fmt::runtime(problem), limit);
    }
    return holds;
  }

  int depth_ = 0;
  long objects_ = 0;
  long values_ = 0;
  std::string problem_;
};

}  // namespace

void require_bounded_gltf(std::string_view json, const std::string& location) {
  Counter counter;
  if (!Json::sax_parse(json, &counter)) {
    throw Error(location, counter.problem().empty() ? "is not valid JSON" : counter.problem(),
                "export it again, if necessary with fewer nodes and meshes");
  }
}

}  // namespace ergodome
